// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// product = start value + factor * word, one bit of the word a clock; for what comes once in a PWM period. The product is
// there WordW + 1 clocks after start_i and goes on moving unless hold_i. docs/blocks/current.md

`default_nettype none

module serial_multiplier #(
    parameter int FactorW = 24,  // signed
    parameter int WordW   = 17   // unsigned
) (
    input  logic                             clk_i,
    input  logic                             start_i,    // one clock: takes the next three
    input  logic signed [       FactorW-1:0] factor_i,
    input  logic        [         WordW-1:0] word_i,
    input  logic signed [       FactorW-1:0] value_i,    // the start value
    input  logic                             hold_i,
    output logic signed [FactorW+WordW-1:0] product_o
);
  // {high_q, low_q} moves down; bits of the word leave, those of the product come.
  logic signed [FactorW-1:0] factor_q, high_q;
  logic signed [FactorW:0] sum;
  logic [WordW-1:0] low_q;
  assign sum       = (FactorW + 1)'(high_q) + (low_q[0] ? (FactorW + 1)'(factor_q) : '0);
  assign product_o = {high_q, low_q};
  always_ff @(posedge clk_i) begin
    if (start_i) begin
      factor_q <= factor_i;
      high_q   <= value_i;
      low_q    <= word_i;
    end else if (!hold_i) begin
      high_q <= sum[FactorW:1];
      low_q  <= {sum[0], low_q[WordW-1:1]};
    end
  end
endmodule

`default_nettype wire
