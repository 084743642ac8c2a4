// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Figures of a run: errors against the quad reference, step responses, extremes.
// Documentation: docs/json.md
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "feltgate/largest.hpp"

namespace feltgate {

/// Largest and root-mean-square difference of a signal from its reference: over the ticks for which
/// its bound holds, and beside them the largest of the others. Without bounds no tick is outside.
class ErrorFigure {
 public:
  void add(double error) {
    const double magnitude = std::abs(error);
    max_ = larger(max_, magnitude);
    sum_of_squares_ += error * error;
    ++count_;
  }
  /// A tick for which the bound does not hold: a ramp, a saturation, or what follows one.
  void add_outside(double error) {
    max_outside_ = larger(max_outside_, std::abs(error));
    ++outside_;
  }
  double max() const { return max_; }
  double rms() const {
    return count_ == 0 ? 0.0 : std::sqrt(sum_of_squares_ / static_cast<double>(count_));
  }
  std::int64_t count() const { return count_; }
  double max_outside() const { return max_outside_; }
  std::int64_t outside() const { return outside_; }  ///< ticks

 private:
  double max_ = 0, sum_of_squares_ = 0, max_outside_ = 0;
  std::int64_t count_ = 0, outside_ = 0;
};

/// Smallest and largest value seen.
struct SignalRange {
  double low = 1e300, high = -1e300;
  void add(double v) {
    low = smaller(low, v);
    high = larger(high, v);
  }
};

/// One torque step.
struct StepResponse {
  double tau_ref_nm = 0;
  double settling_ms = 0;      ///< from the step to the last sample outside 2 % of the final value
  double overshoot_pct = 0;    ///< beyond the final value, in % of the step
  double final_value_nm = 0;   ///< mean of the last tenth
  double final_error_pct = 0;  ///< difference of final value and reference
  double ripple_nm = 0;        ///< rms around the final value in the last tenth
};

/// A signal from a step on, in bounded memory: beyond `most` samples, neighbours are merged into
/// blocks. Times are then accurate to one block, which is at most 2/most of the response.
class StepSamples {
 public:
  static constexpr std::size_t most = std::size_t{1} << 20;  ///< blocks; even

  /// `before_nm`: value of the signal before the step.
  explicit StepSamples(double before_nm) : before_nm_(before_nm) {}
  void add(double value);
  /// Figures of samples that are `sample_s` apart, the first one at the step. Settling is measured
  /// on the band of 2 % around the final value.
  StepResponse response(double sample_s, double tau_ref_nm) const;

 private:
  /// Summary of `per_block_` samples.
  struct Block {
    double low, high, mean, squares;  ///< squares: sum of squared distances from the mean
  };
  void halve();

  double before_nm_;
  std::vector<Block> blocks_;  ///< the last block may be incomplete
  std::int64_t per_block_ = 1, samples_ = 0;
};

}  // namespace feltgate
