// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene: a unilateral spring-damper, tau = k * (contact - position) - b * velocity above the
// contact, and never a pull: 0 where that would be positive. Either product keeps two bits below a
// torque step; their difference is rounded and saturated.
// Latency: start in wave clock 1, operand in 3, products in 7 and 14, torque in 19 and held; 0 while
// the scene is not selected. docs/blocks/scene_wall.md

`default_nettype none

module scene_wall #(
    // 1: pulls on the way out, 2: acts on the wrong side, 3: the damper drives, 4: distance wraps,
    // 5: torque wraps, 6: truncates
    parameter int Defect = 0
) (
    input  logic                                             clk_i,
    input  logic                                             rst_ni,
    input  logic                                             select_i,
    input  logic                                             start_i,
    input  logic signed [feltgate_pkg::SCENE_POSITION_W-1:0] position_i,
    input  logic        [                              31:0] param_i,
    input  logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    output logic signed [  feltgate_pkg::SCENE_OFFSET_W-1:0] operand_o,
    output logic signed [        feltgate_pkg::TORQUE_W-1:0] tau_o
);
  localparam int Guard = feltgate_pkg::WALL_GUARD_BITS;
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int PartF = feltgate_pkg::TORQUE_F + Guard;
  localparam int OffsetW = feltgate_pkg::SCENE_OFFSET_W;
  localparam int OffsetF = feltgate_pkg::SCENE_OFFSET_F;
  localparam int GapW = feltgate_pkg::SCENE_POSITION_W + 1;
  localparam int SpringDrop = OffsetF + feltgate_pkg::P_WALL_STIFFNESS_F - PartF;
  localparam int DamperDrop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_WALL_DAMPING_F - PartF;
  // The wider product without the dropped bits, and at least two above the torque.
  localparam int SpringW = OffsetW + 17 - SpringDrop;
  localparam int DamperW = feltgate_pkg::VELOCITY_W + 17 - DamperDrop;
  localparam int WiderW = (SpringW > DamperW) ? SpringW : DamperW;
  localparam int PartW = (WiderW > TorqueW + Guard + 1) ? WiderW : TorqueW + Guard + 1;

  logic [16:0] stage_q;  // stage_q[k]: wave clock k + 2
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) stage_q <= '0;
    else stage_q <= {stage_q[15:0], start_i};
  end

  // Contact minus position. Only the whole counts are subtracted: a position has no fraction.
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

  // Spring less damper; the bit below the last one is the carry, as far as the design rounds up.
  logic signed [      PartW-1:0] spring_q, damper_q;
  logic signed [        PartW:0] sum_q;
  logic signed [PartW-Guard+1:0] rounded_q;
  logic                          carry;
  assign carry = sum_q[Guard-1] && Defect != 6 &&
                 (feltgate_pkg::ROUNDING == 0 ||
                  (feltgate_pkg::ROUNDING == 2 && (sum_q[0] || sum_q[Guard])));
  always_ff @(posedge clk_i) begin
    if (stage_q[5]) spring_q <= PartW'(product_i >>> SpringDrop);
    if (stage_q[12]) damper_q <= PartW'(product_i >>> DamperDrop);
    sum_q <= (Defect == 3) ? (PartW + 1)'(spring_q) + (PartW + 1)'(damper_q)
                           : (PartW + 1)'(spring_q) - (PartW + 1)'(damper_q);
    rounded_q <= (PartW - Guard + 2)'($signed(sum_q[PartW:Guard])) +
                 (PartW - Guard + 2)'({1'b0, carry});
  end

  // A push is negative. It saturates at the lower end, whose bits are clear like those of no torque.
  logic push, over, pressed;
  assign pressed = operand_o[OffsetW-1] != (Defect == 2);
  assign push    = select_i && pressed && (rounded_q[PartW-Guard+1] || Defect == 1);
  assign over    = rounded_q[PartW-Guard+1:TorqueW-1] != '1 && Defect != 1 && Defect != 5;
  logic               sign_q;
  logic [TorqueW-2:0] low_q;
  always_ff @(posedge clk_i) begin
    sign_q <= push && (over || rounded_q[TorqueW-1]);
    if (!push || over) low_q <= '0;
    else low_q <= rounded_q[TorqueW-2:0];
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) tau_o <= '0;
    else if (stage_q[16]) tau_o <= {sign_q, low_q};
  end

  logic unused;
  assign unused = ^param_i[31:OffsetW];
endmodule

`default_nettype wire
