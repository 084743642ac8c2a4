// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The whole core: encoder pins to gate pins. Once per tick a wave runs through the rooms encoder,
// estimators, scenes and actuation; safety watches them; the room wave gives all of them the clock
// of the wave, one parameter and the products. Latency: sampled position (clock 0) to duty 47
// clocks. docs/architecture.md, docs/architecture.md

`default_nettype none

module feltgate_core #(
    parameter int ReadBack = 1,  // 0: no snapshot RAM, the host can only write
    parameter ParameterFile = ""  // parameters.mem of the design, for tools that want a file; "": none
) (
    input  logic clk_i,
    input  logic rst_ni,

    // Encoder, motor
    input  logic enc_a_i,
    input  logic enc_b_i,
    input  logic enc_z_i,
    input  logic encoder_data_i,    // of an absolute encoder, for the option ABSOLUTE_ENCODER; else tie it to 0
    output logic encoder_select_no,
    output logic encoder_clock_o,
    output logic encoder_command_o,
    input  logic [2:0] hall_i,      // Hall lines of a motor with PHASES = 3, for the option HALL; else tie them to 0
    output logic gate_a_hi_o,
    output logic gate_a_lo_o,
    output logic gate_b_hi_o,
    output logic gate_b_lo_o,
    output logic gate_c_hi_o,  // of a bridge with PHASES = 3; else 0
    output logic gate_c_lo_o,

    // Modulator of the motor current, for the option CURRENT_LOOP, or with PHASES = 3 two of them; else tie the input to 0
    input  logic        [feltgate_pkg::CURRENT_LOOP*(feltgate_pkg::PHASES-2):0] current_data_i,
    output logic               current_clock_o,
    output logic signed [18:0] current_o,   // measured, [1,1,17] of full scale
    input  logic               driver_fault_i,  // fault of the bridge's driver, for the option DRIVER_FAULT; else 0
    output logic               heartbeat_o,     // to a watchdog outside, for the option HEARTBEAT

    // Panel: used while the control word does not give control to the host
    input  logic       arm_i,       // level; its rising edge arms
    input  logic       stop_i,      // external stop, asynchronous, latched as a fault
    input  logic       set_zero_i,  // one clock: position := 0 at the tick's end
    input  logic [3:0] scene_i,

    // Programmed torque of the scene law; state of other axes. Tie unused inputs to 0.
    input  logic signed [feltgate_pkg::TORQUE_W-1:0] law_torque_i,  // sampled in EVENT_AT_LAW_TORQUE
    input  logic law_late_i,      // no valid law_torque_i: it counts as 0; a fault if used
    input  logic law_restart_i,   // last clock of a tick: ramp from the next tick on
    input  logic axis_fault_i,    // another axis has a fault
    input  logic axis_silent_i,   // another axis, or the program's CRC, does not let it arm
    input  logic axis_blocked_i,  // another axis is not ready, or the program's CRC is wrong
    input  logic axis_testing_i,  // another axis runs its self-test: the scene waits
    input  logic axis_waits_i,    // an axis of a lower number runs its self-test: this one waits
    output logic arm_request_o,          // state of this axis for the others: requests arming
    output logic ready_o,
    output logic testing_o,
    output logic measured_o,      // one clock: position, velocity, tau_hat are new, held half a tick
    output logic zeroed_o,        // one clock: the position becomes 0

    // Register port
    input  logic [11:0] reg_addr_i,
    input  logic [31:0] reg_wdata_i,
    input  logic        reg_write_i,
    output logic        reg_busy_o,
    output logic [31:0] reg_rdata_o,

    // Snapshot: with snapshot_valid_o high, all values belong to one tick
    output logic                                         snapshot_valid_o,
    output logic        [                          31:0] tick_count_o,
    output logic signed [                          31:0] position_o,      // counts, wraps
    output logic signed [  feltgate_pkg::VELOCITY_W-1:0] velocity_o,      // rad/s
    output logic signed [    feltgate_pkg::TORQUE_W-1:0] tau_hat_o,       // Nm
    output logic signed [    feltgate_pkg::TORQUE_W-1:0] tau_ref_o,       // Nm
    output logic signed [   feltgate_pkg::CURRENT_W-1:0] current_ref_o,   // A
    output logic signed [   feltgate_pkg::VOLTAGE_W-1:0] voltage_o,       // V
    output logic signed [      feltgate_pkg::DUTY_W-1:0] duty_o,          // clocks of on-time
    output logic        [                           3:0] scene_o,
    output logic        [feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits_o,
    output logic        [feltgate_map_pkg::W_FAULTS_SEEN-1:0]   faults_o,
    output logic        [feltgate_map_pkg::W_FAULTS_FIRST-1:0]  first_fault_o,
    output logic                                         armed_o,
    output logic signed [      feltgate_pkg::DUTY_W-1:0] duty_active_o,   // in force in the bridge
    output logic                                         gates_enable_o,

    // The snapshot's words, one at a time, as they are stored; for a stream or a capture
    output logic                                         word_valid_o,
    output logic        [                           5:0] word_slot_o,
    output logic        [                          31:0] word_data_o
);
  feltgate_checks u_checks ();
  // wave: time, words and products for all rooms
  logic tick, set_zero, clear_faults, kick, disarm, host_stop, restart, paused;
  logic [feltgate_map_pkg::WAVE_LENGTH-1:0] wave;
  logic [31:0] param;
  logic [feltgate_map_pkg::W_CONTROL-1:0] control;
  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] velocity_product, dob_product, scene_product, control_product;
  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] supervisor_product;
  // encoder, estimators, scenes
  logic signed [31:0] index_position, count;
  logic [31:0] hall_angle;
  logic signed [feltgate_pkg::SCENE_POSITION_W-1:0] scene_position;
  logic signed [feltgate_pkg::TRAVEL_BITS-1:0] travel;
  logic [15:0] error_count, rejected_count;
  logic moved, chatters, illegal, encoder_error, law, square, scene_up, scene_not, scene_late_up;
  logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] velocity_difference;
  logic signed [feltgate_pkg::OBSERVER_DIFFERENCE_W-1:0] observer_difference;
  logic signed [feltgate_pkg::SCENE_DISTANCE_W-1:0] distance;
  logic signed [feltgate_pkg::SCENE_TORQUE_W-1:0] scene_early, pulse;  // in a self-test the scene gives 0
  logic signed [feltgate_pkg::TORQUE_W-1:0] scene_late;
  // actuation, safety
  logic over_limit, region_high, period_start, clear, arms, unkicked, gates_clear, derated;
  logic [feltgate_map_pkg::W_FAULTS_CURRENT+1:0] current_state;
  logic [feltgate_map_pkg::W_FAULTS_ABSOLUTE-1:0] absolute_state;
  logic polarity_holds;
  logic signed [feltgate_pkg::WITH_ADDEND_W-1:0] applied;
  logic signed [feltgate_pkg::CURRENT_W-1:0] motor_current;  // measured, if there is a current loop
  logic signed [feltgate_pkg::CURRENT_ESTIMATE_W-1:0] current_estimate;
  logic [feltgate_map_pkg::W_STATUS_SELF_TEST-1:0] test_result;
  // Each room's faults and limits, by bit
  logic [feltgate_map_pkg::W_FAULTS_SEEN-1:0] encoder_trips, estimator_trips, actuation_trips, wave_trips;
  logic [feltgate_map_pkg::W_STATUS_LIMITS-1:0] encoder_limits, estimator_limits, actuation_limits, safety_limits;
  assign paused = testing_o || axis_testing_i;

  encoder u_encoder (
      .clk_i(clk_i), .rst_ni(rst_ni), .wave_i(wave), .tick_count_i(tick_count_o), .enc_a_i(enc_a_i), .enc_b_i(enc_b_i),
      .param_i(param), .hall_i(hall_i), .hall_angle_o(hall_angle),
      .enc_z_i(enc_z_i), .encoder_data_i(encoder_data_i), .encoder_select_no(encoder_select_no),
      .encoder_clock_o(encoder_clock_o), .encoder_command_o(encoder_command_o), .control_i(control),
      .set_zero_i(set_zero), .clear_i(clear), .position_o(position_o), .scene_position_o(scene_position),
      .travel_o(travel), .moved_o(moved), .chatters_o(chatters), .illegal_o(illegal), .error_o(encoder_error),
      .error_count_o(error_count), .rejected_count_o(rejected_count), .index_position_o(index_position),
      .gates_enable_i(gates_enable_o), .polarity_holds_o(polarity_holds),
      .absolute_state_o(absolute_state), .limits_o(encoder_limits),
      .trips_o(encoder_trips), .count_o(count)
  );

  estimators u_estimators (
      .clk_i(clk_i), .rst_ni(rst_ni), .wave_i(wave), .armed_i(armed_o), .travel_i(travel),
      .velocity_difference_o(velocity_difference), .velocity_product_i(velocity_product),
      .observer_difference_o(observer_difference), .dob_product_i(dob_product), .velocity_o(velocity_o),
      .tau_hat_o(tau_hat_o), .limits_o(estimator_limits), .trips_o(estimator_trips)
  );

  scenes u_scenes (
      .clk_i(clk_i), .rst_ni(rst_ni), .wave_i(wave), .param_i(param), .armed_i(armed_o && !paused), .scene_i(scene_o),
      .position_i(scene_position), .product_i(scene_product), .over_limit_i(over_limit), .law_torque_i(law_torque_i),
      .law_late_i(law_late_i), .law_o(law), .distance_o(distance), .square_o(square), .early_term_o(scene_early),
      .early_up_o(scene_up), .late_term_o(scene_late), .late_not_o(scene_not), .late_up_o(scene_late_up)
  );

  actuation u_actuation (
      .clk_i(clk_i), .rst_ni(rst_ni), .wave_i(wave), .param_i(param), .armed_i(armed_o), .paused_i(paused),
      .control_i(control), .scene_i(scene_o), .restart_i(restart || (tick && law && law_restart_i)),
      .hall_angle_i(hall_angle),
      .frozen_i(chatters), .derated_i(derated), .early_term_i(scene_early | pulse), .early_up_i(scene_up),
      .late_term_i(scene_late), .late_not_i(scene_not), .late_up_i(scene_late_up), .product_i(control_product),
      .over_limit_o(over_limit), .applied_o(applied), .region_high_o(region_high), .tau_ref_o(tau_ref_o),
      .current_ref_o(current_ref_o), .voltage_o(voltage_o), .duty_o(duty_o), .limits_o(actuation_limits),
      .current_data_i(current_data_i), .current_clock_o(current_clock_o), .current_o(current_o),
      .motor_current_o(motor_current), .driver_fault_i(driver_fault_i), .current_state_o(current_state),
      .trips_o(actuation_trips), .clear_i(clear), .gates_enable_i(gates_enable_o), .gates_clear_i(gates_clear),
      .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
      .period_start_o(period_start), .duty_active_o(duty_active_o),
      .count_i(count), .gate_c_hi_o(gate_c_hi_o), .gate_c_lo_o(gate_c_lo_o)
  );

  safety u_safety (
      .clk_i(clk_i), .rst_ni(rst_ni), .wave_i(wave), .param_i(param), .tick_i(tick), .tick_count_i(tick_count_o),
      .period_start_i(period_start), .control_i(control), .host_stop_i(host_stop), .arm_i(arm_i), .stop_i(stop_i),
      .disarm_i(disarm), .clear_faults_i(clear_faults), .kick_i(kick), .clear_o(clear), .axis_fault_i(axis_fault_i),
      .axis_silent_i(axis_silent_i), .axis_blocked_i(axis_blocked_i), .axis_waits_i(axis_waits_i),
      .arm_request_o(arm_request_o), .ready_o(ready_o), .current_state_i(current_state),
      .absolute_state_i(absolute_state), .trips_i(encoder_trips | estimator_trips | actuation_trips | wave_trips),
      .illegal_i(illegal), .moved_i(moved), .travel_i(travel[feltgate_pkg::SELF_TEST_DROP+:2]), .velocity_i(velocity_o),
      .current_ref_i(current_ref_o), .product_i(supervisor_product), .over_limit_i(over_limit), .law_i(law),
      .law_late_i(law_late_i), .armed_o(armed_o), .arms_o(arms), .unkicked_o(unkicked), .gates_enable_o(gates_enable_o),
      .gates_clear_o(gates_clear), .faults_o(faults_o), .first_fault_o(first_fault_o), .limits_o(safety_limits),
      .current_estimate_o(current_estimate), .derated_o(derated), .heartbeat_o(heartbeat_o), .testing_o(testing_o),
      .pulse_o(pulse), .test_result_o(test_result)
  );

  assign limits_o = encoder_limits | estimator_limits | actuation_limits | safety_limits;
  wave #(.ReadBack(ReadBack), .ParameterFile(ParameterFile)) u_wave (
      .polarity_holds_i(polarity_holds),
      .clk_i(clk_i), .rst_ni(rst_ni), .tick_o(tick), .tick_count_o(tick_count_o), .wave_o(wave), .param_o(param),
      .reg_addr_i(reg_addr_i), .reg_wdata_i(reg_wdata_i), .reg_write_i(reg_write_i), .reg_busy_o(reg_busy_o),
      .reg_rdata_o(reg_rdata_o), .set_zero_i(set_zero_i), .scene_i(scene_i), .scene_o(scene_o), .control_o(control),
      .set_zero_o(set_zero), .clear_faults_o(clear_faults), .kick_o(kick), .disarm_o(disarm), .stop_o(host_stop),
      .restart_o(restart), .trips_o(wave_trips), .locked_i(armed_o || arms), .region_high_i(region_high),
      .derated_i(derated), .testing_i(testing_o), .armed_i(armed_o), .paused_i(paused), .unkicked_i(unkicked),
      .test_result_i(test_result), .limits_i(limits_o), .faults_i(faults_o), .first_fault_i(first_fault_o),
      .current_state_i(current_state), .absolute_state_i(absolute_state), .encoder_error_i(encoder_error),
      .error_count_i(error_count), .rejected_count_i(rejected_count), .position_i(position_o),
      .index_position_i(index_position), .word_valid_o(word_valid_o), .word_slot_o(word_slot_o),
      .word_data_o(word_data_o), .velocity_difference_i(velocity_difference),
      .observer_difference_i(observer_difference), .distance_i(distance), .square_i(square), .applied_i(applied),
      .velocity_i(velocity_o), .tau_hat_i(tau_hat_o), .tau_ref_i(tau_ref_o), .motor_current_i(motor_current),
      .voltage_i(voltage_o), .current_estimate_i(current_estimate), .velocity_product_o(velocity_product),
      .dob_product_o(dob_product), .scene_product_o(scene_product), .control_product_o(control_product),
      .supervisor_product_o(supervisor_product)
  );

  assign zeroed_o         = set_zero;
  assign measured_o       = wave[feltgate_map_pkg::EVENT_AT_TAU_HAT+1];
  assign snapshot_valid_o = wave[feltgate_map_pkg::EVENT_AT_SNAPSHOT];
endmodule

`default_nettype wire
