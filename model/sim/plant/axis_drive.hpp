// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bridge, winding and friction of one motor among several: computes the mean torques of a step from
// the bridge's state, as in the plant of the lever. Documentation: docs/plant.md
#pragma once

#include "brushed_motor.hpp"
#include "lugre.hpp"
#include "parameters.hpp"

namespace feltgate::plant {

/// Means over one step, at the motor's shaft.
struct AxisStep {
  double current_a = 0.0;
  double motor_nm = 0.0;     ///< Kt*i, before friction
  double friction_nm = 0.0;  ///< bristles; opposes positive speed, excludes sigma2*omega
  double bridge_a = 0.0;     ///< drawn from the bus
};

/// The drive of one motor, step by step.
class AxisDrive {
 public:
  /// Errors: std::invalid_argument for an impossible drive (see BridgeModel).
  AxisDrive(const MotorParameters& motor, const LugreParameters& lugre,
            const SupplyParameters& supply, const Drive& drive, const Effects& effects)
      : motor_(motor, supply, drive, effects), lugre_on_(effects.lugre), lugre_(lugre) {}

  /// Sets the length of the following steps, s.
  void set_step(double dt_s) {
    motor_.set_step(dt_s);
    if (lugre_on_) lugre_.set_step(dt_s);
  }

  /// One step with this bridge; bus voltage (V) and motor speed (rad/s) are held.
  AxisStep advance(const Bridge& bridge, double bus_v, double motor_rad_s) {
    const MotorStep s = motor_.advance(bridge, bus_v, motor_rad_s);
    return {s.current_a, s.torque_nm, friction_nm(motor_rad_s), s.bridge_a};
  }

  /// Mean torque of the bristles over one step, Nm, for a motor that something else drives.
  double friction_nm(double motor_rad_s) { return lugre_on_ ? lugre_.advance(motor_rad_s) : 0.0; }

  double current_a() const { return motor_.current_a(); }
  double bristle_rad() const { return lugre_.z_rad(); }
  /// Whether both gates of a leg were ever on at once.
  bool shoot_through() const { return motor_.shoot_through(); }

 private:
  BrushedMotor motor_;
  bool lugre_on_;
  Lugre lugre_;
};

}  // namespace feltgate::plant
