// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Extremes of one signal over a run, and its mean and swing near the end.
// Documentation: docs/scenes.md
#pragma once

#include <algorithm>
#include <cstdint>

#include "feltgate/largest.hpp"

namespace feltgate {

/// Accumulates one signal, tick by tick.
class SignalRecord {
 public:
  /// For a run of `ticks` ticks.
  explicit SignalRecord(std::int64_t ticks)
      : late_(ticks - ticks / 4), last_(std::min(ticks - 1, ticks - ticks / 10)) {}
  void add(double value) {
    low_ = smaller(low_, value);
    high_ = larger(high_, value);
    if (tick_ >= late_) {
      late_low_ = smaller(late_low_, value);
      late_high_ = larger(late_high_, value);
    }
    if (tick_ >= last_) {
      sum_ += value;
      ++count_;
    }
    ++tick_;
  }
  double low() const { return low_; }
  double high() const { return high_; }
  /// Mean of the last tenth.
  double end() const { return count_ == 0 ? 0.0 : sum_ / static_cast<double>(count_); }
  /// Largest - smallest value in the last quarter.
  double swing() const { return late_high_ < late_low_ ? 0.0 : late_high_ - late_low_; }

 private:
  std::int64_t late_, last_, tick_ = 0, count_ = 0;
  double low_ = 1e300, high_ = -1e300, late_low_ = 1e300, late_high_ = -1e300, sum_ = 0;
};

}  // namespace feltgate
