// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A multiplier each: what each multiplies, and whose product is whose.
`default_nettype none

module parallel_proof
`include "multipliers.svh"
  (* hierconn *) wire signed [feltgate_pkg::MULTIPLIER_A_BITS-1:0] \u_dut.gen_parallel.u_velocity.a_i ;
  (* hierconn *) wire signed [17:0] \u_dut.gen_parallel.u_velocity.b_i ;
  (* hierconn *) wire signed [feltgate_pkg::PRODUCT_BITS-1:0] \u_dut.gen_parallel.u_velocity.product_o ;
  (* hierconn *) wire signed [feltgate_pkg::MULTIPLIER_A_BITS-1:0] \u_dut.gen_parallel.u_dob.a_i ;
  (* hierconn *) wire signed [17:0] \u_dut.gen_parallel.u_dob.b_i ;
  (* hierconn *) wire signed [feltgate_pkg::PRODUCT_BITS-1:0] \u_dut.gen_parallel.u_dob.product_o ;
  (* hierconn *) wire signed [feltgate_pkg::MULTIPLIER_A_BITS-1:0] \u_dut.gen_parallel.u_scene.a_i ;
  (* hierconn *) wire signed [17:0] \u_dut.gen_parallel.u_scene.b_i ;
  (* hierconn *) wire signed [feltgate_pkg::PRODUCT_BITS-1:0] \u_dut.gen_parallel.u_scene.product_o ;
  (* hierconn *) wire signed [feltgate_pkg::MULTIPLIER_A_BITS-1:0] \u_dut.gen_parallel.u_control.a_i ;
  (* hierconn *) wire signed [17:0] \u_dut.gen_parallel.u_control.b_i ;
  (* hierconn *) wire signed [feltgate_pkg::PRODUCT_BITS-1:0] \u_dut.gen_parallel.u_control.product_o ;
  (* hierconn *) wire signed [feltgate_pkg::MULTIPLIER_A_BITS-1:0] \u_dut.gen_parallel.u_supervisor.a_i ;
  (* hierconn *) wire signed [17:0] \u_dut.gen_parallel.u_supervisor.b_i ;
  (* hierconn *) wire signed [feltgate_pkg::PRODUCT_BITS-1:0] \u_dut.gen_parallel.u_supervisor.product_o ;
  always_comb begin
    if (past_ok_q) begin
      operands_are_their_own: assert (\u_dut.gen_parallel.u_velocity.a_i  == feltgate_pkg::MULTIPLIER_A_BITS'(velocity_i) &&
          \u_dut.gen_parallel.u_dob.a_i  == dob_i && \u_dut.gen_parallel.u_scene.a_i  == scene_i &&
          \u_dut.gen_parallel.u_control.a_i  == control_i && \u_dut.gen_parallel.u_supervisor.a_i  == supervisor_i);
      factors_are_the_word: assert (\u_dut.gen_parallel.u_velocity.b_i  == coefficient &&
          \u_dut.gen_parallel.u_dob.b_i  == coefficient &&
          \u_dut.gen_parallel.u_control.b_i  == (zero_control_i ? 18'sd0 : coefficient) && (square_distance_i ||
              \u_dut.gen_parallel.u_scene.b_i  == coefficient) &&
          (square_estimate_i || \u_dut.gen_parallel.u_supervisor.b_i  == coefficient));
      squares_are_of_their_own: assert ((!square_distance_i || \u_dut.gen_parallel.u_scene.b_i  == distance_i) &&
          (!square_estimate_i || \u_dut.gen_parallel.u_supervisor.b_i  == 18'(estimate_i)));
      products_are_their_own: assert (velocity == \u_dut.gen_parallel.u_velocity.product_o  &&
          dob == \u_dut.gen_parallel.u_dob.product_o  &&
          scene == \u_dut.gen_parallel.u_scene.product_o  && control == \u_dut.gen_parallel.u_control.product_o  &&
          supervisor == \u_dut.gen_parallel.u_supervisor.product_o );
      has_a_sign: cover (signed_i && \u_dut.gen_parallel.u_control.b_i  < 0);
    end
  end
endmodule

`default_nettype wire
