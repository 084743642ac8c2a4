// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two filters with one input, one state and products in order. A product is any number between 0 and the
// operand times the largest coefficient: all that is needed of a multiplier is its sign and size.
`default_nettype none

module step_proof (
    input logic                                       clk_i,
    input logic                                       rst_ni,
    input logic                                       valid_i,
    input logic                                       update_i,
    input logic                                       follow_i,
    input logic signed [                        63:0] input_i,
    input logic signed [feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input logic signed [feltgate_pkg::PRODUCT_BITS-1:0] larger_i
);
`ifdef OBSERVER
  localparam int W = feltgate_pkg::OBSERVER_W;
  localparam int OperandW = feltgate_pkg::OBSERVER_DIFFERENCE_W;
  localparam int Drop = feltgate_pkg::OBSERVER_DIFFERENCE_F + feltgate_pkg::P_OBSERVER_A1_F -
                        feltgate_pkg::OBSERVER_F;
`else
  localparam int W = feltgate_pkg::VELOCITY_W;
  localparam int OperandW = feltgate_pkg::VELOCITY_DIFFERENCE_W;
  localparam int Drop = feltgate_pkg::VELOCITY_DIFFERENCE_F + feltgate_pkg::P_VELOCITY_A1_F -
                        feltgate_pkg::VELOCITY_F;
`endif
  localparam int ProductW = feltgate_pkg::PRODUCT_BITS;
  localparam int Given = W + 1 - OperandW;  // bits of the difference that are given up
  localparam int Wide = 64;

  `include "reset.svh"

  logic signed [       W-1:0] x, y, y_larger;
  logic signed [OperandW-1:0] operand, unused_operand;
  assign x = input_i[W-1:0];
  lowpass #(
      .Width(W),
      .OperandW(OperandW),
      .ProductDrop(Drop),
      .ProductW(ProductW)
  ) u_dut (
      .*,
      .x_i(x),
      .operand_o(operand),
      .y_o(y)
  );
  lowpass #(
      .Width(W),
      .OperandW(OperandW),
      .ProductDrop(Drop),
      .ProductW(ProductW)
  ) u_larger (
      .*,
      .x_i(x),
      .operand_o(unused_operand),
      .product_i(larger_i),
      .y_o(y_larger)
  );

  // The input stays away from the ends of the format by what the operand gives up.
  logic signed [Wide-1:0] most;
  (* anyconst *) logic signed [W-1:0] bound;
  assign most = (Wide'(1) <<< (W - 1)) - (Wide'(1) <<< Given);
  logic signed [Wide-1:0] difference, given;
  assign difference = Wide'(x) - Wide'(y);
  assign given      = difference >>> Given;
  always_comb begin
    assume (bound >= 0 && Wide'(bound) <= most);
    assume (x <= bound && x >= -bound);
    if (difference >= 0) assume (product_i >= 0 && Wide'(product_i) <= (given <<< 17));
    else assume (product_i <= 0 && Wide'(product_i) >= (given <<< 17));
    assume (larger_i >= product_i);
    if (difference >= 0) assume (Wide'(larger_i) <= (given <<< 17));
    else assume (larger_i <= 0);
  end

  logic                    after_q, updated_q, followed_q, had_valid_q;
  logic signed [Wide-1:0]  x_q, y_q, y_larger_q, product_q, given_q;
  always_ff @(posedge clk_i) begin
    updated_q   <= update_i;
    followed_q  <= follow_i;
    had_valid_q <= valid_i;
    x_q         <= Wide'(x);
    y_q         <= Wide'(y);
    y_larger_q  <= Wide'(y_larger);
    product_q   <= Wide'(product_i);
    given_q     <= given;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end

  logic signed [Wide-1:0] now, error, half, slack;
  logic                   filtered;
  assign now      = Wide'(y);
  assign half     = Wide'(1) <<< (Drop - 1);
  assign error    = ((now - y_q) <<< Drop) - product_q;
  assign slack    = (Wide'(1) <<< Given) - 1;
  assign filtered = after_q && updated_q && !followed_q;
  always_comb begin
    if (rst_ni && past_ok_q) begin
      error_is_half_a_step: assert (!filtered || (error <= half && error > -half));
      stays_between: assert (!filtered || (x_q >= y_q ? now >= y_q && now <= x_q :
                                           now <= y_q && now >= x_q - slack));
      dead_band: assert (!filtered || product_q >= half || product_q < -half || now == y_q);
      monotone: assert (!filtered || y_q != y_larger_q || Wide'(y_larger) >= now);
      follows: assert (!after_q || !updated_q || !followed_q || now == x_q);
      held: assert (!after_q || updated_q || now == y_q);
      state_within_inputs: assert (now <= Wide'(bound) && now >= 0 - Wide'(bound) - slack);
      operand_is_difference: assert (!after_q || Wide'(operand) == (had_valid_q ? given_q : 0));
      up: cover (filtered && now > y_q);
      down: cover (filtered && now < y_q && y_q < 0);
      dead: cover (filtered && product_q > 0 && now == y_q && y_q > 0);
    end
  end
endmodule

`default_nettype wire
