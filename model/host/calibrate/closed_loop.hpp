// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The closed-loop calibration: torques asked for against a blocked shaft, and what the gauge shows.
// Documentation: docs/calibration.md
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
  std::optional<Interval> border_nm;  ///< none: one gain serves all readings
  double worst_error = 0;             ///< that is left, relative, at the readings
};

/// The constants of a law that models the motor.
struct ModelConstants {
  Interval resistance_ohm, dead_voltage_v;  ///< the latter with what the dead time takes
};

struct ClosedLoop {
  double confidence = 0;
  Interval slope, offset_nm;  ///< torque = offset + slope*asked; 1 and 0 would be right
  std::optional<Regions> regions;
  std::optional<ModelConstants> model;
  std::vector<Residual> residuals;
  double noise_nm = 0;
  int freedom = 0;
  std::vector<std::string> warnings;
};

/// The readings of a core with this design. A law in regions was read with both gains at `gain`.
/// Throws MeasurementError where the readings do not say it.
ClosedLoop fit_closed_loop(std::vector<Reading> readings, const design::Elaborated& design,
                           double gain, double confidence);

/// Kp of the paper: what its first calibration adjusts. The factor from the observer's slope to the
/// gauge's, 1 where they agree already.
Interval slope_ratio(const OpenLoop& open);

}  // namespace feltgate::host
