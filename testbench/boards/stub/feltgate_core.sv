// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Stands in for feltgate_core in the test of a board's top level: shows on its outputs what reached
// its inputs. Its ports are those of rtl/feltgate_core.sv. Documentation: docs/boards/de0_nano.md
`default_nettype none

module feltgate_core #(
  parameter int ReadBack = 1,
  /* verilator lint_off UNUSEDPARAM */
  parameter ParameterFile = ""
  /* verilator lint_on UNUSEDPARAM */
) (
  input  logic        clk_i,
  input  logic        rst_ni,
  input  logic        enc_a_i,
  input  logic        enc_b_i,
  input  logic        enc_z_i,
  output logic        gate_a_hi_o,
  output logic        gate_a_lo_o,
  output logic        gate_b_hi_o,
  output logic        gate_b_lo_o,
  input  logic        arm_i,
  input  logic        stop_i,
  input  logic        set_zero_i,
  input  logic [3:0]  scene_i,
  input  logic [11:0] reg_addr_i,
  input  logic [31:0] reg_wdata_i,
  input  logic        reg_write_i,
  output logic        reg_busy_o,
  output logic [31:0] reg_rdata_o,
  output logic        snapshot_valid_o,
  output logic [31:0] tick_count_o,
  output logic [31:0] position_o,
  output logic        velocity_o,  // widths of the design's formats do not matter here
  output logic        tau_hat_o,
  output logic        tau_ref_o,
  output logic        current_ref_o,
  output logic        voltage_o,
  output logic        duty_o,
  output logic        duty_active_o,
  output logic        gates_enable_o,
  output logic [3:0]  scene_o,
  output logic [11:0] limits_o,
  output logic [15:0] faults_o,
  output logic [4:0]  first_fault_o,
  output logic        armed_o,
  output logic        word_valid_o,
  output logic [5:0]  word_slot_o,
  output logic [31:0] word_data_o
);

  logic fault_q;

  // A stop while armed is a fault until it is cleared on the register port, or by a host, for which the three
  // encoder lines at once stand. B and Z without A stand for a host that has armed.
  logic clear, host_arm;
  assign clear = (reg_write_i && reg_addr_i == 12'h201 && reg_wdata_i == 32'd2) || (enc_a_i && enc_b_i && enc_z_i);
  assign host_arm = enc_b_i && enc_z_i && !enc_a_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) fault_q <= 1'b0;
    else fault_q <= (stop_i && (arm_i || host_arm)) || (fault_q && !clear);
  end

  assign gate_a_hi_o = enc_a_i;
  assign gate_a_lo_o = enc_b_i;
  assign gate_b_hi_o = enc_z_i;
  assign gate_b_lo_o = scene_i == 4'd14;
  assign reg_busy_o  = ReadBack != 0;
  assign reg_rdata_o = {19'd0, reg_write_i, reg_addr_i} ^ reg_wdata_i;
  assign faults_o    = {10'd0, fault_q, 5'd0};
  assign armed_o     = (arm_i || host_arm) && !fault_q;
  assign limits_o    = {4'd0, !armed_o, 3'd0, set_zero_i, 3'd0};

  assign position_o  = {20'd0, {3{enc_z_i}}, 7'd0, enc_b_i, enc_a_i ^ enc_b_i};

  assign {snapshot_valid_o, tick_count_o, velocity_o, tau_hat_o, tau_ref_o} = '0;
  assign {current_ref_o, voltage_o, duty_o, duty_active_o, gates_enable_o, scene_o, first_fault_o} = '0;
  assign {word_valid_o, word_slot_o, word_data_o} = '0;
endmodule

`default_nettype wire
