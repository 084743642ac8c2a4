// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene: a point charge at a fixed position, tau = -+strength * sgn(x) / x^2 outside a linear core
// and -+slope * x inside it (upper sign attracts). The division is an integer one: floor, 16 bits,
// saturating; one quotient bit per clock.
// Latency: start in wave clock 1, operand in 3, x^2 in 7, torque in 25 and held; 0 while the scene
// is not selected. docs/blocks/scene_charge.md

`default_nettype none

module scene_charge #(
    // 1: divider one iteration short, 2: x = 0 not saturated, 3: sign at x = 0,
    // 4: core border inclusive on one side, 5: core repels when it attracts, 6: distance wraps,
    // 7: quotient wraps
    parameter int Defect = 0
) (
    input  logic                                             clk_i,
    input  logic                                             rst_ni,
    input  logic                                             select_i,
    input  logic                                             attract_i,
    input  logic                                             start_i,
    input  logic signed [feltgate_pkg::SCENE_POSITION_W-1:0] position_i,
    input  logic        [                              31:0] param_i,
    input  logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    output logic signed [  feltgate_pkg::SCENE_OFFSET_W-1:0] operand_o,
    output logic signed [        feltgate_pkg::TORQUE_W-1:0] tau_o
);
  localparam int ProductW = feltgate_pkg::PRODUCT_BITS;
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int TorqueF = feltgate_pkg::TORQUE_F;
  localparam int ChargeF = feltgate_pkg::CHARGE_F;
  localparam int OffsetW = feltgate_pkg::SCENE_OFFSET_W;
  localparam int OffsetF = feltgate_pkg::SCENE_OFFSET_F;
  localparam int PositionW = feltgate_pkg::SCENE_POSITION_W;
  localparam int GapW = PositionW + 1;
  localparam int ForceW = 17;  // both laws give [1,0,ChargeF]
  localparam int Up = (TorqueF > ChargeF) ? TorqueF - ChargeF : 0;
  localparam int Down = (TorqueF < ChargeF) ? ChargeF - TorqueF : 0;
  localparam int AttractDrop = OffsetF + feltgate_pkg::P_ATTRACT_CORE_SLOPE_F - ChargeF;
  localparam int RepelDrop = OffsetF + feltgate_pkg::P_REPEL_CORE_SLOPE_F - ChargeF;
  localparam int LeastDrop = (AttractDrop < RepelDrop) ? AttractDrop : RepelDrop;
  localparam int Significant = OffsetW + 17 - LeastDrop + 1;
  localparam int PartW = (Significant > ForceW + 2) ? Significant : ForceW + 2;

  logic [22:0] stage_q;  // stage_q[k]: wave clock k + 2
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) stage_q <= '0;
    else stage_q <= {stage_q[21:0], start_i};
  end

  // Centre minus position, that is -x. The centre's fraction is ignored.
  logic signed [     GapW-1:0] gap, gap_q;
  logic signed [PositionW-1:0] distance_q;
  logic                        far, ahead_q, minus;
  assign gap = GapW'($signed(param_i[OffsetW-1:OffsetF])) - GapW'(position_i);
  assign far = gap_q[GapW-1] != gap_q[GapW-2] && Defect != 6;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) gap_q <= '0;
    else if (start_i) gap_q <= gap;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) distance_q <= '0;
    else if (stage_q[0]) begin
      distance_q <= far ? {gap_q[GapW-1], {(PositionW - 1) {~gap_q[GapW-1]}}} : gap_q[GapW-2:0];
    end
  end
  assign operand_o = {distance_q, {OffsetF{1'b0}}};
  // sgn(0) is +1.
  always_ff @(posedge clk_i) begin
    if (stage_q[0]) ahead_q <= !gap_q[GapW-1] && (gap_q != '0 || Defect == 3);
  end
  assign minus = attract_i != ahead_q;

  // Restoring division of the 32-bit strength by x^2. Its upper bits preset the remainder.
  logic [14:0] preset_q;
  logic [16:0] rest_q;
  logic [30:0] remainder_q;
  logic [31:0] square_q;
  logic [32:0] difference;
  logic        busy_q, bring, bring_q, huge_q, fits, saturated_q, quotient_bit;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) busy_q <= 1'b0;  // clocks 8 to 24
    else busy_q <= stage_q[5] || (busy_q && !stage_q[22]);
  end
  // The next bit of the strength, chosen a clock ahead.
  assign bring = (rest_q & stage_q[21:5]) != '0;
  always_ff @(posedge clk_i) bring_q <= bring;
  assign difference   = {1'b0, remainder_q, bring_q} - {1'b0, square_q};
  assign fits         = !difference[32] && !huge_q && !(Defect == 2 && square_q == '0);
  assign quotient_bit = fits || saturated_q;
  always_ff @(posedge clk_i) begin
    if (stage_q[0]) preset_q <= param_i[31:17];
    else preset_q <= '0;
    if (stage_q[0]) begin
      for (int k = 0; k < 17; k++) rest_q[k] <= param_i[16-k];  // the highest comes first
    end
    if (stage_q[5]) square_q <= product_i[31:0];
    if (stage_q[5]) huge_q <= product_i[34:32] != '0;
    if (stage_q[0]) remainder_q <= '0;
    else if (stage_q[1] || busy_q) begin
      remainder_q <= (fits ? difference[30:0] : {remainder_q[29:0], bring_q}) | 31'(preset_q);
    end
    if (stage_q[6]) saturated_q <= fits && Defect != 7;
  end

  // Quotient with its sign, most significant bit first: -(2q + 1) = 2 * ~q + 1.
  logic        [      15:0] quotient_q;
  logic signed [ForceW-1:0] outside_q;
  logic                     near_q, keep, shift;
  assign keep  = select_i && !near_q && !stage_q[6];
  assign shift = busy_q && !(Defect == 1 && stage_q[22]);
  always_ff @(posedge clk_i) begin
    if (stage_q[6]) quotient_q <= '0;
    else if (shift) quotient_q <= {quotient_q[14:0], quotient_bit};
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) outside_q <= '0;
    else if (shift) begin
      if (!keep) outside_q <= '0;
      else outside_q <= {(quotient_bit && minus) ? ~quotient_q : outside_q[ForceW-2:0], quotient_bit};
    end
  end

  // Core: |x| < half-width.
  logic signed [20:0] sum_q;
  logic               below_q, wide_q;
  logic signed [20:0] width;
  assign width = 21'($signed({1'b0, param_i[17:0]}));
  always_ff @(posedge clk_i) begin
    if (stage_q[10]) begin
      below_q <= 21'(distance_q) < width;
      sum_q   <= 21'(distance_q) + width;
      wide_q  <= param_i[30:18] != '0;
    end
    if (start_i) near_q <= 1'b0;
    else if (stage_q[11]) begin
      near_q <= wide_q || (below_q && !sum_q[20] && (sum_q != '0 || Defect == 4));
    end
  end

  // slope * -x, rounded; negated when the charge repels: -(p + half) = ~p + !half.
  logic signed [ PartW-1:0] part_q;
  logic signed [ForceW  :0] rounded_q;
  logic                     part_over_q, negative_q, beyond_half_q, invert, half;
  localparam logic [ProductW-1:0] AttractBelow =
      (ProductW'(1) << (AttractDrop - 1)) - ProductW'(1);
  localparam logic [ProductW-1:0] RepelBelow = (ProductW'(1) << (RepelDrop - 1)) - ProductW'(1);
  assign half = part_q[0] && (feltgate_pkg::ROUNDING == 0 ||
                              (feltgate_pkg::ROUNDING == 2 && (beyond_half_q || part_q[1])));
  assign invert = !attract_i && Defect != 5;
  always_ff @(posedge clk_i) begin
    if (stage_q[8]) begin
      part_q <= attract_i ? PartW'(product_i >>> (AttractDrop - 1))
                          : PartW'(product_i >>> (RepelDrop - 1));
      beyond_half_q <= (product_i & (attract_i ? AttractBelow : RepelBelow)) != '0;
    end
    if (stage_q[9]) begin
      rounded_q   <= (part_q[ForceW+1:1] ^ {(ForceW + 1) {invert}}) +
                     (ForceW + 1)'({1'b0, half != invert});
      part_over_q <= part_q[PartW-1:ForceW+1] != {(PartW - ForceW - 1) {part_q[PartW-1]}};
      negative_q  <= part_q[PartW-1] != invert;
    end
  end

  // Saturation, one end per clock: clearing and setting registers costs no logic.
  logic over, off;
  assign over = part_over_q || rounded_q[ForceW] != rounded_q[ForceW-1];
  assign off  = !select_i || !near_q;
  logic sign_q, sign_q2, high_q;
  logic [ForceW-2:0] low_q, low_q2;
  always_ff @(posedge clk_i) begin
    sign_q <= !off && (over ? negative_q : rounded_q[ForceW-1]);
    high_q <= !off && over && !negative_q;
    if (off || (over && negative_q)) low_q <= '0;
    else low_q <= rounded_q[ForceW-2:0];
    sign_q2 <= sign_q;
    if (high_q) low_q2 <= '1;
    else low_q2 <= low_q;
  end
  logic signed [ForceW-1:0] inside_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) inside_q <= '0;
    else if (stage_q[14]) inside_q <= {sign_q2, low_q2};
  end
  localparam int WideW = (TorqueW > ForceW) ? TorqueW : ForceW;
  logic signed [WideW-1:0] either, torque;
  assign either = WideW'($signed(outside_q | inside_q));
  assign torque = (either <<< Up) >>> Down;
  assign tau_o  = torque[TorqueW-1:0];

  logic unused;
  assign unused = ^{param_i[31], difference[31], torque, product_i[feltgate_pkg::PRODUCT_BITS-1:35]};
endmodule

`default_nettype wire
