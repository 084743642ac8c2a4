// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Velocity by the N-method: raw = gain * counts of the last M1 ticks, saturated;
// velocity += a1 * (raw - velocity). valid_o 5 clocks after sample_i. docs/blocks/velocity.md

`default_nettype none

module velocity_estimator (
    input  logic                             clk_i,
    input  logic                             rst_ni,
    input  cfg::params_t                     p,
    input  logic                             sample_i,     // one clock a tick: travel_i is taken
    input  logic signed [              15:0] travel_i,     // counts, wraps
    output logic signed [cfg::VELOCITY_W-1:0] velocity_o,  // rad/s, held
    output logic                             saturated_o,  // raw saturated
    output logic                             valid_o       // one clock: velocity_o is new
);
  localparam int W = cfg::VELOCITY_W;
  localparam bit Shifts = cfg::VELOCITY_GAIN == 0;  // the gain is 2^VELOCITY_SHIFT
  localparam int Gain = Shifts ? 1 : cfg::VELOCITY_GAIN;
  localparam int Exponent = cfg::VELOCITY_F + (Shifts ? cfg::VELOCITY_SHIFT : -cfg::VELOCITY_GAIN_F);

  logic signed [15:0] counts;
  travel_window #(.Ticks(cfg::M1)) u_window (
      .clk_i(clk_i), .rst_ni(rst_ni), .sample_i(sample_i), .travel_i(travel_i), .counts_o(counts)
  );

  logic signed [63:0] speed;
  logic signed [W-1:0] raw_q;
  logic signed [W:0] off_q;
  logic signed [W+17:0] product_q;
  logic [3:0] at;  // clocks since sample_i
  assign speed = fx::scale(64'(counts) * 64'(Gain), Exponent);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {at, valid_o, raw_q, saturated_o, velocity_o} <= '0;
    end else begin
      {valid_o, at} <= {at, sample_i};
      if (at[0]) raw_q       <= W'(fx::saturate(speed, W));
      if (at[0]) saturated_o <= fx::overflows(speed, W);
      if (at[3]) velocity_o  <= W'(fx::add_rounded(64'(velocity_o), 64'(product_q), cfg::P_VELOCITY_A1_F));
    end
  end
  always_ff @(posedge clk_i) begin
    off_q     <= (W + 1)'(raw_q) - (W + 1)'(velocity_o);
    product_q <= off_q * $signed({1'b0, p.velocity_a1});
  end
endmodule

`default_nettype wire
