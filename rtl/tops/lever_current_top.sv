// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The lever with a loop of its measured current: a modulator at a shunt, the driver's fault, a heartbeat for a
// watchdog outside. docs/architecture.md

`default_nettype none

module lever_current_top #(
    parameter ParameterFile = ""
) (
    input  logic                  clk_i,
    input  logic                  rst_ni,
    input  logic                  enc_a_i,
    input  logic                  enc_b_i,
    input  logic                  enc_z_i,
    output logic                  gate_a_hi_o,
    output logic                  gate_a_lo_o,
    output logic                  gate_b_hi_o,
    output logic                  gate_b_lo_o,
    input  logic                  current_data_i,
    output logic                  current_clock_o,
    input  logic                  driver_fault_i,
    output logic                  heartbeat_o,
    input  cfg::panel_t           panel_i,
    input  cfg::law_t             law_i,
    input  cfg::peers_t           peers_i,
    input  logic           [11:0] reg_addr_i,
    input  logic           [31:0] reg_wdata_i,
    input  logic                  reg_write_i,
    output logic                  reg_busy_o,
    output logic           [31:0] reg_rdata_o,
    output cfg::tick_t            tick_o,
    output cfg::snapshot_t        snapshot_o,
    output cfg::safety_t          safety_o,
    output cfg::word_t            word_o,
    output logic signed [cfg::DUTY_W-1:0] duty_active_o,
    output logic                  zeroed_o
);
  cfg::encoder_t encoder;
  cfg::position_t position;
  cfg::drive_t drive;
  cfg::bridge_t bridge;
  cfg::params_t p;
  assign duty_active_o = bridge.duty_active;
  quadrature u_quadrature (
      .clk_i(clk_i), .rst_ni(rst_ni), .a_i(enc_a_i), .b_i(enc_b_i), .z_i(enc_z_i), .encoder_i(encoder), .position_o(position)
  );
  axis #(.ParameterFile(ParameterFile)) u_axis (
      .clk_i(clk_i), .rst_ni(rst_ni), .encoder_o(encoder), .position_i(position), .drive_o(drive), .bridge_i(bridge),
      .panel_i(panel_i), .law_i(law_i), .peers_i(peers_i), .reg_addr_i(reg_addr_i), .reg_wdata_i(reg_wdata_i),
      .reg_write_i(reg_write_i), .reg_busy_o(reg_busy_o), .reg_rdata_o(reg_rdata_o), .tick_o(tick_o),
      .snapshot_o(snapshot_o), .safety_o(safety_o), .word_o(word_o), .p_o(p), .zeroed_o(zeroed_o)
  );
  h_bridge_current u_h_bridge_current (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .current_data_i(current_data_i), .current_clock_o(current_clock_o),
      .driver_fault_i(driver_fault_i), .drive_i(drive), .bridge_o(bridge), .gate_a_hi_o(gate_a_hi_o),
      .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o)
  );
  heartbeat u_heartbeat (
      .clk_i(clk_i), .rst_ni(rst_ni), .tick_i(tick_o), .safety_i(safety_o), .heartbeat_o(heartbeat_o)
  );
endmodule

`default_nettype wire
