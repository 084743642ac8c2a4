// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// floor(dividend / divisor), saturated to 16 bits; one bit a clock. quotient_o is new with valid_o,
// 18 clocks after start_i, and held until the next start. docs/blocks/scene.md

`default_nettype none

module divider (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        start_i,
    input  logic [31:0] dividend_i,
    input  logic [31:0] divisor_i,   // held until valid_o
    output logic [15:0] quotient_o,
    output logic        valid_o
);
  logic [16:0] at;     // clocks since start_i
  logic [31:0] rest_q;
  // The dividend's unused bits above the quotient's; at the end bit 16 is 1 if the quotient saturates.
  logic [16:0] low_q;
  logic [32:0] next, difference;
  assign next       = {rest_q, low_q[16]};
  assign difference = next - {1'b0, divisor_i};
  assign quotient_o = low_q[15:0] | {16{low_q[16]}};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {valid_o, at} <= '0;
    else         {valid_o, at} <= {at, start_i};
  end
  always_ff @(posedge clk_i) begin
    if (start_i) begin
      {rest_q, low_q} <= {17'd0, dividend_i};
    end else if (at != '0) begin
      rest_q <= difference[32] ? next[31:0] : difference[31:0];
      low_q  <= {low_q[15:0], !difference[32]};
    end
  end
endmodule

`default_nettype wire
