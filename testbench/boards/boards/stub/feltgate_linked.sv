// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Stands in for feltgate_linked in the test of a board's top level: shows on its outputs what reached
// its inputs. Its ports are those of rtl/link/feltgate_linked.sv. Documentation: docs/boards/de0_nano.md
`default_nettype none
`include "device.svh"

module feltgate_linked #(
  /* verilator lint_off UNUSEDPARAM */
  parameter int AxisCount = 1,
  parameter int Baud = 1000000,
  parameter int Board = 0,
  parameter ParameterFile = ""
  /* verilator lint_on UNUSEDPARAM */
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  `PINS(logic),
  input  logic        arm_i,
  input  logic        stop_i,
  input  logic        set_zero_i,
  input  logic        clear_faults_i,
  input  logic [3:0]  scene_i,
  input  logic        uart_rx_i,
  output logic        uart_tx_o,
  input  logic [7:0]  inputs_i,
  output logic signed [31:0] position_o,
  output logic [11:0] limits_o,
  output logic [15:0] faults_o,
  output logic [4:0]  first_fault_o,
  output logic [3:0]  scene_o,
  output logic        armed_o,
  output logic        gates_enable_o,
  output logic        snapshot_valid_o
);

  logic fault_q;

  logic a, b, z;
  assign {z, b, a} = `ENCODER_LINES;

  // A stop while armed is a fault until it is cleared by the panel, or by a host, for which the three
  // encoder lines at once stand. B and Z without A stand for a host that has armed, A and B without
  // Z for one that has the say and has not.
  logic clear, host_arm, host_say;
  assign clear = clear_faults_i || (a && b && z);
  assign host_arm = b && z && !a;
  assign host_say = a && b && !z;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) fault_q <= 1'b0;
    else fault_q <= (stop_i && (arm_i || host_arm)) || (fault_q && !clear);
  end

  assign gate_a_hi_o = a;
  assign gate_a_lo_o = b;
  assign gate_b_hi_o = z;
  assign gate_b_lo_o = scene_i == 4'd14;
`ifdef FELTGATE_GIMBAL_CURRENT
  // Each output of the options shows an input of theirs.
  assign {gate_c_hi_o, gate_c_lo_o} = current_data_i;
  assign encoder_select_no = !encoder_data_i;
  assign encoder_clock_o   = encoder_data_i;
  assign encoder_command_o = encoder_data_i;
  assign current_clock_o   = ^current_data_i;
  assign heartbeat_o       = driver_fault_i;
`endif
  assign uart_tx_o   = ^{inputs_i, uart_rx_i};
  assign faults_o    = {10'd0, fault_q, 5'd0};
  assign armed_o     = (arm_i || host_arm) && !host_say && !fault_q;
  assign limits_o    = {4'd0, !armed_o, 3'd0, set_zero_i, 3'd0};

  assign position_o  = {20'd0, {3{z}}, 7'd0, b, a ^ b};

  assign {first_fault_o, scene_o, gates_enable_o, snapshot_valid_o} = '0;
endmodule

`default_nettype wire
