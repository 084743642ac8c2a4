// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The loop of several axes alike whose mechanics and law are coupled, linear around a place.
// Derivation: docs/stability.md
#pragma once

#include <Eigen/Dense>
#include <vector>

#include "stability/linear_loop.hpp"

namespace feltgate::stability {

/// How a law's torques change with what it sees of all axes, a row a torque; held in between.
struct AxesWall {
  Eigen::MatrixXd stiffness_nm_rad;  ///< less torque per angle
  Eigen::MatrixXd damping_nm_s_rad;  ///< less torque per estimated speed
  Eigen::MatrixXd observed;          ///< torque per tau_hat
  int scene_ticks = 1;
  int delay_ticks = 0;  ///< as in Wall, at least 0
};

struct AxesLoopModel {
  LoopModel axis;         ///< of a core's axis around its joint, which has the mean inertia
  Eigen::MatrixXd plant;  ///< all currents, speeds, angles after a tick, from those and all volts
};

/// `joint`: the motor, friction and encoder of each joint, all at the joint; its inertia is not
/// used. `inertia_kg_m2`: of all joints at that place, symmetric, positive definite; throws
/// std::invalid_argument where it has no inverse.
AxesLoopModel make_axes_model(const design::Elaborated& e, const plant::Parameters& joint,
                              const Eigen::MatrixXd& inertia_kg_m2);

/// As poles() of one lever.
std::vector<Pole> poles(const AxesLoopModel& model, const AxesWall& wall);

}  // namespace feltgate::stability
