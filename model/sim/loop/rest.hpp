// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How quiet a lever is that should be at rest. Documentation: docs/scenes.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>

#include "../backends/backend.hpp"
#include "feltgate/largest.hpp"

namespace feltgate {

/// Mean, standard deviation and extremes of a value that comes once per tick.
class Spread {
 public:
  void add(double v) {
    ++n_;
    const double off = v - mean_;
    mean_ += off / static_cast<double>(n_);
    squares_ += off * (v - mean_);
    low_ = smaller(low_, v);
    high_ = larger(high_, v);
  }
  double mean() const { return mean_; }
  /// Root-mean-square distance from the mean.
  double rms() const { return n_ == 0 ? 0.0 : std::sqrt(squares_ / static_cast<double>(n_)); }
  double range() const { return n_ == 0 ? 0.0 : high_ - low_; }

 private:
  std::int64_t n_ = 0;
  double mean_ = 0, squares_ = 0, low_ = 1e300, high_ = -1e300;
};

/// Angle and torque from a clock on.
struct Rest {
  Clock from_clock = std::numeric_limits<Clock>::max();
  Spread theta_rad, tau_ref_nm;

  void add(double theta, double tau_ref) {
    theta_rad.add(theta);
    tau_ref_nm.add(tau_ref);
  }
  /// Adds them to the figures of a run.
  void tell(std::map<std::string, double>& figures) const {
    figures["rest_theta_rms_rad"] = theta_rad.rms();
    figures["rest_theta_range_rad"] = theta_rad.range();
    figures["rest_tau_ref_rms_nm"] = tau_ref_nm.rms();
    figures["rest_tau_ref_mean_nm"] = tau_ref_nm.mean();
  }
};

// How heavy a lever feels that a hand swings: the share of the hand's torque in phase with the
// speed, and the share in phase with the acceleration.

/// Accumulates the hand's torque from a clock on. Over whole half swings, from turn to turn, speed
/// and acceleration are orthogonal, so the two shares are those of least squares.
class Drag {
 public:
  Clock from_clock = std::numeric_limits<Clock>::max();

  /// One step of the plant: the hand's mean torque in it, and the speeds at its start and end.
  void step(double dt_s, double hand_nm, double before_rad_s, double after_rad_s) {
    const double speed = 0.5 * (before_rad_s + after_rad_s);
    const double acceleration = (after_rad_s - before_rad_s) / dt_s;
    seconds_ += dt_s;
    squares_ += hand_nm * hand_nm * dt_s;
    with_speed_ += hand_nm * speed * dt_s;
    with_acceleration_ += hand_nm * acceleration * dt_s;
    speeds_ += speed * speed * dt_s;
    accelerations_ += acceleration * acceleration * dt_s;
  }
  /// Adds the figures of a run; both are 0 for a lever that never moved.
  void tell(std::map<std::string, double>& figures) const {
    const auto share = [](double of, double in) { return in > 0 ? of / in : 0.0; };
    figures["drag_rms_nm"] = std::sqrt(share(squares_, seconds_));
    figures["drag_damping_nm_s_rad"] = share(with_speed_, speeds_);
    figures["drag_inertia_kg_m2"] = share(with_acceleration_, accelerations_);
  }

 private:
  double seconds_ = 0, squares_ = 0, with_speed_ = 0, with_acceleration_ = 0, speeds_ = 0,
         accelerations_ = 0;
};

}  // namespace feltgate
