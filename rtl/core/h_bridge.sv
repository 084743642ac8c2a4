// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bridge socket: two legs by the voltage law, without a measured current. docs/blocks/pwm.md

`default_nettype none

module h_bridge (
    input  logic         clk_i,
    input  logic         rst_ni,
    input  cfg::drive_t  drive_i,
    output cfg::bridge_t bridge_o,
    output logic         gate_a_hi_o,
    output logic         gate_a_lo_o,
    output logic         gate_b_hi_o,
    output logic         gate_b_lo_o
);
  assign bridge_o.measured = 1'b0;
  assign bridge_o.current  = '0;
  assign bridge_o.why      = '0;
  pwm #(.Period(cfg::PWM_PERIOD), .DeadClocks(cfg::DEAD_CLOCKS), .ShortestClocks(cfg::SHORTEST_CLOCKS)) u_pwm (
      .clk_i(clk_i), .rst_ni(rst_ni), .clear_i(drive_i.gates_clear), .enable_i(drive_i.gates_enable),
      .mode_i(drive_i.pwm_mode), .polarity_i(drive_i.polarity), .duty_i(drive_i.duty), .gate_a_hi_o(gate_a_hi_o),
      .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
      .period_start_o(bridge_o.period_start), .duty_active_o(bridge_o.duty_active)
  );
endmodule

`default_nettype wire
