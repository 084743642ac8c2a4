// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The table of columns of a run. Documentation: docs/json.md
#include "sim/loop/columns.hpp"

#include <fmt/format.h>

namespace feltgate {

namespace {

constexpr int plant_digits = 9;

struct BackendColumn {
  const char *name, *unit, *meaning;
  double BackendSignals::*value;
};
constexpr BackendColumn backend_columns[] = {
    {"velocity_rad_s", "rad/s", "velocity after its low-pass", &BackendSignals::velocity_rad_s},
    {"tau_ref_nm", "Nm", "torque that the scene asks for, limited and ramped",
     &BackendSignals::tau_ref_nm},
    {"tau_hat_nm", "Nm", "torque that the observer sees", &BackendSignals::tau_hat_nm},
    {"torque_nm", "Nm", "torque that is commanded: nominal torque constant times current_a",
     &BackendSignals::torque_nm},
    {"current_a", "A", "current reference", &BackendSignals::current_a},
    {"voltage_v", "V", "voltage for the motor", &BackendSignals::voltage_v},
    {"duty", "", "of the PWM period, -1 to 1", &BackendSignals::duty}};

struct RowColumn {
  const char *name, *unit, *meaning;
  double Row::*value;
  int digits;
};
constexpr RowColumn time_column = {"time_s", "s", "device time of the tick", &Row::time_s, 0};
constexpr RowColumn plant_columns[] = {
    {"theta_rad", "rad", "angle of the plant's lever", &Row::theta_rad, plant_digits},
    {"omega_rad_s", "rad/s", "its velocity", &Row::omega_rad_s, plant_digits},
    {"motor_torque_nm", "Nm", "torque of the plant's motor, averaged over each PWM period",
     &Row::motor_torque_nm, plant_digits},
    {"hand_torque_nm", "Nm", "torque of the hand on the lever", &Row::hand_torque_nm, plant_digits},
    {"hand_felt_nm", "Nm", "its mean over the last 1 ms that is over, which is what a hand feels",
     &Row::hand_felt_nm, plant_digits}};
constexpr RowColumn position_column = {"position_rad", "rad", "the core's count as an angle",
                                       &Row::position_rad, 0};

struct BitColumn {
  const char *name, *meaning;
  int Row::*value;
};
constexpr BitColumn bit_columns[] = {
    {"limits", "bit set of the limits that hold the torque (docs/architecture.md)", &Row::limits},
    {"faults", "bit set of the latched faults (docs/blocks/safety.md)", &Row::faults}};

Column column(const RowColumn& c) {
  return {c.name, c.unit, c.meaning, c.digits, ColumnValue(c.value)};
}

}  // namespace

std::vector<Column> row_columns(bool closed_loop, const std::vector<std::string>& engines) {
  std::vector<Column> all{column(time_column)};
  if (closed_loop) {
    for (const RowColumn& c : plant_columns) all.push_back(column(c));
  }
  all.push_back(column(position_column));
  for (const BackendColumn& c : backend_columns) {
    all.push_back({c.name, c.unit, c.meaning, 0, ColumnValue(c.value)});
  }
  for (const BitColumn& c : bit_columns) {
    all.push_back({c.name, "", c.meaning, 0, ColumnValue(c.value)});
  }
  for (std::size_t i = 0; i < engines.size(); ++i) {
    for (const BackendColumn& c : backend_columns) {
      all.push_back({fmt::format("{}_{}", engines[i], c.name), c.unit, c.meaning, 0,
                     ColumnValue(c.value, i)});
    }
  }
  return all;
}

std::string columns_markdown() {
  std::string text = "| column | unit | meaning |\n|---|---|---|\n";
  for (const Column& c : row_columns(true, {"X"})) {
    text += fmt::format("| `{}` | {} | {} |\n", c.name, c.unit, c.meaning);
  }
  return text;
}

}  // namespace feltgate
