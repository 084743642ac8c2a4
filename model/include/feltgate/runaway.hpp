// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cause 3 of rtl/core/safety/supervisor.sv: in several windows in a row, the speed grows against
// the commanded current, as with swapped motor leads or encoder channels. Documentation:
// docs/blocks/supervisor.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"

namespace feltgate {

/// For a design D. In each tick the caller makes the two comparisons, then calls turn(), with the
/// current of the tick before.
template <class D>
class Runaway {
 public:
  /// Whether |x| > limit. The limit is a signed word; a negative limit is always exceeded.
  static bool over(std::int32_t x, std::uint32_t limit) {
    const std::int64_t wide = x;
    return (wide < 0 ? -wide : wide) > static_cast<std::int32_t>(limit);
  }

  /// Gain of velocity since the window began, raw, its low bits dropped.
  std::int32_t gain(std::int32_t velocity) const {
    const auto bits =
        static_cast<std::uint32_t>(top(velocity)) - static_cast<std::uint32_t>(begin_);
    constexpr int above = 32 - D::f.velocity.width() + kDrop;
    return static_cast<std::int32_t>(bits << above) >> (above - kDrop);
  }
  void compare_growth(std::int32_t gained, std::int32_t velocity, std::uint32_t limit) {
    grows_ = over(gained, limit) && (gained < 0) == (velocity < 0);
  }
  void compare_current(std::int32_t current_ref, std::uint32_t limit) {
    strong_ = over(current_ref, limit);
  }
  /// Counts the tick; at the end of a window the next window begins.
  void turn(std::int32_t velocity, std::int32_t current_ref, std::uint32_t limit, bool live) {
    const bool full = ticks_ >= limit || ticks_ >= kLongest;
    const bool against = live && strong_ && (velocity < 0) != (current_ref < 0);
    due_ = against && full && grows_ && windows_ == Map::runaway_windows - 1;
    if (against && !full) {
      ++ticks_;
      return;
    }
    if (!against || !grows_)
      windows_ = 0;
    else if (!due_)
      ++windows_;
    ticks_ = 1;
    begin_ = top(velocity);
  }
  /// Whether that tick ended the last of the required windows.
  bool due() const { return due_; }
  /// Whether the next turn() could make due() true.
  bool near(std::uint32_t limit) const {
    return windows_ == Map::runaway_windows - 1 && (ticks_ >= limit || ticks_ >= kLongest);
  }

 private:
  static constexpr std::uint32_t kLongest = 1u << Map::runaway_bits;  // ticks
  static constexpr int kDrop =
      D::f.velocity.fraction > Map::growth_bits ? D::f.velocity.fraction - Map::growth_bits : 0;
  static std::int32_t top(std::int32_t velocity) { return velocity >> kDrop; }

  std::int32_t begin_ = 0;   ///< velocity at the start of the window, low bits dropped
  std::uint32_t ticks_ = 1;  ///< ticks in the window, including this one
  int windows_ = 0;          ///< consecutive windows in which the speed grew
  bool grows_ = false, strong_ = false, due_ = false;
};

}  // namespace feltgate
