// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/stability/mass_loop.hpp"

#include <algorithm>
#include <cmath>

#include "studies/stability/eigenvalues.hpp"

namespace feltgate::stability {

namespace {

/// States: position, velocity, actuator force, command, position of the sample before; behind them
/// the commands that wait for the end of the dead time, the newest last.
enum : int { kX, kSpeed, kForce, kCommand, kBefore, kScalars };

/// The plant for a time with the command held.
Eigen::MatrixXd flow(const MassLoop& loop, double seconds, int size) {
  Eigen::MatrixXd rate = Eigen::MatrixXd::Zero(size, size);
  rate(kX, kSpeed) = 1;
  rate(kSpeed, kSpeed) = -loop.friction / loop.mass;
  // An ideal actuator leaves the state of a lagging one unused; it must not stand still.
  const bool lags = loop.actuator_s > 0;
  rate(kSpeed, lags ? kForce : kCommand) = 1 / loop.mass;
  rate(kForce, kForce) = -1 / (lags ? loop.actuator_s : loop.period_s);
  if (lags) rate(kForce, kCommand) = 1 / loop.actuator_s;
  return Eigen::MatrixXd::Identity(size, size) + matrix_exp_minus_one(rate, seconds);
}

Eigen::MatrixXd one_period(const MassLoop& loop, double stiffness) {
  const double ratio = loop.dead_time_s / loop.period_s;
  // A hair below a whole number of periods is that number.
  const int whole = static_cast<int>(std::floor(ratio + 1e-9));
  const double rest_s = std::max(0.0, ratio - whole) * loop.period_s;
  const int waiting = whole + 1, size = kScalars + waiting;
  const double b = loop.damping / loop.period_s;
  const Eigen::MatrixXd same = Eigen::MatrixXd::Identity(size, size);
  Eigen::MatrixXd sample = same;
  for (int i = kScalars; i < size - 1; ++i) sample.row(i) = same.row(i + 1);
  sample.row(size - 1).setZero();
  sample(size - 1, kX) = -stiffness - b;
  sample(size - 1, kBefore) = b;
  sample.row(kBefore) = same.row(kX);
  Eigen::MatrixXd take = same;
  take.row(kCommand) = same.row(kScalars);
  return flow(loop, loop.period_s - rest_s, size) * take * flow(loop, rest_s, size) * sample;
}

}  // namespace

double spectral_radius(const MassLoop& loop, double stiffness) {
  return eigenvalues(one_period(loop, stiffness)).cwiseAbs().maxCoeff();
}

double stiffest(const MassLoop& loop) {
  double low = 1e-3 * closed_form(loop);
  if (spectral_radius(loop, low) >= 1) return 0;
  double high = 2 * low;
  for (; spectral_radius(loop, high) < 1; high *= 1.2) low = high;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (spectral_radius(loop, middle) < 1 ? low : high) = middle;
  }
  return low;
}

double closed_form(const MassLoop& loop) {
  return (loop.friction + loop.damping) / (loop.period_s / 2 + loop.actuator_s + loop.dead_time_s);
}

double z_width(double stiffness, double friction, double frequency_hz) {
  return stiffness / (friction * 2 * 3.141592653589793 * frequency_hz);
}

}  // namespace feltgate::stability
