// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene: a unilateral spring-damper, tau = k * (contact - position) - b * velocity above the
// contact, not yet rounded. Both products keep the guard bits. The block scenes makes sure that the
// wall never pulls. Latency: plus_o and minus_o one clock after their products, held; 0 outside the
// wall and while the scene is not selected. docs/blocks/scenes.md

`default_nettype none

module scene_wall (
    input  logic                                         clk_i,
    input  logic                                         select_i,
    input  logic                                         behind_i,  // distance is negative
    input  logic                                         product_is_wall_stiffness_i,
    input  logic                                         product_is_wall_damping_i,
    input  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    output logic signed [feltgate_pkg::SCENE_PART_W-1:0] plus_o,    // spring
    output logic signed [feltgate_pkg::SCENE_PART_W-1:0] minus_o    // damper
);
  logic signed [feltgate_pkg::SCENE_PART_W-1:0] spring, damper;
  scene_part #(
      .Fraction(feltgate_pkg::SCENE_DISTANCE_F + feltgate_pkg::P_WALL_STIFFNESS_F),
      .Exact(0)
  ) u_spring (
      .product_i(product_i),
      .part_o(spring)
  );
  scene_part #(
      .Fraction(feltgate_pkg::VELOCITY_F + feltgate_pkg::P_WALL_DAMPING_F),
      .Exact(0)
  ) u_damper (
      .product_i(product_i),
      .part_o(damper)
  );

  // Behind the contact the spring's term is negative; if it does not fit its format, it saturates.
  localparam int W = feltgate_pkg::SCENE_PART_W;
  localparam int PartTop = feltgate_pkg::SCENE_DISTANCE_F + feltgate_pkg::P_WALL_STIFFNESS_F -
                           feltgate_pkg::SCENE_PART_F + W - 1;
  localparam int Top = (PartTop < feltgate_pkg::PRODUCT_BITS) ? PartTop : feltgate_pkg::PRODUCT_BITS - 1;
  logic negative, over;
  assign negative = product_i[feltgate_pkg::PRODUCT_BITS-1];
  assign over     = negative && product_i[feltgate_pkg::PRODUCT_BITS-1:Top] != '1;
  always_ff @(posedge clk_i) begin
    if (!select_i || !behind_i) plus_o[W-1] <= 1'b0;
    else if (product_is_wall_stiffness_i) plus_o[W-1] <= negative;
    if (!select_i || !behind_i || (product_is_wall_stiffness_i && over)) begin
      plus_o[W-2:0] <= '0;
    end else if (product_is_wall_stiffness_i) begin
      plus_o[W-2:0] <= spring[W-2:0];
    end
    if (!select_i || !behind_i) minus_o <= '0;
    else if (product_is_wall_damping_i) minus_o <= damper;
  end

  logic unused;
  assign unused = spring[W-1];
endmodule

`default_nettype wire
