// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/current_command.sv: from the drive's amperes and volts to those of a
// current's controller, once a tick. docs/blocks/current.md
#pragma once

#include <algorithm>

#include "feltgate/axis/signals.hpp"
#include "feltgate/axis/words.hpp"

namespace feltgate::axis {

class CurrentCommand {
 public:
  explicit CurrentCommand(const Design& d)
      : current_drop_(d["CURRENT_DROP"]),
        current_w_(d["CURRENT_W"]),
        feed_gain_(d["FEED_GAIN"]),
        feed_drop_(d["FEED_DROP"]),
        period_(d["PWM_PERIOD"]) {}

  std::int32_t reference() const { return reference_; }   ///< [1,1,17] of full scale
  std::int32_t feed_forward() const { return forward_; }  ///< [1,0,17] of the supply, saturated
  std::int32_t limit() const { return limit_; }           ///< [0,0,17] of the supply
  /// So many clocks of a period as part of the supply; a whole period is below it.
  std::int32_t part(std::int32_t clocks) const { return clocks * (((1 << 17) - 1) / period_); }
  /// A measured current, [1,1,17] of full scale, in amperes.
  std::int32_t amperes(std::int32_t measured) const {
    return static_cast<std::int32_t>(
        Fixed::saturate(Fixed::scale(measured, current_drop_), current_w_));
  }

  void clock(const Drive& drive, const Words<std::int64_t>& p) {
    if (!drive.valid) return;
    reference_ = (drive.current + (1 << (current_drop_ - 1))) >> current_drop_;
    forward_ = static_cast<std::int32_t>(
        Fixed::saturate(Fixed::scale(drive.feed * feed_gain_, -feed_drop_), 18));
    limit_ = part(static_cast<std::int32_t>(std::min<std::int64_t>(p.duty_limit, period_)));
  }
  void reset() { reference_ = forward_ = limit_ = 0; }

 private:
  int current_drop_, current_w_;
  std::int64_t feed_gain_;
  int feed_drop_;
  std::int32_t period_;
  std::int32_t reference_ = 0, forward_ = 0, limit_ = 0;
};

}  // namespace feltgate::axis
