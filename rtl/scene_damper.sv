// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene: a damper, tau = -b * velocity; the product is rounded, then negated, then saturated. The
// core puts the velocity on the multiplier's bus in clock 10 of the wave.
// Latency: start in wave clock 1, product in 14, torque in 19 and held; 0 while the scene is not
// selected. docs/blocks/scene_damper.md

`default_nettype none

module scene_damper #(
    parameter int Defect = 0  // 1: drives instead of damping, 2: truncates, 3: wraps
) (
    input  logic                                         clk_i,
    input  logic                                         rst_ni,
    input  logic                                         select_i,
    input  logic                                         start_i,
    input  logic signed [feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    output logic signed [    feltgate_pkg::TORQUE_W-1:0] tau_o
);
  localparam int ProductW = feltgate_pkg::PRODUCT_BITS;
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int Drop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_DAMPER_DAMPING_F -
                        feltgate_pkg::TORQUE_F;
  // The product without the bits below half a torque step, and at least two above the torque.
  localparam int Significant = feltgate_pkg::VELOCITY_W + 17 - Drop + 1;
  localparam int PartW = (Significant > TorqueW + 2) ? Significant : TorqueW + 2;

  logic [16:0] stage_q;  // stage_q[k]: wave clock k + 2
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) stage_q <= '0;
    else stage_q <= {stage_q[15:0], start_i};
  end

  // -(p + half) = -half - p, -half being all ones or none: one subtraction.
  logic signed [  PartW-1:0] part_q;
  logic signed [TorqueW  :0] rounded_q;
  logic                      part_over_q, negative_q, beyond_half_q, up, half;
  localparam logic [ProductW-1:0] Below = (ProductW'(1) << (Drop - 1)) - ProductW'(1);
  assign up   = feltgate_pkg::ROUNDING == 0 ||
                (feltgate_pkg::ROUNDING == 2 && (beyond_half_q || part_q[1]));
  assign half = part_q[0] && up && Defect != 2;
  always_ff @(posedge clk_i) begin
    if (stage_q[12]) begin
      part_q        <= PartW'(product_i >>> (Drop - 1));
      beyond_half_q <= (product_i & Below) != '0;
    end
    rounded_q   <= (Defect == 1) ? part_q[TorqueW+1:1] + (TorqueW + 1)'({1'b0, part_q[0] && up})
                                 : {(TorqueW + 1) {half}} - part_q[TorqueW+1:1];
    part_over_q <= part_q[PartW-1:TorqueW+1] != {(PartW - TorqueW - 1) {part_q[PartW-1]}};
    negative_q  <= part_q[PartW-1] == (Defect == 1);
  end

  // Saturation, one end per clock: clearing and setting registers costs no logic.
  logic over;
  assign over = (part_over_q || rounded_q[TorqueW] != rounded_q[TorqueW-1]) && Defect != 3;
  logic sign_q, sign_q2, high_q;
  logic [TorqueW-2:0] low_q, low_q2;
  always_ff @(posedge clk_i) begin
    sign_q <= select_i && (over ? negative_q : rounded_q[TorqueW-1]);
    high_q <= select_i && over && !negative_q;
    if (!select_i || (over && negative_q)) low_q <= '0;
    else low_q <= rounded_q[TorqueW-2:0];
    sign_q2 <= sign_q;
    if (high_q) low_q2 <= '1;
    else low_q2 <= low_q;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) tau_o <= '0;
    else if (stage_q[16]) tau_o <= {sign_q2, low_q2};
  end
endmodule

`default_nettype wire
