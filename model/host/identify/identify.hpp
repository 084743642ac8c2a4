// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Constants of a motor that voltage and position determine, and those that they do not.
// Documentation: docs/identify.md
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/calibrate/regression.hpp"
#include "host/identify/recording.hpp"
#include "host/identify/windows.hpp"

namespace feltgate::host {

/// V = a*dw/dt + b*w + c*sign(w) + d*sign(i): all that a driven recording can determine.
struct Drive {
  Interval inertia_v_s2;  ///< a = J R/Kt
  Interval speed_v_s;     ///< b = Ke + B R/Kt
  /// F R/Kt + Vd: friction and dead voltage, which cannot be separated if the motor never brakes.
  Interval both_v;
  std::optional<Interval> friction_v, dead_v;  ///< c and d separately, if the motor braked
  double noise_v = 0;
  int freedom = 0, windows = 0, left_out = 0;
  double fastest_rad_s = 0;
  Eigen::MatrixXd covariance;  ///< of a, b, c + d
};

/// Gates off: dw/dt = -(B/J)*w - (F/J)*sign(w).
struct Coast {
  Interval damping_1_s;      ///< B/J
  Interval friction_rad_s2;  ///< F/J
  double noise_rad = 0;      ///< of the position; rounding to counts gives 0.29 count
  int freedom = 0;
  double length_s = 0;
  double fastest_rad_s = 0;
  Eigen::MatrixXd covariance;
};

/// Voltage per known torque, R/Kt [V/Nm], from a weight on the lever.
struct Weighed {
  Interval volts_per_nm;
  int freedom = 0;
};

/// Below this speed, friction still depends on the speed.
inline constexpr double kCreep_rad_s = 2;

/// Errors: MeasurementError if the recording does not determine the result. `electrical_s` is L/R:
/// the current follows the voltage with this delay, which makes the inertia look smaller by L/R
/// over the time constant of a start; 0 leaves that uncorrected.
Drive identify_drive(const Recording& recording, double electrical_s, double confidence);
Coast identify_coast(const Recording& recording, double confidence);
/// A second driven recording, with a weight: torque mass*g*radius where the arm is level, at the
/// angle `level_rad`; the shaft must be horizontal.
Weighed identify_weight(const Recording& recording, double mass_kg, double radius_m,
                        double level_rad, double electrical_s, double confidence);

/// What an absolute encoder shows beyond the angle of its shaft, as harmonics of the angle that it
/// shows: the sum of cosines and sines of n times the angle, n from 1 on.
struct EncoderError {
  std::vector<Interval> terms_rad;  ///< cosine 1, sine 1, cosine 2, ...
  double largest_rad = 0;           ///< of the sum, over a turn
  double noise_rad = 0;             ///< left over; rounding to counts gives 0.29 count
  double turns = 0, slowest_rad_s = 0, fastest_rad_s = 0;
  bool by_reference = false;
  int freedom = 0;
  std::vector<std::string> warnings;
};

/// From a turn that no torque disturbs, over three revolutions or more: whatever repeats with the
/// shaft is the encoder's error, and the rest is a smooth motion. With a reference, from that.
/// Errors: MeasurementError if the recording does not determine the result.
EncoderError identify_encoder(const Recording& turn, int harmonics, double count_rad,
                              double confidence);

/// Measurements that separate the constants; each may be missing.
struct Separation {
  std::optional<double> resistance_ohm;  ///< from an ohmmeter, with wiring and bridge
  double resistance_error_ohm = 0;       ///< its standard deviation
  std::optional<Drive> loaded;           ///< the same drive with an additional known inertia
  double added_kg_m2 = 0;
  std::optional<Weighed> weighed;
  std::optional<double> emf_constant_v_s_rad;  ///< from a data sheet, if there is no coast-down
};

/// Constants with intervals; empty if nothing separates them.
struct Constants {
  std::optional<Interval> emf_v_s_rad;  ///< Ke, equal to Kt in SI units
  std::optional<Interval> resistance_ohm, inertia_kg_m2, damping_nm_s_rad, friction_nm,
      dead_voltage_v;
  std::vector<std::string> next;  ///< measurements that would give more, one line each
  std::vector<std::string> warnings;
};

Constants separate(const Drive& drive, const std::optional<Coast>& coast, const Separation& known,
                   double confidence);

}  // namespace feltgate::host
