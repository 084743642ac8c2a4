// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The open-loop calibration: voltages against a blocked shaft, and the torque that a gauge shows.
// Documentation: docs/calibration.md
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/calibrate/columns.hpp"
#include "host/calibrate/regression.hpp"

namespace feltgate::host {

/// One reading of the gauge.
struct Reading {
  double command = 0;  ///< V in open loop, Nm in closed loop
  double torque_nm = 0;
  std::optional<double> tau_hat_nm;  ///< what the observer saw meanwhile
  int line = 0;                      ///< of the file, 0: typed
};

/// Columns voltage_v (open loop) or tau_ref_nm (closed loop), torque_nm or force_n with the arm of
/// the pulley, and perhaps tau_hat_nm. Throws MeasurementError.
std::vector<Reading> open_loop_readings(const ColumnTable& table, double arm_m);
std::vector<Reading> closed_loop_readings(const ColumnTable& table, double arm_m);

/// Standard deviation of the rounding of these readings: of the last decimal place that they use.
double rounding_nm(const std::vector<Reading>& readings);

/// A reading beside what was fitted.
struct Residual {
  double command = 0, measured_nm = 0, fitted_nm = 0, studentised = 0;
  bool dead = false;  ///< in the dead zone
  double residual_nm() const { return measured_nm - fitted_nm; }
};

/// Where the line bends, when it does.
struct Bend {
  Interval at_v, slope_below_nm_v, slope_above_nm_v;
  double chance = 1;  ///< that noise alone makes it look so
};

struct OpenLoop {
  double confidence = 0;
  Interval slope_nm_v, dead_voltage_v, resistance_ohm;
  std::optional<Interval> gauge_offset_nm;      ///< with readings of both signs
  std::optional<Interval> observer_slope_nm_v;  ///< with tau_hat
  std::optional<Bend> bend;
  std::vector<Residual> residuals;  ///< by command
  double noise_nm = 0;              ///< standard deviation
  int freedom = 0;
  std::vector<std::string> warnings;
};

/// torque = slope*(V - V0*sign(V)), 0 within the dead zone, with an offset of the gauge where both
/// signs were read. Throws MeasurementError where the readings do not say it.
OpenLoop fit_open_loop(std::vector<Reading> readings, double torque_constant_nm_a,
                       double confidence);

}  // namespace feltgate::host
