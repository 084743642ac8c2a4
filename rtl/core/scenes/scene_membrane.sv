// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene: a membrane between two faces. Inside, a constant torque drives the lever back to the side
// from which it came. The sign stays until the lever is outside again, so the membrane only absorbs
// energy. Latency: plus_o or minus_o one clock after the torque's word, held; 0 while the scene is
// not selected. docs/blocks/scenes.md

`default_nettype none

module scene_membrane (
    input  logic                                     clk_i,
    input  logic                                     rst_ni,
    input  logic                                     select_i,
    input  logic                                     distance_positive_i,  // lower face above the position, a clock after its word
    input  logic                                     gap_negative_i,  // sign of face - position
    input  logic                                     param_is_membrane_upper_i,
    input  logic                                     param_was_membrane_upper_i,
    input  logic                                     param_is_membrane_torque_i,
    input  logic        [                      31:0] param_i,
    output logic signed [feltgate_pkg::TORQUE_W-1:0] plus_o,   // lever came from above
    output logic signed [feltgate_pkg::TORQUE_W-1:0] minus_o   // lever came from below
);
  localparam int W = feltgate_pkg::TORQUE_W;

  logic below_q, above_q;
  always_ff @(posedge clk_i) begin
    if (param_is_membrane_upper_i) begin
      below_q <= distance_positive_i;
      above_q <= gap_negative_i;
    end
  end

  // The side on which the lever was last outside is the side of entry.
  logic seen_q, side_q;  // side 1: above
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      seen_q <= 1'b0;
      side_q <= 1'b0;
    end else if (!select_i) begin
      seen_q <= 1'b0;
    end else if (param_was_membrane_upper_i && (below_q || above_q)) begin
      seen_q <= 1'b1;
      side_q <= above_q && !below_q;
    end
  end

  // A negative torque word counts as 0: it would drive the lever further in.
  logic engaged, refused;
  assign engaged = select_i && seen_q && !below_q && !above_q;
  assign refused = param_is_membrane_torque_i && param_i[W-1];
  always_ff @(posedge clk_i) begin
    if (!engaged || !side_q || refused) plus_o <= '0;
    else if (param_is_membrane_torque_i) plus_o <= param_i[W-1:0];
    if (!engaged || side_q || refused) minus_o <= '0;
    else if (param_is_membrane_torque_i) minus_o <= param_i[W-1:0];
  end
endmodule

`default_nettype wire
