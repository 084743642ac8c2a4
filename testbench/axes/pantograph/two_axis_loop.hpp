// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The loop of a pantograph, and an example law for it. Documentation: docs/devices/pantograph.md
#pragma once

#include <algorithm>

#include "sampled_law.hpp"
#include "sim/plant/axes_loop.hpp"
#include "sim/plant/pantograph/pantograph.hpp"

namespace feltgate::plant {

using TwoAxisLoop = AxesLoop<Pantograph>;
using TwoAxisDevice = AxesDevice<Pantograph>;
using TwoAxisLaw = SampledLaw<Pantograph>;

/// A wall for y < edge_m and a drag everywhere, acting at the pen: F = k*(edge - y) - b*v.
struct WallAndDrag {
  double edge_m = 0.1, stiffness_n_m = 0.0, wall_damping_ns_m = 0.0, drag_ns_m = 0.0;

  /// Force on the pen, N. The wall never pulls.
  Vec2 force_n(Vec2 pen, Vec2 speed) const {
    Vec2 f = -drag_ns_m * speed;
    if (pen.y < edge_m) {
      f.y += std::max(0.0, stiffness_n_m * (edge_m - pen.y) - wall_damping_ns_m * speed.y);
    }
    return f;
  }
  /// The same as a law of the cranks; uses the kinematics of `linkage`.
  AxesLaw<2> law(const Linkage& linkage) const {
    return [wall = *this, linkage](const AxesMotion<2>& m) {
      const LinkagePose p = linkage.pose(m.theta_rad);
      return p.torque(wall.force_n(p.pen, p.pen_speed(m.omega_rad_s)));
    };
  }
};

}  // namespace feltgate::plant
