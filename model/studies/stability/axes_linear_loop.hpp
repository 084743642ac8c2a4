// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The loop of one axis or several equal ones with coupled mechanics and law, linearised at a place;
// the law may have states, delay lines and a host. Derivation: docs/speed-for-accuracy.md
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/plant/mechanics.hpp"
#include "studies/stability/law_loop.hpp"
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
  LoopModel axis;  ///< of a core's axis around its joint, which has the mean inertia
  /// All currents, speeds and angles after a tick, then speed and angle of a hand with a mass;
  /// from those currents, speeds and angles, all volts, and the hand's two.
  Eigen::MatrixXd plant;
  Eigen::MatrixXd per_torque;  ///< inverse of the inertia of all axes
};

/// `joint`: motor, friction and encoder of each joint, referred to the joint; its inertia is not
/// used. `inertia_kg_m2`: inertia of all joints at that place, symmetric, positive definite.
/// `hand`: on a single axis, or nullptr. Throws std::invalid_argument when the inertia has no
/// inverse.
AxesLoopModel make_axes_model(const design::Elaborated& e, const plant::Parameters& joint,
                              const Eigen::MatrixXd& inertia_kg_m2,
                              const plant::HandDynamics* hand = nullptr);
/// The same for one lever.
AxesLoopModel make_axes_model(const design::Elaborated& e, const plant::Parameters& lever,
                              const plant::HandDynamics* hand = nullptr);

/// The poles, as poles() for one lever.
std::vector<Pole> poles(const AxesLoopModel& model, const AxesWall& wall);

/// Of the loop in which the law's torques count `gain` times; springs of `held_nm_rad` hold all
/// axes. Scene and delay as in Wall. Where the periods of a host and of the law have no common
/// multiple, a near one is taken, to half a percent of the host's period; its
/// words wait for half a run of the law on average.
std::vector<Pole> poles(const AxesLoopModel& model, const LinearLaw& law, double gain,
                        double held_nm_rad, int scene_ticks, int delay_ticks);

}  // namespace feltgate::stability
