// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The stimulus of a design point: what the lever does, the same motions in the same seconds for
// every point. Documentation: docs/explore.md
#pragma once

#include <string>
#include <vector>

namespace feltgate::explore {

/// One motion in one scene, from rest after a reset.
struct Motion {
  const char* name;
  const char* scene;  ///< where a design has not built it, the motion is left out
  double duration_s;
  double (*angle_rad)(double t_s);
  double setpoint_nm = 0;  ///< of the scene "setpoint"
  double window_s = 0;     ///< from here on a share of it runs in lock-step
};

/// Scenes across their borders, slow and small signals, a chirp, and speeds at which torque and
/// voltage are at their limits. In the order in which they are run.
const std::vector<Motion>& motions();

/// What the lock-step runs of each motion.
constexpr double lock_step_s = 8e-3;

}  // namespace feltgate::explore
