`default_nettype none
module new_wrap (
    input logic clk_i, rst_ni, enc_a_i, enc_b_i, enc_z_i, arm_i, stop_i, set_zero_i, input logic [3:0] scene_i,
    input logic [31:0] law_torque_i, input logic law_late_i, law_restart_i, input logic axis_fault_i, axis_silent_i, axis_blocked_i, axis_testing_i, axis_waits_i,
    input logic [11:0] reg_addr_i, input logic [31:0] reg_wdata_i, input logic reg_write_i, output logic reg_busy_o, output logic [31:0] reg_rdata_o,
    output logic gate_a_hi_o, gate_a_lo_o, gate_b_hi_o, gate_b_lo_o,
    output logic last_o, output logic [31:0] tick_count_o, position_o, velocity_o, tau_hat_o, tau_ref_o, current_ref_o, voltage_o, duty_o, duty_active_o, estimate_o,
    output logic [3:0] scene_o, output logic [11:0] limits_o, output logic [15:0] faults_o, output logic [4:0] first_fault_o, output logic armed_o, gates_enable_o, arm_request_o, ready_o, testing_o,
    output logic duty_valid_o, sample_o, output logic [14:0] control_o);
  assign control_o = u.u_axis.control;
  cfg::tick_t t; cfg::snapshot_t s; cfg::safety_t f; cfg::word_t w; logic z; logic signed [cfg::DUTY_W-1:0] act;
  lever_top u (.clk_i(clk_i), .rst_ni(rst_ni), .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i), .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
    .panel_i({arm_i, stop_i, set_zero_i, scene_i}), .law_i({law_torque_i[cfg::TORQUE_W-1:0], law_late_i, law_restart_i}), .peers_i({axis_fault_i, axis_silent_i, axis_blocked_i, axis_testing_i, axis_waits_i}),
    .reg_addr_i(reg_addr_i), .reg_wdata_i(reg_wdata_i), .reg_write_i(reg_write_i), .reg_busy_o(reg_busy_o), .reg_rdata_o(reg_rdata_o),
    .tick_o(t), .snapshot_o(s), .safety_o(f), .word_o(w), .duty_active_o(act), .zeroed_o(z));
  assign last_o = t.last; assign tick_count_o = t.count; assign position_o = s.position;
  assign velocity_o = 32'($signed(s.velocity)); assign tau_hat_o = 32'($signed(s.tau_hat)); assign tau_ref_o = 32'($signed(s.tau_ref));
  assign current_ref_o = 32'($signed(s.current)); assign voltage_o = 32'($signed(s.voltage)); assign duty_o = 32'($signed(s.duty)); assign duty_active_o = 32'(act);
  assign estimate_o = 32'($signed(f.current_estimate));
  assign scene_o = s.scene; assign limits_o = s.limits; assign faults_o = f.faults; assign first_fault_o = f.first_fault; assign armed_o = f.armed; assign gates_enable_o = f.gates_enable;
  assign arm_request_o = f.arm_request; assign ready_o = f.ready; assign testing_o = f.testing; assign duty_valid_o = t.duty; assign sample_o = t.sample;
endmodule
