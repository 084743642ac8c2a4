// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene: a viscous damper, tau = -b * velocity, not yet rounded.
// Latency: minus_o one clock after the product of velocity and damping, held; 0 while the scene is
// not selected. docs/blocks/scenes.md

`default_nettype none

module scene_damper (
    input  logic                                         clk_i,
    input  logic                                         select_i,
    input  logic                                         product_is_damper_damping_i,
    input  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    output logic signed [feltgate_pkg::SCENE_PART_W-1:0] minus_o
);
  logic signed [feltgate_pkg::SCENE_PART_W-1:0] part;
  scene_part #(
      .Fraction(feltgate_pkg::VELOCITY_F + feltgate_pkg::P_DAMPER_DAMPING_F)
  ) u_part (
      .product_i(product_i),
      .part_o(part)
  );

  always_ff @(posedge clk_i) begin
    if (!select_i) minus_o <= '0;
    else if (product_is_damper_damping_i) minus_o <= part;
  end
endmodule

`default_nettype wire
