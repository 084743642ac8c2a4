// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of limiter: each kind of signal at, within and beyond its limit on both sides, and misfits.
// docs/testing.md
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
  input logic up,
  input logic misfit,
  input logic [W-1:0] limit,
  input logic [W-1:0] folded,
  input logic [W:0] room
);
  logic [1:0] kind_q;
  always_ff @(posedge clk_i) kind_q <= duty_i ? 2'd3 : voltage_i ? 2'd2 : torque_i ? 2'd1 : 2'd0;

  logic       good, outside, above, below;
  logic [W:0] size;  // |x|, where x is not over
  assign good    = valid_q && !misfit;
  assign outside = over || room[W];
  assign above   = outside && !negative;
  assign below   = outside && negative;
  assign size    = {1'b0, folded} + {{W{1'b0}}, negative ^ up};
  for (genvar n = 0; n < 4; n++) begin : g_kind  // current, torque, voltage, duty
    logic here;
    assign here = good && kind_q == 2'(n);
    allowed:        cover property (@(posedge clk_i) here && !outside && size != 0);
    beyond_above:   cover property (@(posedge clk_i) here && above && !over);
    beyond_below:   cover property (@(posedge clk_i) here && below && !over);
    far_above:      cover property (@(posedge clk_i) here && above && over);
    far_below:      cover property (@(posedge clk_i) here && below && over);
    at_limit:       cover property (@(posedge clk_i) here && !over && !negative && size == (W + 1)'(limit) && limit != 0);
    at_minus_limit: cover property (@(posedge clk_i) here && !over && negative && size == (W + 1)'(limit) && limit != 0);
    one_above:      cover property (@(posedge clk_i) here && !over && !negative && size == (W + 1)'(limit) + 1);
    one_below:      cover property (@(posedge clk_i) here && !over && negative && size == (W + 1)'(limit) + 1);
    limit_0:        cover property (@(posedge clk_i) here && limit == 0);
    refused:        cover property (@(posedge clk_i) valid_q && misfit && kind_q == 2'(n));
    refused_sign:   cover property (@(posedge clk_i) valid_q && limit[W-1] && kind_q == 2'(n));
  end
  border_only:  cover property (@(posedge clk_i) !valid_q && outside);
  back_to_back: cover property (@(posedge clk_i) valid_i && valid_q);
endmodule

bind limiter limiter_cover #(.W(W)) u_cover (.*);

`default_nettype wire
