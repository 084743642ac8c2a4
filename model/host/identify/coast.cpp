// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Evaluates a coast-down of the lever: the angle has a closed form, which is fitted to the counts.
// Documentation: docs/identify.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/identify/identify.hpp"

namespace feltgate::host {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kWindow_s = 0.06, kShortest_s = 0.015;
constexpr int kCoastRounds = 30;
constexpr double kSteepest_1_s = 1e3;

/// The last windows, in which the lever slows down; before them it was still driven.
std::vector<const Window*> slowing(const std::vector<Window>& windows) {
  std::vector<const Window*> used;
  for (const Window& w : windows) {
    if (w.slowest_rad_s <= kCreep_rad_s) continue;
    if (w.acceleration_rad_s2 * w.speed_rad_s >= 0) {
      used.clear();
    } else {
      used.push_back(&w);
    }
  }
  return used;
}

/// The angle without its constant, for speed w0, damping b (1/s) and friction f (rad/s^2):
/// w0*e1 - f*e2, e1 = (1 - exp(-b t))/b, e2 = (t - e1)/b.
struct Way {
  double e1, e2;
};

Way way(double b, double t) {
  const double x = b * t;
  if (std::abs(x) < 1e-4) return {t * (1 - x / 2 + x * x / 6), t * t * (0.5 - x / 6 + x * x / 24)};
  const double e1 = -std::expm1(-x) / b;
  return {e1, (t - e1) / b};
}

/// Gauss-Newton fit of angle, speed, damping and friction; keeps the columns of the last iteration.
class CoastFit {
 public:
  CoastFit(const Recording& r, double from_s, double to_s) {
    for (std::size_t k = 0; k < r.rows(); ++k) {
      if (r.time_s[k] < from_s || r.time_s[k] > to_s) continue;
      time_s_.push_back(r.time_s[k] - from_s);
      angle_rad_.push_back(r.angle_rad[k] - r.angle_rad.front());
    }
  }

  /// Fits, starting from a guess of speed, damping and friction.
  Regression run(double speed_rad_s, double damping_1_s, double friction_rad_s2,
                 double confidence) {
    p_ << angle_rad_.front(), speed_rad_s, damping_1_s, friction_rad_s2;
    for (int round = 0; round < kCoastRounds; ++round) {
      const Regression step = regression(confidence);
      Eigen::Vector4d d;
      for (int k = 0; k < 4; ++k) d[k] = step.value(k);
      p_ += d;
      if (!p_.allFinite() || std::abs(p_[2]) > kSteepest_1_s) {
        throw MeasurementError(
            "the coast-down is no line of dry and viscous friction; let nothing touch the lever, "
            "and record from where it is let go");
      }
      if (std::abs(d[2]) < 1e-9 && std::abs(d[3]) < 1e-9 * std::abs(p_[3])) break;
    }
    return regression(confidence);
  }
  double damping_1_s() const { return p_[2]; }
  double friction_rad_s2() const { return p_[3]; }

 private:
  Regression regression(double confidence) const {
    const auto n = static_cast<Index>(time_s_.size());
    MatrixXd x(n, 4);
    VectorXd y(n);
    for (Index k = 0; k < n; ++k) {
      const double t = time_s_[static_cast<std::size_t>(k)], b = p_[2];
      const double db = 1e-4 / std::max(t, 1e-3);
      const Way w = way(b, t), up = way(b + db, t), down = way(b - db, t);
      x(k, 0) = 1;
      x(k, 1) = w.e1;
      x(k, 2) = (p_[1] * (up.e1 - down.e1) - p_[3] * (up.e2 - down.e2)) / (2 * db);
      x(k, 3) = -w.e2;
      y[k] = angle_rad_[static_cast<std::size_t>(k)] - (p_[0] + p_[1] * w.e1 - p_[3] * w.e2);
    }
    return {x, y, confidence};
  }

  std::vector<double> time_s_, angle_rad_;
  Eigen::Vector4d p_;
};

/// First guess of damping and friction, from the windows alone: coarse, but direct.
std::pair<double, double> guess(const std::vector<const Window*>& windows, double confidence) {
  const auto n = static_cast<Index>(windows.size());
  MatrixXd x(n, 2);
  VectorXd y(n);
  for (Index k = 0; k < n; ++k) {
    const Window& w = *windows[static_cast<std::size_t>(k)];
    x(k, 0) = -std::abs(w.speed_rad_s);
    x(k, 1) = -1;
    y[k] = -std::abs(w.acceleration_rad_s2);
  }
  const Regression fit(x, y, confidence);
  return {fit.value(0), fit.value(1)};
}

}  // namespace

Coast identify_coast(const Recording& recording, double confidence) {
  std::vector<Window> windows;
  std::vector<const Window*> used;
  for (double shortest_s = kWindow_s; shortest_s >= kShortest_s; shortest_s /= 2) {
    windows = windows_of(recording, shortest_s);
    used = slowing(windows);
    if (used.size() >= 8) break;
  }
  if (used.size() < 4) {
    throw MeasurementError(fmt::format(
        "{}: the lever runs down in {} windows only; let it go at a higher speed, and record until "
        "it stands",
        recording.name, used.size()));
  }
  Recording turned = recording;
  if (used.front()->speed_rad_s < 0) {
    for (double& a : turned.angle_rad) a = -a;
  }
  CoastFit coast(turned, used.front()->from_s, used.back()->to_s);
  const auto [damping_1_s, friction_rad_s2] = guess(used, confidence);
  const Regression fit =
      coast.run(std::abs(used.front()->speed_rad_s), damping_1_s, friction_rad_s2, confidence);
  Coast c;
  c.damping_1_s = fit.coefficient(2).plus(coast.damping_1_s());
  c.friction_rad_s2 = fit.coefficient(3).plus(coast.friction_rad_s2());
  c.noise_rad = fit.sigma();
  c.freedom = fit.freedom();
  c.length_s = used.back()->to_s - used.front()->from_s;
  c.covariance = fit.covariance().bottomRightCorner(2, 2);
  for (const Window* w : used) {
    c.fastest_rad_s = std::max(c.fastest_rad_s, std::abs(w->speed_rad_s));
  }
  return c;
}

}  // namespace feltgate::host
