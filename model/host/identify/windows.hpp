// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Integrals of a recording over windows: a smooth weight that vanishes at both ends of a window
// with its derivatives moves every derivative from the position, which has steps of a count, to the
// weight, which has none. Documentation: docs/identify.md
#pragma once

#include <vector>

#include "host/identify/recording.hpp"

namespace feltgate::host {

/// Weighted means over one window.
struct Window {
  double from_s = 0, to_s = 0;
  double speed_rad_s = 0, acceleration_rad_s2 = 0, jerk_rad_s3 = 0, voltage_v = 0;
  double slowest_rad_s = 0;        ///< least size of the speed within it, 0 where it turns round
  double least_v = 0, most_v = 0;  ///< of the voltage
  double cosine = 0;               ///< mean of cos(angle - level)
};

/// Windows of the recording, end to end: from one jump of the voltage to the next, so that no
/// window has to know when between two rows it was; each lasts `shortest_s` to twice that, more
/// where the rows are far apart. Throws MeasurementError where there is room for none.
std::vector<Window> windows_of(const Recording& recording, double shortest_s, double level_rad = 0);

}  // namespace feltgate::host
