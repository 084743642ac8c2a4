// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Weighted integrals of a recording over windows. Documentation: docs/identify.md
#include "host/identify/windows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/calibrate/regression.hpp"

namespace feltgate::host {

namespace {

constexpr int kRows = 32;            ///< least rows in a window
constexpr double kSlowest_s = 3e-3;  ///< longest time between rows
/// Largest step of the voltage between rows, relative to its range.
constexpr double kJump = 0.03;
constexpr int kPieces = 6;  ///< parts of a window in which the speed is checked for a turn

/// The weight (x(1-x))^5 on 0..1, normalised to integral 1, with its first three derivatives.
struct Weight {
  double value, slope, bend, twist;
};

Weight weight(double x) {
  constexpr double norm = 2772;  // 11!/(5!)^2
  const double u = x * (1 - x), du = 1 - 2 * x, u2 = u * u, u3 = u2 * u;
  return {norm * u3 * u2, norm * 5 * u3 * u * du, norm * (20 * u3 * du * du - 10 * u3 * u),
          norm * (60 * u2 * du * du * du - 120 * u3 * du)};
}

double median_step(const Recording& r) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < r.rows(); ++k) steps.push_back(r.time_s[k] - r.time_s[k - 1]);
  std::nth_element(steps.begin(), steps.begin() + static_cast<long>(steps.size() / 2), steps.end());
  return steps[steps.size() / 2];
}

/// Rows [first, last] without a jump of the voltage and without a gap in time.
struct Stretch {
  std::size_t first, last;
};

std::vector<Stretch> stretches_of(const Recording& r, double step_s) {
  const auto [low, high] = std::minmax_element(r.voltage_v.begin(), r.voltage_v.end());
  const double jump = kJump * (*high - *low);
  std::vector<Stretch> stretches;
  std::size_t first = 0;
  const auto end = [&](std::size_t last) {
    if (last > first) stretches.push_back({first, last});
  };
  for (std::size_t k = 1; k < r.rows(); ++k) {
    const bool jumps = std::abs(r.voltage_v[k] - r.voltage_v[k - 1]) > jump;
    if (!jumps && r.time_s[k] - r.time_s[k - 1] < 1.5 * step_s) continue;
    end(k - 1);
    first = k;
  }
  end(r.rows() - 1);
  return stretches;
}

Window window(const Recording& r, std::size_t first, std::size_t last, double level_rad) {
  Window w;
  w.from_s = r.time_s[first];
  w.to_s = r.time_s[last];
  const double length = w.to_s - w.from_s;
  const double middle_rad = r.angle_rad[(first + last) / 2];
  w.least_v = w.most_v = r.voltage_v[first];
  for (std::size_t k = first; k <= last; ++k) {
    const Weight g = weight((r.time_s[k] - w.from_s) / length);
    // The trapezoidal rule is as exact as any where the integrand vanishes so smoothly at the ends.
    const double before = k > first ? r.time_s[k] - r.time_s[k - 1] : 0;
    const double after = k < last ? r.time_s[k + 1] - r.time_s[k] : 0;
    const double dx = (before + after) / 2 / length;
    const double way = r.angle_rad[k] - middle_rad;
    w.voltage_v += dx * g.value * r.voltage_v[k];
    w.speed_rad_s -= dx * g.slope * way / length;
    w.acceleration_rad_s2 += dx * g.bend * way / (length * length);
    w.jerk_rad_s3 -= dx * g.twist * way / (length * length * length);
    w.cosine += dx * g.value * std::cos(r.angle_rad[k] - level_rad);
    w.least_v = std::min(w.least_v, r.voltage_v[k]);
    w.most_v = std::max(w.most_v, r.voltage_v[k]);
  }
  w.slowest_rad_s = std::numeric_limits<double>::infinity();
  for (int piece = 0; piece < kPieces; ++piece) {
    const std::size_t span = last - first;
    const std::size_t a = first + span * static_cast<std::size_t>(piece) / kPieces;
    const std::size_t b = first + span * static_cast<std::size_t>(piece + 1) / kPieces;
    const double speed = (r.angle_rad[b] - r.angle_rad[a]) / (r.time_s[b] - r.time_s[a]);
    const double along = w.speed_rad_s < 0 ? -speed : speed;
    w.slowest_rad_s = std::min(w.slowest_rad_s, std::max(0.0, along));
  }
  return w;
}

}  // namespace

std::vector<Window> windows_of(const Recording& r, double shortest_s, double level_rad) {
  const double step_s = median_step(r);
  shortest_s = std::max(shortest_s, kRows * step_s);
  if (step_s > kSlowest_s) {
    throw MeasurementError(fmt::format(
        "{}:1: a row every {:.3g} ms; the speed changes within tens of ms, record every ms", r.name,
        1e3 * step_s));
  }
  if (r.length_s() < 4 * shortest_s) {
    throw MeasurementError(fmt::format(
        "{}:1: {:.3g} ms are too short for {:.3g} ms windows; record a second or more, a row a ms",
        r.name, 1e3 * r.length_s(), 1e3 * shortest_s));
  }
  std::vector<Window> windows;
  for (const Stretch& s : stretches_of(r, step_s)) {
    // As many equal windows as fit.
    const double length = r.time_s[s.last] - r.time_s[s.first];
    const auto count = static_cast<std::size_t>(length / (shortest_s));
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t span = s.last - s.first;
      windows.push_back(
          window(r, s.first + span * k / count, s.first + span * (k + 1) / count, level_rad));
    }
  }
  if (windows.empty()) {
    throw MeasurementError(fmt::format(
        "{}:1: the voltage or the time jumps every {:.3g} ms or sooner; hold each voltage for 0.1 "
        "s or more",
        r.name, 1e3 * shortest_s));
  }
  return windows;
}

}  // namespace feltgate::host
