// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Identification by least squares over windows. Documentation: docs/identify.md
#include "host/identify/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace feltgate::host {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDriveWindow_s = 0.03;
constexpr double kStandard_m_s2 = 9.80665;
constexpr int kRounds = 20;
/// Least voltage that must drive the current: below it, the effect of dead time depends on the
/// current's ripple.
constexpr double kFlowing_v = 0.4;

double sign(double x) { return x < 0 ? -1.0 : 1.0; }

/// A window with the sign of its current: 1 or -1.
struct Driven {
  const Window* w;
  double current;
};

/// Rows of the regression, from windows in which the lever moves one way and the current has one
/// sign.
class DriveFit {
 public:
  DriveFit(const std::vector<Window>& windows, double electrical_s, double confidence,
           double torque_nm = 0)
      : windows_(windows),
        electrical_s_(electrical_s),
        confidence_(confidence),
        torque_nm_(torque_nm) {
    for (const Window& w : windows_) {
      if (w.slowest_rad_s > kCreep_rad_s) moving_.push_back(&w);
    }
    if (moving_.size() < 6) {
      throw MeasurementError(fmt::format(
          "{} windows in which the lever turns one way faster than {:g} rad/s; record longer, or "
          "at larger voltages",
          moving_.size(), kCreep_rad_s));
    }
  }

  /// Coefficients a, b, c + d; d if the motor braked; and the torque's if there is one.
  Regression run() {
    // First guess: a lever that speeds up has a current along its motion.
    for (const Window* w : moving_) {
      if (w->acceleration_rad_s2 * sign(w->speed_rad_s) > 0) {
        used_.push_back({w, sign(w->speed_rad_s)});
      }
    }
    if (used_.size() < 5) {
      throw MeasurementError(fmt::format(
          "the lever speeds up in {} windows only; step the voltage to and fro, each for 0.1 s or "
          "more",
          used_.size()));
    }
    split_ = false;
    Regression fit = regression();
    for (int round = 0; round < kRounds; ++round) {
      const auto before = used_;
      use_flowing(fit);
      if (used_.size() < 5) {
        throw MeasurementError(
            "hardly a current flows in these windows; step the voltage further, and to and fro");
      }
      fit = regression();
      const bool same = std::equal(used_.begin(), used_.end(), before.begin(), before.end(),
                                   [](const Driven& x, const Driven& y) { return x.w == y.w; });
      if (same) break;
    }
    return fit;
  }

  int used() const { return static_cast<int>(used_.size()); }
  int left_out() const { return static_cast<int>(windows_.size() - used_.size()); }
  bool split() const { return split_; }
  double fastest_rad_s() const {
    double fastest = 0;
    for (const Driven& u : used_) fastest = std::max(fastest, std::abs(u.w->speed_rad_s));
    return fastest;
  }

 private:
  /// Uses the windows in which the voltage after back-EMF and dead voltage drives a current one
  /// way.
  void use_flowing(const Regression& fit) {
    const double b = fit.value(1), dead = split_ ? fit.value(3) : fit.value(2);
    used_.clear();
    int braking = 0;
    for (const Window* w : moving_) {
      const double left = w->voltage_v - b * w->speed_rad_s;
      // Within the window the speed changes by about this much in each direction.
      const double span = std::abs(b * w->acceleration_rad_s2) * (w->to_s - w->from_s) / 3 +
                          (w->most_v - w->least_v) / 2;
      if (std::abs(left) - span < dead + kFlowing_v) continue;
      used_.push_back({w, sign(left)});
      braking += sign(left) != sign(w->speed_rad_s) ? 1 : 0;
    }
    split_ = braking >= 3 && used() - braking >= 3;
    if (!split_) {
      used_.erase(
          std::remove_if(used_.begin(), used_.end(),
                         [](const Driven& u) { return u.current != sign(u.w->speed_rad_s); }),
          used_.end());
    }
  }

  Regression regression() const {
    const bool weight = torque_nm_ != 0;
    const auto n = static_cast<Index>(used_.size());
    MatrixXd x(n, 3 + (split_ ? 1 : 0) + (weight ? 1 : 0));
    VectorXd y(n);
    for (Index k = 0; k < n; ++k) {
      const Driven& u = used_[static_cast<std::size_t>(k)];
      x(k, 0) = u.w->acceleration_rad_s2 + electrical_s_ * u.w->jerk_rad_s3;
      x(k, 1) = u.w->speed_rad_s;
      // Writes c*sign(w) + d*sign(i) as (c + d)*sign(w) + d*(sign(i) - sign(w)).
      x(k, 2) = sign(u.w->speed_rad_s);
      if (split_) x(k, 3) = u.current - sign(u.w->speed_rad_s);
      if (weight) x(k, x.cols() - 1) = torque_nm_ * u.w->cosine;
      y[k] = u.w->voltage_v;
    }
    return {x, y, confidence_};
  }

  const std::vector<Window>& windows_;
  double electrical_s_, confidence_, torque_nm_;
  std::vector<const Window*> moving_;
  std::vector<Driven> used_;
  bool split_ = false;
};

void refuse_nonsense(const Recording& r, const Regression& fit) {
  if (fit.value(0) > 0 && fit.value(1) > 0) return;
  throw MeasurementError(fmt::format(
      "{}: a larger voltage slows the lever down; turn the sign of one column round, or set "
      "control.encoder_polarity",
      r.name));
}

}  // namespace

Drive identify_drive(const Recording& recording, double electrical_s, double confidence) {
  const auto windows = windows_of(recording, kDriveWindow_s);
  DriveFit driven(windows, electrical_s, confidence);
  const Regression fit = driven.run();
  refuse_nonsense(recording, fit);
  Drive d;
  d.inertia_v_s2 = fit.coefficient(0);
  d.speed_v_s = fit.coefficient(1);
  d.both_v = fit.coefficient(2);
  if (driven.split()) {
    VectorXd w = VectorXd::Zero(fit.size());
    w[2] = 1;
    w[3] = -1;
    d.friction_v = fit.combination({0, w});
    d.dead_v = fit.coefficient(3);
  }
  d.noise_v = fit.sigma();
  d.freedom = fit.freedom();
  d.windows = driven.used();
  d.left_out = driven.left_out();
  d.fastest_rad_s = driven.fastest_rad_s();
  d.covariance = fit.covariance().topLeftCorner(3, 3);
  return d;
}

Weighed identify_weight(const Recording& recording, double mass_kg, double radius_m,
                        double level_rad, double electrical_s, double confidence) {
  const auto windows = windows_of(recording, kDriveWindow_s, level_rad);
  double least = 1, most = -1;
  for (const Window& w : windows) {
    least = std::min(least, w.cosine);
    most = std::max(most, w.cosine);
  }
  if (most - least < 0.2) {
    throw MeasurementError(
        fmt::format("{}: the weight's torque hardly changes; let the lever turn further, through "
                    "level and upright",
                    recording.name));
  }
  DriveFit driven(windows, electrical_s, confidence, mass_kg * kStandard_m_s2 * radius_m);
  const Regression fit = driven.run();
  refuse_nonsense(recording, fit);
  return {fit.coefficient(fit.size() - 1), fit.freedom()};
}

}  // namespace feltgate::host
