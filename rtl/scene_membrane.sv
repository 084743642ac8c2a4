// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene: a membrane between two faces. Inside, a constant torque drives the lever back to the side
// from which it came; it holds that sign until it is left, so it only absorbs.
// Latency: start in wave clock 1, torque in 14 and held; 0 while the scene is not selected.
// docs/blocks/scene_membrane.md

`default_nettype none

module scene_membrane #(
    // 1: sign by direction of motion, 2: upper face outside,
    // 3: fraction of the lower face dropped, 4: acts when selected inside
    parameter int Defect = 0
) (
    input  logic                                             clk_i,
    input  logic                                             rst_ni,
    input  logic                                             select_i,
    input  logic                                             start_i,
    input  logic signed [feltgate_pkg::SCENE_POSITION_W-1:0] position_i,
    input  logic        [                              31:0] param_i,
    output logic signed [        feltgate_pkg::TORQUE_W-1:0] tau_o
);
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int OffsetW = feltgate_pkg::SCENE_OFFSET_W;
  localparam int OffsetF = feltgate_pkg::SCENE_OFFSET_F;
  localparam int GapW = feltgate_pkg::SCENE_POSITION_W + 1;

  logic [11:0] stage_q;  // stage_q[k]: wave clock k + 2
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) stage_q <= '0;
    else stage_q <= {stage_q[10:0], start_i};
  end

  // Face minus position. Only the whole counts are subtracted: a position has no fraction.
  logic signed [GapW-1:0] gap, gap_q;
  logic                   fraction_q, below_q, above_q;
  assign gap = GapW'($signed(param_i[OffsetW-1:OffsetF])) - GapW'(position_i);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) gap_q <= '0;
    else if (start_i) gap_q <= gap;
  end
  always_ff @(posedge clk_i) begin
    if (start_i) fraction_q <= (param_i[OffsetF-1:0] != '0) && Defect != 3;
    if (stage_q[0]) begin
      below_q <= !gap_q[GapW-1] && (gap_q != '0 || fraction_q);
      above_q <= gap[GapW-1] || (Defect == 2 && gap == '0);
    end
  end

  // The side seen last is the side of entry.
  logic seen_q, side_q, moves, side;  // side 1: above
  if (Defect == 1) begin : gen_by_motion
    logic signed [feltgate_pkg::SCENE_POSITION_W-1:0] last_q;
    always_ff @(posedge clk_i) if (stage_q[1]) last_q <= position_i;
    assign moves = position_i != last_q;
    assign side  = position_i < last_q;
  end else begin : gen_by_side
    assign moves = below_q || above_q;
    assign side  = !below_q;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      seen_q <= 1'b0;
      side_q <= 1'b0;
    end else if (!select_i) begin
      seen_q <= (Defect == 4);
      side_q <= 1'b0;
    end else if (stage_q[1]) begin
      if (below_q || above_q) seen_q <= 1'b1;
      if (moves) side_q <= side;
    end
  end

  // A negative word counts as 0: it would drive the lever on.
  logic signed [TorqueW-1:0] word_q, plus_q, minus_q, upper_q, lower_q;
  logic                      engaged;
  assign engaged = select_i && seen_q && !below_q && !above_q;
  always_ff @(posedge clk_i) begin
    if (stage_q[8]) word_q <= param_i[TorqueW-1:0];
    if (!engaged || !side_q || word_q[TorqueW-1]) plus_q <= '0;
    else plus_q <= word_q;
    if (!engaged || side_q || word_q[TorqueW-1]) minus_q <= '0;
    else minus_q <= -word_q;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      upper_q <= '0;
      lower_q <= '0;
    end else if (stage_q[11]) begin
      upper_q <= plus_q;
      lower_q <= minus_q;
    end
  end
  assign tau_o = upper_q | lower_q;

  logic unused;
  assign unused = ^param_i[31:OffsetW];
endmodule

`default_nettype wire
