`default_nettype none
module old_wrap (
  input logic encoder_data_i, input logic [2:0] hall_i, input logic [1:0] current_data_i, input logic driver_fault_i,
  output logic encoder_select_no, encoder_clock_o, encoder_command_o, gate_c_hi_o, gate_c_lo_o, current_clock_o, heartbeat_o, period_start_o, output logic [31:0] current_o, output logic [31:0] bridge_current_o, output logic [15:0] why_o,
    input logic clk_i, rst_ni, enc_a_i, enc_b_i, enc_z_i, arm_i, stop_i, set_zero_i, input logic [3:0] scene_i,
    input logic [31:0] law_torque_i, input logic law_late_i, law_restart_i, input logic axis_fault_i, axis_silent_i, axis_blocked_i, axis_testing_i, axis_waits_i,
    input logic [11:0] reg_addr_i, input logic [31:0] reg_wdata_i, input logic reg_write_i, output logic reg_busy_o, output logic [31:0] reg_rdata_o,
    output logic gate_a_hi_o, gate_a_lo_o, gate_b_hi_o, gate_b_lo_o,
    output logic last_o, output logic [31:0] tick_count_o, position_o, velocity_o, tau_hat_o, tau_ref_o, current_ref_o, voltage_o, duty_o, duty_active_o, estimate_o,
    output logic [3:0] scene_o, output logic [11:0] limits_o, output logic [15:0] faults_o, output logic [4:0] first_fault_o, output logic armed_o, gates_enable_o, arm_request_o, ready_o, testing_o, output logic [14:0] control_o);
  import feltgate_pkg::*;
  logic signed [VELOCITY_W-1:0] v; logic signed [TORQUE_W-1:0] th, tr; logic signed [CURRENT_W-1:0] c; logic signed [VOLTAGE_W-1:0] vo; logic signed [DUTY_W-1:0] d, act;
  feltgate_core u (.clk_i(clk_i), .rst_ni(rst_ni), .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i), .encoder_data_i(encoder_data_i), .hall_i(hall_i), .encoder_select_no(encoder_select_no), .encoder_clock_o(encoder_clock_o), .encoder_command_o(encoder_command_o), .gate_c_hi_o(gate_c_hi_o), .gate_c_lo_o(gate_c_lo_o), .current_clock_o(current_clock_o), .heartbeat_o(heartbeat_o),
    .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o), .current_data_i(current_data_i[CURRENT_LOOP*(PHASES-2):0]), .driver_fault_i(driver_fault_i),
    .arm_i(arm_i), .stop_i(stop_i), .set_zero_i(set_zero_i), .scene_i(scene_i), .law_torque_i(law_torque_i[TORQUE_W-1:0]), .law_late_i(law_late_i), .law_restart_i(law_restart_i),
    .axis_fault_i(axis_fault_i), .axis_silent_i(axis_silent_i), .axis_blocked_i(axis_blocked_i), .axis_testing_i(axis_testing_i), .axis_waits_i(axis_waits_i),
    .arm_request_o(arm_request_o), .ready_o(ready_o), .testing_o(testing_o),
    .reg_addr_i(reg_addr_i), .reg_wdata_i(reg_wdata_i), .reg_write_i(reg_write_i), .reg_busy_o(reg_busy_o), .reg_rdata_o(reg_rdata_o), .snapshot_valid_o(last_o), .tick_count_o(tick_count_o),
    .position_o(position_o), .velocity_o(v), .tau_hat_o(th), .tau_ref_o(tr), .current_ref_o(c), .voltage_o(vo), .duty_o(d), .scene_o(scene_o),
    .limits_o(limits_o), .faults_o(faults_o), .first_fault_o(first_fault_o), .armed_o(armed_o), .duty_active_o(act), .gates_enable_o(gates_enable_o));
  assign velocity_o = 32'(v); assign tau_hat_o = 32'(th); assign tau_ref_o = 32'(tr); assign current_ref_o = 32'(c); assign voltage_o = 32'(vo); assign duty_o = 32'(d); assign duty_active_o = 32'(act);
  assign estimate_o = 32'(u.u_safety.current_estimate_o);
  assign control_o = u.u_wave.control_o;
  assign period_start_o = u.period_start; assign current_o = '0; assign bridge_current_o = CURRENT_LOOP ? 32'($signed(u.motor_current)) : 0; assign why_o = {3'b0, u.absolute_state, u.current_state};
endmodule
