// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of limiter: each kind of signal at, within and beyond its limit on both sides, and misfits.
// docs/coverage.md
`default_nettype none

module limiter_cover #(
  parameter int W = 24
) (
  input logic clk_i,
  input logic valid_i,
  input logic torque_i,
  input logic voltage_i,
  input logic duty_i,
  input logic valid_q,
  input logic over,
  input logic negative,
  input logic above,
  input logic below,
  input logic misfit,
  input logic signed [W-1:0] limit,
  input logic signed [W-1:0] low
);
  logic [1:0] kind_q;
  always_ff @(posedge clk_i) kind_q <= duty_i ? 2'd3 : voltage_i ? 2'd2 : torque_i ? 2'd1 : 2'd0;

  logic good;
  assign good = valid_q && !misfit;
  for (genvar n = 0; n < 4; n++) begin : g_kind  // current, torque, voltage, duty
    logic here;
    assign here = good && kind_q == 2'(n);
    allowed:        cover property (@(posedge clk_i) here && !above && !below && low != 0);
    beyond_above:   cover property (@(posedge clk_i) here && above && !over);
    beyond_below:   cover property (@(posedge clk_i) here && below && !over);
    far_above:      cover property (@(posedge clk_i) here && above && over);
    far_below:      cover property (@(posedge clk_i) here && below && over);
    at_limit:       cover property (@(posedge clk_i) here && !over && !negative && low == limit && limit != 0);
    at_minus_limit: cover property (@(posedge clk_i) here && !over && negative && low == -limit);
    one_above:      cover property (@(posedge clk_i) here && !over && !negative && low == limit + 1);
    one_below:      cover property (@(posedge clk_i) here && !over && negative && low == -limit - 1);
    limit_0:        cover property (@(posedge clk_i) here && limit == 0);
    refused:        cover property (@(posedge clk_i) valid_q && misfit && kind_q == 2'(n));
    refused_sign:   cover property (@(posedge clk_i) valid_q && limit[W-1] && kind_q == 2'(n));
  end
  border_only:  cover property (@(posedge clk_i) !valid_q && (above || below));
  back_to_back: cover property (@(posedge clk_i) valid_i && valid_q);
endmodule

bind limiter limiter_cover #(.W(W)) u_cover (.*);

`default_nettype wire
