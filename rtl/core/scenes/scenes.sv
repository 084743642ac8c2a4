// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Room: all scenes, with one distance from the reference, one sum of their terms and one rounding.
// A scene that is not built gives torque 0. Latency: distance_o [1,18,8] counts one clock after the
// reference's word, for two clocks. The unlimited torque goes to the limiter: either on early_term_o, one clock
// before the torque limit's word, or on late_term_o, in the clock of that word. The limiter adds early_up_o, which
// completes the rounding. In an earlier clock early_term_o is a charge's distance, for its comparison with the core.
// docs/blocks/scenes.md

`default_nettype none

module scenes #(
    parameter int Mask = feltgate_pkg::SCENE_MASK  // bit n: scene n is built
) (
    input  logic                                             clk_i,
    input  logic                                             rst_ni,
    input  logic                                             armed_i,
    input  logic        [                               3:0] scene_i,
    input  logic        [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input  logic        [                              31:0] param_i,
    input  logic signed [feltgate_pkg::SCENE_POSITION_W-1:0] position_i,  // counts
    input  logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input  logic                                             over_limit_i,  // from the limiter
    input  logic signed [        feltgate_pkg::TORQUE_W-1:0] law_torque_i,  // of a program; used if law_o
    input  logic                                             law_late_i,    // it counts as 0
    output logic                                             law_o,         // scene law selected
    output logic signed [feltgate_pkg::SCENE_DISTANCE_W-1:0] distance_o,
    output logic                                             square_o,    // square the distance
    output logic signed [  feltgate_pkg::SCENE_TORQUE_W-1:0] early_term_o,  // one clock before its limit
    output logic                                             early_up_o,   // with early_term_o: it is rounded up
    output logic signed [        feltgate_pkg::TORQUE_W-1:0] late_term_o,   // with its limit; charges only
    output logic                                             late_not_o,   // with late_term_o: the torque is its complement
    output logic                                             late_up_o     // + 1
);
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int PartW = feltgate_pkg::SCENE_PART_W;
  localparam int OffsetW = feltgate_pkg::SCENE_OFFSET_W;
  localparam int OffsetF = feltgate_pkg::SCENE_OFFSET_F;
  localparam int GapW = feltgate_pkg::SCENE_POSITION_W + 1;
  localparam int Guard = feltgate_pkg::SCENE_GUARD_BITS;
  localparam int AtDistance = feltgate_map_pkg::EVENT_AT_SCENE_DISTANCE;
  localparam int AtSum = feltgate_map_pkg::EVENT_AT_SCENE_SUM;
  localparam int AtRounded = feltgate_map_pkg::EVENT_AT_SCENE_ROUNDED;

  logic setpoint, membrane, compression, tension, damper, attract, repel, wall;
  assign setpoint    = Mask[{1'b0, feltgate_map_pkg::SCENE_SETPOINT}] &&
                       scene_i == feltgate_map_pkg::SCENE_SETPOINT;
  assign membrane    = Mask[{1'b0, feltgate_map_pkg::SCENE_MEMBRANE}] &&
                       scene_i == feltgate_map_pkg::SCENE_MEMBRANE;
  assign compression = Mask[{1'b0, feltgate_map_pkg::SCENE_SPRING_COMPRESSION}] &&
                       scene_i == feltgate_map_pkg::SCENE_SPRING_COMPRESSION;
  assign tension     = Mask[{1'b0, feltgate_map_pkg::SCENE_SPRING_TENSION}] &&
                       scene_i == feltgate_map_pkg::SCENE_SPRING_TENSION;
  assign damper      = Mask[{1'b0, feltgate_map_pkg::SCENE_DAMPER}] &&
                       scene_i == feltgate_map_pkg::SCENE_DAMPER;
  assign attract     = Mask[{1'b0, feltgate_map_pkg::SCENE_CHARGE_ATTRACT}] &&
                       scene_i == feltgate_map_pkg::SCENE_CHARGE_ATTRACT;
  assign repel       = Mask[{1'b0, feltgate_map_pkg::SCENE_CHARGE_REPEL}] &&
                       scene_i == feltgate_map_pkg::SCENE_CHARGE_REPEL;
  assign wall        = Mask[{1'b0, feltgate_map_pkg::SCENE_WALL}] &&
                       scene_i == feltgate_map_pkg::SCENE_WALL;
  assign law_o       = Mask[{1'b0, feltgate_map_pkg::SCENE_LAW}] &&
                       scene_i == feltgate_map_pkg::SCENE_LAW;
  assign square_o    = attract || repel;

  // Reference minus position. Only the whole counts are subtracted: the position has no fraction,
  // and the fraction of a charge's centre is ignored.
  logic signed [    GapW-1:0] gap, gap_q;
  logic        [OffsetF-1:0] fraction;
  logic                      held_q, distance_positive;
  assign gap      = GapW'($signed(param_i[OffsetW-1:OffsetF])) - GapW'(position_i);
  assign fraction = param_i[OffsetF-1:0];
  always_ff @(posedge clk_i) begin
    if (wave_i[AtDistance]) gap_q <= gap;
    held_q <= wave_i[AtDistance];
    if (wave_i[AtDistance]) distance_o[OffsetF+:GapW] <= gap;
    else if (!held_q) distance_o[OffsetF+:GapW] <= '0;
    if (wave_i[AtDistance] ? square_o : !held_q) distance_o[OffsetF-1:0] <= '0;
    else if (wave_i[AtDistance]) distance_o[OffsetF-1:0] <= fraction;
  end
  // A clock after the subtraction: the parameter's word comes late in its clock.
  assign distance_positive = !gap_q[GapW-1] && (gap_q != '0 || distance_o[OffsetF-1:0] != '0);

  logic signed [TorqueW-1:0] setpoint_plus, membrane_plus, membrane_minus;
  logic signed [PartW-1:0] spring_plus, damper_minus, charge_plus, charge_minus, wall_plus, wall_minus;

  generate
  if (Mask[{1'b0, feltgate_map_pkg::SCENE_SETPOINT}]) begin : gen_setpoint
    scene_setpoint u_setpoint (
        .clk_i(clk_i),
        .select_i(setpoint),
        .param_is_setpoint_torque_i(wave_i[feltgate_map_pkg::PARAM_AT_SETPOINT_TORQUE]),
        .param_i(param_i),
        .plus_o(setpoint_plus)
    );
  end else begin : gen_no_setpoint
    assign setpoint_plus = '0;
  end

  if (Mask[{1'b0, feltgate_map_pkg::SCENE_MEMBRANE}]) begin : gen_membrane
    scene_membrane u_membrane (
        .clk_i(clk_i),
        .rst_ni(rst_ni),
        .select_i(membrane),
        .distance_positive_i(distance_positive),
        .gap_negative_i(gap[GapW-1]),
        .param_is_membrane_upper_i(wave_i[feltgate_map_pkg::PARAM_AT_MEMBRANE_UPPER]),
        .param_was_membrane_upper_i(wave_i[feltgate_map_pkg::PARAM_AT_MEMBRANE_UPPER+1]),
        .param_is_membrane_torque_i(wave_i[feltgate_map_pkg::PARAM_AT_MEMBRANE_TORQUE]),
        .param_i(param_i),
        .plus_o(membrane_plus),
        .minus_o(membrane_minus)
    );
  end else begin : gen_no_membrane
    assign membrane_plus  = '0;
    assign membrane_minus = '0;
  end

  if (Mask[{1'b0, feltgate_map_pkg::SCENE_SPRING_COMPRESSION}] ||
      Mask[{1'b0, feltgate_map_pkg::SCENE_SPRING_TENSION}]) begin : gen_spring
    scene_spring u_spring (
        .clk_i(clk_i),
        .tension_i(tension),
        .compression_i(compression),
        .behind_i(gap_q[GapW-1]),
        .product_is_scene_stiffness_i(wave_i[feltgate_map_pkg::PRODUCT_AT_SCENE_STIFFNESS]),
        .product_i(product_i),
        .plus_o(spring_plus)
    );
  end else begin : gen_no_spring
    assign spring_plus = '0;
  end

  if (Mask[{1'b0, feltgate_map_pkg::SCENE_DAMPER}]) begin : gen_damper
    scene_damper u_damper (
        .clk_i(clk_i),
        .select_i(damper),
        .product_is_damper_damping_i(wave_i[feltgate_map_pkg::PRODUCT_AT_DAMPER_DAMPING]),
        .product_i(product_i),
        .minus_o(damper_minus)
    );
  end else begin : gen_no_damper
    assign damper_minus = '0;
  end

  if (Mask[{1'b0, feltgate_map_pkg::SCENE_CHARGE_ATTRACT}] ||
      Mask[{1'b0, feltgate_map_pkg::SCENE_CHARGE_REPEL}]) begin : gen_charge
    scene_charge u_charge (
        .clk_i(clk_i),
        .rst_ni(rst_ni),
        .attract_i(attract),
        .repel_i(repel),
        .distance_positive_i(distance_positive),
        .division_i(wave_i[feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT-1:feltgate_map_pkg::PRODUCT_AT_CHARGE_SQUARE]),
        .at_scene_distance_i(wave_i[feltgate_map_pkg::EVENT_AT_SCENE_DISTANCE]),
        .param_is_attract_strength_i(wave_i[feltgate_map_pkg::PARAM_AT_ATTRACT_STRENGTH]),
        .param_was_attract_strength_i(wave_i[feltgate_map_pkg::PARAM_AT_ATTRACT_STRENGTH+1]),
        .at_charge_width_limited_i(wave_i[feltgate_map_pkg::EVENT_AT_CHARGE_WIDTH_LIMITED]),
        .at_charge_core_i(wave_i[feltgate_map_pkg::EVENT_AT_CHARGE_CORE]),
        .product_is_attract_core_slope_i(wave_i[feltgate_map_pkg::PRODUCT_AT_ATTRACT_CORE_SLOPE]),
        .product_is_repel_core_slope_i(wave_i[feltgate_map_pkg::PRODUCT_AT_REPEL_CORE_SLOPE]),
        .after_charge_core_i(wave_i[feltgate_map_pkg::EVENT_AT_CHARGE_CORE+1]),
        .param_i(param_i),
        .product_i(product_i),
        .over_limit_i(over_limit_i),
        .plus_o(charge_plus),
        .minus_o(charge_minus),
        .outside_o(late_term_o), .outside_not_o(late_not_o), .outside_up_o(late_up_o),
        .armed_i(armed_i)
    );
  end else begin : gen_no_charge
    assign charge_plus  = '0;
    assign charge_minus = '0;
    assign late_term_o  = '0;
    assign late_not_o   = 1'b0;
    assign late_up_o    = 1'b0;
  end

  if (Mask[{1'b0, feltgate_map_pkg::SCENE_WALL}]) begin : gen_wall
    scene_wall u_wall (
        .clk_i(clk_i),
        .select_i(wall),
        .behind_i(gap_q[GapW-1]),
        .product_is_wall_stiffness_i(wave_i[feltgate_map_pkg::PRODUCT_AT_WALL_STIFFNESS]),
        .product_is_wall_damping_i(wave_i[feltgate_map_pkg::PRODUCT_AT_WALL_DAMPING]),
        .product_i(product_i),
        .plus_o(wall_plus),
        .minus_o(wall_minus)
    );
  end else begin : gen_no_wall
    assign wall_plus  = '0;
    assign wall_minus = '0;
  end
  endgenerate

  // At most one scene has terms that are not 0, so an OR combines them.
  logic signed [  PartW-1:0] plus, minus;
  logic signed [    PartW:0] sum_q;
  assign plus  = spring_plus | charge_plus | wall_plus | (PartW'(membrane_plus) <<< Guard);
  assign minus = damper_minus | charge_minus | wall_minus | (PartW'(membrane_minus) <<< Guard);
  always_ff @(posedge clk_i) begin
    if (wave_i[AtSum]) sum_q <= (PartW + 1)'(plus) - (PartW + 1)'(minus);
  end

  // A scene that subtracts its product (damper, repelling charge) gives the negative of the rounded
  // product. A wall never pulls: a sum that is not negative becomes 0.
  logic up;
  rounding #(
      .Drop(Guard)
  ) u_rounding (
      .low_i(sum_q[Guard:0]),
      .negated_i(damper || repel),
      .up_o(up)
  );
  logic signed [feltgate_pkg::SCENE_TORQUE_W-1:0] rounded_q;
  logic signed [                     TorqueW-1:0] word_q, law_q;  // already a torque: no rounding
  logic signed [                        GapW-1:0] charge_distance_q;
  always_ff @(posedge clk_i) begin
    if (!wave_i[AtRounded] || !armed_i || (wall && !sum_q[PartW])) begin
      rounded_q  <= '0;
      early_up_o <= 1'b0;
    end else begin
      rounded_q  <= feltgate_pkg::SCENE_TORQUE_W'($signed(sum_q[PartW:Guard]));
      early_up_o <= up;
    end
    if (!wave_i[AtRounded] || !armed_i) word_q <= '0;
    else word_q <= setpoint_plus;
    if (!wave_i[feltgate_map_pkg::EVENT_AT_LAW_TORQUE] || !armed_i || !law_o || law_late_i) law_q <= '0;
    else law_q <= law_torque_i;
    if (!wave_i[feltgate_map_pkg::EVENT_AT_CHARGE_WIDTH]) charge_distance_q <= '0;
    else charge_distance_q <= gap_q;
  end
  assign early_term_o = rounded_q | feltgate_pkg::SCENE_TORQUE_W'(word_q) |
                        feltgate_pkg::SCENE_TORQUE_W'(law_q) | feltgate_pkg::SCENE_TORQUE_W'(charge_distance_q);

  // Inputs without a load if fewer scenes are built.
  logic unused;
  assign unused = ^{wave_i, param_i, rst_ni, over_limit_i, product_i, setpoint, membrane, compression, tension, law_torque_i, law_late_i, distance_positive};
endmodule

`default_nettype wire
