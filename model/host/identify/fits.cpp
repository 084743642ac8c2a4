// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Least squares over a driven recording and over a coast-down. Documentation: docs/calibration.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/identify/identify.hpp"

namespace feltgate::host {

namespace {

constexpr int kRounds = 20;
constexpr std::size_t kFewest = 5;
/// Below this speed, friction still depends on the speed.
constexpr double kCreep_rad_s = 2;
/// Least voltage that must drive the current: below it, the effect of dead time depends on the
/// current's ripple.
constexpr double kFlowing_v = 0.4;

double sign(double x) { return x < 0 ? -1.0 : 1.0; }

Regression regression(const std::vector<const Window*>& used, double electrical_s) {
  const auto n = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd x(n, 3);
  Eigen::VectorXd y(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Window& w = *used[static_cast<std::size_t>(k)];
    x.row(k) << w.acceleration_rad_s2 + electrical_s * w.jerk_rad_s3, w.speed_rad_s,
        sign(w.speed_rad_s);
    y[k] = w.voltage_v;
  }
  return {x, y, kConfidence};
}

}  // namespace

Drive identify_drive(const Recording& r, double electrical_s) {
  const std::vector<Window> windows = windows_of(r);
  std::vector<const Window*> moving, used;
  for (const Window& w : windows) {
    if (w.slowest_rad_s <= kCreep_rad_s) continue;
    moving.push_back(&w);
    // First guess: a lever that speeds up has a current along its motion.
    if (w.acceleration_rad_s2 * w.speed_rad_s > 0) used.push_back(&w);
  }
  for (int round = 0; round < kRounds; ++round) {
    if (used.size() < kFewest) {
      throw MeasurementError(fmt::format(
          "{}: of {} windows in which the lever turns one way faster than {:g} rad/s a current "
          "drives it in {}; step the voltage to and fro, each for 0.1 s or more, or further",
          r.name, moving.size(), kCreep_rad_s, used.size()));
    }
    const Regression fit = regression(used, electrical_s);
    // Next the windows in which the voltage after back-EMF and dead voltage drives a current along
    // the motion.
    const auto before = used;
    used.clear();
    for (const Window* w : moving) {
      const double left = w->voltage_v - fit.value(1) * w->speed_rad_s;
      // Within the window the speed changes by about this much in each direction.
      const double span = std::abs(fit.value(1) * w->acceleration_rad_s2) *
                          (r.time_s[w->last] - r.time_s[w->first]) / 3;
      if (left * sign(w->speed_rad_s) - span >= fit.value(2) + kFlowing_v) used.push_back(w);
    }
    if (used == before) break;
  }
  const Regression fit = regression(used, electrical_s);
  if (!(fit.value(0) > 0 && fit.value(1) > 0)) {
    throw MeasurementError(fmt::format(
        "{}: a larger voltage slows the lever down; turn the sign of one column round, or set "
        "control.encoder_polarity",
        r.name));
  }
  return {fit.coefficient(0), fit.coefficient(1), fit.coefficient(2), fit.freedom(),
          fit.covariance()};
}

Coast identify_coast(const Recording& r) {
  // The last windows in which the lever slows down; before them it was still driven, with another
  // voltage.
  const std::vector<Window> windows = windows_of(r);
  std::vector<const Window*> used;
  for (const Window& w : windows) {
    if (w.slowest_rad_s <= kCreep_rad_s) continue;
    if (w.acceleration_rad_s2 * w.speed_rad_s >= 0 ||
        std::abs(w.voltage_v - windows.back().voltage_v) > kFlowing_v) {
      used.clear();
    } else {
      used.push_back(&w);
    }
  }
  if (used.size() < kFewest) {
    throw MeasurementError(fmt::format(
        "{}: the lever runs down in {} windows only; let it go at a higher speed, and record until "
        "it stands",
        r.name, used.size()));
  }
  // dw/dt = -(B/J) w - (F/J), integrated twice: linear in start, speed, B/J and F/J.
  const std::size_t first = used.front()->first, last = used.back()->last;
  const double direction = sign(used.front()->speed_rad_s);
  const auto n = static_cast<Eigen::Index>(last - first + 1);
  Eigen::MatrixXd x(n, 4);
  Eigen::VectorXd y(n);
  double integral = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t row = first + static_cast<std::size_t>(k);
    const double t = r.time_s[row] - r.time_s[first];
    y[k] = direction * (r.angle_rad[row] - r.angle_rad[first]);
    if (k > 0) integral += (y[k] + y[k - 1]) / 2 * (r.time_s[row] - r.time_s[row - 1]);
    x.row(k) << 1, t, -integral, -t * t / 2;
  }
  const Regression fit(x, y, kConfidence);
  return {fit.coefficient(2), fit.coefficient(3), fit.freedom(),
          fit.covariance().bottomRightCorner(2, 2)};
}

}  // namespace feltgate::host
