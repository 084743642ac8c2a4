// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Voltage and position over time, from a capture, a stream or a run.
// Documentation: docs/identify.md
#pragma once

#include <string>
#include <vector>

#include "host/calibrate/columns.hpp"

namespace feltgate::host {

/// A recording, one entry per row.
struct Recording {
  std::string name;
  std::vector<double> time_s, voltage_v, angle_rad;
  std::vector<double> reference_rad;  ///< of a better encoder on the same shaft; empty: none

  std::size_t rows() const { return time_s.size(); }
  double length_s() const { return rows() > 0 ? time_s.back() - time_s.front() : 0; }
};

/// Reads the columns time_s or tick, position_rad or position (counts), and voltage_v, which a
/// coast-down does not need. Errors: MeasurementError if one is missing, if time does not increase,
/// or if there are too few rows.
Recording recording_of(const ColumnTable& table, double count_rad, double tick_s,
                       bool needs_voltage);
/// A turn for the error of an encoder: what it counts, not what a simulated shaft does, and the
/// column reference_rad, if there is one.
Recording turn_of(const ColumnTable& table, double count_rad, double tick_s);

}  // namespace feltgate::host
