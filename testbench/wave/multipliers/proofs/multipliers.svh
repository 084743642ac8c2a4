// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ports of both wrappers, the block, and the word on the bus.

(
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
    input logic signed [   feltgate_pkg::CURRENT_ESTIMATE_W-1:0] estimate_i,
    input logic                                                  zero_control_i
);
  logic past_ok_q;
  initial past_ok_q = 1'b0;
  always_ff @(posedge clk_i) past_ok_q <= 1'b1;

  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] velocity, dob, scene, control, supervisor;
  multipliers u_dut (
      .*,
      .velocity_product_o(velocity),
      .dob_product_o(dob),
      .scene_product_o(scene),
      .control_product_o(control),
      .supervisor_product_o(supervisor)
  );

  // The word on the bus: COEFFICIENT_BITS of it, and the next as a sign where it has one.
  logic signed [17:0] coefficient;
  assign coefficient = signed_i ? $signed(param_i[17:0]) : $signed({1'b0, param_i[16:0]});
