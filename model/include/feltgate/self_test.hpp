// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/safety/self_test.sv, tick by tick: after arming it gives a torque pulse and its
// opposite, and checks which way the lever moves. Documentation: docs/blocks/supervisor.md
#pragma once

#include <algorithm>
#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "feltgate/scenes.hpp"

namespace feltgate {

/// Result of the self-test, as in the status word.
enum class SelfTestResult : std::uint8_t {
  none = 0,                       ///< no result yet, or no test
  right = Map::self_test_right,   ///< the lever moved the right way
  held = Map::self_test_held,     ///< the lever did not move enough
  moving = Map::self_test_moving  ///< the lever did not come to rest before the test
};

/// State of the self-test, advanced tick by tick.
class SelfTestLaw {
 public:
  /// Parameter words: time of rest before the pulse, time of each pulse, both in units; bits of the
  /// results that allow arming.
  struct Words {
    std::uint32_t quiet = 0, pulse = 0, arms = 0;
  };

  /// The travel sampled at the start of a wave.
  void sample(std::uint16_t travel) {
    before_ = now_;
    now_ = travel & 3;
  }
  /// The rest of the tick; it decides what the next tick does. Returns whether the test failed: the
  /// lever moved the wrong way, or must not be armed in this state. `direct`: voltage mode, where
  /// there is no torque to test with. `waits`: another axis tests before this one; no pulse yet.
  bool turn(bool armed, bool direct, std::uint32_t tick_count, const Words& w, bool waits = false) {
    return failed_ = next(armed, direct, tick_count, w, waits);
  }
  /// The result of the last turn(), given only once.
  bool failed() {
    const bool was = failed_;
    failed_ = false;
    return was;
  }

  /// Whether the scene waits for the test.
  bool busy(bool armed) const { return armed && state_ != State::done; }
  /// The pulse that replaces the scene's torque.
  TestPulse pulse(bool armed) const {
    if (!busy(armed)) return TestPulse::none;
    if (state_ == State::first) return TestPulse::up;
    return state_ == State::second ? TestPulse::down : TestPulse::rest;
  }
  SelfTestResult result() const { return result_; }

 private:
  enum class State : std::uint8_t { wait, first, second, rest, done };

  bool next(bool armed, bool direct, std::uint32_t tick_count, const Words& w, bool waits) {
    const unsigned step = static_cast<unsigned>(now_ - before_) & 3u;
    const bool unit = changed(tick_count, Map::self_test_unit_bits, &unit_);
    const bool impatient = changed(tick_count, Map::self_test_patience_bits, &patience_);
    const bool over = reached(w.pulse);
    if (!armed) {
      const bool none = over || direct;  // also a pulse of 0 units
      state_ = none ? State::done : State::wait;
      count_ = 0;
      late_ = false;
      if (none) result_ = SelfTestResult::none;
      return false;
    }
    if (state_ == State::done) {
      count_ = 0;
      return false;
    }
    const bool quiet = reached(w.quiet);
    if (unit) count_ = static_cast<std::uint8_t>(count_ + 1);
    switch (state_) {
      case State::wait:
        return wait(step, impatient, quiet, waits, w.arms);
      case State::first:
        add(step);
        if (over) {
          count_ = 0;
          state_ = State::second;
        }
        return net_ == -Map::self_test_counts;
      case State::second:
        if (net_ != 0) add(step);  // the first movement during the second pulse is no answer
        if (over) {
          count_ = 0;
          state_ = State::rest;
        }
        return net_ == -Map::self_test_counts;
      default:
        break;
    }
    const bool right = net_ == Map::self_test_counts;
    result_ = right ? SelfTestResult::right : SelfTestResult::held;
    state_ = State::done;
    count_ = 0;
    return !right && !arms(w.arms, Map::self_test_held_bit);
  }

  static bool arms(std::uint32_t word, int bit) { return ((word >> bit) & 1u) != 0; }
  static bool changed(std::uint32_t ticks, int bit, bool* before) {
    const bool now = ((ticks >> bit) & 1u) != 0;
    const bool other = now != *before;
    *before = now;
    return other;
  }
  /// Whether `word` units have passed; a longer time counts as the longest that count_ can hold.
  bool reached(std::uint32_t word) const {
    return count_ >= std::min(word, (1u << Map::self_test_count_bits) - 1);
  }
  void add(unsigned step) {
    constexpr int end = Map::self_test_counts;
    if ((step & 1u) == 0 || net_ == end || net_ == -end) return;
    net_ += step == 1 ? 1 : -1;
  }
  bool wait(unsigned step, bool impatient, bool quiet, bool waits, std::uint32_t word) {
    const bool gives_up = impatient && late_;
    result_ = SelfTestResult::none;
    net_ = 0;
    late_ = !waits && (late_ || impatient);
    if (step != 0 || waits) count_ = 0;
    if (gives_up) {
      result_ = SelfTestResult::moving;
      state_ = State::done;
      count_ = 0;
      return !arms(word, Map::self_test_moving_bit);
    }
    if (quiet && step == 0 && !waits) {
      count_ = 0;
      state_ = State::first;
    }
    return false;
  }

  State state_ = State::done;
  SelfTestResult result_ = SelfTestResult::none;
  bool failed_ = false;
  std::uint8_t count_ = 0;                ///< units of time since the last change
  int now_ = 0, before_ = 0;              ///< low bits of the travel
  int net_ = 0;                           ///< counts since the pulse began, up to the answer
  bool unit_ = false, patience_ = false;  ///< last values of two bits of the tick counter
  bool late_ = false;                     ///< half of the patience has passed
};

}  // namespace feltgate
