// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One control tick in `fixed`: velocity difference, low-pass, disturbance observer, torque control,
// duty. The chain of the oracle comparison and of the benchmark; every state is visible.
// Formats: velocity [1,10,21], torque [1,4,16], current [1,5,16], voltage [1,5,14], duty [1,12,0].
// Documentation: docs/fixed-point.md
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "feltgate/fixed.hpp"

namespace feltgate::test {

/// Defects of the chain, for the comparison with the oracle.
enum TickDefect {
  kUnlimitedCurrentToObserver = 1,  ///< the observer sees the current before its limit
  kTruncatedLowPass = 2,            ///< the low-pass step is truncated instead of rounded
  kNarrowObserverSum = 3,           ///< the observer's input lacks its two top bits
  kOneTickLate = 4                  ///< the observer sees the previous tick's velocity
};

/// Numbers of the chain; each coefficient is its SI value times 2^F of its format, rounded.
namespace tick {
constexpr int window = 767;                ///< ticks of the velocity difference
constexpr int velocity_shift = 1;          ///< rad/s per count in the window: 2^1
constexpr std::int64_t a1 = 134218;        ///< [0,-10,28]: 500 rad/s at 1 MHz, 5.0e-4
constexpr std::int64_t inertia = 64173;    ///< [0,-2,18]: g*Jn = 0.2448
constexpr std::int64_t ktn = 63439;        ///< [0,-4,20]: Ktn = 0.0605 Nm/A
constexpr std::int64_t by_ref = 212143;    ///< [0,4,14]: Jn*Kp/Ktn = 12.9482
constexpr std::int64_t by_hat = 29335;     ///< [0,2,13]: (1-Jn*Kp)/Ktn = 3.5809
constexpr std::int64_t kv_low = 20480;     ///< [0,1,14]: 1.25 below 0.15 Nm
constexpr std::int64_t kv_high = 15565;    ///< [0,1,14]: 0.95 from there on
constexpr std::int64_t border = 9830;      ///< [1,4,16]: 0.15 Nm
constexpr std::int64_t limit = 7 * 65536;  ///< [1,5,16]: 7 A
constexpr std::int64_t duty = 213333;      ///< [0,6,12]: 1250 clocks at 24 V
}  // namespace tick

/// What the tick reads: encoder count and torque reference (raw of [1,4,16]).
struct TickStimulus {
  std::int32_t count;
  std::int32_t torque_ref;
};

constexpr std::size_t tick_signals = 8;
constexpr std::array<const char*, tick_signals> tick_signal_names = {
    "raw_velocity", "velocity_state", "velocity", "observer_state",
    "tau_hat",      "current",        "voltage",  "duty"};

/// Raw values after one tick, in the order of tick_signal_names.
using TickStates = std::array<std::int64_t, tick_signals>;

/// Ticks in which each limit acted.
struct TickSaturations {
  long raw_velocity = 0;
  long tau_hat = 0;
  long current = 0;
};

/// The chain; Defect is a TickDefect, 0 for the real one (a template argument: it costs no time).
template <int Defect = 0>
class FixedTick {
 public:
  /// At rest at `count`.
  explicit FixedTick(std::int32_t count) { delay_.fill(count); }

  TickStates tick(const TickStimulus& in) {
    const std::uint32_t difference =
        static_cast<std::uint32_t>(in.count) - static_cast<std::uint32_t>(delay_[position_]);
    delay_[position_] = in.count;
    position_ = position_ + 1 == delay_.size() ? 0 : position_ + 1;
    bool clipped = false;
    const auto counts = fixed<1, 31, 0>::from_raw(static_cast<std::int32_t>(difference));
    const auto raw = narrow<RawVelocity, Round::truncate, Overflow::saturate>(
        scale_by_power_of_two<tick::velocity_shift>(counts), &clipped);
    saturations_.raw_velocity += clipped ? 1 : 0;

    velocity_state_ = low_pass(velocity_state_, raw);
    const auto velocity = narrow<Velocity, Round::half_up, Overflow::saturate>(velocity_state_);

    const auto inertia_torque =
        InertiaGain::from_raw(tick::inertia) * (Defect == kOneTickLate ? velocity_ : velocity);
    velocity_ = velocity;
    auto input = narrow<Observer, Round::half_up, Overflow::saturate>(
        TorqueConstant::from_raw(tick::ktn) * current_seen_ + inertia_torque);
    if (Defect == kNarrowObserverSum) {
      input =
          Observer::from_raw(narrow<fixed<1, 5, 30>, Round::truncate, Overflow::wrap>(input).raw());
    }
    observer_ = low_pass(observer_, input);
    clipped = false;
    const auto tau_hat =
        narrow<Torque, Round::half_up, Overflow::saturate>(observer_ - inertia_torque, &clipped);
    saturations_.tau_hat += clipped ? 1 : 0;

    const auto torque_ref = Torque::from_raw(in.torque_ref);
    const auto wanted = narrow<Current, Round::half_up, Overflow::saturate>(
        fixed<0, 4, 14>::from_raw(tick::by_ref) * torque_ref +
        fixed<0, 2, 13>::from_raw(tick::by_hat) * tau_hat);
    const auto current = limited(wanted);
    saturations_.current += current != wanted ? 1 : 0;
    current_seen_ = Defect == kUnlimitedCurrentToObserver ? wanted : current;

    const bool low =
        torque_ref < Torque::from_raw(tick::border) && torque_ref > Torque::from_raw(-tick::border);
    const auto kv = fixed<0, 1, 14>::from_raw(low ? tick::kv_low : tick::kv_high);
    const auto voltage = narrow<Voltage, Round::convergent, Overflow::saturate>(kv * current);
    const auto duty = narrow<fixed<1, 12, 0>, Round::toward_zero, Overflow::saturate>(
        fixed<0, 6, 12>::from_raw(tick::duty) * voltage);
    return {raw.raw(),     velocity_state_.raw(), velocity.raw(), observer_.raw(),
            tau_hat.raw(), current.raw(),         voltage.raw(),  duty.raw()};
  }

  const TickSaturations& saturations() const { return saturations_; }

 private:
  using RawVelocity = fixed<1, 10, 0>;
  using Velocity = fixed<1, 10, 21>;
  using VelocityState = fixed<1, 10, 33>;
  using Observer = fixed<1, 9, 30>;
  using Torque = fixed<1, 4, 16>;
  using Current = fixed<1, 5, 16>;
  using Voltage = fixed<1, 5, 14>;
  using InertiaGain = fixed<0, -2, 18>;
  using TorqueConstant = fixed<0, -4, 20>;

  /// state + round(a1*(input - state)); the step never leaves the interval, the limit never acts.
  template <class State, class Input>
  static State low_pass(State state, Input input) {
    using Step = fixed<1, State::format.integer + 1, State::format.fraction>;
    const auto product = fixed<0, -10, 28>::from_raw(tick::a1) * (input - state);
    const Step step = Defect == kTruncatedLowPass
                          ? narrow<Step, Round::truncate, Overflow::wrap>(product)
                          : narrow<Step, Round::half_up, Overflow::wrap>(product);
    return narrow<State, Round::truncate, Overflow::saturate>(state + step);
  }

  static Current limited(Current x) {
    const Current limit = Current::from_raw(tick::limit);
    const Current low = Current::from_raw(-tick::limit);
    return x > limit ? limit : (x < low ? low : x);
  }

  std::array<std::int32_t, tick::window> delay_{};
  std::size_t position_ = 0;
  VelocityState velocity_state_;
  Velocity velocity_;
  Observer observer_;
  Current current_seen_;
  TickSaturations saturations_;
};

/// Hand motion and references that visit every branch: a swing of 4 rad, dither on one edge, a rare
/// burst of one count per tick (the velocity saturates), a count that wraps, torque steps to 0.6
/// Nm.
class TickPattern {
 public:
  static constexpr std::int32_t first_count = 2147483600;

  TickStimulus next() {
    const double t = static_cast<double>(k_) * 1e-6;
    const double angle = 4.0 * std::sin(8.2 * t) + 0.3 * std::sin(70.0 * t);
    const auto swing = static_cast<std::int64_t>(std::floor(angle * 651.898646904403));
    if (k_ % 150000 >= 148800) ++burst_;
    const std::int64_t dither = (k_ / 50000) % 3 == 1 ? (k_ / 193) % 2 : 0;
    if (k_ % 4000 == 0) {
      reference_ = static_cast<std::int32_t>((hash(k_) >> 33) % 55051) - 27525;
    }
    ++k_;
    const std::int64_t count = first_count + swing + burst_ + dither;
    return {static_cast<std::int32_t>(static_cast<std::uint32_t>(count)), reference_};
  }

 private:
  static std::uint64_t hash(std::int64_t k) {
    std::uint64_t z = static_cast<std::uint64_t>(k) * 0x9E3779B97F4A7C15u + 1;
    z = (z ^ (z >> 29)) * 0xBF58476D1CE4E5B9u;
    return z ^ (z >> 32);
  }

  std::int64_t k_ = 0;
  std::int64_t burst_ = 0;
  std::int32_t reference_ = 0;
};

/// FNV-1a over every state of every tick.
class TrajectoryHash {
 public:
  void add(const TickStates& states) {
    for (const std::int64_t s : states) {
      hash_ = (hash_ ^ static_cast<std::uint64_t>(s)) * 0x100000001B3u;
    }
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325u;
};

}  // namespace feltgate::test
