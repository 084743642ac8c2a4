// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Either one multiplier on the operand bus, or one multiplier per block with the same timing. For a
// square the factor is the operand itself; it does not come from the parameter bus.
// Latency: that of mult, 4 clocks. In one clock either square_*_i or the parameter is the factor, or zero_control_i
// makes it 0.
// Documentation: docs/architecture.md

`default_nettype none

module multipliers (
    input  logic                                                  clk_i,
    input  logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] operand_i,  // the whole bus
    input  logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] velocity_i,
    input  logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] dob_i,
    input  logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] scene_i,
    input  logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] control_i,
    input  logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] supervisor_i,
    input  logic                                                  signed_i,  // param_i is signed
    input  logic        [                                   31:0] param_i,
    input  logic                                                  square_distance_i,
    input  logic signed [                                   17:0] distance_i,  // one of them is 0
    input  logic                                                  square_estimate_i,
    input  logic signed [   feltgate_pkg::CURRENT_ESTIMATE_W-1:0] estimate_i,
    input  logic                                                  zero_control_i,  // the control's product is 0
    output logic signed [         feltgate_pkg::PRODUCT_BITS-1:0] velocity_product_o,
    output logic signed [         feltgate_pkg::PRODUCT_BITS-1:0] dob_product_o,
    output logic signed [         feltgate_pkg::PRODUCT_BITS-1:0] scene_product_o,
    output logic signed [         feltgate_pkg::PRODUCT_BITS-1:0] control_product_o,
    output logic signed [         feltgate_pkg::PRODUCT_BITS-1:0] supervisor_product_o
);
  logic signed [17:0] coefficient, supervisor_factor;
  assign coefficient = 18'($signed({param_i[feltgate_pkg::COEFFICIENT_BITS] && signed_i,
                                    param_i[feltgate_pkg::COEFFICIENT_BITS-1:0]}));
  assign supervisor_factor = 18'(estimate_i);  // 0 outside its clock

  generate
  if (feltgate_pkg::PARALLEL_MULTIPLIERS == 0) begin : gen_shared
    logic signed [feltgate_pkg::PRODUCT_BITS-1:0] product;
    mult u_mult (
        .clk_i(clk_i),
        .a_i(operand_i),
        .b_i((square_distance_i || square_estimate_i || zero_control_i) ? distance_i | supervisor_factor : coefficient),
        .product_o(product)
    );
    assign velocity_product_o   = product;
    assign dob_product_o        = product;
    assign scene_product_o      = product;
    assign control_product_o    = product;
    assign supervisor_product_o = product;
    logic unused;
    assign unused = ^{velocity_i, dob_i, scene_i, control_i, supervisor_i, param_i};
  end else begin : gen_parallel
    // One multiplier per block, same timing: no operand uses the core's operand bus.
    mult u_velocity (
        .clk_i(clk_i),
        .a_i(feltgate_pkg::MULTIPLIER_A_BITS'(velocity_i)),
        .b_i(coefficient),
        .product_o(velocity_product_o)
    );
    mult u_dob (
        .clk_i(clk_i),
        .a_i(dob_i),
        .b_i(coefficient),
        .product_o(dob_product_o)
    );
    mult u_scene (
        .clk_i(clk_i),
        .a_i(scene_i),
        .b_i(square_distance_i ? distance_i : coefficient),
        .product_o(scene_product_o)
    );
    mult u_control (
        .clk_i(clk_i),
        .a_i(control_i),
        .b_i(zero_control_i ? 18'sd0 : coefficient),
        .product_o(control_product_o)
    );
    mult u_supervisor (
        .clk_i(clk_i),
        .a_i(supervisor_i),
        .b_i(square_estimate_i ? supervisor_factor : coefficient),
        .product_o(supervisor_product_o)
    );
    logic unused;
    assign unused = ^{operand_i, param_i};
  end
  endgenerate
endmodule

`default_nettype wire
