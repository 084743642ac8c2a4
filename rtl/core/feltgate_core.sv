// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The whole core: encoder pins to gate pins. Once per tick a wave runs through quad_decoder,
// velocity_n, dob, scenes, limiter, ramp and torque_control. Each wave clock gives the one
// parameter bus and the multiplier (one shared, or one per block) to one block. Latency: sampled
// position (clock 0) to duty 47 clocks. docs/blocks/feltgate_core.md, docs/architecture.md

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
    output logic gate_a_hi_o,
    output logic gate_a_lo_o,
    output logic gate_b_hi_o,
    output logic gate_b_lo_o,

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
    input  logic axis_waits_i,    // an axis of a lower number does: the self-test waits
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
  localparam int SceneW = feltgate_pkg::SCENE_POSITION_W;
  localparam int FaultsW = feltgate_map_pkg::W_FAULTS_SEEN;
  feltgate_checks u_checks ();
  // The wave and its two buses.
  logic                       tick;
  logic [                5:0] slot_fetch;
  logic                       scene_slot_fetch;
  logic [feltgate_map_pkg::WAVE_LENGTH-1:0] wave;
  logic [               31:0] param;
  logic signed [feltgate_pkg::MULTIPLIER_A_BITS-1:0] operand;
  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] velocity_product, dob_product, scene_product;
  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] control_product, supervisor_product;

  // Requests of the registers and of the panel.
  logic [feltgate_map_pkg::W_CONTROL-1:0] control;
  logic [ 3:0] scene_wanted, scene_q;
  logic [ 1:0] mode;
  logic host, clear_faults, kick, region_high;
  logic clear, disarm, host_stop, restart, refused, arms, unkicked, word_error, testing, paused, law, self_test_trip;
  logic moved, over_limit, frozen, derated, channel_trip, index_trip, flip_trip;
  assign host         = control[feltgate_map_pkg::B_CONTROL_HOST];
  assign mode         = control[feltgate_map_pkg::B_CONTROL_MODE+:feltgate_map_pkg::W_CONTROL_MODE];
  assign scene_wanted = host ? control[feltgate_map_pkg::B_CONTROL_SCENE+:feltgate_map_pkg::W_CONTROL_SCENE] : scene_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) scene_q <= '0;
    else if (tick) scene_q <= scene_wanted;
  end

  sequencer u_sequencer (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .tick_o(tick), .tick_count_o(tick_count_o), .wave_o(wave),
      .slot_fetch_o(slot_fetch), .scene_slot_fetch_o(scene_slot_fetch)
  );

  registers #(.ReadBack(ReadBack), .ParameterFile(ParameterFile)) u_registers (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .tick_i(tick),
      .reg_addr_i(reg_addr_i), .reg_wdata_i(reg_wdata_i), .reg_write_i(reg_write_i),
      .reg_rdata_o(reg_rdata_o), .reg_busy_o(reg_busy_o),
      .armed_i(armed_o || arms), .set_zero_i(set_zero_i),
      .slot_fetch_i(slot_fetch), .scene_slot_fetch_i(scene_slot_fetch),
      .scene_i(scene_q),
      .region_high_i(region_high), .derated_i(derated), .testing_i(testing),
      .param_o(param),
      .word_error_o(word_error),
      .control_o(control), .set_zero_o(zeroed_o),
      .clear_faults_o(clear_faults), .kick_o(kick),
      .disarm_o(disarm), .stop_o(host_stop),
      .restart_o(restart),
      .refused_o(refused),
      .snap_slot_i(word_slot_o), .snap_valid_i(word_valid_o), .snap_data_i(word_data_o)
  );

  // Encoder to position, and the position that the wave samples.
  logic signed [31:0] position, index_position, count, zero;
  logic signed [feltgate_pkg::TRAVEL_BITS-1:0] travel;
  logic [15:0] error_count, rejected_count;
  logic encoder_error, illegal, unused_index_seen, index_wrong;
  logic signed [1:0] step;
  logic [1:0] levels;
  quad_decoder #(.IndexCounts(feltgate_pkg::INDEX_COUNTS)) u_quad_decoder (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .a_i(enc_a_i), .b_i(enc_b_i), .z_i(enc_z_i),
      .filter_i(control[feltgate_map_pkg::B_CONTROL_FILTER+:feltgate_map_pkg::W_CONTROL_FILTER]),
      .polarity_i(control[feltgate_map_pkg::B_CONTROL_ENCODER_POLARITY]),
      .set_zero_i(zeroed_o),
      .clear_error_i(clear),
      .position_o(position), .travel_o(travel),
      .step_o(step), .count_o(count), .zero_o(zero),
      .levels_o(levels), .illegal_o(illegal),
      .error_o(encoder_error),
      .error_count_o(error_count), .rejected_count_o(rejected_count),
      .index_position_o(index_position),
      .index_seen_o(unused_index_seen), .index_wrong_o(index_wrong)
  );

  encoder_monitor u_encoder_monitor (
      .clk_i(clk_i), .rst_ni(rst_ni), .wave_i(wave), .tick_count_i(tick_count_o), .levels_i(levels),
      .count_i(count), .zero_i(zero), .step_i(step), .set_zero_i(zeroed_o), .flip_trip_o(flip_trip),
      .index_wrong_i(index_wrong), .index_trip_o(index_trip), .moved_o(moved), .chatters_o(frozen), .trip_o(channel_trip)
  );
  hold_timer u_hold_timer (
      .clk_i(clk_i), .rst_ni(rst_ni), .armed_i(armed_o), .wave_i(wave), .tick_count_i(tick_count_o),
      .param_i(param), .moved_i(moved), .over_limit_i(over_limit), .derated_o(derated)
  );

  logic signed [SceneW-1:0] scene_position_q;
  logic position_over;
  assign position_over = position[31:SceneW-1] != {(33 - SceneW) {position[31]}};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      position_o       <= '0;
      scene_position_q <= '0;
    end else if (wave[feltgate_map_pkg::EVENT_AT_SAMPLE]) begin
      position_o       <= position;
      scene_position_q <= position_over ? {position[31], {(SceneW - 1) {~position[31]}}}
                                        : position[SceneW-1:0];
    end
  end

  logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] velocity_difference;
  logic velocity_saturated, tau_hat_saturated, square;
  velocity_n u_velocity_n (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .wave_i(wave),
      .travel_i(travel), .operand_o(velocity_difference),
      .product_i(velocity_product),
      .velocity_o(velocity_o),
      .saturated_o(velocity_saturated)
  );
  logic velocity_jumped;
  velocity_jump u_velocity_jump (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .wave_i(wave),
      .velocity_i(velocity_o),
      .trip_o(velocity_jumped)
  );

  logic signed [feltgate_pkg::OBSERVER_DIFFERENCE_W-1:0] observer_difference;
  dob u_dob (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(armed_o),
      .wave_i(wave),
      .product_i(dob_product),
      .operand_o(observer_difference),
      .tau_hat_o(tau_hat_o),
      .saturated_o(tau_hat_saturated)
  );

  logic signed [feltgate_pkg::LIMITER_W-1:0] limited;
  logic signed [feltgate_pkg::SCENE_DISTANCE_W-1:0] distance;
  logic signed [feltgate_pkg::SCENE_TORQUE_W-1:0] scene_early;
  logic signed [feltgate_pkg::TORQUE_W-1:0] scene_late;
  assign paused = testing || axis_testing_i;
  scenes u_scenes (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(armed_o && !paused),
      .scene_i(scene_q),
      .wave_i(wave), .position_i(scene_position_q),
      .param_i(param),
      .product_i(scene_product),
      .over_limit_i(over_limit),
      .law_torque_i(law_torque_i), .law_late_i(law_late_i), .law_o(law),
      .distance_o(distance), .square_o(square),
      .early_term_o(scene_early), .late_term_o(scene_late)
  );

  logic signed [feltgate_pkg::SCENE_TORQUE_W-1:0] pulse_early;
  logic [feltgate_map_pkg::W_STATUS_SELF_TEST-1:0] test_result;
  self_test u_self_test (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(armed_o), .direct_i(mode == 2'(feltgate_map_pkg::MODE_VOLTAGE)), .waits_i(axis_waits_i),
      .travel_i(travel[1:0]), .tick_count_i(tick_count_o),
      .wave_i(wave), .param_i(param),
      .busy_o(testing), .early_term_o(pulse_early),
      .result_o(test_result), .trip_o(self_test_trip)
  );

  logic signed [feltgate_pkg::LIMITER_INPUT_W-1:0] control_early, control_late;
  logic signed [feltgate_pkg::WITH_ADDEND_W-1:0] applied;
  limiter u_limiter (
      .clk_i(clk_i),
      .valid_i(wave[feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT-1] || wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_STEP-1] ||
               wave[feltgate_map_pkg::PARAM_AT_CURRENT_LIMIT-1] || wave[feltgate_map_pkg::PARAM_AT_DEAD_VOLTAGE-1] ||
               wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_WINDOW-1] || wave[feltgate_map_pkg::PARAM_AT_DUTY_LIMIT-1]),
      .torque_i(wave[feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT-1]), .voltage_i(wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_WINDOW-1]),
      .duty_i(wave[feltgate_map_pkg::PARAM_AT_DUTY_LIMIT-1]),
      .early_term_i(control_early | feltgate_pkg::LIMITER_INPUT_W'(scene_early | pulse_early)),
      .late_term_i(control_late | feltgate_pkg::LIMITER_INPUT_W'(scene_late)),
      .param_i(param),
      .limited_o(limited),
      .over_limit_o(over_limit)
  );
  logic limit_torque, limit_ramp, limit_hold, limit_current, limit_voltage, limit_duty;
  ramp u_ramp (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(armed_o && !paused),
      .scene_i(scene_q),
      .restart_i(restart || (tick && law && law_restart_i)),
      .wave_i(wave), .param_i(param),
      .limited_i(limited), .over_limit_i(over_limit),
      .tau_ref_o(tau_ref_o),
      .frozen_i(frozen), .derated_i(derated),
      .limit_torque_o(limit_torque), .limit_ramp_o(limit_ramp),
      .limit_hold_o(limit_hold)
  );

  torque_control u_torque_control (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(armed_o),
      .mode_i(mode), .wave_i(wave), .param_i(param),
      .product_i(control_product),
      .tau_ref_i(tau_ref_o),
      .early_term_o(control_early),
      .late_term_o(control_late),
      .limited_i(limited), .over_limit_i(over_limit), .applied_o(applied),
      .region_high_o(region_high),
      .current_ref_o(current_ref_o),
      .voltage_o(voltage_o),
      .duty_o(duty_o),
      .limit_current_o(limit_current), .limit_voltage_o(limit_voltage), .limit_duty_o(limit_duty)
  );

  logic signed [feltgate_pkg::CURRENT_ESTIMATE_W-1:0] current_estimate;
  logic gates_enable, gates_clear, period_start;
  supervisor u_supervisor (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .tick_i(tick), .period_start_i(period_start),
      .host_i(host), .host_arm_i(control[feltgate_map_pkg::B_CONTROL_ARM]), .arm_i(arm_i), .disarm_i(disarm),
      .arm_request_o(arm_request_o), .arms_o(arms), .ready_o(ready_o), .axis_silent_i(axis_silent_i), .axis_blocked_i(axis_blocked_i),
      .stop_i(stop_i),
      .clear_faults_i(clear_faults), .clear_o(clear), .kick_i(kick),
      .encoder_error_i(illegal),
      .velocity_i(velocity_o), .current_ref_i(current_ref_o),
      .wave_i(wave), .param_i(param), .product_i(supervisor_product),
      .trips_i((FaultsW'(self_test_trip) << feltgate_map_pkg::FAULT_SELF_TEST) |
               (FaultsW'(host_stop) << feltgate_map_pkg::FAULT_STOP) |
               (FaultsW'(word_error || flip_trip) << feltgate_map_pkg::FAULT_WORD) |
               (FaultsW'(channel_trip) << feltgate_map_pkg::FAULT_CHANNEL) | (FaultsW'(index_trip) << feltgate_map_pkg::FAULT_INDEX) |
               (FaultsW'(law && law_late_i && gates_enable) << feltgate_map_pkg::FAULT_ENGINE) |
               (FaultsW'(axis_fault_i && gates_enable) << feltgate_map_pkg::FAULT_AXIS) |
               (FaultsW'(velocity_jumped) << feltgate_map_pkg::FAULT_JUMP)),
      .current_estimate_o(current_estimate),
      .armed_o(armed_o), .unkicked_o(unkicked),
      .gates_enable_o(gates_enable), .gates_clear_o(gates_clear),
      .faults_o(faults_o), .first_fault_o(first_fault_o)
  );

  pwm #(.Period(feltgate_pkg::PWM_PERIOD), .DeadClocks(feltgate_pkg::DEAD_CLOCKS),
        .ShortestClocks(feltgate_pkg::SHORTEST_CLOCKS)) u_pwm (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .clear_i(gates_clear),
      .enable_i(gates_enable), .mode_i(control[feltgate_map_pkg::B_CONTROL_PWM_MODE]),
      .polarity_i(control[feltgate_map_pkg::B_CONTROL_MOTOR_POLARITY]),
      .duty_i(duty_o),
      .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
      .period_start_o(period_start),
      .duty_active_o(duty_active_o)
  );

  localparam int LimitsW = feltgate_map_pkg::W_STATUS_LIMITS;
  logic [31:0] status, faults;
  assign limits_o = (LimitsW'(limit_torque) << feltgate_map_pkg::L_TORQUE) | (LimitsW'(limit_ramp) << feltgate_map_pkg::L_RAMP) |
                    (LimitsW'(limit_current) << feltgate_map_pkg::L_CURRENT) | (LimitsW'(limit_voltage) << feltgate_map_pkg::L_VOLTAGE) |
                    (LimitsW'(limit_duty) << feltgate_map_pkg::L_DUTY) | (LimitsW'(velocity_saturated) << feltgate_map_pkg::L_VELOCITY) |
                    (LimitsW'(tau_hat_saturated) << feltgate_map_pkg::L_TAU_HAT) | (LimitsW'(!gates_enable) << feltgate_map_pkg::L_GATES_CLOSED) |
                    (LimitsW'(limit_hold) << feltgate_map_pkg::L_HOLD) | (LimitsW'(frozen) << feltgate_map_pkg::L_CHATTER);
  assign faults = (32'(faults_o) << feltgate_map_pkg::B_FAULTS_SEEN) |
                  (32'(first_fault_o) << feltgate_map_pkg::B_FAULTS_FIRST);
  assign status = (32'(limits_o) << feltgate_map_pkg::B_STATUS_LIMITS) |
                  (32'(scene_q) << feltgate_map_pkg::B_STATUS_SCENE) |
                  (32'(armed_o) << feltgate_map_pkg::B_STATUS_ARMED) |
                  (32'(mode) << feltgate_map_pkg::B_STATUS_MODE) |
                  (32'(test_result) << feltgate_map_pkg::B_STATUS_SELF_TEST) |
                  (32'(paused) << feltgate_map_pkg::B_STATUS_TESTING) |
                  (32'(encoder_error) << feltgate_map_pkg::B_STATUS_ENCODER_ERROR) |
                  (32'(refused) << feltgate_map_pkg::B_STATUS_REFUSED) | (32'(unkicked) << feltgate_map_pkg::B_STATUS_UNKICKED);
  snapshot #(.ReadBack(ReadBack)) u_snapshot (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .slot_fetch_i(slot_fetch),
      .wave_i(wave),
      .status_i(status), .faults_i(faults),
      .position_i(position_o),
      .tick_count_i(tick_count_o),
      .index_position_i(index_position),
      .error_count_i(error_count), .rejected_count_i(rejected_count),
      .operand_i(operand[31:0]),
      .valid_o(word_valid_o), .slot_o(word_slot_o), .data_o(word_data_o)
  );

  logic signed [feltgate_pkg::MULTIPLIER_A_BITS-1:0] dob_operand, scene_operand, control_operand, supervisor_operand;
  logic signed [feltgate_pkg::CURRENT_ESTIMATE_W-1:0] estimate_operand;
  logic signed_word, square_estimate;
  operand_bus u_operand_bus (
      .clk_i(clk_i),
      .wave_i(wave),
      .velocity_difference_i(velocity_difference),
      .observer_difference_i(observer_difference),
      .distance_i(distance),
      .limited_i(applied),
      .velocity_i(velocity_o),
      .tau_hat_i(tau_hat_o),
      .tau_ref_i(tau_ref_o),
      .current_ref_i(current_ref_o),
      .voltage_i(voltage_o),
      .current_estimate_i(current_estimate),
      .operand_o(operand),
      .dob_o(dob_operand), .scene_o(scene_operand),
      .control_o(control_operand), .supervisor_o(supervisor_operand),
      .signed_o(signed_word),
      .estimate_o(estimate_operand),
      .square_estimate_o(square_estimate)
  );

  logic square_q;
  always_ff @(posedge clk_i) square_q <= square && wave[feltgate_map_pkg::PARAM_AT_CHARGE_SQUARE-1];
  multipliers u_multipliers (
      .clk_i(clk_i),
      .operand_i(operand),
      .velocity_i(velocity_difference),
      .dob_i(dob_operand), .scene_i(scene_operand),
      .control_i(control_operand), .supervisor_i(supervisor_operand),
      .signed_i(signed_word),
      .param_i(param),
      .square_distance_i(square_q),
      .distance_i(distance[feltgate_pkg::SCENE_DISTANCE_F+:18]),
      .square_estimate_i(square_estimate),
      .estimate_i(estimate_operand),
      .velocity_product_o(velocity_product),
      .dob_product_o(dob_product),
      .scene_product_o(scene_product),
      .control_product_o(control_product),
      .supervisor_product_o(supervisor_product)
  );

  assign scene_o = scene_q;
  assign gates_enable_o = gates_enable;
  assign testing_o = testing;
  assign measured_o = wave[feltgate_map_pkg::EVENT_AT_TAU_HAT+1];
  assign snapshot_valid_o = wave[feltgate_map_pkg::EVENT_AT_SNAPSHOT];
endmodule

`default_nettype wire
