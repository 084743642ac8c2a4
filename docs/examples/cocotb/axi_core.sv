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

  // The host alone arms and chooses: the panel is at rest but for the stop.
  cfg::panel_t panel;
  cfg::safety_t safe;
  assign panel   = {1'b0, stop_i, 1'b0, 4'd0};
  assign armed_o = safe.armed;
  /* verilator lint_off PINCONNECTEMPTY */
  lever_top u_device (
    .clk_i(clk_i), .rst_ni(rst_ni),
    .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i),
    .gate_a_hi_o(gates_o[0]), .gate_a_lo_o(gates_o[1]), .gate_b_hi_o(gates_o[2]), .gate_b_lo_o(gates_o[3]),
    .panel_i(panel), .law_i({(cfg::TORQUE_W + 2){1'b0}}), .peers_i(5'd0),
    .reg_addr_i(reg_addr), .reg_wdata_i(reg_wdata), .reg_write_i(reg_write),
    .reg_busy_o(reg_busy), .reg_rdata_o(reg_rdata),
    .tick_o(), .snapshot_o(), .safety_o(safe), .word_o(), .duty_active_o(), .zeroed_o()
  );
  /* verilator lint_on PINCONNECTEMPTY */

endmodule

`default_nettype wire
