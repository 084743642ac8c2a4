// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked with the core's ports beside its own, for a simulated board that says what each tick showed.
// Documentation: docs/host.md
`default_nettype none

module board_pins #(
    parameter int AxisCount = feltgate_pkg::AXES
) (
    input  logic                   clk_i,
    input  logic                   rst_ni,
    input  logic [AxisCount-1:0]   enc_a_i,
    input  logic [AxisCount-1:0]   enc_b_i,
    input  logic [AxisCount-1:0]   enc_z_i,
    input  logic                   encoder_data_i,
    input  logic [feltgate_pkg::CURRENT_LOOP*(feltgate_pkg::PHASES-2):0] current_data_i,
    input  logic [2:0]             hall_i,
    input  logic                   arm_i,
    input  logic                   stop_i,
    input  logic [4*AxisCount-1:0] scene_i,
    input  logic                   uart_rx_i,
    input  logic [7:0]             inputs_i,
    output logic                   uart_tx_o,

    output logic [AxisCount-1:0] gate_a_hi_o,
    output logic [AxisCount-1:0] gate_a_lo_o,
    output logic [AxisCount-1:0] gate_b_hi_o,
    output logic [AxisCount-1:0] gate_b_lo_o,
    output logic                 gate_c_hi_o,
    output logic                 gate_c_lo_o,
    output logic [ 2:0]          serial_o,    // of an absolute encoder, as CoreOut::serial
    output logic [35:0]          on_times_o,  // of three legs, in force: C, B, A
    output logic                 snapshot_valid_o,
    output logic [31:0]          tick_count_o,
    output logic [AxisCount*32-1:0]                                position_o,
    output logic [AxisCount*feltgate_pkg::VELOCITY_W-1:0]          velocity_o,
    output logic [AxisCount*feltgate_pkg::TORQUE_W-1:0]            tau_hat_o,
    output logic [AxisCount*feltgate_pkg::TORQUE_W-1:0]            tau_ref_o,
    output logic [AxisCount*feltgate_pkg::CURRENT_W-1:0]           current_ref_o,
    output logic [AxisCount*feltgate_pkg::VOLTAGE_W-1:0]           voltage_o,
    output logic [AxisCount*feltgate_pkg::DUTY_W-1:0]              duty_o,
    output logic [AxisCount*feltgate_pkg::DUTY_W-1:0]              duty_active_o,
    output logic [AxisCount*4-1:0]                                 scene_o,
    output logic [AxisCount*feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits_o,
    output logic [AxisCount*feltgate_map_pkg::W_FAULTS_SEEN-1:0]   faults_o,
    output logic [AxisCount*feltgate_map_pkg::W_FAULTS_FIRST-1:0]  first_fault_o,
    output logic [AxisCount-1:0]                                   armed_o,
    output logic [AxisCount-1:0]                                   gates_enable_o,
    output logic                                                   word_valid_o,
    output logic [5:0]                                             word_slot_o,
    output logic [AxisCount*32-1:0]                                word_data_o
);
  feltgate_linked #(.Simulated(1)) u_linked (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i),
      .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o),
      .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
      .gate_c_hi_o(gate_c_hi_o), .gate_c_lo_o(gate_c_lo_o),
      .encoder_data_i(encoder_data_i), .encoder_select_no(serial_o[0]), .encoder_clock_o(serial_o[1]),
      .encoder_command_o(serial_o[2]),
      /* verilator lint_off PINCONNECTEMPTY */  // the board's plant has no clock of a modulator and no watchdog
      .current_data_i(current_data_i), .current_clock_o(), .driver_fault_i(1'b0), .heartbeat_o(), .hall_i(hall_i),
      /* verilator lint_on PINCONNECTEMPTY */
      .arm_i(arm_i), .stop_i(stop_i), .set_zero_i({AxisCount{1'b0}}), .clear_faults_i(1'b0),
      .scene_i(scene_i),
      .uart_rx_i(uart_rx_i), .uart_tx_o(uart_tx_o), .inputs_i(inputs_i),
      .position_o(position_o), .limits_o(limits_o), .faults_o(faults_o),
      .first_fault_o(first_fault_o), .scene_o(scene_o), .armed_o(armed_o),
      .gates_enable_o(gates_enable_o), .snapshot_valid_o(snapshot_valid_o)
  );

  // What a board's top has no use for.
  generate
  if (feltgate_pkg::ENGINE != 0 || AxisCount > 1) begin : g_law
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
    if (feltgate_pkg::PHASES == 3) begin : g_three_legs
      assign on_times_o = u_linked.g_law.u_axes.g_axis[0].u_core.u_actuation.g_three_legs.u_pwm.taken_q;
    end else begin : g_two_legs
      assign on_times_o = '0;
    end
  end else begin : g_core
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
    if (feltgate_pkg::PHASES == 3) begin : g_three_legs
      assign on_times_o = u_linked.g_core.u_core.u_actuation.g_three_legs.u_pwm.taken_q;
    end else begin : g_two_legs
      assign on_times_o = '0;
    end
  end
  endgenerate
endmodule

`default_nettype wire
