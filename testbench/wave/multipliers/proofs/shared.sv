// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One multiplier: what it multiplies, and that all blocks get its product.
`default_nettype none

module shared_proof
`include "multipliers.svh"
  (* hierconn *) wire signed [feltgate_pkg::MULTIPLIER_A_BITS-1:0] \u_dut.gen_shared.u_mult.a_i ;
  (* hierconn *) wire signed [17:0] \u_dut.gen_shared.u_mult.b_i ;
  (* hierconn *) wire signed [feltgate_pkg::PRODUCT_BITS-1:0] \u_dut.gen_shared.u_mult.product_o ;
  wire signed [17:0] factor = \u_dut.gen_shared.u_mult.b_i ;
  wire signed [feltgate_pkg::PRODUCT_BITS-1:0] product = \u_dut.gen_shared.u_mult.product_o ;
  always_comb begin
    // Who squares brings a factor of 0 while the other does.
    assume (!(square_distance_i && square_estimate_i));
    assume (!zero_control_i || (!square_distance_i && !square_estimate_i && distance_i == '0));
    assume (square_distance_i || !square_estimate_i || distance_i == '0);
    assume (square_estimate_i || estimate_i == '0);
    if (past_ok_q) begin
      operand_is_the_bus: assert (\u_dut.gen_shared.u_mult.a_i == operand_i);
      factor_is_the_word: assert (square_distance_i || square_estimate_i ||
                                  factor == (zero_control_i ? 18'sd0 : coefficient));
      squares_are_of_their_own: assert (!(square_distance_i && factor != distance_i) &&
                                        !(square_estimate_i && factor != 18'(estimate_i)));
      product_is_for_all: assert (velocity == product && dob == product && scene == product && control == product &&
                                  supervisor == product);
      squares: cover (square_estimate_i && factor < 0);
      has_a_sign: cover (signed_i && factor < 0 && !square_distance_i);
    end
  end
endmodule

`default_nettype wire
