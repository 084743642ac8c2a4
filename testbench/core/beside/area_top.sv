`default_nettype none
module area_top (input logic clk_i, rst_ni, enc_a_i, enc_b_i, enc_z_i, arm_i, stop_i, set_zero_i, input logic [3:0] scene_i, input logic [11:0] reg_addr_i, input logic [31:0] reg_wdata_i, input logic reg_write_i, output logic reg_busy_o,
  output logic gate_a_hi_o, gate_a_lo_o, gate_b_hi_o, gate_b_lo_o, output logic [15:0] faults_o, output logic armed_o, output logic [11:0] limits_o
`ifdef READ
  , output logic [31:0] reg_rdata_o
`endif
  );
`ifndef READ
  logic [31:0] reg_rdata_o;
`endif
  cfg::tick_t t; cfg::snapshot_t s; cfg::safety_t f; cfg::word_t w; logic z; logic signed [cfg::DUTY_W-1:0] act;
  lever_top u (.clk_i(clk_i), .rst_ni(rst_ni), .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i), .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
    .panel_i({arm_i, stop_i, set_zero_i, scene_i}), .law_i('0), .peers_i('0),
    .reg_addr_i(reg_addr_i), .reg_wdata_i(reg_wdata_i), .reg_write_i(reg_write_i), .reg_busy_o(reg_busy_o), .reg_rdata_o(reg_rdata_o),
    .tick_o(t), .snapshot_o(s), .safety_o(f), .word_o(w), .duty_active_o(act), .zeroed_o(z));
  assign faults_o = f.faults; assign armed_o = f.armed; assign limits_o = s.limits;
endmodule
