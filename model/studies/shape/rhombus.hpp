// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Kinematics of the pantograph with four equal links and both motors at one point: angles, speeds
// and forces at a place of the pen. Documentation: docs/devices/pantograph.md
#pragma once

#include <array>

#include "studies/shape/outline.hpp"

namespace feltgate::shape {

constexpr double link_m = 0.1;

/// Angles of the two cranks, rad, for the pen at `pen_m` (motors at the origin); the second is the
/// larger.
std::array<double, 2> cranks(Point pen_m);

/// The force at the pen, N, of the two torques.
Point force_at(Point pen_m, const std::array<double, 2>& torque_nm);

/// Speeds of the two cranks, rad/s, for the pen at `pen_m` with this velocity, m/s.
std::array<double, 2> crank_speeds(Point pen_m, Point velocity_m_s);

}  // namespace feltgate::shape
