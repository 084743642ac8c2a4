// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One multiplier: what it multiplies, and that all blocks get its product.
`default_nettype none

module shared_proof (
    input logic                                                  clk_i,
    input logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] operand_i,
    input logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] velocity_i,
    input logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] dob_i,
    input logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] scene_i,
    input logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] control_i,
    input logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] supervisor_i,
    input logic                                                  signed_i,
    input logic        [                                   31:0] param_i,
    input logic                                                  square_distance_i,
    input logic signed [                                   17:0] distance_i,
    input logic                                                  square_estimate_i,
    input logic signed [   feltgate_pkg::CURRENT_ESTIMATE_W-1:0] estimate_i
);
  logic past_ok_q;
  initial past_ok_q = 1'b0;
  always_ff @(posedge clk_i) past_ok_q <= 1'b1;

  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] velocity, dob, scene, control, supervisor;
  multipliers u_dut (
      .clk_i(clk_i),
      .operand_i(operand_i),
      .velocity_i(velocity_i),
      .dob_i(dob_i),
      .scene_i(scene_i),
      .control_i(control_i),
      .supervisor_i(supervisor_i),
      .signed_i(signed_i),
      .param_i(param_i),
      .square_distance_i(square_distance_i),
      .distance_i(distance_i),
      .square_estimate_i(square_estimate_i),
      .estimate_i(estimate_i),
      .velocity_product_o(velocity),
      .dob_product_o(dob),
      .scene_product_o(scene),
      .control_product_o(control),
      .supervisor_product_o(supervisor)
  );

  // The word on the bus: COEFFICIENT_BITS of it, and the next as a sign where it has one.
  logic signed [17:0] coefficient;
  assign coefficient = signed_i ? $signed(param_i[17:0]) : $signed({1'b0, param_i[16:0]});
  (* hierconn *) wire signed [feltgate_pkg::MULTIPLIER_A_BITS-1:0] \u_dut.gen_shared.u_mult.a_i ;
  (* hierconn *) wire signed [17:0] \u_dut.gen_shared.u_mult.b_i ;
  (* hierconn *) wire signed [feltgate_pkg::PRODUCT_BITS-1:0] \u_dut.gen_shared.u_mult.product_o ;
  wire signed [17:0] factor = \u_dut.gen_shared.u_mult.b_i ;
  wire signed [feltgate_pkg::PRODUCT_BITS-1:0] product = \u_dut.gen_shared.u_mult.product_o ;
  always_comb begin
    // Who squares brings a factor of 0 while the other does.
    assume (!(square_distance_i && square_estimate_i));
    assume (square_distance_i || !square_estimate_i || distance_i == '0);
    assume (square_estimate_i || estimate_i == '0);
    if (past_ok_q) begin
      operand_is_the_bus: assert (\u_dut.gen_shared.u_mult.a_i == operand_i);
      factor_is_the_word: assert (square_distance_i || square_estimate_i || factor == coefficient);
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
