// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A second simulator's opinion: Icarus runs the core on the twin's vectors, four-valued, so that an
// X that reaches an output after reset differs from every number. Documentation: docs/testing.md

`timescale 1ns / 1ps
`default_nettype none

module core_tb;
  localparam int InputBits = 56;
  localparam int OutputBits = 340;

  logic clk = 1'b0;
  logic rst_n = 1'b1;
  logic [InputBits-1:0] inputs = '0;
  logic [OutputBits-1:0] expected, shown;

  wire [31:0] rdata, tick_count, word_data;
  wire [5:0] word_slot;
  wire word_valid;
  wire signed [31:0] position;
  wire signed [feltgate_pkg::VELOCITY_W-1:0] velocity;
  wire signed [feltgate_pkg::TORQUE_W-1:0] tau_hat, tau_ref;
  wire signed [feltgate_pkg::CURRENT_W-1:0] current_ref;
  wire signed [feltgate_pkg::VOLTAGE_W-1:0] voltage;
  wire signed [feltgate_pkg::DUTY_W-1:0] duty, duty_active;
  wire [3:0] scene;
  wire [4:0] first_fault;
  wire [11:0] limits;
  wire [15:0] faults;
  wire a_hi, a_lo, b_hi, b_lo, armed, gates_enable, snapshot_valid, busy;

  feltgate_core dut (
      .clk_i(clk),
      .rst_ni(rst_n),
      .enc_a_i(inputs[48]),
      .enc_b_i(inputs[49]),
      .enc_z_i(inputs[50]),
      .arm_i(inputs[51]),
      .stop_i(inputs[52]),
      .set_zero_i(inputs[53]),
      .reg_write_i(inputs[54]),
      .current_data_i(1'b0),
      .hall_i(3'b000),
      .driver_fault_i(1'b0),
      .encoder_data_i(1'b0),
      .law_torque_i('0),
      .law_late_i(1'b0),
      .law_restart_i(1'b0),
      .axis_fault_i(1'b0),
      .axis_silent_i(1'b0),
      .axis_blocked_i(1'b0),
      .axis_testing_i(1'b0),
      .axis_waits_i(1'b0),
      .scene_i(inputs[47:44]),
      .reg_addr_i(inputs[43:32]),
      .reg_wdata_i(inputs[31:0]),
      .gate_a_hi_o(a_hi),
      .gate_a_lo_o(a_lo),
      .gate_b_hi_o(b_hi),
      .gate_b_lo_o(b_lo),
      .reg_busy_o(busy),
      .reg_rdata_o(rdata),
      .snapshot_valid_o(snapshot_valid),
      .tick_count_o(tick_count),
      .position_o(position),
      .velocity_o(velocity),
      .tau_hat_o(tau_hat),
      .tau_ref_o(tau_ref),
      .current_ref_o(current_ref),
      .voltage_o(voltage),
      .duty_o(duty),
      .scene_o(scene),
      .limits_o(limits),
      .faults_o(faults),
      .first_fault_o(first_fault),
      .armed_o(armed),
      .duty_active_o(duty_active),
      .gates_enable_o(gates_enable),
      .word_valid_o(word_valid),
      .word_slot_o(word_slot),
      .word_data_o(word_data)
  );

  // Beside the core, for their drawings alone: the blocks that the core does not have, with any bits.
  wire sense_clock, sense_valid;
  wire signed [18:0] sense_current;
  reg [6:0] sense_bits = 7'd1;
  current_sense u_current_sense (
      .clk_i(clk),
      .rst_ni(rst_n),
      .modulator_clock_o(sense_clock),
      .data_i(sense_bits[0]),
      .strobe_i(clocks % 1000 == 0),
      .armed_i(armed),
      .clear_i(1'b0),
      .threshold_i(8'd200),
      .current_o(sense_current),
      .valid_o(sense_valid),
      .aligned_o(),
      .overcurrent_o(),
      .calibrated_o(),
      .offset_fault_o(),
      .stuck_o(),
      .saturated_o()
  );
  wire signed [18:0] resistive;
  current_control u_current_control (
      .clk_i(clk),
      .rst_ni(rst_n),
      .armed_i(1'b1),
      .valid_i(sense_valid),
      .reference_i({1'b0, sense_bits, 11'd0}),
      .current_i(sense_current),
      .emf_i(18'sd1000),
      .proportional_i(17'd11842),
      .integral_i(17'd12762),
      .limit_i(17'd124518),
      .voltage_o(),
      .valid_o(),
      .saturated_o(),
      .resistive_o(resistive)
  );

  // What the check compares is far apart, so each arming ends with a current that is missing.
  current_check u_current_check (
      .clk_i(clk),
      .rst_ni(rst_n),
      .armed_i(clocks % 2000 > 200),
      .valid_i(sense_valid),
      .resistive_i(resistive),
      .across_i(19'sd0),
      .current_i({{2{sense_current[18]}}, sense_current}),
      .resistance_i(17'd4588),
      .margin_i(17'd100),
      .missing_o()
  );
  absolute_encoder #(
      .HalfClocks(4),
      .GapClocks(4)
  ) u_absolute_encoder (
      .clk_i(clk),
      .rst_ni(rst_n),
      .sample_i(clocks % 1000 == 0),
      .select_no(),
      .serial_clock_o(),
      .command_o(),
      .data_i(sense_bits[0]),
      .position_o(),
      .valid_o(),
      .busy_o(),
      .faults_o()
  );
  wire [11:0] leg_b, leg_c;
  commutation u_commutation (
      .clk_i(clk),
      .rst_ni(rst_n),
      .sample_i(clocks % 1000 == 0),
      .position_i({25'd0, sense_bits}),
      .gain_i(32'h01234567),
      .offset_i(32'd0),
      .amplitude_i(13'sd700),
      .polarity_i(1'b0),
      .on_a_o(),
      .on_b_o(leg_b),
      .on_c_o(leg_c),
      .valid_o()
  );
  pwm_three_phase #(
      .Period(60),
      .DeadClocks(2)
  ) u_pwm_three_phase (
      .clk_i(clk),
      .rst_ni(rst_n),
      .clear_i(1'b0),
      .enable_i(clocks % 1000 > 200),
      .on_a_i(12'd30),
      .on_b_i({7'd0, leg_b[4:0]}),
      .on_c_i({7'd1, leg_c[4:0]}),
      .gate_a_hi_o(),
      .gate_a_lo_o(),
      .gate_b_hi_o(),
      .gate_b_lo_o(),
      .gate_c_hi_o(),
      .gate_c_lo_o(),
      .period_start_o()
  );
  field_oriented u_field_oriented (
      .clk_i(clk),
      .rst_ni(rst_n),
      .armed_i(1'b1),
      .valid_i(sense_valid),
      .direct_i(1'b0),
      .reference_i({1'b0, sense_bits, 11'd0}),
      .current_a_i(sense_current),
      .current_b_i(19'sd1000),
      .emf_i(18'sd1000),
      .position_i({25'd0, sense_bits}),
      .gain_i(32'h01234567),
      .offset_i(32'd0),
      .polarity_i(1'b0),
      .proportional_i(17'd11842),
      .integral_i(17'd12762),
      .limit_i(17'd124518),
      .current_q_o(),
      .open_o(),
      .saturated_o(),
      .on_a_o(),
      .on_b_o(),
      .on_c_o(),
      .valid_o()
  );
  always @(posedge sense_clock) sense_bits <= {sense_bits[5:0], sense_bits[6] ^ sense_bits[5]};

  // Read data are left out until the host has read: a RAM that was never written holds X.
  logic compare_read;
  always @* begin
    shown = {word_valid, 1'b0, word_slot, word_data, b_lo, b_hi, a_lo, a_hi, busy, snapshot_valid, gates_enable, armed, tick_count,
             position, velocity, {{3{tau_hat[20]}}, tau_hat}, {{3{tau_ref[20]}}, tau_ref},
             {{2{current_ref[21]}}, current_ref}, voltage, {{3{duty[12]}}, duty},
             {{3{duty_active[12]}}, duty_active}, scene, limits, faults, {3'b000, first_fault},
             compare_read ? rdata : expected[31:0]};
  end

  // With +vcd=FILE +first=CLOCK the tick after this clock is written as a VCD, for the drawings of the blocks' clocks.
  integer file, got, clocks, mismatches, first;
  reg [8*200-1:0] path, vcd;
  initial begin
    if (!$value$plusargs("vectors=%s", path)) begin
      $display("usage: vvp core_tb.vvp +vectors=FILE");
      $finish;
    end
    file = $fopen(path, "r");
    compare_read = 1'b0;
    if (!$value$plusargs("first=%d", first)) first = -1;
    if ($value$plusargs("vcd=%s", vcd)) $dumpfile(vcd);
    clocks = 0;
    mismatches = 0;
    #1 rst_n = 1'b0;
    repeat (4) begin
      #10 clk = 1'b1;
      #10 clk = 1'b0;
    end
    rst_n = 1'b1;
    got = $fscanf(file, "%h %h", inputs, expected);
    while (got == 2) begin
      if (clocks == first) $dumpvars(0, dut, u_absolute_encoder, u_current_sense, u_current_control, u_current_check, u_commutation, u_pwm_three_phase, u_field_oriented);
      if (clocks == first + 8000) $dumpoff;
      #9 inputs[52] = 1'b0;  // the stop was seen since the last edge, and is not after this one
      #1 clk = 1'b1;
      #1;
      if (shown !== expected) begin
        if (mismatches == 0) begin
          $display("first mismatch at clock %0d:\n shown    %h\n expected %h", clocks, shown, expected);
        end
        mismatches = mismatches + 1;
      end
      clocks = clocks + 1;
      #9 clk = 1'b0;
      got = $fscanf(file, "%h %h", inputs, expected);
    end
    $display("%0d clocks in Icarus, %0d mismatches", clocks, mismatches);
    $finish;
  end
endmodule

`default_nettype wire
