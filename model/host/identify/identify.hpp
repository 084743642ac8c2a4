// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What voltage and position say of a motor, and what they cannot. Documentation: docs/identify.md
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/calibrate/regression.hpp"
#include "host/identify/recording.hpp"
#include "host/identify/windows.hpp"

namespace feltgate::host {

/// V = a*dw/dt + b*w + c*sign(w) + d*sign(i): all that a driven recording can say.
struct Drive {
  Interval inertia_v_s2;  ///< a = J R/Kt
  Interval speed_v_s;     ///< b = Ke + B R/Kt
  /// F R/Kt + Vd, friction and dead voltage, which are one where the motor never brakes.
  Interval both_v;
  std::optional<Interval> friction_v, dead_v;  ///< c and d by themselves, where it did
  double noise_v = 0;
  int freedom = 0, windows = 0, left_out = 0;
  double fastest_rad_s = 0;
  Eigen::MatrixXd covariance;  ///< of a, b, c + d
};

/// dw/dt = -(B/J)*w - (F/J)*sign(w), the gates open.
struct Coast {
  Interval damping_1_s;      ///< B/J
  Interval friction_rad_s2;  ///< F/J
  double noise_rad = 0;      ///< of the position: a count has 0.29 of one
  int freedom = 0;
  double length_s = 0;
  double fastest_rad_s = 0;
  Eigen::MatrixXd covariance;
};

/// V/Nm: what a known torque is worth, R/Kt, from a weight on the lever.
struct Weighed {
  Interval volts_per_nm;
  int freedom = 0;
};

/// Slower than this friction is not yet the same for all speeds.
inline constexpr double kCreep_rad_s = 2;

/// Throws MeasurementError where the recording does not say it. `electrical_s` is L/R: the current
/// follows the voltage so much later, which makes the inertia look smaller by L/R over the time
/// constant of a start; 0 leaves it at that.
Drive identify_drive(const Recording& recording, double electrical_s, double confidence);
Coast identify_coast(const Recording& recording, double confidence);
/// A second driven recording, with a weight: mass*g*radius torque where the arm is level, its angle
/// `level_rad`; the shaft lies.
Weighed identify_weight(const Recording& recording, double mass_kg, double radius_m,
                        double level_rad, double electrical_s, double confidence);

/// What separates the constants; each may be missing.
struct Separation {
  std::optional<double> resistance_ohm;  ///< by ohmmeter, with wiring and bridge
  double resistance_error_ohm = 0;       ///< standard deviation of that
  std::optional<Drive> loaded;           ///< the same drive with a known inertia more
  double added_kg_m2 = 0;
  std::optional<Weighed> weighed;
  std::optional<double> emf_constant_v_s_rad;  ///< of a data sheet, where there is no coast-down
};

/// Constants with intervals; empty where nothing separates them.
struct Constants {
  std::optional<Interval> emf_v_s_rad;  ///< Ke, and Kt: equal in SI units
  std::optional<Interval> resistance_ohm, inertia_kg_m2, damping_nm_s_rad, friction_nm,
      dead_voltage_v;
  std::vector<std::string> next;  ///< what to measure for more, one line each
  std::vector<std::string> warnings;
};

Constants separate(const Drive& drive, const std::optional<Coast>& coast, const Separation& known,
                   double confidence);

}  // namespace feltgate::host
