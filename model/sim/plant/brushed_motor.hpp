// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A motor with brushes behind its H-bridge: current, torque and supply current of a step.
// Documentation: docs/plant.md
#pragma once

#include <algorithm>
#include <cmath>

#include "bridge.hpp"
#include "parameters.hpp"

namespace feltgate::plant {

/// Current at the end of a step and its mean over the step, A.
struct CurrentStep {
  double end_a;
  double mean_a;
};

/// The current of one winding, step by step.
class Winding {
 public:
  Winding(double resistance_ohm, double inductance_h)
      : per_ohm_(1.0 / resistance_ohm), tau_s_(inductance_h / resistance_ohm) {}

  /// Sets the length of the following steps, s.
  void set_step(double dt_s) {
    dt_s_ = dt_s;
    decay_ = std::exp(-dt_s / tau_s_);
    mean_weight_ = -std::expm1(-dt_s / tau_s_) * tau_s_ / dt_s;
  }

  /// `positive_v` drives the current while it is positive (terminal voltage - back-EMF - dead
  /// voltage), `negative_v` while it is negative; positive_v <= negative_v. At 0 the current stays
  /// 0 while positive_v <= 0 <= negative_v.
  CurrentStep advance(double current_a, double positive_v, double negative_v) const {
    if (current_a > 0.0 || (current_a == 0.0 && positive_v > 0.0)) {
      return from_positive(current_a, positive_v, negative_v);
    }
    if (current_a < 0.0 || negative_v < 0.0) {
      const CurrentStep mirror = from_positive(-current_a, -negative_v, -positive_v);
      return {-mirror.end_a, -mirror.mean_a};
    }
    return {0.0, 0.0};
  }

  /// The current without inductance, where it follows the voltage at once.
  double settled_a(double positive_v, double negative_v) const {
    if (positive_v > 0.0) return positive_v * per_ohm_;
    return negative_v < 0.0 ? negative_v * per_ohm_ : 0.0;
  }

 private:
  CurrentStep from_positive(double current_a, double positive_v, double negative_v) const {
    const double final_a = positive_v * per_ohm_;
    const double end_a = final_a + (current_a - final_a) * decay_;
    if (end_a >= 0.0) return {end_a, final_a + (current_a - final_a) * mean_weight_};
    return through_zero(current_a, final_a, negative_v);
  }

  // From a positive current to 0 at time t, then on to negative values if a voltage drives it.
  CurrentStep through_zero(double current_a, double final_a, double negative_v) const {
    const double t = tau_s_ * std::log((current_a - final_a) / -final_a);
    double charge = final_a * t + current_a * tau_s_;
    double end_a = 0.0;
    if (negative_v < 0.0) {
      const double settled = negative_v * per_ohm_;
      const double rest = dt_s_ - t;
      end_a = -settled * std::expm1(-rest / tau_s_);
      charge += settled * rest - end_a * tau_s_;
    }
    return {end_a, charge / dt_s_};
  }

  double per_ohm_;
  double tau_s_;
  double dt_s_ = 0.0;
  double decay_ = 0.0;
  double mean_weight_ = 0.0;
};

/// Means of a motor over one step.
struct MotorStep {
  double current_a = 0.0;  ///< that makes the torque
  double torque_nm = 0.0;  ///< before friction
  double bridge_a = 0.0;   ///< drawn from the bus
};

/// Bridge and winding, step by step.
class BrushedMotor {
 public:
  /// Errors: std::invalid_argument for an impossible drive (see BridgeModel).
  BrushedMotor(const MotorParameters& motor, const SupplyParameters& supply, const Drive& drive,
               const Effects& effects)
      : motor_(motor),
        on_(effects),
        bridge_(drive, supply, motor, effects),
        winding_(motor.resistance_ohm, motor.inductance_h) {}

  /// Sets the length of the following steps, s.
  void set_step(double dt_s) {
    if (on_.inductance) winding_.set_step(dt_s);
  }

  /// Shorts the terminals: the bridge drives this wiring alone. Set the step again afterwards.
  void short_terminals(double wiring_ohm, double wiring_h) {
    winding_ = Winding(wiring_ohm, wiring_h);
    on_.back_emf = on_.dead_voltage = false;
  }

  /// One step with this bridge; bus voltage (V) and speed (rad/s) are held.
  MotorStep advance(const Bridge& bridge, double bus_v, double omega_rad_s) {
    const BridgeVoltage voltage = bridge_.voltage(bridge, bus_v, current_a_);
    double positive_v = voltage.at_positive_v(bus_v);
    double negative_v = voltage.at_negative_v(bus_v);
    if (on_.back_emf) {
      const double emf_v = motor_.back_emf_constant_v_s_rad * omega_rad_s;
      positive_v -= emf_v;
      negative_v -= emf_v;
    }
    if (on_.dead_voltage) {
      positive_v -= motor_.dead_voltage_v;
      negative_v += motor_.dead_voltage_v;
    }
    double mean_a = 0.0;
    if (on_.inductance) {
      const CurrentStep step = winding_.advance(current_a_, positive_v, negative_v);
      current_a_ = step.end_a;
      mean_a = step.mean_a;
    } else {
      current_a_ = winding_.settled_a(positive_v, negative_v);
      mean_a = current_a_;
    }
    const double share = mean_a >= 0.0 ? voltage.share_positive : voltage.share_negative;
    return {mean_a, motor_.torque_constant_nm_a * mean_a, share * mean_a};
  }

  /// The same at any angle.
  double current_a(double /*theta_rad*/ = 0.0) const { return current_a_; }
  double torque_nm(double /*theta_rad*/) const { return motor_.torque_constant_nm_a * current_a_; }

 private:
  MotorParameters motor_;
  Effects on_;
  BridgeModel bridge_;
  Winding winding_;
  double current_a_ = 0.0;
};

// A source with a current limit and a bus capacitor; a clamp absorbs what the motor returns above
// the nominal voltage.

/// The bus voltage, step by step.
class Supply {
 public:
  explicit Supply(const SupplyParameters& p) : p_(p), bus_v_(p.voltage_v) {}

  /// Advances the bus by dt_s while the bridge draws `bridge_a`; returns the current of the source,
  /// A (negative: absorbed by the clamp).
  double advance(double bridge_a, double dt_s) {
    const double free_v = bus_v_ + (p_.current_limit_a - bridge_a) * dt_s / p_.bus_capacitance_f;
    const double next_v = std::clamp(free_v, 0.0, p_.voltage_v);
    const double source_a = bridge_a + (next_v - bus_v_) * p_.bus_capacitance_f / dt_s;
    bus_v_ = next_v;
    return std::min(source_a, p_.current_limit_a);
  }

  double bus_v() const { return bus_v_; }

 private:
  SupplyParameters p_;
  double bus_v_;
};

}  // namespace feltgate::plant
