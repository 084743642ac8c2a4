// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The closed-loop calibration: commanded torques against a blocked shaft, and the readings of a
// gauge. Documentation: docs/calibration.md
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "host/calibrate/open_loop.hpp"

namespace feltgate::host {

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
