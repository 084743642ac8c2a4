// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Recordings of a drive and of a coast-down. Documentation: docs/identify.md
#include "host/identify/recording.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/calibrate/regression.hpp"

namespace feltgate::host {

namespace {

constexpr std::size_t kFewestRows = 64;

/// Ticks have 32 bits: continues the count where it wraps.
double unwrapped(double tick, double before) {
  constexpr double whole = 4294967296.0;
  return tick + whole * std::round((before - tick) / whole);
}

}  // namespace

Recording recording_of(const ColumnTable& table, double count_rad, double tick_s,
                       bool needs_voltage) {
  Recording r;
  r.name = table.file();
  const auto tick = table.find({"tick", "tick_count", "ticks"});
  const bool in_s = table.find({"time_s", "t_s", "time", "t"}).has_value();
  const std::size_t time =
      in_s || !tick ? table.need({"time_s", "t_s", "time", "t", "tick"}, "time") : *tick;
  const bool in_rad = table.find({"position_rad", "theta_rad", "angle_rad"}).has_value();
  const std::size_t angle = table.need(
      {"position_rad", "theta_rad", "angle_rad", "position", "position_counts", "count", "counts"},
      "the position");
  auto voltage = table.find({"voltage_v", "voltage", "v"});
  if (!voltage && needs_voltage) {
    voltage = table.need({"voltage_v", "voltage", "v"}, "the voltage");
  }
  double tick_before = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    double t = table.at(row, time);
    if (!in_s) {
      if (row == 0) tick_before = t;
      tick_before = unwrapped(t, tick_before);
      t = tick_before * tick_s;
    }
    const double a = table.at(row, angle), v = voltage ? table.at(row, *voltage) : 0.0;
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
  if (r.rows() < kFewestRows) {
    throw MeasurementError(
        fmt::format("{}:1: {} rows; record at least {}, better a thousand over a second", r.name,
                    r.rows(), kFewestRows));
  }
  return r;
}

Recording turn_of(const ColumnTable& table, double count_rad, double tick_s) {
  Recording r = recording_of(table, count_rad, tick_s, false);
  const auto counts = table.find({"position", "position_counts", "count", "counts"});
  const auto reference = table.find({"reference_rad"});
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (counts) r.angle_rad[row] = table.at(row, *counts) * count_rad;
    if (reference) r.reference_rad.push_back(table.at(row, *reference));
    if (!std::isfinite(r.angle_rad[row]) || (reference && !std::isfinite(r.reference_rad[row]))) {
      table.fail(row, "a field is empty", "take the row out");
    }
  }
  return r;
}

}  // namespace feltgate::host
