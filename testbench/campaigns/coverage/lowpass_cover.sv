// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of lowpass: ties of the product from odd and even states, the dead band, the ends of the state.
// docs/testing.md
`default_nettype none

module lowpass_cover #(
  parameter int Width       = 32,
  parameter int ProductDrop = 27,
  parameter int ProductW    = 53
) (
  input logic                       clk_i,
  input logic                       rst_ni,
  input logic                       valid_i,
  input logic                       update_i,
  input logic                       follow_i,
  input logic signed [ProductW-1:0] product_i,
  input logic signed [   Width-1:0] x_i,
  input logic signed [   Width-1:0] y_q,
  input logic                       beyond_half
);
  logic half, sum_odd, tie;
  assign half    = product_i[ProductDrop-1];
  assign sum_odd = y_q[0] ^ product_i[ProductDrop];
  assign tie     = update_i && !follow_i && half && !beyond_half;
  for (genvar n = 0; n < 4; n++) begin : g_sign  // of the product, of the state
    logic here;
    assign here = {product_i[ProductW-1], y_q[Width-1]} == 2'(n);
    tie_to_odd:  cover property (@(posedge clk_i) disable iff (!rst_ni) tie && here && !sum_odd);
    tie_to_even: cover property (@(posedge clk_i) disable iff (!rst_ni) tie && here && sum_odd);
    above_half:  cover property (@(posedge clk_i) disable iff (!rst_ni)
                                 update_i && !follow_i && here && half && beyond_half);
    below_half:  cover property (@(posedge clk_i) disable iff (!rst_ni)
                                 update_i && !follow_i && here && !half && beyond_half);
  end
  both_bits_odd: cover property (@(posedge clk_i) disable iff (!rst_ni) tie && y_q[0] && product_i[ProductDrop]);
  dead_band:     cover property (@(posedge clk_i) disable iff (!rst_ni)
                                 update_i && !follow_i && product_i != '0 && product_i[ProductW-1:ProductDrop-1] == '0);
  follows:       cover property (@(posedge clk_i) disable iff (!rst_ni) update_i && follow_i && x_i != y_q);
  largest_step:  cover property (@(posedge clk_i) disable iff (!rst_ni)
                                 valid_i && x_i[Width-1] != y_q[Width-1] && x_i[Width-2] != x_i[Width-1] &&
                                 y_q[Width-2] != y_q[Width-1]);
endmodule

bind lowpass lowpass_cover #(.Width(Width), .ProductDrop(ProductDrop), .ProductW(ProductW)) u_cover (.*);

`default_nettype wire
