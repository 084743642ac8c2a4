// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Converts the drives of a device's joints to the form of the linear loop of several axes.
// Documentation: docs/speed-for-accuracy.md
#pragma once

#include <Eigen/Core>

#include "sim/axes_loop/axes_scene.hpp"

namespace feltgate::rates {

/// Motor, encoder and friction of each joint, converted as if the motor turned with the joint, with
/// viscous friction and the effects `on`. The inertia is 0 if it depends on the place.
plant::Parameters joint_of(const DeviceSetup& device, plant::Effects on);

/// Inertia matrix of all joints at these angles, kg m^2.
Eigen::MatrixXd inertia_kg_m2(const DeviceSetup& device, const Eigen::VectorXd& angle_rad);

/// Gives the device a hand that brings it beside the angles `at_rad` and lets it go after `hold_s`;
/// from then on it applies `nm` at the joints. Errors: std::invalid_argument for a gimbal.
void hold_and_let_go(DeviceSetup& device, const Eigen::VectorXd& at_rad,
                     const Eigen::VectorXd& beside_rad, const Eigen::VectorXd& nm, double hold_s);
/// Where the pen of a device that has one is at these angles.
plant::Vec3 pen_m(const DeviceSetup& device, const Eigen::VectorXd& angle_rad);

}  // namespace feltgate::rates
