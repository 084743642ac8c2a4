// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What moves a device's joints, as the linear loop of several axes wants it. Documentation:
// docs/rates.md
#pragma once

#include <Eigen/Dense>

#include "axes_loop/axes_scene.hpp"

namespace feltgate::rates {

/// Motor, encoder and friction of each joint as if the motor turned with it, viscous friction on;
/// of the effects those of `on`. Its inertia is left 0 where the place decides it.
plant::Parameters joint_of(const DeviceSetup& device, plant::Effects on);

/// Of all joints at these angles, kg m^2.
Eigen::MatrixXd inertia_kg_m2(const DeviceSetup& device, const Eigen::VectorXd& angle_rad);

}  // namespace feltgate::rates
