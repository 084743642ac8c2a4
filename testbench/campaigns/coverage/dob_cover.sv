// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of dob: ties of the observed torque, both ends of its format, the state that follows while disarmed.
// docs/testing.md
`default_nettype none

module dob_cover #(
  parameter int ObservedW  = 24,
  parameter int TorqueDrop = 2
) (
  input logic clk_i,
  input logic rst_ni,
  input logic armed_i,
  input logic rounds,
  input logic shows,
  input logic over,
  input logic negative,
  input logic beyond_half,
  input logic signed [ObservedW-1:0] filter_q
);
  logic half;
  assign half = filter_q[TorqueDrop-1];
  for (genvar n = 0; n < 4; n++) begin : g_kind  // odd, negative
    logic here;
    assign here = rounds && {filter_q[TorqueDrop], filter_q[ObservedW-1]} == 2'(n);
    tie:        cover property (@(posedge clk_i) disable iff (!rst_ni) here && half && !beyond_half);
    above_half: cover property (@(posedge clk_i) disable iff (!rst_ni) here && half && beyond_half);
    below_half: cover property (@(posedge clk_i) disable iff (!rst_ni) here && !half && beyond_half);
  end
  over_above: cover property (@(posedge clk_i) disable iff (!rst_ni) shows && over && !negative);
  over_below: cover property (@(posedge clk_i) disable iff (!rst_ni) shows && over && negative);
  disarmed:   cover property (@(posedge clk_i) disable iff (!rst_ni) shows && !armed_i && !over);
endmodule

bind dob dob_cover #(.ObservedW(ObservedW), .TorqueDrop(TorqueDrop)) u_cover (
  .rounds(at_observed_i), .shows(at_tau_hat_i), .beyond_half((filter_q & BelowHalf) != '0),
  .negative(rounded_q[RoundedW-1]), .*);

`default_nettype wire
