// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Voltage and position over time, and their integrals over windows. Documentation:
// docs/calibration.md
#pragma once

#include <string>
#include <vector>

#include "host/calibrate/columns.hpp"

namespace feltgate::host {

/// A recording, one entry per row.
struct Recording {
  std::string name;
  std::vector<double> time_s, voltage_v, angle_rad;

  std::size_t rows() const { return time_s.size(); }
  double length_s() const { return rows() > 0 ? time_s.back() - time_s.front() : 0; }
};

/// Reads the columns time_s, position_rad or position (counts), and voltage_v, which a coast-down
/// does not need. Errors: MeasurementError if one is missing, if time does not increase, or if
/// there are too few rows.
Recording recording_of(const ColumnTable& table, double count_rad, bool needs_voltage);

/// Weighted means over one window. A smooth weight, which vanishes with its derivatives at both
/// ends, moves every derivative from the position, which has steps of a count, to the weight.
struct Window {
  std::size_t first = 0, last = 0;  ///< its rows
  double speed_rad_s = 0, acceleration_rad_s2 = 0, jerk_rad_s3 = 0, voltage_v = 0;
  double slowest_rad_s = 0;  ///< least |speed| within it; below 0 if it reverses
};

/// Consecutive windows of 30 ms or more of the recording. None contains a jump of the voltage,
/// since its exact time between two rows is unknown. Errors: MeasurementError if not even one fits.
std::vector<Window> windows_of(const Recording& recording);

}  // namespace feltgate::host
