// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core behind its AXI4-Lite slave. Documentation: docs/other-tools.md
`default_nettype none

module axi_core (
  input  logic        clk_i,
  input  logic        rst_ni,

  input  logic        enc_a_i,
  input  logic        enc_b_i,
  input  logic        enc_z_i,
  input  logic        stop_i,
  output logic [ 3:0] gates_o,  // of legs B and A: b_lo, b_hi, a_lo, a_hi
  output logic        armed_o,

  input  logic        awvalid_i,
  output logic        awready_o,
  input  logic [13:0] awaddr_i,
  input  logic        wvalid_i,
  output logic        wready_o,
  input  logic [31:0] wdata_i,
  input  logic [ 3:0] wstrb_i,
  output logic        bvalid_o,
  input  logic        bready_i,
  output logic [ 1:0] bresp_o,
  input  logic        arvalid_i,
  output logic        arready_o,
  input  logic [13:0] araddr_i,
  output logic        rvalid_o,
  input  logic        rready_i,
  output logic [31:0] rdata_o,
  output logic [ 1:0] rresp_o
);

  logic [11:0] reg_addr;
  logic [31:0] reg_wdata, reg_rdata;
  logic reg_write, reg_busy;

  axi_lite_port u_port (
    .clk_i(clk_i), .rst_ni(rst_ni),
    .awvalid_i(awvalid_i), .awready_o(awready_o), .awaddr_i(awaddr_i),
    .wvalid_i(wvalid_i), .wready_o(wready_o), .wdata_i(wdata_i), .wstrb_i(wstrb_i),
    .bvalid_o(bvalid_o), .bready_i(bready_i), .bresp_o(bresp_o),
    .arvalid_i(arvalid_i), .arready_o(arready_o), .araddr_i(araddr_i),
    .rvalid_o(rvalid_o), .rready_i(rready_i), .rdata_o(rdata_o), .rresp_o(rresp_o),
    .reg_addr_o(reg_addr), .reg_wdata_o(reg_wdata), .reg_write_o(reg_write),
    .reg_rdata_i(reg_rdata), .reg_busy_i(reg_busy)
  );

  // The host alone arms and chooses: the panel's inputs are at rest.
  /* verilator lint_off PINCONNECTEMPTY */
  feltgate_core u_core (
    .clk_i(clk_i), .rst_ni(rst_ni),
    .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i),
    .gate_a_hi_o(gates_o[0]), .gate_a_lo_o(gates_o[1]), .gate_b_hi_o(gates_o[2]), .gate_b_lo_o(gates_o[3]),
    // For a design without their options; one that has them needs these pins as ports of this module.
    .gate_c_hi_o(), .gate_c_lo_o(), .hall_i(3'b000),
    .encoder_data_i(1'b0), .encoder_select_no(), .encoder_clock_o(), .encoder_command_o(),
    .current_data_i(1'b0), .current_clock_o(), .current_o(), .driver_fault_i(1'b0), .heartbeat_o(),
    .arm_i(1'b0), .stop_i(stop_i), .set_zero_i(1'b0), .scene_i(4'd0),
    .law_torque_i({feltgate_pkg::TORQUE_W{1'b0}}), .law_late_i(1'b0), .law_restart_i(1'b0),
    .axis_fault_i(1'b0), .axis_silent_i(1'b0), .axis_blocked_i(1'b0), .axis_testing_i(1'b0), .axis_waits_i(1'b0),
    .arm_request_o(), .ready_o(), .testing_o(), .measured_o(), .zeroed_o(),
    .reg_addr_i(reg_addr), .reg_wdata_i(reg_wdata), .reg_write_i(reg_write),
    .reg_busy_o(reg_busy), .reg_rdata_o(reg_rdata),
    .snapshot_valid_o(), .tick_count_o(), .position_o(), .velocity_o(), .tau_hat_o(), .tau_ref_o(),
    .current_ref_o(), .voltage_o(), .duty_o(), .scene_o(), .limits_o(), .faults_o(), .first_fault_o(),
    .armed_o(armed_o), .duty_active_o(), .gates_enable_o(),
    .word_valid_o(), .word_slot_o(), .word_data_o()
  );
  /* verilator lint_on PINCONNECTEMPTY */

endmodule

`default_nettype wire
