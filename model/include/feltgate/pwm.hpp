// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/pwm.sv: centre-aligned PWM for an H-bridge, with dead time. Duty
// [1,12,0] in clocks is sampled once per period, with period_start. It reaches the gates 3 clocks
// later, rising edges after the dead time in addition; while disabled, the duty is 0.
// Documentation: docs/blocks/pwm.md
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace feltgate {

/// Bit-exact and clock-exact with the RTL.
class Pwm {
 public:
  struct In {
    bool clear = false;     ///< turns every gate off, also between clock edges
    bool enable = false;    ///< false: every gate off from this clock on, duty 0
    bool mode = false;      ///< false: sign-magnitude, true: locked-antiphase
    bool polarity = false;  ///< true: motor wired the other way
    std::int16_t duty = 0;  ///< clocks, -4096..4095; beyond +-period it acts as +-period
    bool operator==(const In& o) const {
      return clear == o.clear && enable == o.enable && mode == o.mode && polarity == o.polarity &&
             duty == o.duty;
    }
  };
  /// The gates, at the H-bridge's legs A and B.
  struct Out {
    bool gate_a_hi = false;
    bool gate_a_lo = false;
    bool gate_b_hi = false;
    bool gate_b_lo = false;
    bool period_start = false;     ///< the duty was sampled in the last clock
    std::int16_t duty_active = 0;  ///< the sampled duty, clocks; 0 while disabled
    bool operator==(const Out& o) const {
      return gate_a_hi == o.gate_a_hi && gate_a_lo == o.gate_a_lo && gate_b_hi == o.gate_b_hi &&
             gate_b_lo == o.gate_b_lo && period_start == o.period_start &&
             duty_active == o.duty_active;
    }
  };
  /// `period` in clocks: even, 4 to 4094. `dead_clocks`: 1 to 64. `shortest_clocks`: shortest pulse
  /// at a gate, 1 to 255; if above 1, both together are at most half a period.
  explicit Pwm(int period = 1000, int dead_clocks = 25, int shortest_clocks = 1)
      : period_(period), dead_(dead_clocks - 1), shortest_(shortest_clocks) {
    reset();
  }

  void reset() {
    time_ = period_ - 2;
    taken_ = Command{};
    command_ = Command{};
    debt_ = 0;
    legs_ = {};
    for (Leg& leg : legs_) leg.dead = dead_;
    enable_ = false;
    out_ = Out{};
  }

  void clock(const In& in) {
    const std::array<bool, 2> high = wanted();
    for (std::size_t l = 0; l < 2; ++l) legs_[l].clock(high[l], in, dead_);
    command_ = taken_;
    out_.period_start = time_ == period_ - 2;
    if (out_.period_start) {
      take(in);
      out_.duty_active = in.duty;
    }
    if (!in.enable) {
      taken_.threshold = taken_.antiphase ? period_ / 2 : 0;
      debt_ = 0;
      out_.duty_active = 0;
    }
    time_ = time_ == period_ - 1 ? 0 : time_ + 1;
    enable_ = in.enable;
    out_.gate_a_hi = legs_[0].hi_q;
    out_.gate_a_lo = legs_[0].lo_q;
    out_.gate_b_hi = legs_[1].hi_q;
    out_.gate_b_lo = legs_[1].lo_q;
  }

  const Out& out() const { return out_; }

  /// Number of clocks before the clock that samples the duty.
  int clocks_to_duty() const { return time_ > period_ - 2 ? period_ - 1 : period_ - 2 - time_; }

  /// Number of coming clocks, with the inputs held, in which no output changes, so that skip() may
  /// replace clock(). If it is 0, call clock() at least once.
  int quiet_clocks(const In& in) const {
    if (in.clear || in.enable != enable_ || out_.period_start || !(command_ == taken_)) return 0;
    int quiet = period_ - 2 - time_;
    const std::array<bool, 2> next = wanted();
    for (std::size_t l = 0; l < 2; ++l) {
      const Leg& leg = legs_[l];
      if (leg.high_q != next[l] || leg.wanted_q != leg.high_q) return 0;
      if (!in.enable) {
        if (leg.dead != dead_) return 0;
      } else if (leg.dead > 0) {
        quiet = std::min(quiet, leg.dead);
      } else if (leg.hi_q != leg.wanted_q || leg.lo_q == leg.wanted_q) {
        return 0;
      }
    }
    const int threshold = command_.threshold;
    if (threshold > 0 && threshold < period_) {
      const int rise = (period_ - threshold + 1) / 2;
      const int fall = (period_ + threshold + 1) / 2;
      if (time_ < rise) {
        quiet = std::min(quiet, rise - time_);
      } else if (time_ < fall) {
        quiet = std::min(quiet, fall - time_);
      }
    }
    return quiet;
  }

  /// Equals `clocks` calls of clock() with the inputs held, for 0 <= clocks <= quiet_clocks().
  void skip(int clocks) {
    time_ += clocks;
    if (!enable_) return;
    for (Leg& leg : legs_) leg.dead = std::max(0, leg.dead - clocks);
  }

 private:
  struct Leg {
    bool high_q = false;
    bool wanted_q = false;
    bool hi_q = false;
    bool lo_q = false;
    int dead = 0;  // clocks until dead_q has counted to its top bit

    void clock(bool high, const In& in, int dead_clocks) {
      const bool free = in.enable && high_q == wanted_q;
      const bool on = free && dead == 0 && !in.clear;
      hi_q = on && wanted_q;
      lo_q = on && !wanted_q;
      dead = free ? std::max(0, dead - 1) : dead_clocks;
      wanted_q = high_q;
      high_q = high;
    }
  };

  /// A duty in the form that the comparator uses.
  struct Command {
    int threshold = 0;  // clocks with leg A high (leg B when switch_b)
    bool antiphase = false;
    bool switch_b = false;
    bool operator==(const Command& o) const {
      return threshold == o.threshold && antiphase == o.antiphase && switch_b == o.switch_b;
    }
  };

  void take(const In& in) {
    Command c;
    c.antiphase = in.mode;
    c.switch_b = (in.duty < 0) != in.polarity;
    if (c.antiphase || c.switch_b != taken_.switch_b) debt_ = 0;
    const int twice = period_ + (in.polarity ? -in.duty : in.duty);
    c.threshold =
        whole(in.mode ? (twice - (twice & 1)) / 2 : (in.duty < 0 ? -in.duty : in.duty), in.mode);
    taken_ = c;
  }
  /// `threshold`, changed so that no pulse is shorter than shortest_: the clocks of a short high
  /// pulse wait in debt_ until they make a whole one; in antiphase it is made longer. A short low
  /// pulse is made longer.
  int whole(int threshold, bool antiphase) {
    if (shortest_ == 1) return threshold;
    const int dead = dead_ + 1, least = dead + shortest_, most = period_ - least;
    if (antiphase) return std::clamp(threshold, least, most);
    if (threshold <= dead) return threshold;
    const int sum = threshold + debt_;
    debt_ = sum < least ? sum - dead : 0;
    return sum < least ? dead : std::min(sum, most);
  }
  /// Whether legs A and B are to be high in this clock; the carrier counts Period, Period-2 .. 2,
  /// 1, 3 .. Period-1.
  std::array<bool, 2> wanted() const {
    const int carrier = 2 * time_ < period_ ? period_ - 2 * time_ : 2 * time_ - period_ + 1;
    const bool high = carrier <= command_.threshold;
    if (command_.antiphase) return {high, !high};
    return {high && !command_.switch_b, high && command_.switch_b};
  }
  int period_;
  int dead_;      // DeadClocks - 1
  int shortest_;  // ShortestClocks
  int time_ = 0;  // clocks since the start of the carrier
  int debt_ = 0;  // clocks of high pulses that were too short
  Command taken_;
  Command command_;
  bool enable_ = false;
  std::array<Leg, 2> legs_{};
  Out out_;
};

}  // namespace feltgate
