// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene: a spring, tau = k * (reference - position), not yet rounded. Tension acts on both sides of
// the rest position, compression only below the contact.
// Latency: plus_o one clock after the product of distance and stiffness, held; 0 while the scene is
// not selected. docs/blocks/scenes.md

`default_nettype none

module scene_spring (
    input  logic                                         clk_i,
    input  logic                                         tension_i,      // selects; at most one
    input  logic                                         compression_i,
    input  logic                                         behind_i,       // distance is negative
    input  logic                                         product_is_scene_stiffness_i,
    input  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    output logic signed [feltgate_pkg::SCENE_PART_W-1:0] plus_o
);
  logic signed [feltgate_pkg::SCENE_PART_W-1:0] part;
  scene_part #(
      .Fraction(feltgate_pkg::SCENE_DISTANCE_F + feltgate_pkg::P_COMPRESSION_STIFFNESS_F)
  ) u_part (
      .product_i(product_i),
      .part_o(part)
  );

  always_ff @(posedge clk_i) begin
    if (!tension_i && (!compression_i || behind_i)) plus_o <= '0;
    else if (product_is_scene_stiffness_i) plus_o <= part;
  end
endmodule

`default_nettype wire
