// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core behind its Wishbone slave: what a SoC instantiates. Documentation: docs/other-tools.md
`default_nettype none

module wishbone_core #(
  parameter int Pipelined = 0
) (
  input  logic        clk_i,
  input  logic        rst_ni,

  input  logic        enc_a_i,
  input  logic        enc_b_i,
  input  logic        enc_z_i,
  input  logic        stop_i,
  output logic [ 3:0] gates_o,  // of legs B and A: b_lo, b_hi, a_lo, a_hi
  output logic        armed_o,

  input  logic        cyc_i,
  input  logic        stb_i,
  input  logic        we_i,
  input  logic [11:0] adr_i,
  input  logic [ 3:0] sel_i,
  input  logic [31:0] dat_i,
  output logic [31:0] dat_o,
  output logic        ack_o,
  output logic        err_o,
  output logic        stall_o
);

  logic [11:0] reg_addr;
  logic [31:0] reg_wdata, reg_rdata;
  logic reg_write, reg_busy;

  wishbone_port #(.Pipelined(Pipelined)) u_port (
    .clk_i(clk_i), .rst_ni(rst_ni),
    .cyc_i(cyc_i), .stb_i(stb_i), .we_i(we_i), .adr_i(adr_i), .sel_i(sel_i), .dat_i(dat_i),
    .dat_o(dat_o), .ack_o(ack_o), .err_o(err_o), .stall_o(stall_o),
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
