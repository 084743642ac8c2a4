// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One-pole low-pass y += round(a1 * (x - y)) on the shared multiplier; the design sets the
// rounding. The parent block sets the timing: x in the clock of valid_i, operand in the
// next clock alone, product in the clock of update_i, new y from the next clock on. The difference loses
// its lowest bits if it is wider than the multiplier's operand. docs/blocks/dob.md

`default_nettype none

module lowpass #(
    parameter int Width       = 32,  // of x and y
    parameter int OperandW    = 33,  // of the difference on the multiplier
    parameter int ProductDrop = 27,  // fraction bits of the product below those of y
    parameter int ProductW    = 53,
    parameter int Rounding    = feltgate_pkg::ROUNDING  // 0 half up, 1 floor, 2 convergent
) (
    input  logic                       clk_i,
    input  logic                       rst_ni,
    input  logic                       valid_i,    // x_i is new
    input  logic                       update_i,   // product_i is the operand's product
    input  logic                       follow_i,   // 1: y := x, no filtering; held like x
    input  logic signed [   Width-1:0] x_i,        // stable until the new y
    output logic signed [OperandW-1:0] operand_o,
    input  logic signed [ProductW-1:0] product_i,
    output logic signed [   Width-1:0] y_o
);
  generate
  if (!(OperandW <= Width + 1 && ProductDrop >= 1 && ProductW > ProductDrop))
  begin : g_check_widths
    the_widths_of_a_lowpass_must_nest missing ();
  end
  endgenerate

  logic signed [Width-1:0] y_q;

  logic signed [Width:0] difference_q;
  always_ff @(posedge clk_i) begin
    if (!valid_i) difference_q <= '0;
    else difference_q <= x_i - y_q;
  end
  assign operand_o = difference_q[Width-:OperandW];

  // {y,up} + {p,r}: the low bit carries exactly when the rounding bit r and up are set, so rounding
  // needs no second adder. With rounding to even, a tie goes up only from an odd sum.
  logic        [  Width:0] increment;
  logic        [  Width:0] sum;
  logic                    beyond_half, odd, up;
  assign increment = (Width + 1)'(product_i >>> (ProductDrop - 1));
  localparam logic [ProductW-1:0] Below = (ProductW'(1) << (ProductDrop - 1)) - ProductW'(1);
  assign beyond_half = (product_i & Below) != '0;
  assign odd         = y_q[0] ^ increment[1];
  assign up          = Rounding == 0 || (Rounding == 2 && (beyond_half || odd));
  assign sum         = {y_q, up} + increment;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      y_q <= '0;
    end else if (update_i) begin
      y_q <= follow_i ? x_i : $signed(sum[Width:1]);
    end
  end
  assign y_o = y_q;

  logic unused;
  assign unused = ^{difference_q, sum};  // their lowest bits
endmodule

`default_nettype wire
