// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Weighted integrals of a recording over windows. Documentation: docs/calibration.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/calibrate/regression.hpp"
#include "host/identify/recording.hpp"

namespace feltgate::host {

namespace {

constexpr std::size_t kRows = 32;  ///< least rows in a window
constexpr double kShortest_s = 0.03;
constexpr double kSlowest_s = 3e-3;  ///< longest time between rows
/// Largest step of the voltage between rows, relative to its range.
constexpr double kJump = 0.03;
constexpr std::size_t kPieces = 6;  ///< parts of a window in which the speed is checked for a turn

Window window(const Recording& r, std::size_t first, std::size_t last) {
  Window w;
  w.first = first;
  w.last = last;
  const double from_s = r.time_s[first], length = r.time_s[last] - from_s;
  const double middle_rad = r.angle_rad[(first + last) / 2];
  for (std::size_t k = first; k <= last; ++k) {
    // The weight (x(1-x))^5 on 0..1, normalised to integral 1, with its first three derivatives.
    constexpr double norm = 2772;  // 11!/(5!)^2
    const double x = (r.time_s[k] - from_s) / length, u = x * (1 - x), du = 1 - 2 * x;
    const double u3 = u * u * u, value = norm * u3 * u * u, slope = norm * 5 * u3 * u * du;
    const double bend = norm * (20 * u3 * du * du - 10 * u3 * u);
    const double twist = norm * (60 * u * u * du * du * du - 120 * u3 * du);
    // The trapezoidal rule is as exact as any where the integrand vanishes so smoothly at the ends.
    const double before = k > first ? r.time_s[k] - r.time_s[k - 1] : 0;
    const double after = k < last ? r.time_s[k + 1] - r.time_s[k] : 0;
    const double dx = (before + after) / 2 / length;
    const double way = r.angle_rad[k] - middle_rad;
    w.voltage_v += dx * value * r.voltage_v[k];
    w.speed_rad_s -= dx * slope * way / length;
    w.acceleration_rad_s2 += dx * bend * way / (length * length);
    w.jerk_rad_s3 -= dx * twist * way / (length * length * length);
  }
  w.slowest_rad_s = std::abs(w.speed_rad_s);
  for (std::size_t piece = 0; piece < kPieces; ++piece) {
    const std::size_t a = first + (last - first) * piece / kPieces;
    const std::size_t b = first + (last - first) * (piece + 1) / kPieces;
    const double speed = (r.angle_rad[b] - r.angle_rad[a]) / (r.time_s[b] - r.time_s[a]);
    w.slowest_rad_s = std::min(w.slowest_rad_s, w.speed_rad_s < 0 ? -speed : speed);
  }
  return w;
}

}  // namespace

std::vector<Window> windows_of(const Recording& r) {
  const double step_s = r.length_s() / static_cast<double>(r.rows() - 1);
  if (step_s > kSlowest_s) {
    throw MeasurementError(fmt::format(
        "{}:1: a row every {:.3g} ms; the speed changes within tens of ms, record every ms", r.name,
        1e3 * step_s));
  }
  const auto rows = std::max(kRows, static_cast<std::size_t>(std::lround(kShortest_s / step_s)));
  const auto [low, high] = std::minmax_element(r.voltage_v.begin(), r.voltage_v.end());
  const double jump = kJump * (*high - *low);
  std::vector<Window> windows;
  std::size_t first = 0;
  for (std::size_t k = 1; k < r.rows(); ++k) {
    if (std::abs(r.voltage_v[k] - r.voltage_v[k - 1]) > jump ||
        r.time_s[k] - r.time_s[k - 1] > 1.5 * step_s) {
      first = k;
    } else if (k - first == rows) {
      windows.push_back(window(r, first, k));
      first = k;
    }
  }
  if (windows.empty()) {
    throw MeasurementError(fmt::format(
        "{}:1: the voltage or the time jumps every {:.3g} ms or sooner; hold each voltage for 0.1 "
        "s or more, a row a ms",
        r.name, 1e3 * static_cast<double>(rows) * step_s));
  }
  return windows;
}

}  // namespace feltgate::host
