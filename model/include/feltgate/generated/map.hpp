// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/registers.toml by
// `feltgate generate`: do not edit.
#pragma once

#include <cstdint>
#include <string_view>

namespace feltgate {

/// Addresses, bits and numbers of all designs.
struct Map {
  /// While armed: words of all scenes that are refused or ramp, by address; scenes whose
  /// words act at once.
  static constexpr std::uint64_t refused_while_armed = 0xc23ef78c083b0;
  static constexpr std::uint64_t ramps_while_armed = 0x100000001000000;
  static constexpr unsigned input_scenes = 0x4;
  static constexpr int mode_open = 1;  ///< control.mode: open loop
  static constexpr int mode_voltage = 2;  ///< control.mode: direct voltage
  static constexpr int errors_borne = 7;  ///< encoder errors that are borne, less one every 2^forgive_bits ticks
  static constexpr int forgive_bits = 10;  ///< bits of the ticks after which one encoder error is forgiven
  static constexpr int runaway_bits = 16;  ///< bits of the longest window of the wrong-polarity check [tick]
  static constexpr int runaway_windows = 2;  ///< windows on end in which the speed must grow against the commanded current
  static constexpr int growth_bits = 5;  ///< fraction bits of the velocity whose growth is watched
  static constexpr int self_test_unit_bits = 7;  ///< bits of the ticks in a unit of the self-test's times
  static constexpr int self_test_count_bits = 8;  ///< bits of these times
  static constexpr int self_test_patience_bits = 17;  ///< bits of the ticks of which the second multiple ends the self-test's wait
  static constexpr int self_test_counts = 2;  ///< counts that are an answer to the self-test
  static constexpr int self_test_right = 1;  ///< what status.self_test says: the lever answered the right way
  static constexpr int self_test_held = 2;  ///< it did not answer
  static constexpr int self_test_moving = 3;  ///< it was not still for long enough to be asked
  static constexpr int self_test_held_bit = 0;  ///< of self_test_arms: the scene begins though the lever is held
  static constexpr int self_test_moving_bit = 1;  ///< of self_test_arms: the scene begins though the lever moves
  static constexpr int kickless_bits = 24;  ///< bits of the longest time without a kick [tick]
  static constexpr int arm_wait_ms = 20;  ///< for so long a request to arm may wait until the gates open [ms]; then it is refused
  static constexpr int absolute_jump_bit = 3;  ///< of faults.absolute: the angle has jumped
  static constexpr int one_channel_edges = 16;  ///< edges of one channel in a row from which it is chatter or a dead channel
  static constexpr int dead_channel_edges = 24;  ///< as many are a dead channel
  static constexpr int edge_units = 19;  ///< so many times 2^EDGE_UNIT_BITS ticks (of the design) without an edge end the row
  static constexpr int chatter_units = 20;  ///< chatter for so many times 4 * 2^EDGE_UNIT_BITS ticks is a dead channel
  static constexpr int index_width_bits = 3;  ///< an index may be less than 2^index_width_bits counts wide
  static constexpr int hold_unit_bits = 10;  ///< bits of the ticks in which hold_time is counted
  static constexpr int hold_bits = 13;  ///< bits of the longest hold_time

  /// Places of the snapshot's words, from C::snapshot on.
  struct R {
    static constexpr int tick = 6;
    static constexpr int position = 1;
    static constexpr int status = 0;
    static constexpr int faults = 26;
    static constexpr int encoder = 14;
    static constexpr int index = 11;
    static constexpr int velocity = 9;
    static constexpr int tau_hat = 23;
    static constexpr int tau_ref = 28;
    static constexpr int current_ref = 34;
    static constexpr int voltage = 40;
    static constexpr int duty = 46;
  };

  /// Addresses of the parameters.
  struct A {
    static constexpr int velocity_a1 = 4;
    static constexpr int inverse_resistance = 5;
    static constexpr int emf_over_resistance = 7;
    static constexpr int torque_constant = 8;
    static constexpr int inertia_gain = 9;
    static constexpr int nominal_current_squared = 17;
    static constexpr int observer_a1 = 15;
    static constexpr int overspeed = 16;
    static constexpr int i2t_budget = 18;
    static constexpr int polarity_speed = 19;
    static constexpr int polarity_current = 20;
    static constexpr int polarity_ticks = 21;
    static constexpr int emf_constant = 22;
    static constexpr int observer_gain = 23;
    static constexpr int voltage_setpoint = 31;
    static constexpr int voltage_step = 32;
    static constexpr int torque_limit = 24;
    static constexpr int ramp_step = 25;
    static constexpr int voltage_to_current = 27;
    static constexpr int torque_gain = 28;
    static constexpr int dead_voltage_slope = 29;
    static constexpr int region_torque = 30;
    static constexpr int hold_torque = 36;
    static constexpr int hold_time = 43;
    static constexpr int hold_limit = 56;
    static constexpr int current_limit = 33;
    static constexpr int voltage_gain = 34;
    static constexpr int voltage_gain_high = 50;
    static constexpr int dead_voltage = 35;
    static constexpr int voltage_window = 39;
    static constexpr int duty_gain = 40;
    static constexpr int duty_limit = 45;
    static constexpr int watchdog_ticks = 46;
    static constexpr int self_test_torque = 51;
    static constexpr int self_test_quiet = 37;
    static constexpr int self_test_pulse = 38;
    static constexpr int self_test_arms = 41;
    static constexpr int commutation_gain = 26;
    static constexpr int commutation_offset = 13;
    static constexpr int setpoint_torque = 74;
    static constexpr int membrane_lower = 97;
    static constexpr int membrane_upper = 98;
    static constexpr int membrane_torque = 106;
    static constexpr int compression_contact = 129;
    static constexpr int compression_stiffness = 130;
    static constexpr int tension_rest = 161;
    static constexpr int tension_stiffness = 162;
    static constexpr int damper_damping = 202;
    static constexpr int attract_centre = 225;
    static constexpr int attract_strength = 226;
    static constexpr int attract_core = 230;
    static constexpr int attract_core_slope = 227;
    static constexpr int repel_centre = 257;
    static constexpr int repel_strength = 258;
    static constexpr int repel_core = 262;
    static constexpr int repel_core_slope = 259;
    static constexpr int wall_contact = 289;
    static constexpr int wall_stiffness = 290;
    static constexpr int wall_damping = 298;
  };

  /// Scene numbers.
  struct S {
    static constexpr int free = 0;
    static constexpr int setpoint = 2;
    static constexpr int membrane = 3;
    static constexpr int spring_compression = 4;
    static constexpr int spring_tension = 5;
    static constexpr int damper = 6;
    static constexpr int charge_attract = 7;
    static constexpr int charge_repel = 8;
    static constexpr int wall = 9;
    static constexpr int law = 10;
  };
  /// Number of a scene by name, -1 when there is none.
  static constexpr int scene_number(std::string_view scene) {
    if (scene == "free") return 0;
    if (scene == "setpoint") return 2;
    if (scene == "membrane") return 3;
    if (scene == "spring_compression") return 4;
    if (scene == "spring_tension") return 5;
    if (scene == "damper") return 6;
    if (scene == "charge_attract") return 7;
    if (scene == "charge_repel") return 8;
    if (scene == "wall") return 9;
    if (scene == "law") return 10;
    return -1;
  }
  /// All of them, built or not, in the order of their numbers.
  static constexpr std::string_view scene_names[] = {
      "free",
      "setpoint",
      "membrane",
      "spring_compression",
      "spring_tension",
      "damper",
      "charge_attract",
      "charge_repel",
      "wall",
      "law"};

  /// Addresses of control and snapshot words, and bits of the words' fields.
  struct C {
    static constexpr int snapshot = 768;
    static constexpr int control = 512;
    static constexpr int control_width = 15;
    static constexpr int control_host = 0;
    static constexpr int control_arm = 1;
    static constexpr int control_scene = 2;
    static constexpr int control_scene_width = 4;
    static constexpr int control_mode = 6;
    static constexpr int control_mode_width = 2;
    static constexpr int control_motor_polarity = 8;
    static constexpr int control_encoder_polarity = 9;
    static constexpr int control_pwm_mode = 10;
    static constexpr int control_filter = 11;
    static constexpr int control_filter_width = 4;
    static constexpr int command = 513;
    static constexpr int command_width = 6;
    static constexpr int command_set_zero = 0;
    static constexpr int command_clear_faults = 1;
    static constexpr int command_kick = 2;
    static constexpr int command_freeze = 3;
    static constexpr int command_thaw = 4;
    static constexpr int command_stop = 5;
    static constexpr int read_tick = 774;
    static constexpr int read_position = 769;
    static constexpr int read_status = 768;
    static constexpr int status_limits = 0;
    static constexpr int status_limits_width = 12;
    static constexpr int status_scene = 20;
    static constexpr int status_scene_width = 4;
    static constexpr int status_armed = 24;
    static constexpr int status_mode = 25;
    static constexpr int status_mode_width = 2;
    static constexpr int status_encoder_error = 27;
    static constexpr int status_refused = 28;
    static constexpr int status_unkicked = 29;
    static constexpr int status_self_test = 16;
    static constexpr int status_self_test_width = 2;
    static constexpr int status_testing = 18;
    static constexpr int status_driver_fault = 19;
    static constexpr int status_saturated = 31;
    static constexpr int status_current_missing = 30;
    static constexpr int read_faults = 794;
    static constexpr int faults_seen = 0;
    static constexpr int faults_seen_width = 16;
    static constexpr int faults_first = 16;
    static constexpr int faults_first_width = 5;
    static constexpr int faults_current = 21;
    static constexpr int faults_current_width = 5;
    static constexpr int faults_absolute = 26;
    static constexpr int faults_absolute_width = 6;
    static constexpr int read_encoder = 782;
    static constexpr int read_index = 779;
    static constexpr int read_velocity = 777;
    static constexpr int read_tau_hat = 791;
    static constexpr int read_tau_ref = 796;
    static constexpr int read_current_ref = 802;
    static constexpr int read_voltage = 808;
    static constexpr int read_duty = 814;
  };

  /// Bits of the limits.
  struct L {
    static constexpr int torque = 0;
    static constexpr int ramp = 1;
    static constexpr int current = 2;
    static constexpr int voltage = 3;
    static constexpr int duty = 4;
    static constexpr int velocity = 5;
    static constexpr int tau_hat = 6;
    static constexpr int gates_closed = 7;
    static constexpr int hold = 8;
    static constexpr int chatter = 9;
  };
};

}  // namespace feltgate
