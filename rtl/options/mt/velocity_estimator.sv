// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Velocity by the M/T method, in place of rtl/core/velocity_estimator.sv and with its ports: raw is of the
// span between two edges up to the sample before; velocity += a1 * (raw - velocity), and at a standstill
// velocity = raw = 0. valid_o 5 clocks after sample_i. docs/blocks/velocity.md

`default_nettype none

module velocity_estimator #(
    parameter int StampW = 26  // bits of an edge's time
) (
    input  logic                             clk_i,
    input  logic                             rst_ni,
    input  cfg::params_t                     p,
    input  logic                             sample_i,     // one clock a tick
    input  logic signed [              15:0] travel_i,     // counts, wraps; of each clock
    output logic signed [cfg::VELOCITY_W-1:0] velocity_o,  // rad/s, held
    output logic                             saturated_o,  // raw saturated
    output logic                             valid_o       // one clock: velocity_o is new
);
  localparam int W = cfg::VELOCITY_W;

  logic signed [W-1:0] raw;
  logic saturated, still;
  span_meter #(.StampW(StampW)) u_span_meter (
      .clk_i(clk_i), .rst_ni(rst_ni), .sample_i(sample_i), .travel_i(travel_i), .raw_o(raw), .saturated_o(saturated),
      .still_o(still)
  );

  // A velocity of at most SlowW bits may fall to 0 in one step: overspeed allows a step of this size.
  localparam int Weight = W + 17 - cfg::P_VELOCITY_A1_F;
  localparam int SlowW = Weight >= 0 && Weight <= W - 2 ? Weight + 1 : W;

  logic signed [W-1:0] raw_q;
  logic signed [W:0] off_q;
  logic signed [W+17:0] product_q;
  logic follows_q;
  logic [3:0] at;  // clocks since sample_i
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {at, valid_o, raw_q, saturated_o, follows_q, velocity_o} <= '0;
    end else begin
      {valid_o, at} <= {at, sample_i};
      if (at[0]) {raw_q, saturated_o, follows_q} <= {raw, saturated, still && !fx::overflows(64'(velocity_o), SlowW)};
      if (at[3]) velocity_o <= follows_q ? raw_q :
                               W'(fx::add_rounded(64'(velocity_o), 64'(product_q), cfg::P_VELOCITY_A1_F));
    end
  end
  always_ff @(posedge clk_i) begin
    off_q     <= (W + 1)'(raw_q) - (W + 1)'(velocity_o);
    product_q <= off_q * $signed({1'b0, p.velocity_a1});
  end
endmodule

`default_nettype wire
