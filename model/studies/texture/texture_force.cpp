// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/devices/shapes.md
#include "studies/texture/texture_force.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "law/load.hpp"

namespace feltgate::texture {

Words::Words(const law::Compiled& c)
    : machine_(law::memory(c.image)), thread_(c.target.thread), count_rad_(c.target.count_rad()) {
  machine_.enter();
  for (const law::Output& o : c.law.outputs) {
    lsb_nm_[static_cast<std::size_t>(o.axis)] = std::ldexp(1.0, -c.target.torque.fraction);
  }
}

std::array<double, 3> Words::torque_nm(const std::array<std::int32_t, 3>& counts,
                                       const std::array<std::int32_t, 3>& velocities) {
  law::MachineInputs inputs{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    inputs[3 * axis] = counts[axis];
    inputs[3 * axis + 1] = velocities[axis];
  }
  const law::MachineRun& run = machine_.run(thread_, inputs);
  std::array<double, 3> torque{};
  for (std::size_t axis = 0; axis < 3; ++axis) torque[axis] = run.outputs[axis] * lsb_nm_[axis];
  return torque;
}

PenForce pen_force(Words& words, shape::Point pen_m) {
  const auto asked = shape::cranks(pen_m);
  std::array<std::int32_t, 3> counts{};
  std::array<double, 2> angle{};
  for (std::size_t i = 0; i < 2; ++i) {
    counts[i] = static_cast<std::int32_t>(std::lround(asked[i] / words.count_rad()));
    angle[i] = counts[i] * words.count_rad();
  }
  const shape::Point at{shape::link_m * (std::cos(angle[0]) + std::cos(angle[1])),
                        shape::link_m * (std::sin(angle[0]) + std::sin(angle[1]))};
  const auto torque = words.torque_nm(counts);
  return {at, shape::force_at(at, {torque[0], torque[1]})};
}

void check_reach(const LawRequest& r, double half_m, double below_m) {
  const double low_m = r.surface_m - below_m;
  if (low_m >= shape::nearest_pen_m && std::hypot(half_m, r.surface_m) <= shape::farthest_pen_m)
    return;
  throw std::invalid_argument(fmt::format(
      "the pen reaches {:.0f} to {:.0f} mm from the motors, and a way of {:.4g} mm at "
      "{:.4g} mm leaves that; choose another --surface, or leave --path and --table away",
      1e3 * shape::nearest_pen_m, 1e3 * shape::farthest_pen_m, 2e3 * half_m, 1e3 * r.surface_m));
}

shape::Point plane_force(const std::vector<double>& row, const LawRequest& r, double x_m,
                         double below_m) {
  const auto last = static_cast<int>(row.size()) - 2;
  const double q = x_m / r.texel_m;
  const int i = std::clamp(static_cast<int>(std::floor(q)), 0, last);
  const double left = r.depth_m * row[static_cast<std::size_t>(i)];
  const double slope = (r.depth_m * row[static_cast<std::size_t>(i) + 1] - left) / r.texel_m;
  const double upright = 1 / std::sqrt(1 + slope * slope), sideways = -slope * upright;
  double depth = std::max(0.0, (below_m + left + slope * (q - i) * r.texel_m) * upright);
  if (sideways > 0) depth = std::min(depth, (i + 1 - q) * r.texel_m / sideways);
  if (sideways < 0) depth = std::min(depth, (i - q) * r.texel_m / sideways);
  return {r.stiffness_n_per_m * depth * sideways, r.stiffness_n_per_m * depth * upright};
}

Firmness firmness(const law::Compiled& c, const std::vector<double>& row, const LawRequest& r) {
  // As far to the sides as the pen reaches well, in 101 places that are no pixels.
  const double half_m = std::min(0.05, 0.5 * r.texel_m * (static_cast<double>(row.size()) - 1));
  const double middle_m = 0.5 * r.texel_m * (static_cast<double>(row.size()) - 1);
  constexpr int places = 101;
  check_reach(r, half_m, firmness_depth_m);
  Words words(c);
  Firmness f;
  for (int i = 0; i < places; ++i) {
    const double x = half_m * (2.0 * (i + 0.5) / places - 1);
    const PenForce top = pen_force(words, {x, r.surface_m});
    const PenForce low = pen_force(words, {x, r.surface_m - firmness_depth_m});
    f.split += (low.force_n.y - top.force_n.y) / (top.at_m.y - low.at_m.y);
    const auto at_top = plane_force(row, r, x + middle_m, 0);
    const auto at_low = plane_force(row, r, x + middle_m, firmness_depth_m);
    f.plane += (at_low.y - at_top.y) / firmness_depth_m;
  }
  f.split /= places * r.stiffness_n_per_m;
  f.plane /= places * r.stiffness_n_per_m;
  return f;
}

}  // namespace feltgate::texture
