// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// dob of a design: adapter, random stimulus, and the chain beside clock(). docs/blocks/dob.md
#pragma once

#include <Vdob.h>

#include <algorithm>

#include "../../wave/mult/shared_mult.hpp"
#include "../lowpass/exact.hpp"
#include "dob_twin.hpp"
#include "lock_step.hpp"
#include "ports.hpp"

namespace feltgate::test {

using Observer = Dob<Design>;
using Chain = ObserverStep<Design, Fixed>;
using Current = Observer::Current;
using Velocity = Observer::Velocity;

/// What one wave works on: two signals and three words.
struct Wave {
  std::int64_t current = 0, velocity = 0;
  std::int64_t torque_constant = parameter(Design::A::torque_constant).raw;
  std::int64_t inertia_gain = parameter(Design::A::inertia_gain).raw;
  std::int64_t a1 = parameter(Design::A::observer_a1).raw;
  bool armed = false;
};
using Twin = Watched<Observer, Wave>;

/// The wave as the chain takes it.
inline void tick(Chain& chain, const Wave& w) {
  struct Coefficients {
    const Wave& wave;
    auto torque_constant() const {
      return Observer::TorqueConstant::from_raw(wave.torque_constant);
    }
    auto inertia_gain() const { return Observer::InertiaGain::from_raw(wave.inertia_gain); }
    auto observer_a1() const { return fixed_of<Design::P::observer_a1.key()>::from_raw(wave.a1); }
  };
  chain.tick(Coefficients{w}, w.armed, Current::from_raw(w.current),
             Velocity::from_raw(w.velocity));
}

struct Adapter {
  static void drive(Vdob& rtl, const Twin::In& in) {
    rtl.armed_i = in.port.armed;
    FELTGATE_STROBES(rtl, in.port.wave, at, T, drive_torque, observer_input, observer_difference,
                     observer_state, observed, observed_rounded, tau_hat);
    rtl.product_i = port_bits<53, std::uint64_t>(in.port.product);
  }
  template <class Check>
  static void compare(Check& check, const Vdob& rtl, const Twin::Out& out) {
    if (out.clocked) {
      check("operand", sign_extend<Design::f.observer_difference.width()>(rtl.operand_o),
            out.port.operand);
    }
    check("tau_hat", sign_extend<Design::f.torque.width()>(rtl.tau_hat_o), out.port.tau_hat);
    check("saturated", rtl.saturated_o, out.port.saturated);
  }
};

using Bench = LockStep<Vdob, Twin, Adapter>;

/// In this clock the step T is taken.
inline bool at(const Twin::In& in, int t) { return ((in.port.wave >> t) & 1u) != 0; }

/// The clocks of the observer in waves of next(wave number).
template <class Next>
struct Waves {
  Waves(std::uint64_t seed, Next n, std::uint32_t more_clocks)
      : next(n), mult(seed), gaps(seed + 1), spread(more_clocks) {}

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    if (out.resets != resets) {
      resets = out.resets;
      clock = kStart;
      wave = 0;
    }
    if (clock == kStart) {
      in.aside = next(wave++);
      in.port.armed = in.aside.armed;
      period = kShortest + static_cast<int>(gaps.below(spread));
    }
    in.port.wave = clock < Map::wave_length ? std::uint64_t{1} << clock : 0;
    in.port.product = mult.product();
    if (clock == Map::W::torque_constant) {
      mult.operands(in.aside.current, in.aside.torque_constant);
    } else if (clock == Map::W::inertia_gain) {
      mult.operands(in.aside.velocity, in.aside.inertia_gain);
    } else if (clock == Map::W::observer_a1) {
      mult.operands(out.port.operand, in.aside.a1);
    } else if (clock == Map::T::observed - Map::multiplier_latency ||
               clock == Map::T::observed_rounded - Map::multiplier_latency) {
      mult.operands(0, 1);  // nothing is on the operand bus
    } else {
      mult.others();
    }
    clock = clock + 1 == kStart + period ? kStart : clock + 1;
    return in;
  }

  static constexpr int kStart = 0;
  static constexpr int kShortest = Map::T::tau_hat + 2 - kStart;
  Next next;
  SharedMult mult;
  Random gaps;
  std::uint32_t spread;
  Twin::In in;
  std::int64_t resets = 0, wave = 0;
  int clock = kStart, period = kShortest;
};

/// Currents and velocities of every size, held or jumping; coefficients of the design or any;
/// arming and disarming between waves.
struct RandomWaves {
  Random random{13};
  Wave wave;
  int left = 0;

  template <class Number>
  std::int64_t any() {
    const auto word = static_cast<std::int64_t>(random.bits()) >> (64 - Number::width);
    if (random.one_in(8)) return random.coin() ? Number::max_raw() : Number::min_raw();
    return word >> random.below(Number::width);
  }
  Wave operator()(std::int64_t) {
    if (random.one_in(50)) wave.armed = !wave.armed;
    if (left-- > 0) {
      if (random.coin()) return wave;
      wave.velocity += random.between(-20000, 20000);  // a motion without jumps
      wave.velocity = std::min(std::max(wave.velocity, Velocity::min_raw()), Velocity::max_raw());
      return wave;
    }
    left = static_cast<int>(random.below(60));
    wave.current = any<Current>();
    wave.velocity = any<Velocity>();
    const Wave design;
    const bool others = random.one_in(4);
    wave.torque_constant = others ? random.between(0, 131071) : design.torque_constant;
    wave.inertia_gain = others ? random.between(0, 131071) : design.inertia_gain;
    wave.a1 = others ? random.between(0, 131071) : design.a1;
    return wave;
  }
};

struct Tally {
  std::int64_t waves = 0, armed = 0, saturated = 0, arming = 0, disarmed_in_motion = 0;
};

/// The chain's tau_hat is due in the clock after its step; disarmed it is 0.
struct ChainBeside {
  Tally* tally;
  Chain shadow{};
  bool was_armed = false;

  const char* operator()(const Twin::In& in, const Vdob& rtl, const Twin&, bool in_reset) {
    if (in_reset) {
      shadow = {};
      return nullptr;
    }
    if (!at(in, Map::T::tau_hat)) return nullptr;
    tick(shadow, in.aside);
    ++tally->waves;
    if (in.port.armed) ++tally->armed;
    if (in.port.armed && !was_armed) ++tally->arming;
    if (!in.port.armed && in.aside.velocity != 0) ++tally->disarmed_in_motion;
    was_armed = in.port.armed;
    if (shadow.limit) ++tally->saturated;
    const std::int64_t tau_hat = sign_extend<Design::f.torque.width()>(rtl.tau_hat_o);
    if (tau_hat != shadow.tau_hat.raw()) return "tau_hat of the chain is that of clock()";
    if ((rtl.saturated_o != 0) != shadow.limit) return "saturated of the chain";
    if (!in.port.armed && tau_hat != 0) return "tau_hat is 0 while disarmed";
    return nullptr;
  }
};

}  // namespace feltgate::test
