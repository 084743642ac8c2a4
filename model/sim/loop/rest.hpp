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

}  // namespace feltgate
