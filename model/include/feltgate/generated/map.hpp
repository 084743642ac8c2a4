// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/registers.toml and rtl/schedule.toml by
// `feltgate generate`: do not edit.
#pragma once

#include <cstdint>
#include <string_view>

namespace feltgate {

/// Clocks, slots, addresses, bits and numbers of all designs.
struct Map {
  static constexpr int wave_length = 50;       ///< clocks; a tick is at least as long
  static constexpr int first_wave_clock = 2;  ///< clock of the tick that is wave clock 0
  static constexpr int multiplier_latency = 4;  ///< clocks from the operands to the product
  /// Bit n: slot n is read from the scene's bank.
  static constexpr std::uint64_t scene_slots = 0x44e;
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
  static constexpr int absolute_entry_bits = 20;  ///< a correction of an absolute encoder's table is in steps of a turn / 2^20
  static constexpr int absolute_segment_bits = 8;  ///< its table has 2^8 corrections over a turn
  static constexpr int one_channel_edges = 16;  ///< edges of one channel in a row from which it is chatter or a dead channel
  static constexpr int dead_channel_edges = 24;  ///< as many are a dead channel
  static constexpr int edge_units = 19;  ///< so many times 2^EDGE_UNIT_BITS ticks (of the design) without an edge end the row
  static constexpr int chatter_units = 20;  ///< chatter for so many times 4 * 2^EDGE_UNIT_BITS ticks is a dead channel
  static constexpr int index_width_bits = 3;  ///< an index may be less than 2^index_width_bits counts wide
  static constexpr int hold_unit_bits = 10;  ///< bits of the ticks in which hold_time is counted
  static constexpr int hold_bits = 13;  ///< bits of the longest hold_time

  /// Wave clocks in which a word, or a square, is on its bus.
  struct W {
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
    static constexpr int setpoint_torque = 10;
    static constexpr int membrane_lower = 1;
    static constexpr int membrane_upper = 2;
    static constexpr int membrane_torque = 10;
    static constexpr int compression_contact = 1;
    static constexpr int compression_stiffness = 2;
    static constexpr int tension_rest = 1;
    static constexpr int tension_stiffness = 2;
    static constexpr int damper_damping = 10;
    static constexpr int attract_centre = 1;
    static constexpr int attract_strength = 2;
    static constexpr int attract_core = 6;
    static constexpr int attract_core_slope = 3;
    static constexpr int repel_centre = 1;
    static constexpr int repel_strength = 2;
    static constexpr int repel_core = 6;
    static constexpr int repel_core_slope = 3;
    static constexpr int wall_contact = 1;
    static constexpr int wall_stiffness = 2;
    static constexpr int wall_damping = 10;
    static constexpr int scene_stiffness = 2;
    static constexpr int charge_square = 2;
    static constexpr int charge_slope = 3;
    static constexpr int scene_damping = 10;
    static constexpr int current_square = 13;
  };

  /// Wave clocks in which a product is on the product bus.
  struct M {
    static constexpr int velocity_a1 = 8;
    static constexpr int inverse_resistance = 9;
    static constexpr int emf_over_resistance = 11;
    static constexpr int torque_constant = 12;
    static constexpr int inertia_gain = 13;
    static constexpr int observer_a1 = 19;
    static constexpr int emf_constant = 26;
    static constexpr int observer_gain = 27;
    static constexpr int voltage_to_current = 31;
    static constexpr int torque_gain = 32;
    static constexpr int dead_voltage_slope = 33;
    static constexpr int voltage_gain = 38;
    static constexpr int duty_gain = 44;
    static constexpr int compression_stiffness = 6;
    static constexpr int tension_stiffness = 6;
    static constexpr int damper_damping = 14;
    static constexpr int attract_core_slope = 7;
    static constexpr int repel_core_slope = 7;
    static constexpr int wall_stiffness = 6;
    static constexpr int wall_damping = 14;
    static constexpr int scene_stiffness = 6;
    static constexpr int charge_square = 6;
    static constexpr int charge_slope = 7;
    static constexpr int scene_damping = 14;
    static constexpr int current_square = 17;
  };

  /// Wave clocks of the steps; what a step gives is there a clock later.
  struct T {
    static constexpr int sample = 0;
    static constexpr int travel = 1;
    static constexpr int velocity_raw = 2;
    static constexpr int velocity_difference = 3;
    static constexpr int velocity = 8;
    static constexpr int jump = 9;
    static constexpr int drive_torque = 12;
    static constexpr int observer_input = 13;
    static constexpr int observer_difference = 14;
    static constexpr int observer_state = 19;
    static constexpr int observed = 20;
    static constexpr int observed_rounded = 21;
    static constexpr int tau_hat = 22;
    static constexpr int scene_distance = 1;
    static constexpr int scene_gap = 1;
    static constexpr int membrane_lower = 1;
    static constexpr int membrane_upper = 2;
    static constexpr int charge_strength = 2;
    static constexpr int charge_divide = 6;
    static constexpr int spring_part = 6;
    static constexpr int charge_part = 7;
    static constexpr int damper_part = 14;
    static constexpr int setpoint_part = 10;
    static constexpr int membrane_side = 3;
    static constexpr int membrane_torque = 10;
    static constexpr int charge_width = 4;
    static constexpr int charge_width_early = 5;
    static constexpr int charge_quotient = 8;
    static constexpr int charge_width_limited = 6;
    static constexpr int charge_core = 7;
    static constexpr int charge_chosen = 8;
    static constexpr int least_full = 11;
    static constexpr int least_hold = 12;
    static constexpr int least_test = 14;
    static constexpr int least = 22;
    static constexpr int scene_sum = 15;
    static constexpr int scene_rounded = 22;
    static constexpr int law_torque = 22;
    static constexpr int scene_early = 23;
    static constexpr int scene_torque = 23;
    static constexpr int torque_limited = 24;
    static constexpr int ramp_begin = 1;
    static constexpr int ramp_excess = 25;
    static constexpr int ramp_change = 26;
    static constexpr int tau_ref = 27;
    static constexpr int direct_voltage_to_bus = 26;
    static constexpr int set_error = 31;
    static constexpr int set_step = 32;
    static constexpr int direct_voltage = 33;
    static constexpr int voltage_to_bus = 4;
    static constexpr int current_to_bus = 7;
    static constexpr int voltage_part = 26;
    static constexpr int current_part = 27;
    static constexpr int border = 28;
    static constexpr int border_early = 29;
    static constexpr int region_limited = 30;
    static constexpr int region = 31;
    static constexpr int gain_fetch = 32;
    static constexpr int direct_current = 31;
    static constexpr int direct_early = 32;
    static constexpr int current_sum = 32;
    static constexpr int current_limited = 33;
    static constexpr int current = 34;
    static constexpr int dead_sum = 33;
    static constexpr int dead_early = 34;
    static constexpr int dead_voltage = 35;
    static constexpr int voltage_offset = 36;
    static constexpr int voltage_sum = 38;
    static constexpr int voltage_limited = 39;
    static constexpr int voltage = 40;
    static constexpr int duty_sum = 44;
    static constexpr int duty_limited = 45;
    static constexpr int duty = 46;
    static constexpr int estimate_part = 9;
    static constexpr int current_estimate = 11;
    static constexpr int estimate_to_bus = 12;
    static constexpr int speed_size = 15;
    static constexpr int too_fast = 16;
    static constexpr int speed = 17;
    static constexpr int nominal = 17;
    static constexpr int cooled = 18;
    static constexpr int current_squared = 17;
    static constexpr int too_hot = 18;
    static constexpr int heat = 19;
    static constexpr int growth_size = 18;
    static constexpr int growth = 19;
    static constexpr int strong_size = 19;
    static constexpr int strong = 20;
    static constexpr int window_over = 21;
    static constexpr int polarity = 22;
    static constexpr int self_test_quiet = 37;
    static constexpr int self_test_over = 38;
    static constexpr int self_test_turn = 41;
    static constexpr int self_test = 42;
    static constexpr int silent = 46;
    static constexpr int watchdog = 47;
    static constexpr int levels = 0;
    static constexpr int channel = 1;
    static constexpr int hold_size = 34;
    static constexpr int hold_early = 35;
    static constexpr int hold_limited = 36;
    static constexpr int hold_strong = 37;
    static constexpr int hold = 43;
    static constexpr int position_word = 1;
    static constexpr int status_word = 0;
    static constexpr int duty_word = 46;
    static constexpr int snapshot = 47;
  };

  /// Wave clocks in which the snapshot takes its words, off the operand bus or by inputs of its own.
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

  /// All that happens in a tick: words read into the snapshot, operands of products, steps.
  enum class Step {
    read_status,
    sample,
    levels,
    status_word,
    read_position,
    travel,
    scene_distance,
    scene_gap,
    membrane_lower,
    ramp_begin,
    channel,
    position_word,
    operand_scene_stiffness,
    operand_charge_square,
    velocity_raw,
    membrane_upper,
    charge_strength,
    operand_charge_slope,
    velocity_difference,
    membrane_side,
    operand_velocity_a1,
    charge_width,
    voltage_to_bus,
    operand_inverse_resistance,
    charge_width_early,
    read_tick,
    charge_divide,
    spring_part,
    charge_width_limited,
    operand_emf_over_resistance,
    charge_part,
    charge_core,
    current_to_bus,
    operand_torque_constant,
    velocity,
    charge_quotient,
    charge_chosen,
    read_velocity,
    operand_inertia_gain,
    jump,
    estimate_part,
    operand_scene_damping,
    setpoint_part,
    membrane_torque,
    read_index,
    least_full,
    current_estimate,
    drive_torque,
    least_hold,
    estimate_to_bus,
    operand_current_square,
    observer_input,
    read_encoder,
    observer_difference,
    damper_part,
    least_test,
    operand_observer_a1,
    scene_sum,
    speed_size,
    too_fast,
    speed,
    nominal,
    current_squared,
    cooled,
    too_hot,
    growth_size,
    observer_state,
    heat,
    growth,
    strong_size,
    observed,
    strong,
    observed_rounded,
    window_over,
    operand_emf_constant,
    tau_hat,
    least,
    scene_rounded,
    law_torque,
    polarity,
    read_tau_hat,
    operand_observer_gain,
    scene_early,
    scene_torque,
    torque_limited,
    ramp_excess,
    read_faults,
    ramp_change,
    direct_voltage_to_bus,
    voltage_part,
    operand_voltage_to_current,
    tau_ref,
    current_part,
    read_tau_ref,
    operand_torque_gain,
    border,
    operand_dead_voltage_slope,
    border_early,
    region_limited,
    set_error,
    region,
    direct_current,
    set_step,
    gain_fetch,
    direct_early,
    current_sum,
    direct_voltage,
    current_limited,
    dead_sum,
    read_current_ref,
    operand_voltage_gain,
    current,
    dead_early,
    hold_size,
    dead_voltage,
    hold_early,
    voltage_offset,
    hold_limited,
    self_test_quiet,
    hold_strong,
    voltage_sum,
    self_test_over,
    voltage_limited,
    read_voltage,
    operand_duty_gain,
    voltage,
    self_test_turn,
    self_test,
    hold,
    duty_sum,
    duty_limited,
    read_duty,
    duty,
    silent,
    duty_word,
    watchdog,
    snapshot,
  };
  struct StepAt {
    Step step;
    int clock;  ///< of the wave
  };
  /// In the order of the clocks; what is taken in a clock comes before what is new after it.
  static constexpr StepAt steps[] = {
      {Step::read_status, 0},
      {Step::sample, 0},
      {Step::levels, 0},
      {Step::status_word, 0},
      {Step::read_position, 1},
      {Step::travel, 1},
      {Step::scene_distance, 1},
      {Step::scene_gap, 1},
      {Step::membrane_lower, 1},
      {Step::ramp_begin, 1},
      {Step::channel, 1},
      {Step::position_word, 1},
      {Step::operand_scene_stiffness, 2},
      {Step::operand_charge_square, 2},
      {Step::velocity_raw, 2},
      {Step::membrane_upper, 2},
      {Step::charge_strength, 2},
      {Step::operand_charge_slope, 3},
      {Step::velocity_difference, 3},
      {Step::membrane_side, 3},
      {Step::operand_velocity_a1, 4},
      {Step::charge_width, 4},
      {Step::voltage_to_bus, 4},
      {Step::operand_inverse_resistance, 5},
      {Step::charge_width_early, 5},
      {Step::read_tick, 6},
      {Step::charge_divide, 6},
      {Step::spring_part, 6},
      {Step::charge_width_limited, 6},
      {Step::operand_emf_over_resistance, 7},
      {Step::charge_part, 7},
      {Step::charge_core, 7},
      {Step::current_to_bus, 7},
      {Step::operand_torque_constant, 8},
      {Step::velocity, 8},
      {Step::charge_quotient, 8},
      {Step::charge_chosen, 8},
      {Step::read_velocity, 9},
      {Step::operand_inertia_gain, 9},
      {Step::jump, 9},
      {Step::estimate_part, 9},
      {Step::operand_scene_damping, 10},
      {Step::setpoint_part, 10},
      {Step::membrane_torque, 10},
      {Step::read_index, 11},
      {Step::least_full, 11},
      {Step::current_estimate, 11},
      {Step::drive_torque, 12},
      {Step::least_hold, 12},
      {Step::estimate_to_bus, 12},
      {Step::operand_current_square, 13},
      {Step::observer_input, 13},
      {Step::read_encoder, 14},
      {Step::observer_difference, 14},
      {Step::damper_part, 14},
      {Step::least_test, 14},
      {Step::operand_observer_a1, 15},
      {Step::scene_sum, 15},
      {Step::speed_size, 15},
      {Step::too_fast, 16},
      {Step::speed, 17},
      {Step::nominal, 17},
      {Step::current_squared, 17},
      {Step::cooled, 18},
      {Step::too_hot, 18},
      {Step::growth_size, 18},
      {Step::observer_state, 19},
      {Step::heat, 19},
      {Step::growth, 19},
      {Step::strong_size, 19},
      {Step::observed, 20},
      {Step::strong, 20},
      {Step::observed_rounded, 21},
      {Step::window_over, 21},
      {Step::operand_emf_constant, 22},
      {Step::tau_hat, 22},
      {Step::least, 22},
      {Step::scene_rounded, 22},
      {Step::law_torque, 22},
      {Step::polarity, 22},
      {Step::read_tau_hat, 23},
      {Step::operand_observer_gain, 23},
      {Step::scene_early, 23},
      {Step::scene_torque, 23},
      {Step::torque_limited, 24},
      {Step::ramp_excess, 25},
      {Step::read_faults, 26},
      {Step::ramp_change, 26},
      {Step::direct_voltage_to_bus, 26},
      {Step::voltage_part, 26},
      {Step::operand_voltage_to_current, 27},
      {Step::tau_ref, 27},
      {Step::current_part, 27},
      {Step::read_tau_ref, 28},
      {Step::operand_torque_gain, 28},
      {Step::border, 28},
      {Step::operand_dead_voltage_slope, 29},
      {Step::border_early, 29},
      {Step::region_limited, 30},
      {Step::set_error, 31},
      {Step::region, 31},
      {Step::direct_current, 31},
      {Step::set_step, 32},
      {Step::gain_fetch, 32},
      {Step::direct_early, 32},
      {Step::current_sum, 32},
      {Step::direct_voltage, 33},
      {Step::current_limited, 33},
      {Step::dead_sum, 33},
      {Step::read_current_ref, 34},
      {Step::operand_voltage_gain, 34},
      {Step::current, 34},
      {Step::dead_early, 34},
      {Step::hold_size, 34},
      {Step::dead_voltage, 35},
      {Step::hold_early, 35},
      {Step::voltage_offset, 36},
      {Step::hold_limited, 36},
      {Step::self_test_quiet, 37},
      {Step::hold_strong, 37},
      {Step::voltage_sum, 38},
      {Step::self_test_over, 38},
      {Step::voltage_limited, 39},
      {Step::read_voltage, 40},
      {Step::operand_duty_gain, 40},
      {Step::voltage, 40},
      {Step::self_test_turn, 41},
      {Step::self_test, 42},
      {Step::hold, 43},
      {Step::duty_sum, 44},
      {Step::duty_limited, 45},
      {Step::read_duty, 46},
      {Step::duty, 46},
      {Step::silent, 46},
      {Step::duty_word, 46},
      {Step::watchdog, 47},
      {Step::snapshot, 47},
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
