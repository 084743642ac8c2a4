// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The default chip with ports that have the same widths in every design.

`default_nettype none

module lever_wrap (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        enc_a_i,
    input  logic        enc_b_i,
    input  logic        enc_z_i,
    input  logic        arm_i,
    input  logic        stop_i,
    input  logic        set_zero_i,
    input  logic [ 3:0] scene_i,
    input  logic [31:0] law_torque_i,
    input  logic        law_late_i,
    input  logic        law_restart_i,
    input  logic [ 4:0] peers_i,
    input  logic [11:0] reg_addr_i,
    input  logic [31:0] reg_wdata_i,
    input  logic        reg_write_i,
    output logic        reg_busy_o,
    output logic [31:0] reg_rdata_o,
    output logic [ 3:0] gates_o,
    output logic [15:0] clock_o,
    output logic [ 6:0] at_o,
    output logic [31:0] count_o,
    output logic [31:0] position_o,
    output logic [31:0] status_o,
    output logic [31:0] faults_o,
    output logic [31:0] encoder_o,
    output logic [31:0] index_o,
    output logic [31:0] tick_word_o,
    output logic [15:0] scene_limits_o,
    output logic [31:0] velocity_o,
    output logic [31:0] tau_hat_o,
    output logic [31:0] tau_ref_o,
    output logic [31:0] current_o,
    output logic [31:0] voltage_o,
    output logic [31:0] duty_o,
    output logic [ 9:0] safety_o,
    output logic [31:0] test_torque_o,
    output logic [22:0] latched_o,
    output logic [31:0] estimate_o,
    output logic [38:0] word_o,
    output logic [31:0] duty_active_o,
    output logic        zeroed_o
);
  cfg::tick_t t;
  cfg::snapshot_t s;
  cfg::safety_t f;
  logic signed [cfg::DUTY_W-1:0] duty_active;
  lever_top u_lever_top (
      .clk_i(clk_i), .rst_ni(rst_ni), .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i),
      .gate_a_hi_o(gates_o[0]), .gate_a_lo_o(gates_o[1]), .gate_b_hi_o(gates_o[2]), .gate_b_lo_o(gates_o[3]),
      .panel_i({arm_i, stop_i, set_zero_i, scene_i}),
      .law_i({law_torque_i[cfg::TORQUE_W-1:0], law_late_i, law_restart_i}), .peers_i(peers_i),
      .reg_addr_i(reg_addr_i), .reg_wdata_i(reg_wdata_i), .reg_write_i(reg_write_i), .reg_busy_o(reg_busy_o),
      .reg_rdata_o(reg_rdata_o), .tick_o(t), .snapshot_o(s), .safety_o(f), .word_o(word_o),
      .duty_active_o(duty_active), .zeroed_o(zeroed_o)
  );
  assign clock_o        = 16'(t.clock);
  assign at_o           = {t.sample, t.velocity, t.tau_hat, t.scene, t.tau_ref, t.duty, t.last};
  assign count_o        = t.count;
  assign position_o     = s.position;
  assign status_o       = s.status;
  assign faults_o       = s.faults;
  assign encoder_o      = s.encoder;
  assign index_o        = s.index;
  assign tick_word_o    = s.tick;
  assign scene_limits_o = {s.scene, s.limits};
  assign velocity_o     = 32'($signed(s.velocity));
  assign tau_hat_o      = 32'($signed(s.tau_hat));
  assign tau_ref_o      = 32'($signed(s.tau_ref));
  assign current_o      = 32'($signed(s.current));
  assign voltage_o      = 32'($signed(s.voltage));
  assign duty_o         = 32'($signed(s.duty));
  assign safety_o       = {f.armed, f.locks, f.gates_enable, f.gates_clear, f.clear, f.arm_request, f.ready, f.unkicked,
                           f.derated, f.testing};
  assign test_torque_o  = 32'($signed(f.test_torque));
  assign latched_o      = {f.test_result, f.faults, f.first_fault};
  assign estimate_o     = 32'($signed(f.current_estimate));
  assign duty_active_o  = 32'(duty_active);
endmodule

`default_nettype wire
