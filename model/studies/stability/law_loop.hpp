// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The loop of core, motor and a law with states of its own (filters, masses, springs), linear near
// one place. Derivation: docs/stability.md
#pragma once

#include <Eigen/Core>
#include <vector>

#include "studies/stability/linear_loop.hpp"

namespace feltgate::stability {

/// A law near one place. A run gives the torque c x + d u and leaves the states a x + b u, where u
/// is (position, rad; velocity estimate, rad/s; tau_hat, Nm).
struct LinearLaw {
  Eigen::MatrixXd a, b;
  Eigen::RowVectorXd c;
  Eigen::RowVector3d d = Eigen::RowVector3d::Zero();
};

/// The law without the states that no input moves, or that no torque shows: a phase that turns by
/// itself has an eigenvalue of 1, which says nothing of the loop.
LinearLaw in_loop(const LinearLaw& law);

/// Torque per angle at 5, 50 and 500 Hz, Nm/rad.
struct Steepness {
  double spring_nm_rad = 0;  ///< at 50 Hz, against the angle and in phase with it: a spring's
  double most_nm_rad = 0;    ///< the largest magnitude of the three, a damper's included
};
/// For runs every `period_s`.
Steepness steepness(const LinearLaw& law, double period_s);

/// Poles nearest to growth of the loop in which the law's torque counts `gain` times; a spring of
/// `held_nm_rad` holds the lever. `renewal` as in Wall: scene_ticks and delay_ticks.
std::vector<Pole> poles(const LoopModel& model, const LinearLaw& law, double gain,
                        double held_nm_rad, int scene_ticks, int delay_ticks);

}  // namespace feltgate::stability
