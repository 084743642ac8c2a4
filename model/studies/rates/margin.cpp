// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/rates/margin.hpp"

#include <algorithm>
#include <functional>

namespace feltgate::rates {

namespace {

constexpr double least_stiffness_nm_rad = 1e-3;  ///< below it there is no wall
constexpr double next_to_none_nm_rad = 1e-7;     ///< no friction is so low that it shakes
constexpr double most = 1e4, least = 1e-4;       ///< ratios that are told apart

Margin::Of kind(const Slope& slope, double least_nm_rad) {
  if (slope.stiffness_nm_rad > least_nm_rad) return Margin::Of::stiffness;
  return slope.damping_nm_s_rad > 0 ? Margin::Of::damping : Margin::Of::none;
}

/// Finds the border: `stable` tests a ratio; the stable ratios are those from 0 up to the border.
/// `own`: what the ratio scales.
Margin search(Margin::Of of, double own, const std::function<bool(double)>& stable) {
  Margin m;
  m.of = of;
  double low = 1, high = 1;
  if (stable(1)) {
    while (low < most && stable(high *= 1.5)) low = high;
    if (low >= most) high = low;
  } else {
    while (low > least && !stable(low /= 1.5)) high = low;
    if (low <= least) low = high = 0;
  }
  while (high - low > 1e-3 * high) {
    const double middle = (low + high) / 2;
    (stable(middle) ? low : high) = middle;
  }
  m.ratio = low;
  m.border = low * own;
  return m;
}

/// Two directions that slide alike are a pair with next to no frequency.
bool swings(const stability::Pole& p) { return std::abs(p.imag()) > 0.05 * std::abs(p); }

double scaled(Margin::Of of, const Slope& slope) {
  return of == Margin::Of::stiffness ? slope.stiffness_nm_rad : slope.damping_nm_s_rad;
}

}  // namespace

Margin margin(const stability::LoopModel& model, const Slope& slope, int scene_ticks,
              int delay_ticks) {
  const Margin::Of of = kind(slope, least_stiffness_nm_rad);
  if (of == Margin::Of::none) return {};
  return search(of, scaled(of, slope), [&](double ratio) {
    stability::Wall wall{least_stiffness_nm_rad, slope.damping_nm_s_rad, scene_ticks, delay_ticks};
    if (of == Margin::Of::stiffness) {
      wall.stiffness_nm_rad = ratio * slope.stiffness_nm_rad;
    } else {
      wall.damping_nm_s_rad = ratio * slope.damping_nm_s_rad;
    }
    return stability::poles(model, wall).front().real() < 0;
  });
}

Margin margin(const stability::AxesLoopModel& model, const stability::LinearLaw& law,
              double steepness_nm_rad, int scene_ticks, int delay_ticks) {
  const bool may_slide = law.host.period_ticks > 0 && law.axes() > 1;
  const auto all = [&](double ratio) {
    return stability::poles(model, law, ratio, next_to_none_nm_rad, scene_ticks, delay_ticks);
  };
  Margin out = search(Margin::Of::torque, steepness_nm_rad, [&](double ratio) {
    for (const stability::Pole& p : all(ratio)) {
      if (!(may_slide && !swings(p)) && !(p.real() < 0)) return false;
    }
    return true;
  });
  if (!may_slide) return out;
  for (const stability::Pole& p : all(1)) {
    if (!swings(p)) out.slides_1_s = std::max(out.slides_1_s, p.real());
  }
  return out;
}

Margin margin(const stability::AxesLoopModel& model, const Slope& slope, int scene_ticks,
              int delay_ticks) {
  const Margin::Of of = kind(slope, next_to_none_nm_rad);
  if (of == Margin::Of::none) return {};
  // Along a wall, and where two levers turn together, nothing holds an angle.
  const auto axes = slope.damping.rows();
  const Eigen::MatrixXd held = next_to_none_nm_rad * Eigen::MatrixXd::Identity(axes, axes);
  return search(of, scaled(of, slope), [&](double ratio) {
    stability::AxesWall wall{held, slope.damping, slope.observed, scene_ticks, delay_ticks};
    if (of == Margin::Of::stiffness) {
      wall.stiffness_nm_rad += ratio * slope.stiffness;
    } else {
      wall.damping_nm_s_rad *= ratio;
    }
    return stability::poles(model, wall).front().real() < 0;
  });
}

}  // namespace feltgate::rates
