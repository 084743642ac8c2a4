// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene: a spring, tau = k * (reference - position), rounded and saturated. Tension: both
// ways from the rest position. Compression: only below the contact.
// Latency: start in wave clock 1, operand in 3, product in 7, torque in 12 and held; 0 while the
// scene is not selected. docs/blocks/scene_spring.md

`default_nettype none

module scene_spring #(
    // 1: compression pushes on the wrong side, 2: wrong sign beyond the rest position,
    // 3: truncates, 4: distance wraps, 5: torque wraps
    parameter int Defect = 0
) (
    input  logic                                             clk_i,
    input  logic                                             rst_ni,
    input  logic                                             select_i,
    input  logic                                             tension_i,
    input  logic                                             start_i,
    input  logic signed [feltgate_pkg::SCENE_POSITION_W-1:0] position_i,
    input  logic        [                              31:0] param_i,
    input  logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    output logic signed [  feltgate_pkg::SCENE_OFFSET_W-1:0] operand_o,
    output logic signed [        feltgate_pkg::TORQUE_W-1:0] tau_o
);
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int TorqueF = feltgate_pkg::TORQUE_F;
  localparam int OffsetW = feltgate_pkg::SCENE_OFFSET_W;
  localparam int OffsetF = feltgate_pkg::SCENE_OFFSET_F;
  localparam int ProductW = feltgate_pkg::PRODUCT_BITS;
  localparam int GapW = feltgate_pkg::SCENE_POSITION_W + 1;
  localparam int CompressionDrop = OffsetF + feltgate_pkg::P_COMPRESSION_STIFFNESS_F - TorqueF;
  localparam int TensionDrop = OffsetF + feltgate_pkg::P_TENSION_STIFFNESS_F - TorqueF;
  localparam int LeastDrop = (CompressionDrop < TensionDrop) ? CompressionDrop : TensionDrop;
  // The product without the bits below half a torque step, and at least two above the torque.
  localparam int Significant = OffsetW + 17 - LeastDrop + 1;
  localparam int PartW = (Significant > TorqueW + 2) ? Significant : TorqueW + 2;

  logic [9:0] stage_q;  // stage_q[k]: wave clock k + 2
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) stage_q <= '0;
    else stage_q <= {stage_q[8:0], start_i};
  end

  // Reference minus position. Only the whole counts are subtracted: a position has no fraction.
  logic signed [   GapW-1:0] gap, gap_q;
  logic        [OffsetF-1:0] fraction_q;
  logic                      far;
  assign gap = GapW'($signed(param_i[OffsetW-1:OffsetF])) - GapW'(position_i);
  assign far = gap_q[GapW-1] != gap_q[GapW-2] && Defect != 4;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) gap_q <= '0;
    else if (start_i) gap_q <= gap;
  end
  always_ff @(posedge clk_i) if (start_i) fraction_q <= param_i[OffsetF-1:0];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) operand_o <= '0;
    else if (stage_q[0]) begin
      operand_o <= far ? {gap_q[GapW-1], {(OffsetW - 1) {~gap_q[GapW-1]}}}
                       : {gap_q[GapW-2:0], fraction_q};
    end
  end

  // The bit below the last one is the carry, as far as the design rounds up.
  logic signed [  PartW-1:0] part_q;
  logic signed [TorqueW  :0] rounded_q;
  logic                      part_over_q, negative_q, beyond_half_q, carry;
  localparam logic [ProductW-1:0] CompressionBelow =
      (ProductW'(1) << (CompressionDrop - 1)) - ProductW'(1);
  localparam logic [ProductW-1:0] TensionBelow =
      (ProductW'(1) << (TensionDrop - 1)) - ProductW'(1);
  assign carry = part_q[0] && Defect != 3 &&
                 (feltgate_pkg::ROUNDING == 0 ||
                  (feltgate_pkg::ROUNDING == 2 && (beyond_half_q || part_q[1])));
  always_ff @(posedge clk_i) begin
    if (stage_q[5]) begin
      part_q <= tension_i ? PartW'(product_i >>> (TensionDrop - 1))
                          : PartW'(product_i >>> (CompressionDrop - 1));
      beyond_half_q <= (product_i & (tension_i ? TensionBelow : CompressionBelow)) != '0;
    end
    rounded_q   <= part_q[TorqueW+1:1] + (TorqueW + 1)'({1'b0, carry});
    part_over_q <= part_q[PartW-1:TorqueW+1] != {(PartW - TorqueW - 1) {part_q[PartW-1]}};
    negative_q  <= part_q[PartW-1];
  end

  // Saturation, one end per clock: clearing and setting registers costs no logic.
  logic over, off;
  assign over = (part_over_q || rounded_q[TorqueW] != rounded_q[TorqueW-1]) && Defect != 5;
  assign off  = !select_i || (!tension_i && operand_o[OffsetW-1] != (Defect == 1));
  logic sign_q, sign_q2, high_q;
  logic [TorqueW-2:0] low_q, low_q2;
  always_ff @(posedge clk_i) begin
    sign_q <= !off && (over ? negative_q : rounded_q[TorqueW-1]);
    high_q <= !off && over && !negative_q;
    if (off || (over && negative_q)) low_q <= '0;
    else low_q <= rounded_q[TorqueW-2:0];
    sign_q2 <= sign_q;
    if (high_q) low_q2 <= '1;
    else low_q2 <= low_q;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) tau_o <= '0;
    else if (stage_q[9]) begin
      tau_o <= (Defect == 2 && tension_i && operand_o[OffsetW-1]) ? -{sign_q2, low_q2}
                                                                  : {sign_q2, low_q2};
    end
  end

  logic unused;
  assign unused = ^param_i[31:OffsetW];
endmodule

`default_nettype wire
