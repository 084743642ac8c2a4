// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Counts of the last Ticks ticks; until so many have passed, the counts since the reset. New one
// clock after sample_i, held. docs/blocks/velocity.md

`default_nettype none

module travel_window #(
    parameter int Ticks = 767
) (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               sample_i,
    input  logic signed [15:0] travel_i,  // counts, wraps
    output logic signed [15:0] counts_o
);
  localparam int W = Ticks > 1 ? $clog2(Ticks) : 1;
  logic signed [15:0] line[2**W];
  logic signed [15:0] oldest_q;
  logic [W-1:0] place_q;
  logic full_q;
  always_ff @(posedge clk_i) begin
    oldest_q <= line[place_q];
    if (sample_i) line[place_q] <= travel_i;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {place_q, full_q, counts_o} <= '0;
    end else if (sample_i) begin
      counts_o <= travel_i - (full_q ? oldest_q : '0);
      place_q  <= place_q == W'(Ticks - 1) ? '0 : place_q + 1'b1;
      full_q   <= full_q || place_q == W'(Ticks - 1);
    end
  end
endmodule

`default_nettype wire
