// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Random waves for torque_control, their coverage, and tick() against clock().
// Documentation: docs/blocks/torque_control.md
#pragma once

#include <cmath>

#include "wave_bus.hpp"

namespace feltgate::test {

/// Torques of every size and on the border; the design's words, legal ones, or any 32 bits.
struct RandomWaves {
  Random random;

  template <class Number>
  std::int64_t any() {
    if (random.one_in(20)) return random.coin() ? Number::max_raw() : Number::min_raw();
    const auto word = static_cast<std::int64_t>(random.bits()) >> (64 - Number::width);
    return word >> random.below(Number::width);
  }
  /// A limit: zero, small, or up to the format's end.
  template <class Number>
  std::int64_t limit() {
    return random.one_in(10) ? 0 : Number::max_raw() >> random.below(Number::width - 3);
  }
  Wave operator()() {
    Wave w;
    const std::uint32_t kind = random.below(4);
    if (kind >= 2) {
      for (const int a :
           {A::emf_constant, A::voltage_to_current, A::torque_gain, A::dead_voltage_slope,
            A::voltage_gain, A::voltage_gain_high, A::duty_gain}) {
        w.words.set(a, random.between(0, 131071) >> random.below(10));
      }
      w.words.set(A::observer_gain, random.between(-131072, 131071) >> random.below(10));
      w.words.set(A::region_torque, limit<Torque>());
      w.words.set(A::dead_voltage, limit<Voltage>());
    }
    if (kind >= 1) {
      w.words.set(A::current_limit, limit<Current>());
      w.words.set(A::voltage_window, limit<Voltage>());
      w.words.set(A::duty_limit, random.between(0, 4095) >> random.below(12));
    }
    w.words.set(A::voltage_setpoint, any<Voltage>());
    w.words.set(A::voltage_step, limit<Voltage>());
    if (kind == 3 && random.one_in(4)) {
      for (auto& word : w.words.raw) word = static_cast<std::int32_t>(random.bits() >> 32);
    }
    w.mode = static_cast<Mode>(random.below(4));
    w.armed = !random.one_in(5);
    w.tau_ref = random.coin() ? any<Torque>() : random.between(-40000, 40000);
    w.tau_hat = random.coin() ? any<Torque>() : random.between(-40000, 40000);
    w.velocity = any<Velocity>();
    if (random.one_in(4)) {
      const std::int64_t border = w.words.get<Step::Law::kBorderKey>(A::region_torque).raw();
      w.tau_ref = (random.coin() ? border : -border) + random.between(-1, 1);
      if (w.tau_ref > Torque::max_raw()) w.tau_ref = Torque::max_raw();
      if (w.tau_ref < Torque::min_raw()) w.tau_ref = Torque::min_raw();
    }
    return w;
  }
};

using Twin = Watched<Control, Wave>;
using Bench = LockStep<Vtorque_control, Twin, Adapter>;

/// A wave, then up to `spread` - 1 clocks of rest. The wave after a reset is disarmed, as in the
/// core, because the sums have no reset.
struct Waves {
  Waves(std::uint64_t seed, std::uint32_t more_clocks)
      : next{Random(seed)}, shared(seed + 1), spread(more_clocks) {}

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    const bool first = out.resets != resets;
    if (first) {
      resets = out.resets;
      clock = 0;
    }
    if (clock == 0) {
      in.aside = next();
      if (first) in.aside.armed = false;
      period = kShortest + static_cast<int>(shared.garbage.below(spread));
    }
    in.port = wave_inputs(in.aside, clock, out.port, shared);
    clock = clock + 1 == period ? 0 : clock + 1;
    return in;
  }

  static constexpr int kShortest = Map::T::duty + 2;
  RandomWaves next;
  Shared shared;
  std::uint32_t spread;
  Twin::In in;
  std::int64_t resets = 0;
  int clock = 0, period = kShortest;
};

/// Counts, by sign if the value has one: [0] negative, [1] positive.
struct Tally {
  std::int64_t waves = 0, disarmed = 0, modes[4] = {}, current[2] = {}, voltage[2] = {},
               duty[2] = {}, dead[2] = {}, dead_linear = 0, border[2] = {}, high[2] = {};
};

/// Runs tick() at the clock at which the duty is ready.
struct TickBeside {
  Tally* tally;
  Step step{};  // the ramp starts from the voltage of the tick before

  const char* operator()(const Twin::In& in, const Vtorque_control& rtl, const Twin&,
                         bool in_reset) {
    if (in_reset) step = {};
    if (in_reset || ((in.port.wave >> Map::T::duty) & 1u) == 0) return nullptr;
    tick(step, in.aside);
    count(in.aside, step);
    const Control::Out out = Adapter::outputs(rtl);
    if (out.region_high != step.region_high) return "region of tick() is that of clock()";
    if (out.current_ref != step.current.raw()) return "current of tick() is that of clock()";
    if (out.voltage != step.voltage.raw()) return "voltage of tick() is that of clock()";
    if (out.duty != step.duty.raw()) return "duty of tick() is that of clock()";
    if (out.limit.current != step.limit.current || out.limit.voltage != step.limit.voltage ||
        out.limit.duty != step.limit.duty) {
      return "limits of tick() are those of clock()";
    }
    // For all words the voltage is within the window; the port's format ends at +-32 V.
    const Words& words = in.aside.words;
    const auto window =
        std::max<std::int64_t>(0, words.get<Step::Law::kVoltageKey>(A::voltage_window).raw());
    const auto emf = (in.aside.velocity * (words.at(A::emf_constant) & 0x1ffff)) >>
                     (Design::f.velocity.fraction + Design::P::emf_constant.fraction -
                      Design::f.voltage.fraction);
    const std::int64_t low = emf - window, high = emf + window;
    const auto port = [](std::int64_t v) {
      return std::clamp<std::int64_t>(v, Voltage::min_raw(), Voltage::max_raw());
    };
    if (in.port.armed && (out.voltage < port(low) || out.voltage > port(high))) {
      return "the voltage is within the window around the back-EMF";
    }
    if (!in.port.armed && (out.current_ref != 0 || out.voltage != 0)) return "disarmed is silent";
    return nullptr;
  }

  void count(const Wave& w, const Step& step) {
    ++tally->waves;
    if (!w.armed) ++tally->disarmed;
    ++tally->modes[static_cast<int>(w.mode)];
    if (step.limit.current && step.current.raw() != 0) ++tally->current[step.current.raw() > 0];
    if (step.limit.voltage && step.voltage.raw() != 0) ++tally->voltage[step.voltage.raw() > 0];
    if (step.limit.duty && step.duty.raw() != 0) ++tally->duty[step.duty.raw() > 0];
    const std::int64_t border = w.words.get<Step::Law::kBorderKey>(A::region_torque).raw();
    if (w.tau_ref == border || w.tau_ref == -border) ++tally->border[w.tau_ref > 0];
    if (step.region_high) ++tally->high[w.tau_ref > 0];
    const double slope =
        std::ldexp(static_cast<double>(w.tau_ref * (w.words.at(A::dead_voltage_slope) & 0x1ffff)),
                   -16 - Design::P::dead_voltage_slope.fraction);
    const double dead = std::ldexp(static_cast<double>(w.words.at(A::dead_voltage)), -14);
    if (slope > dead || slope < -dead) {
      ++tally->dead[slope > 0];
    } else if (slope != 0) {
      ++tally->dead_linear;
    }
  }
};

}  // namespace feltgate::test
