// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Constants of a motor from its voltage and position: a driven recording, a coast-down, and R by an
// ohmmeter. Documentation: docs/calibration.md
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "host/calibrate/regression.hpp"
#include "host/calibrate/report.hpp"

namespace feltgate::host {

// Voltage and position over time, and their integrals over windows.

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

/// V = a*dw/dt + b*w + c*sign(w): all that a driven recording can determine.
struct Drive {
  Interval inertia_v_s2;  ///< a = J R/Kt
  Interval speed_v_s;     ///< b = Ke + B R/Kt
  Interval both_v;        ///< c = F R/Kt + Vd: friction and dead voltage
  int freedom = 0;
  Eigen::MatrixXd covariance;  ///< of a, b, c
};

/// Gates off: dw/dt = -(B/J)*w - (F/J)*sign(w).
struct Coast {
  Interval damping_1_s;      ///< B/J
  Interval friction_rad_s2;  ///< F/J
  int freedom = 0;
  Eigen::MatrixXd covariance;
};

/// Of all intervals.
inline constexpr double kConfidence = 0.95;

/// Errors: MeasurementError if the recording does not determine the result. `electrical_s` is L/R:
/// the current follows the voltage with this delay, which makes the inertia look smaller by L/R
/// over the time constant of a start; 0 leaves that uncorrected.
Drive identify_drive(const Recording& recording, double electrical_s);
Coast identify_coast(const Recording& recording);

/// Constants with intervals; empty if nothing separates them.
struct Constants {
  std::optional<Interval> emf_v_s_rad;  ///< Ke, equal to Kt in SI units
  std::optional<Interval> resistance_ohm, inertia_kg_m2, damping_nm_s_rad, friction_nm,
      dead_voltage_v;
  std::vector<std::string> next;  ///< measurements that would give more, one line each
};

/// `resistance_ohm`: from an ohmmeter, with wiring and bridge; 0: not measured.
Constants constants_of(const Drive& drive, const std::optional<Coast>& coast,
                       double resistance_ohm);

std::string report_text(const Drive& drive, const std::optional<Coast>& coast, const Constants& c);
nlohmann::ordered_json report_json(const Drive& drive, const std::optional<Coast>& coast,
                                   const Constants& c);
/// The changes to a design that follow from the known constants.
std::vector<Change> changes_of(const Constants& c, const design::Elaborated& design);

}  // namespace feltgate::host
