// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/safety/self_test.sv: after arming it waits until the lever is at rest, applies a
// torque pulse and then its opposite, and checks the direction of motion before the scene begins.
// docs/blocks/safety.md
#pragma once

#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

class SelfTest {
 public:
  enum class Phase : std::uint8_t { done, wait, first, second, judge };

  /// The scene runs: no test is under way, and none begins.
  bool idle(bool armed) const { return armed && phase_ == Phase::done; }
  bool busy(bool armed) const { return armed && phase_ != Phase::done; }
  /// 1: forward, -1: backward, beyond every limit; 0: no pulse.
  int pulse() const { return phase_ == Phase::first ? 1 : phase_ == Phase::second ? -1 : 0; }
  int result() const { return result_; }
  /// In the clock after start.
  bool failed() const { return fail_; }

  /// A tick begins. `travel`: the count's low two bits.
  void sample(unsigned travel) {
    before_ = now_;
    now_ = travel & 3;
  }
  /// A tick in which no test is under way.
  void rest(std::uint32_t tick_count) {
    unit_ = (tick_count >> Map::self_test_unit_bits & 1) != 0;
    patience_ = (tick_count >> Map::self_test_patience_bits & 1) != 0;
    fail_ = late_ = false;
    units_ = 0;
  }
  /// Once a tick, after the scene's torque. `direct`: voltage mode, no test. `waits`: an axis of a
  /// lower number tests first.
  template <class T>
  void start(const Words<T>& p, bool armed, bool direct, bool waits, std::uint32_t tick_count) {
    constexpr int answer = Map::self_test_counts, end = (1 << Map::self_test_count_bits) - 1;
    if (idle(armed)) return rest(tick_count);
    const bool unit_now = (tick_count >> Map::self_test_unit_bits & 1) != 0;
    const bool patience_now = (tick_count >> Map::self_test_patience_bits & 1) != 0;
    const unsigned step = (now_ - before_) & 3;
    const bool still = step == 0;
    // Counts since the first pulse began. Motion that begins only in the second does not count.
    int net = net_;
    if ((step & 1) != 0 && net != answer && net != -answer &&
        (phase_ == Phase::first || (phase_ == Phase::second && net != 0))) {
      net += step == 3 ? -1 : 1;
    }
    const bool unit = unit_now != unit_, patience = patience_now != patience_;
    const bool quiet = units_ == end || static_cast<T>(units_) >= p.self_test_quiet;
    const bool over = units_ == end || static_cast<T>(units_) >= p.self_test_pulse;
    const bool gives_up = patience && late_, late = late_;
    const auto arms = [&p](int bit) {
      return (static_cast<int>(p.self_test_arms) >> bit & 1) != 0;
    };
    const int units = units_;
    const bool wrong = net_ != answer;
    unit_ = unit_now;
    patience_ = patience_now;
    fail_ = late_ = false;
    net_ = phase_ == Phase::wait ? 0 : net;
    units_ = 0;
    if (!armed) {
      phase_ = over || direct ? Phase::done : Phase::wait;  // a pulse of 0 units means no test
      units_ = 0;
      if (phase_ == Phase::done) result_ = 0;
      return;
    }
    switch (phase_) {
      case Phase::wait:
        result_ = gives_up ? Map::self_test_moving : 0;
        late_ = !waits && (late || patience);
        fail_ = gives_up && !arms(Map::self_test_moving_bit);
        if (gives_up) {
          phase_ = Phase::done;
        } else if (quiet && still && !waits) {
          phase_ = Phase::first;
        } else if (!waits && still) {
          units_ = (units + unit) & end;
        }
        break;
      case Phase::first:
      case Phase::second:
        fail_ = net == -answer;
        if (over) {
          phase_ = phase_ == Phase::first ? Phase::second : Phase::judge;
        } else {
          units_ = (units + unit) & end;
        }
        break;
      case Phase::judge:
        result_ = wrong ? Map::self_test_held : Map::self_test_right;
        fail_ = wrong && !arms(Map::self_test_held_bit);
        phase_ = Phase::done;
        break;
      case Phase::done:
        break;
    }
  }

 private:
  Phase phase_ = Phase::done;
  unsigned now_ = 0, before_ = 0;
  int net_ = 0, units_ = 0, result_ = 0;
  bool unit_ = false, patience_ = false, late_ = false, fail_ = false;
};

}  // namespace feltgate::axis
