// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked with the core's ports beside its own, for a simulated board that says what each tick showed.
// Documentation: docs/board.md
`default_nettype none

module board_pins (
    input  logic       clk_i,
    input  logic       rst_ni,
    input  logic       enc_a_i,
    input  logic       enc_b_i,
    input  logic       enc_z_i,
    input  logic       arm_i,
    input  logic       stop_i,
    input  logic       set_zero_i,
    input  logic [3:0] scene_i,
    input  logic       uart_rx_i,
    input  logic [7:0] inputs_i,
    output logic       uart_tx_o,

    output logic gate_a_hi_o,
    output logic gate_a_lo_o,
    output logic gate_b_hi_o,
    output logic gate_b_lo_o,
    output logic        reg_busy_o,
    output logic [31:0] reg_rdata_o,
    output logic        snapshot_valid_o,
    output logic        [31:0] tick_count_o,
    output logic signed [31:0] position_o,
    output logic signed [ feltgate_pkg::VELOCITY_W-1:0] velocity_o,
    output logic signed [   feltgate_pkg::TORQUE_W-1:0] tau_hat_o,
    output logic signed [   feltgate_pkg::TORQUE_W-1:0] tau_ref_o,
    output logic signed [  feltgate_pkg::CURRENT_W-1:0] current_ref_o,
    output logic signed [  feltgate_pkg::VOLTAGE_W-1:0] voltage_o,
    output logic signed [     feltgate_pkg::DUTY_W-1:0] duty_o,
    output logic signed [     feltgate_pkg::DUTY_W-1:0] duty_active_o,
    output logic [ 3:0] scene_o,
    output logic [feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits_o,
    output logic [feltgate_map_pkg::W_FAULTS_SEEN-1:0]   faults_o,
    output logic [feltgate_map_pkg::W_FAULTS_FIRST-1:0]  first_fault_o,
    output logic        armed_o,
    output logic        gates_enable_o,
    output logic        word_valid_o,
    output logic [ 5:0] word_slot_o,
    output logic [31:0] word_data_o
);
  feltgate_linked #(.Simulated(1)) u_linked (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i),
      .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o),
      .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
      // The design of this RTL, lever, has none of these options.
      /* verilator lint_off PINCONNECTEMPTY */
      .encoder_data_i(1'b0), .encoder_select_no(), .encoder_clock_o(), .encoder_command_o(),
      .current_data_i(1'b0), .current_clock_o(), .driver_fault_i(1'b0), .heartbeat_o(),
      .gate_c_hi_o(), .gate_c_lo_o(),
      /* verilator lint_on PINCONNECTEMPTY */
      .arm_i(arm_i), .stop_i(stop_i), .set_zero_i(set_zero_i), .clear_faults_i(1'b0),
      .scene_i(scene_i),
      .uart_rx_i(uart_rx_i), .uart_tx_o(uart_tx_o), .inputs_i(inputs_i),
      .position_o(position_o), .limits_o(limits_o), .faults_o(faults_o),
      .first_fault_o(first_fault_o), .scene_o(scene_o), .armed_o(armed_o),
      .gates_enable_o(gates_enable_o), .snapshot_valid_o(snapshot_valid_o)
  );

  // What a board's top has no use for.
  generate
  if (feltgate_pkg::ENGINE != 0) begin : g_law
    assign reg_busy_o    = u_linked.g_law.u_axes.reg_busy_o;
    assign reg_rdata_o   = u_linked.g_law.u_axes.reg_rdata_o;
    assign tick_count_o  = u_linked.g_law.u_axes.tick_count_o;
    assign velocity_o    = u_linked.g_law.u_axes.velocity_o;
    assign tau_hat_o     = u_linked.g_law.u_axes.tau_hat_o;
    assign tau_ref_o     = u_linked.g_law.u_axes.tau_ref_o;
    assign current_ref_o = u_linked.g_law.u_axes.current_ref_o;
    assign voltage_o     = u_linked.g_law.u_axes.voltage_o;
    assign duty_o        = u_linked.g_law.u_axes.duty_o;
    assign duty_active_o = u_linked.g_law.u_axes.duty_active_o;
    assign word_valid_o  = u_linked.g_law.u_axes.word_valid_o;
    assign word_slot_o   = u_linked.g_law.u_axes.word_slot_o;
    assign word_data_o   = u_linked.g_law.u_axes.word_data_o;
  end else begin : g_core
    assign reg_busy_o    = u_linked.g_core.u_core.reg_busy_o;
    assign reg_rdata_o   = u_linked.g_core.u_core.reg_rdata_o;
    assign tick_count_o  = u_linked.g_core.u_core.tick_count_o;
    assign velocity_o    = u_linked.g_core.u_core.velocity_o;
    assign tau_hat_o     = u_linked.g_core.u_core.tau_hat_o;
    assign tau_ref_o     = u_linked.g_core.u_core.tau_ref_o;
    assign current_ref_o = u_linked.g_core.u_core.current_ref_o;
    assign voltage_o     = u_linked.g_core.u_core.voltage_o;
    assign duty_o        = u_linked.g_core.u_core.duty_o;
    assign duty_active_o = u_linked.g_core.u_core.duty_active_o;
    assign word_valid_o  = u_linked.g_core.u_core.word_valid_o;
    assign word_slot_o   = u_linked.g_core.u_core.word_slot_o;
    assign word_data_o   = u_linked.g_core.u_core.word_data_o;
  end
  endgenerate
endmodule

`default_nettype wire
