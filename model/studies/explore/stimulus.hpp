// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The stimulus of a design point: the motions of the lever, with equal times for every point.
// Documentation: docs/speed-for-accuracy.md
#pragma once

#include <string>
#include <vector>

namespace feltgate::explore {

/// One motion in one scene, from rest after a reset.
struct Motion {
  const char* name;
  const char* scene;  ///< a design without this scene skips the motion
  double duration_s;
  double (*angle_rad)(double t_s);
  double setpoint_nm = 0;  ///< of the scene "setpoint"
  double window_s = 0;     ///< begin of the part that runs in lock-step
};

/// All motions in the order of the run: scenes across their borders, slow and small signals, a
/// chirp, and speeds at which torque and voltage reach their limits.
const std::vector<Motion>& motions();

/// Length of the lock-step part of each motion, seconds.
constexpr double lock_step_s = 8e-3;

}  // namespace feltgate::explore
