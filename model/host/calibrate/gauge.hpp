// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The calibrations with a gauge: in open loop voltages, in closed loop torques against a blocked
// shaft, and the torques that the gauge shows. Documentation: docs/calibration.md
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "host/calibrate/regression.hpp"

namespace feltgate::host {

/// One reading of the gauge.
struct Reading {
  double command = 0;  ///< V in open loop, Nm in closed loop
  double torque_nm = 0;
  std::optional<double> tau_hat_nm;  ///< the observer's torque during the reading
  int line = 0;                      ///< line in the file; 0: typed in
};

/// Reads the columns voltage_v (open loop) or tau_ref_nm (closed loop); torque_nm, or force_n with
/// the pulley's arm; and optionally tau_hat_nm. Errors: MeasurementError.
std::vector<Reading> open_loop_readings(const ColumnTable& table, double arm_m);
std::vector<Reading> closed_loop_readings(const ColumnTable& table, double arm_m);

/// Standard deviation of the readings' rounding, from the last decimal place that they use.
double rounding_nm(const std::vector<Reading>& readings);

/// A reading and its fitted value.
struct Residual {
  double command = 0, measured_nm = 0, fitted_nm = 0, studentised = 0;
  bool dead = false;  ///< in the dead zone
  double residual_nm() const { return measured_nm - fitted_nm; }
};

/// Result of the open-loop calibration.
struct OpenLoop {
  double confidence = 0;
  Interval slope_nm_v, dead_voltage_v, resistance_ohm;
  std::optional<Interval> gauge_offset_nm;      ///< only with readings of both signs
  std::optional<Interval> observer_slope_nm_v;  ///< only with tau_hat
  std::vector<Residual> residuals;              ///< sorted by command
  double noise_nm = 0;                          ///< standard deviation
  int freedom = 0;
  std::vector<std::string> warnings;
};

/// Fits torque = slope*(V - V0*sign(V)), 0 in the dead zone, with an offset of the gauge if both
/// signs were read. Errors: MeasurementError if the readings do not determine the result.
OpenLoop fit_open_loop(std::vector<Reading> readings, double torque_constant_nm_a,
                       double confidence);

/// The voltage gains of a law in two regions.
struct Regions {
  Interval low, high;
  std::optional<Interval> border_nm;  ///< none: one gain fits all readings
  double worst_error = 0;             ///< largest remaining error at the readings, relative
};

/// The constants of a law that models the motor.
struct ModelConstants {
  Interval resistance_ohm, dead_voltage_v;  ///< dead voltage including the effect of dead time
};

/// Result of the closed-loop calibration.
struct ClosedLoop {
  double confidence = 0;
  Interval slope, offset_nm;  ///< torque = offset + slope*asked; ideal: 1 and 0
  std::optional<Regions> regions;
  std::optional<ModelConstants> model;
  std::vector<Residual> residuals;
  double noise_nm = 0;
  int freedom = 0;
  std::vector<std::string> warnings;
};

/// Evaluates the readings of a core with this design. For a law in regions, both gains were `gain`
/// during the readings. Errors: MeasurementError if the readings do not determine the result.
ClosedLoop fit_closed_loop(std::vector<Reading> readings, const design::Elaborated& design,
                           double gain, double confidence);

/// Factor for Kp of the paper, which its first calibration adjusts: from the observer's slope to
/// the gauge's; 1 if they agree already.
Interval slope_ratio(const OpenLoop& open);

}  // namespace feltgate::host
