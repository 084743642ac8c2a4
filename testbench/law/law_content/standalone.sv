// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One axis whose law is there from power-up on, as a board without a host would have it.
`default_nettype none

module standalone (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               enc_a_i,
    input  logic               enc_b_i,
    input  logic               arm_i,
    input  logic        [ 3:0] scene_i,
    output logic               armed_o,
    output logic        [ 4:0] first_fault_o,
    output logic signed [31:0] position_o,
    output logic signed [cfg::TORQUE_W-1:0] tau_ref_o,
    output logic        [ 3:0] gates_o
);
  /* verilator lint_off PINCONNECTEMPTY */
  feltgate_axes #(
      .AxisCount(1),
      `include "law.svh"
  ) u_axes (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(1'b0),
      .gate_a_hi_o(gates_o[0]), .gate_a_lo_o(gates_o[1]), .gate_b_hi_o(gates_o[2]), .gate_b_lo_o(gates_o[3]),
      .arm_i(arm_i), .stop_i(1'b0), .set_zero_i(1'b0), .scene_i(scene_i),
      .law_torque_i({cfg::TORQUE_W{1'b0}}), .law_late_i(1'b0), .law_restart_i(1'b0),
      .measured_o(),
      .reg_addr_i(16'd0), .reg_wdata_i(32'd0), .reg_write_i(1'b0), .reg_read_i(1'b0), .reg_busy_o(), .reg_rdata_o(),
      .event_valid_o(), .event_number_o(), .event_value_o(),
      .snapshot_valid_o(), .last_o(), .tick_count_o(), .position_o(position_o), .velocity_o(), .tau_hat_o(),
      .tau_ref_o(tau_ref_o), .current_ref_o(), .voltage_o(), .duty_o(), .scene_o(), .limits_o(), .faults_o(),
      .first_fault_o(first_fault_o), .armed_o(armed_o), .duty_active_o(), .gates_enable_o(), .zeroed_o(),
      .word_valid_o(), .word_slot_o(), .word_data_o()
  );
  /* verilator lint_on PINCONNECTEMPTY */
endmodule

`default_nettype wire
