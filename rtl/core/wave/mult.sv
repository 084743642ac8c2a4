// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Signed multiplier, 35 x 18 bits, made of two 18 x 18 multipliers; every stage is registered.
// Latency: operands in clock t, product in clock t + 4. With FELTGATE_ECP5 the two multipliers are
// MULT18X18D cells and use their registers; otherwise the tool infers them. docs/architecture.md

`default_nettype none

module mult (
    input  logic               clk_i,
    input  logic signed [34:0] a_i,
    input  logic signed [17:0] b_i,
    output logic signed [52:0] product_o
);
  // a = high * 2^17 + low, with low unsigned: both halves fit a signed 18-bit operand.
  logic signed [17:0] low, high;
  assign low  = {1'b0, a_i[16:0]};
  assign high = a_i[34:17];

  logic signed [35:0] low_product, high_product;  // in clock t + 3

`ifdef FELTGATE_ECP5
  mult18_ecp5 u_low (.clk_i(clk_i), .a_i(low), .b_i(b_i), .product_o(low_product));
  mult18_ecp5 u_high (.clk_i(clk_i), .a_i(high), .b_i(b_i), .product_o(high_product));
`else
  logic signed [17:0] low_q, high_q, b_q;
  logic signed [35:0] low_product_q, high_product_q, low_product_q2, high_product_q2;
  always_ff @(posedge clk_i) begin
    low_q           <= low;
    high_q          <= high;
    b_q             <= b_i;
    low_product_q   <= low_q * b_q;
    high_product_q  <= high_q * b_q;
    low_product_q2  <= low_product_q;
    high_product_q2 <= high_product_q;
  end
  assign low_product  = low_product_q2;
  assign high_product = high_product_q2;
`endif

  // The 17 lowest bits come from the low product alone.
  logic signed [35:0] upper_q;
  logic        [16:0] lower_q;
  always_ff @(posedge clk_i) begin
    upper_q <= high_product + 36'(low_product >>> 17);
    lower_q <= low_product[16:0];
  end
  assign product_o = {upper_q, lower_q};
endmodule

`default_nettype wire
