// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The loop of several equal axes with coupled mechanics and law, linearised at a place. Derivation:
// docs/stability.md
#pragma once

#include <Eigen/Core>
#include <vector>

#include "studies/stability/linear_loop.hpp"

namespace feltgate::stability {

/// Derivatives of a law's torques with respect to its inputs of all axes, with a row per torque;
/// the torques are held between runs.
struct AxesWall {
  Eigen::MatrixXd stiffness_nm_rad;  ///< decrease of torque per angle
  Eigen::MatrixXd damping_nm_s_rad;  ///< decrease of torque per estimated speed
  Eigen::MatrixXd observed;          ///< torque per tau_hat
  int scene_ticks = 1;
  int delay_ticks = 0;  ///< as in Wall, at least 0
};

struct AxesLoopModel {
  LoopModel axis;         ///< of a core's axis around its joint, which has the mean inertia
  Eigen::MatrixXd plant;  ///< all currents, speeds, angles after a tick, from those and all volts
};

/// `joint`: motor, friction and encoder of each joint, referred to the joint; its inertia is not
/// used. `inertia_kg_m2`: inertia of all joints at that place, symmetric, positive definite. Throws
/// std::invalid_argument when it has no inverse.
AxesLoopModel make_axes_model(const design::Elaborated& e, const plant::Parameters& joint,
                              const Eigen::MatrixXd& inertia_kg_m2);

/// The poles, as poles() for one lever.
std::vector<Pole> poles(const AxesLoopModel& model, const AxesWall& wall);

}  // namespace feltgate::stability
