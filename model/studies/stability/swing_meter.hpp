// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How fast a swing grows or dies: the slope of the logarithm of its size, taken from one turning
// point to the next. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <vector>

namespace feltgate::stability {

/// Growth of a swing: slope of the logarithm of its size over time.
struct Growth {
  double rate_1_s = 0;  ///< positive: it grows; +-infinity where too few turning points were seen
  double rad_s = 0;     ///< of the swing
  int swings = 0;       ///< half periods that the slope was taken from
  bool left = false;    ///< it grew until the lever left the wall or the torque met its limit
};

class SwingMeter {
 public:
  /// From `start_rad`; the first three half periods are not counted, `wanted` are; a swing smaller
  /// than `smallest_rad` ends it.
  SwingMeter(double start_rad, double smallest_rad, int wanted)
      : extreme_rad_(start_rad), smallest_rad_(smallest_rad), wanted_(wanted) {}

  /// One look at the lever, often against its period; false when enough was seen.
  bool add(double time_s, double theta_rad, double omega_rad_s);
  /// The lever left the wall: nothing more is to be seen.
  void leave() { left_ = true; }
  Growth growth() const;

 private:
  double extreme_rad_, smallest_rad_;
  int wanted_, seen_ = 0;
  double speed_ = 0;
  bool left_ = false, done_ = false;
  std::vector<double> times_s_, logs_;
};

}  // namespace feltgate::stability
