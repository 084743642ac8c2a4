// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The parameter words of the hand-written chain. Documentation: docs/bench.md
#include "bench/shift_chain.hpp"

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
      {A::velocity_a1, &M::velocity_a1, 17, false},
      {A::torque_constant, &M::torque_constant, 17, false},
      {A::inertia_gain, &M::inertia_gain, 17, false},
      {A::observer_a1, &M::observer_a1, 17, false},
      {A::emf_constant, &M::emf_constant, 17, false},
      {A::observer_gain, &M::observer_gain, 18, true},
      {A::voltage_setpoint, &M::voltage_setpoint, 20, true},
      {A::torque_limit, &M::torque_limit, 21, true},
      {A::ramp_step, &M::ramp_step, 29, true},
      {A::voltage_to_current, &M::voltage_to_current, 17, false},
      {A::torque_gain, &M::torque_gain, 17, false},
      {A::dead_voltage_slope, &M::dead_voltage_slope, 17, false},
      {A::region_torque, &M::region_torque, 22, true},
      {A::current_limit, &M::current_limit, 22, true},
      {A::voltage_gain, &M::voltage_gain, 17, false},
      {A::voltage_gain_high, &M::voltage_gain_high, 17, false},
      {A::dead_voltage, &M::dead_voltage, 22, true},
      {A::voltage_limit, &M::voltage_limit, 22, true},
      {A::duty_gain, &M::duty_gain, 17, false},
      {A::duty_limit, &M::duty_limit, 22, true},
      {A::setpoint_torque, &M::setpoint_torque, 21, true},
      {A::membrane_lower, &M::membrane_lower, 26, true},
      {A::membrane_upper, &M::membrane_upper, 26, true},
      {A::membrane_torque, &M::membrane_torque, 21, true},
      {A::compression_contact, &M::compression_contact, 26, true},
      {A::compression_stiffness, &M::compression_stiffness, 17, false},
      {A::tension_rest, &M::tension_rest, 26, true},
      {A::tension_stiffness, &M::tension_stiffness, 17, false},
      {A::damper_damping, &M::damper_damping, 17, false},
      {A::attract_centre, &M::attract_centre, 26, true},
      {A::attract_strength, &M::attract_strength, 32, false},
      {A::attract_core, &M::attract_core, 31, false},
      {A::attract_core_slope, &M::attract_core_slope, 17, false},
      {A::repel_centre, &M::repel_centre, 26, true},
      {A::repel_strength, &M::repel_strength, 32, false},
      {A::repel_core, &M::repel_core, 31, false},
      {A::repel_core_slope, &M::repel_core_slope, 17, false},
      {A::wall_contact, &M::wall_contact, 26, true},
      {A::wall_stiffness, &M::wall_stiffness, 17, false},
      {A::wall_damping, &M::wall_damping, 17, false},
  };
  for (const Entry& e : entries) {
    if (e.address != address) continue;
    const Word low = word & ((Word{1} << e.width) - 1);
    p_.*e.member = e.signed_ ? wrapped(low, e.width) : low;
  }
}

}  // namespace feltgate
