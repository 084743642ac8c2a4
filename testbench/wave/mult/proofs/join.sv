// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The two halves' products are taken out and may be anything; what stands around them is then linear:
// a = high * 2^17 + low, and product = H * 2^17 + L of the same operands. With H = high * b and L = low * b
// that is a * b, by distributivity.
`default_nettype none

module join_proof (
    input logic               clk_i,
    input logic signed [34:0] a_i,
    input logic signed [17:0] b_i
);
  logic signed [52:0] product;
  mult u_dut (
      .*,
      .product_o(product)
  );
  (* hierconn *) wire signed [17:0] \u_dut.low_q ;
  wire signed [17:0] low = \u_dut.low_q ;
  (* hierconn *) wire signed [17:0] \u_dut.high_q ;
  wire signed [17:0] high = \u_dut.high_q ;
  (* hierconn *) wire signed [17:0] \u_dut.b_q ;
  wire signed [17:0] b = \u_dut.b_q ;
  (* hierconn *) wire signed [35:0] \u_dut.low_product_q ;
  wire signed [35:0] low_product = \u_dut.low_product_q ;
  (* hierconn *) wire signed [35:0] \u_dut.high_product_q ;
  wire signed [35:0] high_product = \u_dut.high_product_q ;

  logic [2:0] age_q;
  initial age_q = 3'd0;
  always_ff @(posedge clk_i) if (age_q != 3'd5) age_q <= age_q + 3'd1;

  // The operands of the last clocks, and the products of two clocks ago.
  logic signed [34:0] a_q;
  logic signed [17:0] b_q;
  logic signed [35:0] low_q2, low_q3, high_q2, high_q3;
  always_ff @(posedge clk_i) begin
    a_q      <= a_i;
    b_q      <= b_i;
    low_q2   <= low_product;
    low_q3   <= low_q2;
    high_q2  <= high_product;
    high_q3  <= high_q2;
  end
  // No product of two operands of 18 bits is beyond these.
  always_comb begin
    assume (low_product <= 36'sh400000000 && low_product >= -36'sh400000000);
    assume (high_product <= 36'sh400000000 && high_product >= -36'sh400000000);
  end

  always_comb begin
    if (age_q != 3'd0) begin
      halves_are_the_operand: assert ((40'(high) <<< 17) + 40'(low) == 40'(a_q));
      low_half_is_positive: assert (low >= 0);
      factor_is_the_operand: assert (b == b_q);
    end
    if (age_q == 3'd5) begin
      sum_is_the_product: assert (60'(product) == (60'(high_q3) <<< 17) + 60'(low_q3));
      negative: cover (high_q3 < 0 && low_q3 < 0 && product < 0);
      carries: cover (high_q3 == -36'sd1 && low_q3 > 36'sd131072);
    end
  end
endmodule

`default_nettype wire
