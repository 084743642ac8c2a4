// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Converts a product to one term of a scene's torque: it drops the bits below the guard bits. If
// the design rounds to even and the term is Exact, the lowest guard bit is set when any dropped bit
// was set (sticky bit). The later rounding then gives the same result as for the whole product.
// Combinational. docs/blocks/scenes.md

`default_nettype none

module scene_part #(
    parameter int Fraction = 30,  // fraction bits of the product
    parameter int Exact    = 1
) (
    input  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    output logic signed [feltgate_pkg::SCENE_PART_W-1:0] part_o
);
  localparam int W = feltgate_pkg::SCENE_PART_W;
  localparam int Drop = Fraction - feltgate_pkg::SCENE_PART_F;

  logic signed [W-1:0] whole;
  logic                rest;
  assign whole = W'(product_i >>> Drop);
  generate
  if (Exact != 0 && feltgate_pkg::ROUNDING == 2) begin : gen_rest
    localparam logic [feltgate_pkg::PRODUCT_BITS-1:0] Below =
        (feltgate_pkg::PRODUCT_BITS'(1) << Drop) - feltgate_pkg::PRODUCT_BITS'(1);
    assign rest = (product_i & Below) != '0;
  end else begin : gen_no_rest
    assign rest = 1'b0;
  end
  endgenerate
  assign part_o = {whole[W-1:1], whole[0] || rest};
endmodule

`default_nettype wire
