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

  // Read data are left out until the host has read: a RAM that was never written holds X.
  logic compare_read;
  always @* begin
    shown = {word_valid, 1'b0, word_slot, word_data, b_lo, b_hi, a_lo, a_hi, busy, snapshot_valid, gates_enable, armed, tick_count,
             position, velocity, {{3{tau_hat[20]}}, tau_hat}, {{3{tau_ref[20]}}, tau_ref},
             {{2{current_ref[21]}}, current_ref}, voltage, {{3{duty[12]}}, duty},
             {{3{duty_active[12]}}, duty_active}, scene, limits, faults, {3'b000, first_fault},
             compare_read ? rdata : expected[31:0]};
  end

  integer file, got, clocks, mismatches;
  reg [8*200-1:0] path;
  initial begin
    if (!$value$plusargs("vectors=%s", path)) begin
      $display("usage: vvp core_tb.vvp +vectors=FILE");
      $finish;
    end
    file = $fopen(path, "r");
    compare_read = 1'b0;
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
