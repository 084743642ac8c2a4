// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The whole core: encoder pins to gate pins. Once per tick a wave runs through quad_decoder,
// velocity_n, dob, scenes and torque_control. They share one parameter bus and, unless each has its
// own, one multiplier, by clocks of the wave. Sampled position (clock 0) to duty: 46 clocks.
// docs/blocks/feltgate_core.md, docs/architecture.md

`default_nettype none

module feltgate_core #(
    parameter int ReadBack = 1,  // 0: no snapshot RAM, the host can only write
    parameter int Defect   = 0   // 1: tau_hat of the tick before, 2: scene operand late, 3: gates open on a fault
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

    // Panel, used while the control word does not say that the host has the say
    input  logic       arm_i,       // level; its rising edge arms
    input  logic       stop_i,      // external stop, asynchronous, latched as a fault
    input  logic       set_zero_i,  // one clock: position := 0 at the end of the tick
    input  logic [3:0] scene_i,

    // Register port
    input  logic [11:0] reg_addr_i,
    input  logic [31:0] reg_wdata_i,
    input  logic        reg_write_i,
    output logic        reg_busy_o,
    output logic [31:0] reg_rdata_o,

    // Snapshot: all of one tick in the clock in which snapshot_valid_o is high
    output logic                                         snapshot_valid_o,
    output logic        [                          31:0] tick_count_o,
    output logic signed [                          31:0] position_o,
    output logic signed [  feltgate_pkg::VELOCITY_W-1:0] velocity_o,
    output logic signed [    feltgate_pkg::TORQUE_W-1:0] tau_hat_o,
    output logic signed [    feltgate_pkg::TORQUE_W-1:0] tau_ref_o,
    output logic signed [   feltgate_pkg::CURRENT_W-1:0] current_ref_o,
    output logic signed [   feltgate_pkg::VOLTAGE_W-1:0] voltage_o,
    output logic signed [      feltgate_pkg::DUTY_W-1:0] duty_o,
    output logic        [                           3:0] scene_o,
    output logic        [                           7:0] limits_o,
    output logic        [                           7:0] faults_o,
    output logic        [                           3:0] first_fault_o,
    output logic                                         armed_o,
    output logic signed [      feltgate_pkg::DUTY_W-1:0] duty_active_o,   // in force in the bridge
    output logic                                         gates_enable_o
);
  localparam int OperandW = feltgate_pkg::MULTIPLIER_A_BITS;
  localparam int ProductW = feltgate_pkg::PRODUCT_BITS;
  localparam int SceneW = feltgate_pkg::SCENE_POSITION_W;
  feltgate_checks u_checks ();
  // The wave and its two buses.
  logic                       tick;
  logic [                5:0] slot_fetch;
  logic                       scene_slot_fetch;
  logic [               49:0] wave;
  logic [               31:0] param;
  logic signed [OperandW-1:0] operand;
  logic                       snap_valid;
  logic signed [ProductW-1:0] velocity_product, dob_product, scene_product, control_product;
  logic signed [ProductW-1:0] supervisor_product;  // all the same where one multiplier is shared

  // What the registers and the panel ask for.
  logic [14:0] control;
  logic [ 3:0] scene_wanted;
  logic [ 1:0] mode;
  logic host, arm_request, set_zero, zero_pending_q, host_zero, clear_faults, kick, region_high;
  logic [3:0] scene_q;
  assign host         = control[feltgate_pkg::B_CONTROL_HOST];
  assign mode         = control[feltgate_pkg::B_CONTROL_MODE+:2];
  assign arm_request  = host ? control[feltgate_pkg::B_CONTROL_ARM] : arm_i;
  assign scene_wanted = host ? control[feltgate_pkg::B_CONTROL_SCENE+:4] : scene_i;
  assign set_zero     = tick && (host_zero || zero_pending_q);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      scene_q        <= '0;
      zero_pending_q <= 1'b0;
    end else begin
      if (tick) scene_q <= scene_wanted;
      zero_pending_q <= set_zero_i || (zero_pending_q && !tick);
    end
  end

  sequencer u_sequencer (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .tick_o(tick),
      .slot_fetch_o(slot_fetch),
      .scene_slot_fetch_o(scene_slot_fetch),
      .wave_o(wave),
      .tick_count_o(tick_count_o)
  );

  registers #(
      .ReadBack(ReadBack)
  ) u_registers (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .tick_i(tick),
      .reg_addr_i(reg_addr_i),
      .reg_wdata_i(reg_wdata_i),
      .reg_write_i(reg_write_i),
      .reg_rdata_o(reg_rdata_o),
      .reg_busy_o(reg_busy_o),
      .slot_fetch_i(slot_fetch),
      .scene_slot_fetch_i(scene_slot_fetch),
      .scene_i(scene_q),
      .region_high_i(region_high),
      .param_o(param),
      .control_o(control),
      .set_zero_o(host_zero),
      .clear_faults_o(clear_faults),
      .kick_o(kick),
      .snap_slot_i(slot_fetch - 6'd2),
      .snap_valid_i(snap_valid),
      .snap_data_i(operand[31:0])
  );

  // Encoder to position; the sample that the wave carries.
  logic signed [31:0] position, index_position;
  logic signed [feltgate_pkg::TRAVEL_BITS-1:0] travel;
  logic [15:0] error_count, rejected_count;
  logic encoder_error, illegal, unused_index_seen;
  logic signed [1:0] unused_step;
  quad_decoder u_quad_decoder (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .a_i(enc_a_i),
      .b_i(enc_b_i),
      .z_i(enc_z_i),
      .filter_i(control[feltgate_pkg::B_CONTROL_FILTER+:4]),
      .polarity_i(control[feltgate_pkg::B_CONTROL_ENCODER_POLARITY]),
      .set_zero_i(set_zero),
      .clear_error_i(clear_faults),
      .position_o(position),
      .travel_o(travel),
      .step_o(unused_step),
      .illegal_o(illegal),
      .error_o(encoder_error),
      .error_count_o(error_count),
      .rejected_count_o(rejected_count),
      .index_position_o(index_position),
      .index_seen_o(unused_index_seen)
  );

  logic signed [SceneW-1:0] scene_position_q;
  logic position_over;
  assign position_over = position[31:SceneW-1] != {(33 - SceneW) {position[31]}};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      position_o       <= '0;
      scene_position_q <= '0;
    end else if (wave[0]) begin
      position_o       <= position;
      scene_position_q <= position_over ? {position[31], {(SceneW - 1) {~position[31]}}}
                                        : position[SceneW-1:0];
    end
  end

  logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] velocity_operand;
  logic velocity_saturated;
  velocity_n u_velocity_n (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .wave_i(wave),
      .travel_i(travel),
      .operand_o(velocity_operand),
      .product_i(velocity_product),
      .velocity_o(velocity_o),
      .saturated_o(velocity_saturated)
  );

  logic signed [feltgate_pkg::OBSERVER_DIFFERENCE_W-1:0] dob_operand;
  logic signed [feltgate_pkg::TORQUE_W-1:0] tau_hat;
  logic tau_hat_saturated;
  dob u_dob (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .armed_i(armed_o),
      .wave_i(wave),
      .product_i(dob_product),
      .operand_o(dob_operand),
      .tau_hat_o(tau_hat),
      .saturated_o(tau_hat_saturated)
  );
  assign tau_hat_o = tau_hat;

  logic signed [feltgate_pkg::SCENE_OFFSET_W-1:0] scene_operand;
  logic scene_square, limit_torque, limit_ramp;
  scenes u_scenes (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .armed_i(armed_o),
      .scene_i(scene_q),
      .start_i(wave[1]),
      .position_i(scene_position_q),
      .param_i(param),
      .product_i(scene_product),
      .operand_o(scene_operand),
      .square_o(scene_square),
      .tau_ref_o(tau_ref_o),
      .limit_torque_o(limit_torque),
      .limit_ramp_o(limit_ramp)
  );

  logic signed [feltgate_pkg::CURRENT_W-1:0] control_operand;
  logic limit_current, limit_voltage, limit_duty;
  torque_control u_torque_control (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .armed_i(armed_o),
      .mode_i(mode),
      .wave_i(wave),
      .param_i(param),
      .product_i(control_product),
      .tau_ref_i(tau_ref_o),
      .region_high_o(region_high),
      .operand_o(control_operand),
      .current_ref_o(current_ref_o),
      .voltage_o(voltage_o),
      .duty_o(duty_o),
      .limit_current_o(limit_current),
      .limit_voltage_o(limit_voltage),
      .limit_duty_o(limit_duty)
  );

  logic signed [feltgate_pkg::CURRENT_ESTIMATE_W-1:0] current_estimate;
  logic gates_enable, unused_period_start;
  supervisor u_supervisor (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .tick_i(tick),
      .arm_i(arm_request),
      .stop_i(stop_i),
      .clear_faults_i(clear_faults),
      .kick_i(kick),
      .encoder_error_i(illegal),
      .velocity_i(velocity_o),
      .current_ref_i(current_ref_o),
      .wave_i(wave),
      .param_i(param),
      .product_i(supervisor_product),
      .current_estimate_o(current_estimate),
      .armed_o(armed_o),
      .gates_enable_o(gates_enable),
      .faults_o(faults_o),
      .first_fault_o(first_fault_o)
  );

  pwm #(
      .Period(feltgate_pkg::PWM_PERIOD),
      .DeadClocks(feltgate_pkg::DEAD_CLOCKS)
  ) u_pwm (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .enable_i((Defect == 3) ? armed_o : gates_enable),
      .mode_i(control[feltgate_pkg::B_CONTROL_PWM_MODE]),
      .polarity_i(control[feltgate_pkg::B_CONTROL_MOTOR_POLARITY]),
      .duty_i(duty_o),
      .gate_a_hi_o(gate_a_hi_o),
      .gate_a_lo_o(gate_a_lo_o),
      .gate_b_hi_o(gate_b_hi_o),
      .gate_b_lo_o(gate_b_lo_o),
      .period_start_o(unused_period_start),
      .duty_active_o(duty_active_o)
  );

  // Operand bus: who holds the wave drives it. Between the products pass the snapshot's words.
  logic [31:0] status;
  assign status = {4'd0, encoder_error, mode, armed_o, scene_q, limits_o, first_fault_o, faults_o};
  logic signed [feltgate_pkg::TORQUE_W-1:0] tau_hat_bus;
  if (Defect == 1) begin : gen_stale
    logic signed [feltgate_pkg::TORQUE_W-1:0] stale_q;
    always_ff @(posedge clk_i) if (wave[0]) stale_q <= tau_hat;
    assign tau_hat_bus = stale_q;
  end else begin : gen_fresh
    assign tau_hat_bus = tau_hat;
  end
  // Selects are registered one clock ahead. Words that are narrow share one sign extension.
  logic take_velocity_q, take_velocity_operand_q, take_scene_q, take_square_q, take_voltage_q;
  logic take_control_q, take_current_q, take_estimate_q, take_dob_q, take_tau_hat_q, take_tau_ref_q;
  logic take_tick_q, take_position_q, take_status_q, take_index_q, take_errors_q, take_duty_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {take_velocity_q, take_velocity_operand_q, take_scene_q, take_square_q, take_voltage_q,
       take_control_q, take_current_q, take_estimate_q, take_dob_q, take_tau_hat_q,
       take_tau_ref_q, take_tick_q, take_position_q, take_status_q, take_index_q, take_errors_q,
       take_duty_q} <= '0;
    end else begin
      take_velocity_q         <= wave[6] || wave[8] || wave[9] || wave[21];
      take_velocity_operand_q <= wave[3];
      take_scene_q            <= (wave[2] && !(scene_square && Defect != 2)) || wave[5];
      take_square_q           <= wave[2] && scene_square;
      take_voltage_q          <= wave[4] || wave[26];
      take_control_q          <= wave[39];
      take_current_q          <= wave[7] || wave[33];
      take_estimate_q         <= wave[12];
      take_dob_q              <= wave[14];
      take_tau_hat_q          <= wave[22];
      take_tau_ref_q          <= wave[27] || wave[28];
      take_tick_q             <= ReadBack != 0 && slot_fetch == 6'd1;  // before wave clock 0
      take_position_q         <= ReadBack != 0 && wave[0];
      take_status_q           <= ReadBack != 0 && wave[1];
      take_index_q            <= ReadBack != 0 && wave[10];
      take_errors_q           <= ReadBack != 0 && wave[13];
      take_duty_q             <= ReadBack != 0 && wave[45];
    end
  end

  localparam int NarrowW = feltgate_pkg::NARROW_W;  // holds each of these
  logic signed [NarrowW-1:0] narrow;
  assign narrow =
      ({NarrowW{take_square_q && Defect != 2}} &
       NarrowW'(scene_operand >>> feltgate_pkg::SCENE_OFFSET_F)) |
      ({NarrowW{take_voltage_q}} & NarrowW'(voltage_o)) |
      ({NarrowW{take_control_q}} & NarrowW'(control_operand)) |
      ({NarrowW{take_current_q}} & NarrowW'(current_ref_o)) |
      ({NarrowW{take_estimate_q}} & NarrowW'(current_estimate)) |
      ({NarrowW{take_tau_hat_q}} & NarrowW'(tau_hat_bus)) |
      ({NarrowW{take_tau_ref_q}} & NarrowW'(tau_ref_o)) |
      ({NarrowW{take_duty_q}} & NarrowW'(duty_o));
  assign operand =
      OperandW'(narrow) |
      ({OperandW{take_velocity_q}} & OperandW'(velocity_o)) |
      ({OperandW{take_velocity_operand_q}} & OperandW'(velocity_operand)) |
      ({OperandW{take_scene_q}} & OperandW'(scene_operand)) |
      ({OperandW{take_dob_q}} & OperandW'(dob_operand)) |
      ({OperandW{take_tick_q}} & OperandW'($signed(tick_count_o))) |
      ({OperandW{take_position_q}} & OperandW'(position_o)) |
      ({OperandW{take_status_q}} & OperandW'($signed(status))) |
      ({OperandW{take_index_q}} & OperandW'(index_position)) |
      ({OperandW{take_errors_q}} & OperandW'($signed({rejected_count, error_count})));

  // A coefficient has no sign but in slot 23.
  logic signed [17:0] coefficient;
  assign coefficient = 18'($signed({param[feltgate_pkg::COEFFICIENT_BITS] && take_tau_hat_q,
                                    param[feltgate_pkg::COEFFICIENT_BITS-1:0]}));
  // A square takes its own operand as the factor, past the operand bus.
  logic signed [17:0] scene_factor, supervisor_factor, plain_factor;
  assign scene_factor = {18{take_square_q}} & scene_operand[feltgate_pkg::SCENE_OFFSET_F+:18];
  assign supervisor_factor = {18{take_estimate_q}} & 18'(current_estimate);
  assign plain_factor = {18{!take_square_q && !take_estimate_q}} & coefficient;
  if (feltgate_pkg::PARALLEL_MULTIPLIERS == 0) begin : gen_shared
    logic signed [ProductW-1:0] product;
    mult u_mult (.clk_i(clk_i), .a_i(operand),
                 .b_i(scene_factor | supervisor_factor | plain_factor), .product_o(product));
    assign {velocity_product, dob_product, scene_product, control_product, supervisor_product} =
        {5{product}};
  end else begin : gen_parallel
    // Each block its own, in the same clocks: no operand passes through a mux of the whole core.
    wire unused = ^operand[OperandW-1:32];  // the bus remains for the snapshot
    logic signed [OperandW-1:0] of_dob, of_scene, of_torque, of_supervisor;
    assign of_dob = take_velocity_q ? OperandW'(velocity_o) :
                    take_current_q  ? OperandW'(current_ref_o) : OperandW'(dob_operand);
    assign of_scene = take_velocity_q ? OperandW'(velocity_o) :
                      take_square_q   ? OperandW'(scene_factor) : OperandW'(scene_operand);
    logic signed [NarrowW-1:0] control_narrow, supervisor_narrow;
    assign control_narrow = ({NarrowW{take_tau_hat_q}} & NarrowW'(tau_hat_bus)) |
                            ({NarrowW{take_voltage_q}} & NarrowW'(voltage_o)) |
                            ({NarrowW{take_tau_ref_q}} & NarrowW'(tau_ref_o)) |
                            ({NarrowW{take_current_q}} & NarrowW'(current_ref_o)) |
                            ({NarrowW{take_control_q}} & NarrowW'(control_operand));
    assign of_torque = take_velocity_q ? OperandW'(velocity_o) : OperandW'(control_narrow);
    assign supervisor_narrow = take_estimate_q ? NarrowW'(current_estimate) : NarrowW'(voltage_o);
    assign of_supervisor = take_velocity_q ? OperandW'(velocity_o) : OperandW'(supervisor_narrow);
    mult u_velocity (.clk_i(clk_i), .a_i(OperandW'(velocity_operand)), .b_i(coefficient),
                     .product_o(velocity_product));
    mult u_dob (.clk_i(clk_i), .a_i(of_dob), .b_i(coefficient), .product_o(dob_product));
    mult u_scene (.clk_i(clk_i), .a_i(of_scene), .b_i(scene_factor | plain_factor),
                  .product_o(scene_product));
    mult u_control (.clk_i(clk_i), .a_i(of_torque), .b_i(coefficient), .product_o(control_product));
    mult u_supervisor (.clk_i(clk_i), .a_i(of_supervisor), .b_i(supervisor_factor | plain_factor),
                       .product_o(supervisor_product));
  end

  assign snap_valid =
      wave[feltgate_pkg::R_TICK] || wave[feltgate_pkg::R_POSITION] || wave[feltgate_pkg::R_STATUS] ||
      wave[feltgate_pkg::R_ENCODER] || wave[feltgate_pkg::R_INDEX] ||
      wave[feltgate_pkg::R_VELOCITY] || wave[feltgate_pkg::R_TAU_HAT] ||
      wave[feltgate_pkg::R_TAU_REF] || wave[feltgate_pkg::R_CURRENT_REF] ||
      wave[feltgate_pkg::R_VOLTAGE] || wave[feltgate_pkg::R_DUTY];

  assign scene_o          = scene_q;
  assign gates_enable_o   = gates_enable;
  assign snapshot_valid_o = wave[47];
  assign limits_o = {!gates_enable, tau_hat_saturated, velocity_saturated, limit_duty,
                     limit_voltage, limit_current, limit_ramp, limit_torque};
endmodule

`default_nettype wire
