// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate_linked with the ports of its axes beside its own, for a simulated board that says what each tick showed.
// Documentation: docs/host.md
`default_nettype none
`include "device.svh"

module board_pins #(
    parameter int AxisCount = cfg::AXES
) (
    input  logic                   clk_i,
    input  logic                   rst_ni,
    `PINS(logic [AxisCount-1:0]),
    input  logic                   arm_i,
    input  logic                   stop_i,
    input  logic [4*AxisCount-1:0] scene_i,
    input  logic                   uart_rx_i,
    input  logic [7:0]             inputs_i,
    output logic                   uart_tx_o,

    output logic [35:0] on_times_o,  // of three legs, in force: C, B, A
    output logic                 snapshot_valid_o,
    output logic [31:0]          tick_count_o,
    output logic [AxisCount*32-1:0]              position_o,
    output logic [AxisCount*cfg::VELOCITY_W-1:0] velocity_o,
    output logic [AxisCount*cfg::TORQUE_W-1:0]   tau_hat_o,
    output logic [AxisCount*cfg::TORQUE_W-1:0]   tau_ref_o,
    output logic [AxisCount*cfg::CURRENT_W-1:0]  current_ref_o,
    output logic [AxisCount*cfg::VOLTAGE_W-1:0]  voltage_o,
    output logic [AxisCount*cfg::DUTY_W-1:0]     duty_o,
    output logic [AxisCount*cfg::DUTY_W-1:0]     duty_active_o,
    output logic [AxisCount*4-1:0]               scene_o,
    output logic [AxisCount*12-1:0]              limits_o,
    output logic [AxisCount*16-1:0]              faults_o,
    output logic [AxisCount*5-1:0]               first_fault_o,
    output logic [AxisCount-1:0]                 armed_o,
    output logic [AxisCount-1:0]                 gates_enable_o,
    output logic [AxisCount-1:0]                 word_valid_o,
    output logic [6*AxisCount-1:0]               word_slot_o,
    output logic [AxisCount*32-1:0]              word_data_o
);
  feltgate_linked #(.Simulated(1)) u_linked (.set_zero_i('0), .clear_faults_i(1'b0), .*);

  // What a board's top has no use for.
  assign tick_count_o  = u_linked.u_axes.tick_count_o;
  assign velocity_o    = u_linked.u_axes.velocity_o;
  assign tau_hat_o     = u_linked.u_axes.tau_hat_o;
  assign tau_ref_o     = u_linked.u_axes.tau_ref_o;
  assign current_ref_o = u_linked.u_axes.current_ref_o;
  assign voltage_o     = u_linked.u_axes.voltage_o;
  assign duty_o        = u_linked.u_axes.duty_o;
  assign duty_active_o = u_linked.u_axes.duty_active_o;
  assign word_valid_o  = u_linked.u_axes.word_valid_o;
  assign word_slot_o   = u_linked.u_axes.word_slot_o;
  assign word_data_o   = u_linked.u_axes.word_data_o;
`ifdef FELTGATE_GIMBAL_CURRENT
  assign on_times_o = u_linked.u_axes.g_axis[0].u_member.u_device.u_three_phase_current.u_pwm.taken_q;
`elsif FELTGATE_GIMBAL_MOTOR
  assign on_times_o = u_linked.u_axes.g_axis[0].u_member.u_device.u_three_phase.u_pwm.taken_q;
`elsif FELTGATE_HALL_MOTOR
  assign on_times_o = u_linked.u_axes.g_axis[0].u_member.u_device.u_three_phase.u_pwm.taken_q;
`else
  assign on_times_o = '0;
`endif
endmodule

`default_nettype wire
