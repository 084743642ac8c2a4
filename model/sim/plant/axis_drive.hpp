// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bridge, winding and friction of one motor among several: computes the mean torques of a step from
// the bridge's state, as in the plant of the lever. Documentation: docs/plant.md
#pragma once

#include "bridge.hpp"
#include "lugre.hpp"
#include "parameters.hpp"
#include "winding.hpp"

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
      : motor_(motor),
        on_(effects),
        bridge_(drive, supply, motor, effects),
        winding_(motor.resistance_ohm, motor.inductance_h),
        lugre_(lugre) {}

  /// Sets the length of the following steps, s.
  void set_step(double dt_s) {
    if (on_.inductance) winding_.set_step(dt_s);
    if (on_.lugre) lugre_.set_step(dt_s);
  }

  /// One step with this bridge; bus voltage (V) and motor speed (rad/s) are held.
  AxisStep advance(const Bridge& bridge, double bus_v, double motor_rad_s) {
    if (bridge.shoots_through()) shoot_through_ = true;
    const BridgeVoltage voltage = bridge_.voltage(bridge, bus_v, current_a_);
    const double emf_v = on_.back_emf ? motor_.back_emf_constant_v_s_rad * motor_rad_s : 0.0;
    const double dead_v = on_.dead_voltage ? motor_.dead_voltage_v : 0.0;
    const double positive_v = voltage.at_positive_v(bus_v) - emf_v - dead_v;
    const double negative_v = voltage.at_negative_v(bus_v) - emf_v + dead_v;
    AxisStep s;
    if (on_.inductance) {
      const CurrentStep step = winding_.advance(current_a_, positive_v, negative_v);
      current_a_ = step.end_a;
      s.current_a = step.mean_a;
    } else {
      s.current_a = current_a_ = winding_.settled_a(positive_v, negative_v);
    }
    s.bridge_a =
        (s.current_a >= 0.0 ? voltage.share_positive : voltage.share_negative) * s.current_a;
    s.motor_nm = motor_.torque_constant_nm_a * s.current_a;
    s.friction_nm = friction_nm(motor_rad_s);
    return s;
  }

  /// Mean torque of the bristles over one step, Nm, for a motor that something else drives.
  double friction_nm(double motor_rad_s) { return on_.lugre ? lugre_.advance(motor_rad_s) : 0.0; }

  double current_a() const { return current_a_; }
  double bristle_rad() const { return lugre_.z_rad(); }
  /// Whether both gates of a leg were ever on at once.
  bool shoot_through() const { return shoot_through_; }

 private:
  MotorParameters motor_;
  Effects on_;
  BridgeModel bridge_;
  Winding winding_;
  Lugre lugre_;
  double current_a_ = 0.0;
  bool shoot_through_ = false;
};

}  // namespace feltgate::plant
