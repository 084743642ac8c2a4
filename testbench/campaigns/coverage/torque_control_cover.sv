// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of torque_control: each mode at each limit, both regions of the voltage gain, a mode's change.
// docs/testing.md
`default_nettype none

module torque_control_cover (
  input logic clk_i,
  input logic rst_ni,
  input logic armed_i,
  input logic [1:0] mode_i,
  input logic shows,
  input logic region,
  input logic limit_current_o,
  input logic limit_voltage_o,
  input logic limit_duty_o,
  input logic over_limit_i,
  input logic region_high_o,
  input logic voltage_over,
  input logic signed [feltgate_pkg::CURRENT_W-1:0] current_ref_o,
  input logic signed [feltgate_pkg::VOLTAGE_W-1:0] voltage_o,
  input logic signed [feltgate_pkg::DUTY_W-1:0] duty_o
);
  for (genvar n = 0; n < 3; n++) begin : g_mode
    logic here;
    assign here = shows && armed_i && mode_i == 2'(n);
    at_current_limit:    cover property (@(posedge clk_i) disable iff (!rst_ni) here && limit_current_o && current_ref_o > 0);
    at_minus_current:    cover property (@(posedge clk_i) disable iff (!rst_ni) here && limit_current_o && current_ref_o < 0);
    at_voltage_limit:    cover property (@(posedge clk_i) disable iff (!rst_ni) here && limit_voltage_o && voltage_o > 0);
    at_minus_voltage:    cover property (@(posedge clk_i) disable iff (!rst_ni) here && limit_voltage_o && voltage_o < 0);
    at_duty_limit:       cover property (@(posedge clk_i) disable iff (!rst_ni) here && limit_duty_o && duty_o > 0);
    at_minus_duty:       cover property (@(posedge clk_i) disable iff (!rst_ni) here && limit_duty_o && duty_o < 0);
    free_of_limits:      cover property (@(posedge clk_i) disable iff (!rst_ni) here && !limit_current_o && !limit_voltage_o &&
                                         !limit_duty_o && duty_o != 0);
  end
  enters_high_region: cover property (@(posedge clk_i) disable iff (!rst_ni) region && over_limit_i && !region_high_o);
  leaves_high_region: cover property (@(posedge clk_i) disable iff (!rst_ni) region && !over_limit_i && region_high_o);
  beyond_the_port:    cover property (@(posedge clk_i) disable iff (!rst_ni) shows && voltage_over);
  disarmed:           cover property (@(posedge clk_i) disable iff (!rst_ni) shows && !armed_i && voltage_o == 0 && duty_o == 0);
endmodule

bind torque_control torque_control_cover u_cover (
  .shows(product_is_emf_constant_i), .region(at_region_i), .*);

`default_nettype wire
