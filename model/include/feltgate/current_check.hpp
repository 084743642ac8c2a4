// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/current_check.sv: compares a measured current with the one that the
// applied voltage makes; and its words from a winding. Documentation: docs/blocks/current.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "feltgate/current_control.hpp"

namespace feltgate {

/// Words of the check.
struct CurrentCheckWords {
  std::int32_t resistance = 0;  ///< [0,4,13], parts of the supply per part of full-scale current
  std::int32_t margin = 0;      ///< [0,0,17] of the supply: half of what the largest current needs
  bool in_range = false;  ///< the resistance fits its word; a margin beyond its end is the end
};

/// The words for a winding whose current is at most `limit_a`. All arguments are above 0.
inline CurrentCheckWords current_check_words(double resistance_ohm, double limit_a,
                                             double full_scale_a, double supply_v) {
  constexpr double most = (1 << 17) - 1;  // both words have 17 bits
  const double resistance =
      std::round(std::ldexp(resistance_ohm * full_scale_a / supply_v, kCurrentProportionalBits));
  const double margin =
      std::round(std::ldexp(resistance_ohm * limit_a / supply_v / 2, kCurrentControlBits));
  return {static_cast<std::int32_t>(std::min(resistance, most)),
          static_cast<std::int32_t>(std::min(margin, most)),
          resistance >= 1 && resistance <= most && margin >= 1};
}

/// Bit-exact and clock-exact with the RTL.
class CurrentCheck {
 public:
  static constexpr int kLatencyClocks = 19;  ///< from valid to out().missing
  static constexpr int kBusyClocks = 19;     ///< fewest from a taken valid to the next one
  static constexpr int kPatience = 16;       ///< results astray, one after the other
  struct In {
    bool armed = false;           ///< false: nothing is missing, the count begins anew
    bool valid = false;           ///< one clock: takes the three words after it
    std::int32_t resistive = 0;   ///< [1,1,17] of the supply: voltage at the resistance
    std::int32_t across = 0;      ///< [1,1,17]: that across the axis of torque; else 0
    std::int32_t current = 0;     ///< [1,3,17] of full scale, measured
    std::int32_t resistance = 0;  ///< [0,4,13], taken with the current
    std::int32_t margin = 0;      ///< [0,0,17] of the supply, taken with the result
  };
  struct Out {
    bool missing = false;  ///< the measured current is not what the voltage makes; held while armed
  };

  void reset() { *this = CurrentCheck(); }

  void clock(const In& in) {
    if (!in.armed) {
      reset();
      return;
    }
    if (step_ == 0) {
      if (!in.valid) return;
      resistive_ = in.resistive;
      across_ = in.across;
      needed_ = (std::int64_t{in.current} * in.resistance) >> kCurrentProportionalBits;
    } else if (step_ == kLatencyClocks - 1) {
      result(in.margin);
    }
    step_ = step_ == kBusyClocks - 1 ? 0 : step_ + 1;
  }

  const Out& out() const { return out_; }

 private:
  void result(std::int64_t margin) {
    constexpr std::int64_t end = (1 << 18) - 1;
    const std::int64_t far = std::min(4 * margin, end);
    const std::int64_t apart = std::abs(resistive_ - needed_), across = std::abs(across_);
    const bool astray = apart > margin || across > margin;
    const bool full = count_ == kPatience - 1;
    if ((astray && full) || std::abs(resistive_) > far || across > far) out_.missing = true;
    count_ = !astray ? 0 : full ? count_ : count_ + 1;
  }

  Out out_;
  int step_ = 0, count_ = 0;                              // clocks since a current; results astray
  std::int64_t resistive_ = 0, across_ = 0, needed_ = 0;  // LSB of the voltage
};

}  // namespace feltgate
