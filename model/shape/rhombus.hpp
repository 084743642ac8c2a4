// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The pantograph of four equal links with both motors at one point: angles of a place, and the
// force that two torques are there. Documentation: docs/pantograph.md
#pragma once

#include <array>
#include <string>

#include "shape/outline.hpp"

namespace feltgate::shape {

constexpr double link_m = 0.1;

/// Angles of the two cranks, rad, with which the pen (motors at the origin) is at p; the second is
/// the larger.
std::array<double, 2> cranks(Point pen_m);

/// The force at the pen, N, that two torques are.
Point force_at(Point pen_m, const std::array<double, 2>& torque_nm);

/// Speeds of the two cranks, rad/s, with which the pen at p has this velocity, m/s.
std::array<double, 2> crank_speeds(Point pen_m, Point velocity_m_s);

/// The same in a law: its length L, sines and cosines s1, c1, s5, c5 of the cranks; and the torques
/// of the force fx, fy.
std::string law_cranks();
std::string law_torques();

}  // namespace feltgate::shape
