// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the value of every parameter from a design. Documentation: docs/designs.md
#include "design/design.hpp"

#include <algorithm>
#include <cmath>

#include "feltgate/commutation.hpp"

namespace feltgate::design {

namespace {

constexpr double kPi = 3.14159265358979323846;

double low_pass_a1(double cutoff_rad_s, double tick_s) {
  return -std::expm1(-cutoff_rad_s * tick_s);
}

// Largest duty. A bootstrap driver is charged by the pulses of the low gate: the low gate of each
// switching leg gets its shortest pulse in every period. If the period is too short, the limit is
// half a period. Of three legs with space vectors the highest is on for half a period and half the
// amplitude, with sines for half a period and amplitude/sqrt(3).
double duty_limit(const Design& d) {
  const int period = d.pwm_period_clocks(), legs = d.pwm_mode == 1 || d.phases == 3 ? 2 : 1;
  if (d.phases == 3 && d.modulation == Commutation::kSines) {
    const int most = period / 2 - d.dead_clocks() - d.shortest_clocks() - 1;
    return std::max<double>(period / 2, std::floor(most * std::sqrt(3.0)));
  }
  return std::max(period / 2, period - legs * (d.dead_clocks() + d.shortest_clocks()));
}

}  // namespace

std::map<std::string, Value> parameter_values(const Design& d) {
  const double q = d.count_rad();
  const bool model = d.voltage_law == "motor_model";
  const double jk = d.inertia_kg_m2 * d.kp_1_kg_m2;
  const double one_ohm = 1.0;
  const double tick_hz = static_cast<double>(d.tick_hz);
  const double observer_part = 1.0 - jk;
  // Each switching leg turns on late by the dead time; until then the current flows through diodes.
  // The lost voltage opposes the current like a brush drop, so the same law compensates it.
  // Of three legs the sum of the three signs turns with the current: 4/pi on average.
  const double legs = d.phases == 3 ? 4 / kPi : d.pwm_mode == 1 ? 2.0 : 1.0;
  const double lost_v =
      legs * (d.supply_v + 2 * d.diode_drop_v) * d.dead_clocks() / d.pwm_period_clocks();
  const double dead_v = (model ? d.dead_voltage_v : 0.0) + (d.compensate_dead_time ? lost_v : 0.0);
  const double core_slope =
      d.charge_core_rad > 0 ? d.charge_nm_rad2 / std::pow(d.charge_core_rad, 3) * q : 0.0;
  const double charge = d.charge_nm_rad2 / (q * q);
  // For whole counts, |x| < core means |x| <= ceil(core) - 1.
  const double core = std::max(0.0, std::ceil(d.charge_core_rad / q) - 1);
  // Without a current limit of the motor: the current that the law demands at stall.
  const double law_a =
      model ? d.current_limit_a
            : std::max(d.kv_low, d.kv_high) * one_ohm * d.current_limit_a / d.resistance_ohm;
  const double current_a = d.motor_current_limit_a > 0 ? d.motor_current_limit_a : law_a;
  const double offset_turns = d.commutation_offset_rad / (2 * kPi);
  // A whole number of LSB, at least one, is exact in every engine.
  const double step_v = std::ldexp(
      std::max(1.0, std::round(std::ldexp(d.voltage_ramp_v_s / tick_hz, d.voltage.fraction))),
      -d.voltage.fraction);
  return {
      {"velocity_a1", {low_pass_a1(d.velocity_cutoff_rad_s, d.tick_s()), "velocity.cutoff_rad_s"}},
      {"observer_a1", {low_pass_a1(d.observer_cutoff_rad_s, d.tick_s()), "observer.cutoff_rad_s"}},
      {"inverse_resistance", {1.0 / d.resistance_ohm, "motor.resistance_ohm"}},
      {"emf_over_resistance",
       {d.emf_constant_v_s_rad / d.resistance_ohm, "motor.emf_constant_v_s_rad"}},
      {"torque_constant", {d.torque_constant_nm_a, "observer.torque_constant_nm_a"}},
      {"inertia_gain", {d.observer_cutoff_rad_s * d.inertia_kg_m2, "observer.inertia_kg_m2"}},
      {"nominal_current_squared",
       {d.nominal_current_a * d.nominal_current_a, "supervisor.nominal_current_a"}},
      {"overspeed", {d.overspeed_rad_s, "supervisor.overspeed_rad_s"}},
      {"i2t_budget", {d.i2t_budget_a2_s * tick_hz, "supervisor.i2t_budget_a2_s"}},
      {"polarity_speed", {d.polarity_speed_rad_s, "supervisor.polarity_speed_rad_s"}},
      {"polarity_current", {d.polarity_current_a, "supervisor.polarity_current_a"}},
      {"polarity_ticks", {std::ceil(d.polarity_time_s * tick_hz), "supervisor.polarity_time_s"}},
      {"emf_constant", {d.emf_constant_v_s_rad, "motor.emf_constant_v_s_rad"}},
      {"observer_gain",
       {std::abs(observer_part) < 1e-12 ? 0.0 : observer_part / d.torque_constant_nm_a,
        "observer.torque_constant_nm_a"}},
      {"voltage_setpoint", {0.0, "voltage.law"}},
      {"voltage_step", {step_v, "voltage.ramp_v_s"}},
      {"torque_limit", {d.torque_limit_nm, "control.torque_limit_nm"}},
      {"ramp_step", {d.ramp_nm_s / tick_hz, "control.ramp_nm_s"}},
      {"voltage_to_current",
       {model ? 1.0 / d.resistance_ohm : 1.0 / one_ohm, "motor.resistance_ohm"}},
      {"torque_gain", {jk / d.torque_constant_nm_a, "control.kp_1_kg_m2"}},
      {"dead_voltage_slope", {dead_v / d.dead_voltage_linear_nm, "voltage.dead_voltage_linear_nm"}},
      {"region_torque", {model ? d.torque_limit_nm : d.region_nm, "voltage.region_nm"}},
      {"hold_torque", {d.hold_torque_nm, "supervisor.hold_torque_nm"}},
      {"hold_time",
       {std::ceil(d.hold_s * tick_hz / (1 << Map::hold_unit_bits)), "supervisor.hold_s"}},
      {"hold_limit", {d.hold_limit_nm, "supervisor.hold_limit_nm"}},
      {"current_limit", {d.current_limit_a, "control.current_limit_a"}},
      {"voltage_gain",
       {model ? d.resistance_ohm : d.kv_low * one_ohm,
        model ? "motor.resistance_ohm" : "voltage.kv_low"}},
      {"voltage_gain_high",
       {model ? d.resistance_ohm : d.kv_high * one_ohm,
        model ? "motor.resistance_ohm" : "voltage.kv_high"}},
      {"dead_voltage", {dead_v, "voltage.dead_voltage_v"}},
      {"voltage_window",
       {std::min(d.resistance_ohm * current_a + dead_v, d.full_duty_v()), "motor.resistance_ohm"}},
      {"duty_gain", {d.pwm_period_clocks() / d.full_duty_v(), "pwm.supply_v"}},
      {"duty_limit", {duty_limit(d), "pwm.frequency_hz"}},
      {"watchdog_ticks", {std::ceil(d.watchdog_s * tick_hz), "supervisor.watchdog_s"}},
      {"self_test_torque", {d.self_test_nm, "self_test.torque_nm"}},
      {"self_test_quiet",
       {std::ceil(d.self_test_units(d.self_test_quiet_s)), "self_test.quiet_ms"}},
      {"self_test_pulse",
       {d.self_test ? std::round(d.self_test_units(d.self_test_pulse_s)) : 0.0,
        "self_test.pulse_ms"}},
      {"self_test_arms",
       {static_cast<double>(d.arm_when_held << Map::self_test_held_bit |
                            d.arm_when_moving << Map::self_test_moving_bit),
        "self_test.arm_when_held"}},
      {"commutation_gain", {d.pole_pairs / (4.0 * std::max(1, d.lines)), "commutation.pole_pairs"}},
      {"commutation_offset", {offset_turns - std::floor(offset_turns), "commutation.offset_rad"}},
      {"setpoint_torque", {d.setpoint_nm, "scenes.setpoint_nm"}},
      {"membrane_lower", {d.membrane_lower_rad / q, "scenes.membrane_lower_rad"}},
      {"membrane_upper", {d.membrane_upper_rad / q, "scenes.membrane_upper_rad"}},
      {"membrane_torque", {d.membrane_nm, "scenes.membrane_nm"}},
      {"compression_contact", {d.compression_contact_rad / q, "scenes.compression_contact_rad"}},
      {"compression_stiffness", {d.compression_nm_rad * q, "scenes.compression_nm_rad"}},
      {"tension_rest", {d.tension_rest_rad / q, "scenes.tension_rest_rad"}},
      {"tension_stiffness", {d.tension_nm_rad * q, "scenes.tension_nm_rad"}},
      {"damper_damping", {d.damper_nm_s_rad, "scenes.damper_nm_s_rad"}},
      {"attract_centre", {std::round(d.charge_centre_rad / q), "scenes.charge_centre_rad"}},
      {"attract_strength", {charge, "scenes.charge_nm_rad2"}},
      {"attract_core", {core, "scenes.charge_core_rad"}},
      {"attract_core_slope", {core_slope, "scenes.charge_core_rad"}},
      {"repel_centre", {std::round(d.charge_centre_rad / q), "scenes.charge_centre_rad"}},
      {"repel_strength", {charge, "scenes.charge_nm_rad2"}},
      {"repel_core", {core, "scenes.charge_core_rad"}},
      {"repel_core_slope", {core_slope, "scenes.charge_core_rad"}},
      {"wall_contact", {d.wall_contact_rad / q, "scenes.wall_contact_rad"}},
      {"wall_stiffness", {d.wall_nm_rad * q, "scenes.wall_nm_rad"}},
      {"wall_damping", {d.wall_nm_s_rad, "scenes.wall_nm_s_rad"}},
  };
}

}  // namespace feltgate::design
