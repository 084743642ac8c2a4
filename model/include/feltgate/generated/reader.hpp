// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/registers.toml by `feltgate generate`: do not edit.
#pragma once

namespace feltgate {

/// The parameters of design D by name, each in the format that D gives it. Derived is the
/// class that inherits this; it reads any word: get<Key>(address).
template <class D, class Derived>
struct ParameterReader {
  auto velocity_a1() const {
    return word<D::P::velocity_a1.key()>(D::A::velocity_a1);
  }
  auto inverse_resistance() const {
    return word<D::P::inverse_resistance.key()>(D::A::inverse_resistance);
  }
  auto emf_over_resistance() const {
    return word<D::P::emf_over_resistance.key()>(D::A::emf_over_resistance);
  }
  auto torque_constant() const {
    return word<D::P::torque_constant.key()>(D::A::torque_constant);
  }
  auto inertia_gain() const {
    return word<D::P::inertia_gain.key()>(D::A::inertia_gain);
  }
  auto nominal_current_squared() const {
    return word<D::P::nominal_current_squared.key()>(D::A::nominal_current_squared);
  }
  auto observer_a1() const {
    return word<D::P::observer_a1.key()>(D::A::observer_a1);
  }
  auto overspeed() const {
    return word<D::P::overspeed.key()>(D::A::overspeed);
  }
  auto i2t_budget() const {
    return word<D::P::i2t_budget.key()>(D::A::i2t_budget);
  }
  auto polarity_speed() const {
    return word<D::P::polarity_speed.key()>(D::A::polarity_speed);
  }
  auto polarity_current() const {
    return word<D::P::polarity_current.key()>(D::A::polarity_current);
  }
  auto polarity_ticks() const {
    return word<D::P::polarity_ticks.key()>(D::A::polarity_ticks);
  }
  auto emf_constant() const {
    return word<D::P::emf_constant.key()>(D::A::emf_constant);
  }
  auto observer_gain() const {
    return word<D::P::observer_gain.key()>(D::A::observer_gain);
  }
  auto voltage_setpoint() const {
    return word<D::P::voltage_setpoint.key()>(D::A::voltage_setpoint);
  }
  auto voltage_step() const {
    return word<D::P::voltage_step.key()>(D::A::voltage_step);
  }
  auto torque_limit() const {
    return word<D::P::torque_limit.key()>(D::A::torque_limit);
  }
  auto ramp_step() const {
    return word<D::P::ramp_step.key()>(D::A::ramp_step);
  }
  auto voltage_to_current() const {
    return word<D::P::voltage_to_current.key()>(D::A::voltage_to_current);
  }
  auto torque_gain() const {
    return word<D::P::torque_gain.key()>(D::A::torque_gain);
  }
  auto dead_voltage_slope() const {
    return word<D::P::dead_voltage_slope.key()>(D::A::dead_voltage_slope);
  }
  auto region_torque() const {
    return word<D::P::region_torque.key()>(D::A::region_torque);
  }
  auto hold_torque() const {
    return word<D::P::hold_torque.key()>(D::A::hold_torque);
  }
  auto hold_time() const {
    return word<D::P::hold_time.key()>(D::A::hold_time);
  }
  auto hold_limit() const {
    return word<D::P::hold_limit.key()>(D::A::hold_limit);
  }
  auto current_limit() const {
    return word<D::P::current_limit.key()>(D::A::current_limit);
  }
  auto voltage_gain() const {
    return word<D::P::voltage_gain.key()>(D::A::voltage_gain);
  }
  auto voltage_gain_high() const {
    return word<D::P::voltage_gain_high.key()>(D::A::voltage_gain_high);
  }
  auto dead_voltage() const {
    return word<D::P::dead_voltage.key()>(D::A::dead_voltage);
  }
  auto voltage_window() const {
    return word<D::P::voltage_window.key()>(D::A::voltage_window);
  }
  auto duty_gain() const {
    return word<D::P::duty_gain.key()>(D::A::duty_gain);
  }
  auto duty_limit() const {
    return word<D::P::duty_limit.key()>(D::A::duty_limit);
  }
  auto watchdog_ticks() const {
    return word<D::P::watchdog_ticks.key()>(D::A::watchdog_ticks);
  }
  auto self_test_torque() const {
    return word<D::P::self_test_torque.key()>(D::A::self_test_torque);
  }
  auto self_test_quiet() const {
    return word<D::P::self_test_quiet.key()>(D::A::self_test_quiet);
  }
  auto self_test_pulse() const {
    return word<D::P::self_test_pulse.key()>(D::A::self_test_pulse);
  }
  auto self_test_arms() const {
    return word<D::P::self_test_arms.key()>(D::A::self_test_arms);
  }
  auto commutation_gain() const {
    return word<D::P::commutation_gain.key()>(D::A::commutation_gain);
  }
  auto commutation_offset() const {
    return word<D::P::commutation_offset.key()>(D::A::commutation_offset);
  }
  auto setpoint_torque() const {
    return word<D::P::setpoint_torque.key()>(D::A::setpoint_torque);
  }
  auto membrane_lower() const {
    return word<D::P::membrane_lower.key()>(D::A::membrane_lower);
  }
  auto membrane_upper() const {
    return word<D::P::membrane_upper.key()>(D::A::membrane_upper);
  }
  auto membrane_torque() const {
    return word<D::P::membrane_torque.key()>(D::A::membrane_torque);
  }
  auto compression_contact() const {
    return word<D::P::compression_contact.key()>(D::A::compression_contact);
  }
  auto compression_stiffness() const {
    return word<D::P::compression_stiffness.key()>(D::A::compression_stiffness);
  }
  auto tension_rest() const {
    return word<D::P::tension_rest.key()>(D::A::tension_rest);
  }
  auto tension_stiffness() const {
    return word<D::P::tension_stiffness.key()>(D::A::tension_stiffness);
  }
  auto damper_damping() const {
    return word<D::P::damper_damping.key()>(D::A::damper_damping);
  }
  auto attract_centre() const {
    return word<D::P::attract_centre.key()>(D::A::attract_centre);
  }
  auto attract_strength() const {
    return word<D::P::attract_strength.key()>(D::A::attract_strength);
  }
  auto attract_core() const {
    return word<D::P::attract_core.key()>(D::A::attract_core);
  }
  auto attract_core_slope() const {
    return word<D::P::attract_core_slope.key()>(D::A::attract_core_slope);
  }
  auto repel_centre() const {
    return word<D::P::repel_centre.key()>(D::A::repel_centre);
  }
  auto repel_strength() const {
    return word<D::P::repel_strength.key()>(D::A::repel_strength);
  }
  auto repel_core() const {
    return word<D::P::repel_core.key()>(D::A::repel_core);
  }
  auto repel_core_slope() const {
    return word<D::P::repel_core_slope.key()>(D::A::repel_core_slope);
  }
  auto wall_contact() const {
    return word<D::P::wall_contact.key()>(D::A::wall_contact);
  }
  auto wall_stiffness() const {
    return word<D::P::wall_stiffness.key()>(D::A::wall_stiffness);
  }
  auto wall_damping() const {
    return word<D::P::wall_damping.key()>(D::A::wall_damping);
  }

 private:
  template <int Key>
  auto word(int address) const {
    return static_cast<const Derived&>(*this).template get<Key>(address);
  }
};

}  // namespace feltgate
