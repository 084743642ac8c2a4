// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/rates.md
#include "rates/margin.hpp"

namespace feltgate::rates {

namespace {

constexpr double least_stiffness_nm_rad = 1e-3;  ///< below it there is no wall
constexpr double most = 1e4, least = 1e-4;       ///< ratios that are told apart

}  // namespace

Margin margin(const stability::LoopModel& model, const Slope& slope, int scene_ticks,
              int delay_ticks) {
  Margin m;
  const bool stiff = slope.stiffness_nm_rad > least_stiffness_nm_rad;
  if (!stiff && slope.damping_nm_s_rad <= 0) return m;
  m.of = stiff ? Margin::Of::stiffness : Margin::Of::damping;
  const double whole = stiff ? slope.stiffness_nm_rad : slope.damping_nm_s_rad;
  const auto stable = [&](double ratio) {
    stability::Wall wall{least_stiffness_nm_rad, slope.damping_nm_s_rad, scene_ticks, delay_ticks};
    (stiff ? wall.stiffness_nm_rad : wall.damping_nm_s_rad) = ratio * whole;
    return stability::poles(model, wall).front().real() < 0;
  };
  // The stable ratios begin at 0 and end once.
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
  m.border = low * whole;
  return m;
}

}  // namespace feltgate::rates
