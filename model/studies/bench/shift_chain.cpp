// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The parameter words of the hand-written chain. Documentation: docs/bench.md
#include "studies/bench/shift_chain.hpp"

namespace feltgate {

void ShiftChain::set_word(int address, std::uint32_t word) {
  using A = Lever::A;
  using M = Parameters;
  struct Entry {
    int address;
    Word M::*member;
    int width;  ///< bits of the word that count
    bool signed_;
  };
  static constexpr Entry entries[] = {
      {A::velocity_a1, &M::velocity_a1, P::velocity_a1.width(), P::velocity_a1.sign == 1},
      {A::torque_constant, &M::torque_constant, P::torque_constant.width(),
       P::torque_constant.sign == 1},
      {A::inertia_gain, &M::inertia_gain, P::inertia_gain.width(), P::inertia_gain.sign == 1},
      {A::observer_a1, &M::observer_a1, P::observer_a1.width(), P::observer_a1.sign == 1},
      {A::emf_constant, &M::emf_constant, P::emf_constant.width(), P::emf_constant.sign == 1},
      {A::observer_gain, &M::observer_gain, P::observer_gain.width(), P::observer_gain.sign == 1},
      {A::voltage_setpoint, &M::voltage_setpoint, P::voltage_setpoint.width(),
       P::voltage_setpoint.sign == 1},
      {A::torque_limit, &M::torque_limit, 22, true},
      {A::ramp_step, &M::ramp_step, P::ramp_step.width(), P::ramp_step.sign == 1},
      {A::voltage_to_current, &M::voltage_to_current, P::voltage_to_current.width(),
       P::voltage_to_current.sign == 1},
      {A::torque_gain, &M::torque_gain, P::torque_gain.width(), P::torque_gain.sign == 1},
      {A::dead_voltage_slope, &M::dead_voltage_slope, P::dead_voltage_slope.width(),
       P::dead_voltage_slope.sign == 1},
      {A::region_torque, &M::region_torque, 22, true},
      {A::current_limit, &M::current_limit, 22, true},
      {A::voltage_gain, &M::voltage_gain, P::voltage_gain.width(), P::voltage_gain.sign == 1},
      {A::voltage_gain_high, &M::voltage_gain_high, P::voltage_gain_high.width(),
       P::voltage_gain_high.sign == 1},
      {A::dead_voltage, &M::dead_voltage, 22, true},
      {A::voltage_window, &M::voltage_window, 22, true},
      {A::voltage_step, &M::voltage_step, 22, true},
      {A::duty_gain, &M::duty_gain, P::duty_gain.width(), P::duty_gain.sign == 1},
      {A::duty_limit, &M::duty_limit, 22, true},
      {A::setpoint_torque, &M::setpoint_torque, P::setpoint_torque.width(),
       P::setpoint_torque.sign == 1},
      {A::membrane_lower, &M::membrane_lower, P::membrane_lower.width(),
       P::membrane_lower.sign == 1},
      {A::membrane_upper, &M::membrane_upper, P::membrane_upper.width(),
       P::membrane_upper.sign == 1},
      {A::membrane_torque, &M::membrane_torque, P::membrane_torque.width(),
       P::membrane_torque.sign == 1},
      {A::compression_contact, &M::compression_contact, P::compression_contact.width(),
       P::compression_contact.sign == 1},
      {A::compression_stiffness, &M::compression_stiffness, P::compression_stiffness.width(),
       P::compression_stiffness.sign == 1},
      {A::tension_rest, &M::tension_rest, P::tension_rest.width(), P::tension_rest.sign == 1},
      {A::tension_stiffness, &M::tension_stiffness, P::tension_stiffness.width(),
       P::tension_stiffness.sign == 1},
      {A::damper_damping, &M::damper_damping, P::damper_damping.width(),
       P::damper_damping.sign == 1},
      {A::attract_centre, &M::attract_centre, P::attract_centre.width(),
       P::attract_centre.sign == 1},
      {A::attract_strength, &M::attract_strength, P::attract_strength.width(),
       P::attract_strength.sign == 1},
      {A::attract_core, &M::attract_core, 22, true},
      {A::attract_core_slope, &M::attract_core_slope, P::attract_core_slope.width(),
       P::attract_core_slope.sign == 1},
      {A::repel_centre, &M::repel_centre, P::repel_centre.width(), P::repel_centre.sign == 1},
      {A::repel_strength, &M::repel_strength, P::repel_strength.width(),
       P::repel_strength.sign == 1},
      {A::repel_core, &M::repel_core, 22, true},
      {A::repel_core_slope, &M::repel_core_slope, P::repel_core_slope.width(),
       P::repel_core_slope.sign == 1},
      {A::wall_contact, &M::wall_contact, P::wall_contact.width(), P::wall_contact.sign == 1},
      {A::wall_stiffness, &M::wall_stiffness, P::wall_stiffness.width(),
       P::wall_stiffness.sign == 1},
      {A::wall_damping, &M::wall_damping, P::wall_damping.width(), P::wall_damping.sign == 1},
  };
  for (const Entry& e : entries) {
    if (e.address != address) continue;
    const Word low = word & ((Word{1} << e.width) - 1);
    p_.*e.member = e.signed_ ? wrapped(low, e.width) : low;
  }
}

}  // namespace feltgate
