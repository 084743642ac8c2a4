// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene: a point charge at a fixed position, tau = -+strength * sgn(x) / x^2 outside a linear core
// and -+slope * x inside it (upper sign attracts). The division is an integer one: floor, 16 bits,
// saturating; one quotient bit per clock.
// Latency: plus_o or minus_o (inside the core, not yet rounded) two clocks after their product,
// held. outside_o (a final torque) in the clock of the torque limit's word; before, it shows the
// quotient's first bits. All are 0 while the scene is not selected. docs/blocks/scenes.md

`default_nettype none

module scene_charge (
    input  logic                                            clk_i,
    input  logic                                            rst_ni,
    input  logic                                            armed_i,
    input  logic                                            attract_i,  // selects, attracting
    input  logic                                            repel_i,    // selects, repelling
    input  logic                                            distance_positive_i,  // the centre is above the position; with the strength
    input  logic        [                             17:0] division_i,  // one-hot clocks: the square on product_i, 17 of the divider
    input  logic                                            at_scene_distance_i,
    input  logic                                            param_is_attract_strength_i,
    input  logic                                            param_was_attract_strength_i,
    input  logic                                            at_charge_width_limited_i,
    input  logic                                            at_charge_core_i,
    input  logic                                            product_is_attract_core_slope_i,
    input  logic                                            product_is_repel_core_slope_i,
    input  logic                                            after_charge_core_i,
    input  logic        [                             31:0] param_i,
    input  logic signed [   feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input  logic                                            over_limit_i,   // from the limiter
    output logic signed [   feltgate_pkg::SCENE_PART_W-1:0] plus_o,
    output logic signed [   feltgate_pkg::SCENE_PART_W-1:0] minus_o,
    output logic signed [       feltgate_pkg::TORQUE_W-1:0] outside_o,      // the size of the torque
    output logic                                            outside_not_o,  // the torque is negative: ~outside_o
    output logic                                            outside_up_o    // + 1
);
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int TorqueF = feltgate_pkg::TORQUE_F;
  localparam int ChargeF = feltgate_pkg::CHARGE_F;
  localparam int DistanceF = feltgate_pkg::SCENE_DISTANCE_F;
  localparam int ForceW = 17;  // the quotient with its sign, [1,0,ChargeF]
  localparam int Up = (TorqueF > ChargeF) ? TorqueF - ChargeF : 0;
  localparam int Down = (TorqueF < ChargeF) ? ChargeF - TorqueF : 0;
  localparam logic [ForceW-2:0] Dropped = ((ForceW - 1)'(1) << Down) - (ForceW - 1)'(1);
  localparam int Last = 17;  // last clock of the divider

  logic select, minus_q;
  assign select = attract_i || repel_i;

  // Restoring division of the 32-bit strength by x^2. The strength's upper bits preset the
  // remainder. A square of more than 32 bits never fits, so the quotient is 0. The same holds for a
  // distance beyond 18 bits: one factor wraps to the other sign and the product is negative. If the
  // square fits in the first clock, the quotient saturates: nothing is subtracted, and the square
  // becomes 0, which fits in every later clock.
  logic [14:0] preset_q;
  logic [16:0] rest_q;
  logic [30:0] remainder_q;
  logic [32:0] square_q;
  logic [33:0] difference;
  logic        busy_q, bring_q, fits, takes_q, saturated_q, huge;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) busy_q <= 1'b0;
    else busy_q <= division_i[0] || (busy_q && !division_i[Last]);
  end
  // The strength's next bit, selected one clock ahead.
  always_ff @(posedge clk_i) bring_q <= (rest_q & division_i[16:0]) != '0;
  assign difference = {2'b0, remainder_q, bring_q} - {1'b0, square_q};
  assign fits       = !difference[33];
  assign huge       = product_i[DistanceF+34:DistanceF+32] != '0;
  always_ff @(posedge clk_i) begin
    if (param_is_attract_strength_i) preset_q <= param_i[31:17];
    else preset_q <= '0;
    if (param_is_attract_strength_i) begin
      for (int k = 0; k < 17; k++) rest_q[k] <= param_i[16-k];  // the highest comes first
      minus_q <= attract_i != distance_positive_i;  // sgn(0) is +1
    end
    takes_q     <= !division_i[0];
    saturated_q <= division_i[1] && fits;
    if (saturated_q) square_q <= '0;
    else if (division_i[0]) square_q <= {huge, product_i[DistanceF+:32]};
    if (param_is_attract_strength_i) remainder_q <= '0;
    else if (param_was_attract_strength_i || busy_q) begin
      remainder_q <= (fits && takes_q ? difference[30:0] : {remainder_q[29:0], bring_q}) | 31'(preset_q);
    end
  end

  // The quotient, most significant bit first. It is valid for one clock. The limiter gives it its sign.
  logic [ForceW-2:0] outside_q;
  logic              near_q;
  always_ff @(posedge clk_i) begin
    if (!armed_i || !select || near_q || !busy_q || division_i[1]) begin
      outside_q     <= '0;
      outside_not_o <= 1'b0;
    end else begin
      outside_q     <= {outside_q[ForceW-3:0], fits};
      outside_not_o <= minus_q;
    end
  end
  localparam int WideW = (TorqueW > ForceW) ? TorqueW : ForceW;
  logic [WideW-1:0] torque;
  assign torque       = (WideW'(outside_q) << Up) >> Down;
  assign outside_o    = torque[TorqueW-1:0];
  assign outside_up_o = outside_not_o && (outside_q & Dropped) == '0;

  // Core: |x| <= half-width; the limiter compares them. A half-width of 0 means no core.
  logic none_q;
  always_ff @(posedge clk_i) begin
    if (at_charge_width_limited_i) begin
      none_q <= param_i[feltgate_pkg::LIMITER_W-1:0] == '0;
    end
    if (at_scene_distance_i) near_q <= 1'b0;
    else if (at_charge_core_i) near_q <= !over_limit_i && !none_q;
  end

  // slope * -x attracts; its negative repels.
  logic signed [feltgate_pkg::SCENE_PART_W-1:0] attract, repel;
  scene_part #(
      .Fraction(DistanceF + feltgate_pkg::P_ATTRACT_CORE_SLOPE_F)
  ) u_attract (
      .product_i(product_i),
      .part_o(attract)
  );
  scene_part #(
      .Fraction(DistanceF + feltgate_pkg::P_REPEL_CORE_SLOPE_F)
  ) u_repel (
      .product_i(product_i),
      .part_o(repel)
  );
  always_ff @(posedge clk_i) begin
    if (!attract_i || (after_charge_core_i && !near_q)) plus_o <= '0;
    else if (product_is_attract_core_slope_i) plus_o <= attract;
    if (!repel_i || (after_charge_core_i && !near_q)) minus_o <= '0;
    else if (product_is_repel_core_slope_i) minus_o <= repel;
  end

  logic unused;
  assign unused = ^{param_i[31], difference[32:31], torque,
                    product_i[feltgate_pkg::PRODUCT_BITS-1:35]};
endmodule

`default_nettype wire
