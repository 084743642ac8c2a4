// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The ramp of a design after the core's limiter: adapter, waves, and the chain compared with
// clock(). Documentation: docs/blocks/torque_control.md
#pragma once

#include <Vramp.h>

#include "../../estimators/lowpass/exact.hpp"
#include "../limiter/shared_limiter.hpp"
#include "lock_step.hpp"
#include "ports.hpp"
#include "ramp_twin.hpp"

namespace feltgate::test {

using Law = RampLaw<Design, Fixed>;
using Torque = Law::Torque;
using Rendered = fixed_of<Design::f.scene_torque.key()>;
using Step = fixed_of<Design::P::ramp_step.key()>;
constexpr int kFine = Design::f.ramp.fraction - Design::f.torque.fraction;

/// The inputs of one wave.
struct Wave {
  bool armed = true;
  int scene = 0;
  bool restart = false;                              ///< the torque may jump in this wave
  std::int64_t rendered = 0;                         ///< torque of the scene
  std::int64_t limit = Torque::max_raw(), step = 0;  ///< words
  int pulse = 0;  ///< sign of the self-test's, while the ramp takes the motor for disarmed
  Relief relief;
};
using Twin = Watched<Ramp<Design>, Wave>;

struct Adapter {
  static void drive(Vramp& rtl, const Twin::In& in) {
    rtl.armed_i = in.port.armed;
    rtl.restart_i = in.port.restart;
    rtl.scene_i = static_cast<std::uint8_t>(in.port.scene);
    FELTGATE_STROBES(rtl, in.port.wave, at, T, ramp_begin, ramp_excess, ramp_change, tau_ref);
    rtl.param_i = in.port.param;
    rtl.limited_i = port_bits<Design::f.torque.width()>(in.port.limited);
    rtl.over_limit_i = in.port.over_limit;
    rtl.frozen_i = in.port.relief.frozen;
    rtl.derated_i = in.port.relief.derated;
  }
  template <class Check>
  static void compare(Check& check, const Vramp& rtl, const Twin::Out& out) {
    check("tau_ref", sign_extend<Torque::width>(rtl.tau_ref_o), out.port.tau_ref);
    check("limit_torque", rtl.limit_torque_o, out.port.limit_torque);
    check("limit_ramp", rtl.limit_ramp_o, out.port.limit_ramp);
    check("limit_hold", rtl.limit_hold_o, out.port.limit_hold);
  }
};

using Bench = LockStep<Vramp, Twin, Adapter>;

/// In this clock the step T is taken.
inline bool at(const Twin::In& in, int t) { return ((in.port.wave >> t) & 1u) != 0; }

/// The clocks of the ramp in waves of next(wave number).
template <class Next>
struct Waves {
  Waves(std::uint64_t seed, Next n, std::uint32_t more_clocks)
      : next(n), limiter(seed), garbage(seed + 1), spread(more_clocks) {
    following = next(wave++);
  }

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    if (out.resets != resets) {
      resets = out.resets;
      clock = 0;
      wave = 0;
      following = next(wave++);
    }
    if (clock == 0) {
      in.aside = following;
      in.port.armed = in.aside.armed;
      in.port.scene = in.aside.scene;
      in.port.relief = in.aside.relief;
      period = kShortest + static_cast<int>(garbage.below(spread));
      following = next(wave++);
    }
    in.port.restart = clock + 1 == period && following.restart;
    const bool limits = clock == Map::W::torque_limit;
    std::int64_t word = static_cast<std::int64_t>(garbage.bits() & 0xffffffff);
    if (limits) word = in.aside.limit;
    if (clock == Map::W::ramp_step) word = in.aside.step;
    in.port.wave = clock < Map::wave_length ? std::uint64_t{1} << clock : 0;
    in.port.param = static_cast<std::uint32_t>(word & 0xffffffff);
    in.port.limited = limiter.limited();
    in.port.over_limit = limiter.beyond();
    // Disarmed, the scenes give 0; the self-test gives what is beyond every limit.
    const std::int64_t over_limit = in.aside.pulse > 0   ? Rendered::max_raw()
                                    : in.aside.pulse < 0 ? Rendered::min_raw()
                                                         : 0;
    const std::int64_t x = limits ? (in.aside.armed ? in.aside.rendered : over_limit) : 0;
    const bool comes = clock == Map::W::torque_limit - 1;
    limiter.clock(limits, {comes, 0, x, in.port.param, comes});
    clock = clock + 1 == period ? 0 : clock + 1;
    return in;
  }

  static constexpr int kShortest = Map::T::tau_ref + 2;
  Next next;
  SharedLimiter<Design> limiter;
  Random garbage;
  std::uint32_t spread;
  Twin::In in;
  Wave following{};  ///< the wave to come: what it restarts is told at the end of this one
  std::int64_t resets = 0, wave = 0;
  int clock = 0, period = kShortest;
};

/// By direction or sign where it has one: [0] down, [1] up.
struct Tally {
  std::int64_t waves = 0, disarmed = 0, free = 0, limited[2] = {}, ramping[2] = {}, ended[2] = {},
               scene_changes = 0, restarts = 0, held = 0, negative_step = 0, negative_limit = 0,
               derated_changes = 0, frozen[2] = {}, fallen[2] = {}, pulsed = 0, pulsed_frozen = 0;
};

/// Checks that the chain gives the same result, and the properties of limit and ramp.
struct ChainBeside {
  Tally* tally;
  Law chain{};
  std::int64_t before = 0;
  bool was_ramping = true;
  int scene = 0;
  bool derated = false;

  const char* operator()(const Twin::In& in, const Vramp& rtl, const Twin&, bool in_reset) {
    if (in_reset) {
      *this = ChainBeside{tally};
      return nullptr;
    }
    if (!at(in, Map::T::tau_ref)) return nullptr;
    const Wave& w = in.aside;
    const std::int64_t limit = decode_word(Design::f.limiter, static_cast<std::uint32_t>(w.limit));
    const std::int64_t step = decode_word(Step::format, static_cast<std::uint32_t>(w.step));
    if (w.restart) chain.restart();
    chain.begin(w.armed, w.scene, w.relief);
    const bool pulsed = !w.armed && w.pulse != 0;
    if (pulsed) {
      chain.pulse(w.pulse, Fixed::from_raw<Law::kLimitKey>(limit));
    } else {
      chain.limit(Rendered::from_raw(w.rendered), Fixed::from_raw<Law::kLimitKey>(limit));
    }
    chain.move(Fixed::from_raw<Step::format.key()>(step));
    const std::int64_t tau = sign_extend<Torque::width>(rtl.tau_ref_o);
    const bool ramped = rtl.limit_ramp_o != 0;
    count(w, limit, step, tau, ramped);
    const std::int64_t moved = tau > before ? tau - before : before - tau;
    const bool grown = before < 0 ? tau < before || tau > 0 : tau < 0 || tau > before;
    before = tau;
    was_ramping = ramped;
    scene = w.scene;
    derated = w.relief.derated;
    if (chain.tau_ref().raw() != tau) return "tau_ref of the chain is that of clock()";
    if (chain.limit_torque() != (rtl.limit_torque_o != 0)) return "limit_torque of the chain";
    if (chain.limit_ramp() != ramped) return "limit_ramp of the chain";
    if (chain.limit_hold() != (rtl.limit_hold_o != 0)) return "limit_hold of the chain";
    if (w.relief.frozen && grown && !pulsed) return "a frozen torque grows";
    if (!w.armed && !pulsed && tau != 0) return "a torque while disarmed";
    if (pulsed) ++(w.relief.frozen ? tally->pulsed_frozen : tally->pulsed);
    const std::int64_t most = std::max<std::int64_t>(limit, 0);
    if (!ramped && (tau > most || tau < -most)) return "beyond the limit";
    const std::int64_t fine = std::int64_t{1} << kFine;
    if (ramped &&
        moved > ((w.relief.frozen ? 0 : std::max<std::int64_t>(step, 1)) + fine - 1) / fine) {
      return "faster than the ramp";
    }
    return nullptr;
  }

  void count(const Wave& w, std::int64_t limit, std::int64_t step, std::int64_t tau, bool ramped) {
    ++tally->waves;
    tally->derated_changes += w.armed && w.relief.derated != derated && !was_ramping;
    if (w.armed && w.relief.frozen && before != 0) {
      ++(tau == before ? tally->frozen : tally->fallen)[before > 0];
    }
    tally->disarmed += !w.armed;
    tally->free += w.armed && !ramped;
    tally->scene_changes += w.armed && w.scene != scene && !was_ramping;
    tally->restarts += w.armed && w.restart && w.scene == scene && !was_ramping;
    if (w.armed && chain.limit_torque()) ++tally->limited[w.rendered > 0];
    if (ramped && tau != before) ++tally->ramping[tau > before];
    if (w.armed && was_ramping && !ramped && tau != before) ++tally->ended[tau > before];
    tally->held += ramped && tau == before;
    tally->negative_step += ramped && step < 0;
    tally->negative_limit += w.armed && limit < 0;
  }
};

}  // namespace feltgate::test
