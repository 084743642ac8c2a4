// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Recordings of a drive and of a coast-down. Documentation: docs/calibration.md
#include "host/identify/recording.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/calibrate/regression.hpp"

namespace feltgate::host {

Recording recording_of(const ColumnTable& table, double count_rad, bool needs_voltage) {
  Recording r;
  r.name = table.file();
  const std::size_t time = table.need({"time_s", "t_s", "time", "t"}, "time");
  const bool in_rad = table.find({"position_rad", "theta_rad", "angle_rad"}).has_value();
  const std::size_t angle = table.need(
      {"position_rad", "theta_rad", "angle_rad", "position", "position_counts", "count", "counts"},
      "the position");
  const std::vector<std::string> voltages{"voltage_v", "voltage", "v"};
  const auto voltage =
      needs_voltage ? std::optional(table.need(voltages, "the voltage")) : table.find(voltages);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double t = table.at(row, time), a = table.at(row, angle);
    const double v = voltage ? table.at(row, *voltage) : 0.0;
    if (!std::isfinite(t) || !std::isfinite(a) || !std::isfinite(v)) {
      table.fail(row, "a field is empty", "take the row out");
    }
    if (!r.time_s.empty() && !(t > r.time_s.back())) {
      table.fail(row, "time does not go on", "sort the rows, and take repeated ones out");
    }
    r.time_s.push_back(t);
    r.voltage_v.push_back(v);
    r.angle_rad.push_back(in_rad ? a : a * count_rad);
  }
  constexpr std::size_t fewest_rows = 64;
  if (r.rows() < fewest_rows) {
    throw MeasurementError(
        fmt::format("{}:1: {} rows; record at least {}, better a thousand over a second", r.name,
                    r.rows(), fewest_rows));
  }
  return r;
}

}  // namespace feltgate::host
