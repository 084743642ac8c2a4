// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Trips if the velocity changes in one tick by more than its low-pass can, whatever its
// coefficient: then the hardware is faulty. |a1 * (x - y)| < 2^(W + 17 - F) LSB for all x, y of W
// bits and every word a1 of 17 bits with F fraction bits. So the bits from that weight up change by
// at most one. Latency: trip_o in the clock after EVENT_AT_JUMP. docs/blocks/velocity.md

`default_nettype none

module velocity_jump (
    input  logic                                            clk_i,
    input  logic                                            rst_ni,
    input  logic                                            at_jump_i,
    input  logic signed [     feltgate_pkg::VELOCITY_W-1:0] velocity_i,
    output logic                                            trip_o
);
  localparam int W = feltgate_pkg::VELOCITY_W;
  localparam int Weight = W + feltgate_pkg::COEFFICIENT_BITS - feltgate_pkg::P_VELOCITY_A1_F;

  generate
  if (Weight >= 0 && Weight <= W - 2) begin : gen_compare
    localparam int TopW = W - Weight;
    logic signed [TopW-1:0] before_q;
    // slow: moved is -1, 0 or 1. All bits but the lowest are equal in -2..1; -2 is excluded.
    logic signed [TopW  :0] moved;
    logic                   slow;
    assign moved = (TopW + 1)'($signed(velocity_i[W-1:Weight])) - (TopW + 1)'(before_q);
    assign slow = moved[TopW:1] == {TopW{moved[TopW]}} && !(moved[TopW] && !moved[0]);
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        before_q <= '0;
        trip_o   <= 1'b0;
      end else begin
        trip_o <= at_jump_i && !slow;
        if (at_jump_i) before_q <= $signed(velocity_i[W-1:Weight]);
      end
    end
    logic unused;
    assign unused = ^velocity_i;
  end else begin : gen_none  // the filter may change by its whole range
    logic unused;
    assign unused = ^{clk_i, rst_ni, at_jump_i, velocity_i};
    assign trip_o = 1'b0;
  end
  endgenerate
endmodule

`default_nettype wire
