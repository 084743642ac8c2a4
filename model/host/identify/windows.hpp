// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Integrals of a recording over windows. A smooth weight, which vanishes with its derivatives at
// both ends of a window, moves every derivative from the position, which has steps of a count, to
// the weight, which has none. Documentation: docs/identify.md
#pragma once

#include <vector>

#include "host/identify/recording.hpp"

namespace feltgate::host {

/// Weighted means over one window.
struct Window {
  double from_s = 0, to_s = 0;
  double speed_rad_s = 0, acceleration_rad_s2 = 0, jerk_rad_s3 = 0, voltage_v = 0;
  double slowest_rad_s = 0;        ///< least |speed| within it; 0 if it reverses
  double least_v = 0, most_v = 0;  ///< of the voltage
  double cosine = 0;               ///< mean of cos(angle - level)
};

/// Consecutive windows of the recording, each from one jump of the voltage to the next, since the
/// exact time of a jump between two rows is unknown. Each lasts `shortest_s` to twice that, or more
/// if the rows are far apart. Errors: MeasurementError if not even one fits.
std::vector<Window> windows_of(const Recording& recording, double shortest_s, double level_rad = 0);

}  // namespace feltgate::host
