// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The scenes and the limiter that serves them: the torque of a tick for any position, words and products.
`default_nettype none

module torque_proof (
    input logic                                             clk_i,
    input logic                                             rst_ni,
    input logic        [                               8:0] start_i,  // where in a tick a reset ends
    input logic                                             armed_i,
    input logic        [                               3:0] scene_i,
    input logic        [                              31:0] param_i,
    input logic signed [feltgate_pkg::SCENE_POSITION_W-1:0] position_i,
    input logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input logic signed [  feltgate_pkg::SCENE_TORQUE_W-1:0] pulse_i,  // of the self-test
    input logic signed [        feltgate_pkg::TORQUE_W-1:0] law_torque_i,
    input logic                                             law_late_i
);
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int PartW = feltgate_pkg::SCENE_PART_W;
  localparam int GapW = feltgate_pkg::SCENE_POSITION_W + 1;
  localparam int OffsetW = feltgate_pkg::SCENE_OFFSET_W;
  localparam int OffsetF = feltgate_pkg::SCENE_OFFSET_F;
  localparam int DistanceW = feltgate_pkg::SCENE_DISTANCE_W;
  localparam int Guard = feltgate_pkg::SCENE_GUARD_BITS;
  localparam int LimiterW = feltgate_pkg::LIMITER_W;
  localparam int Wide = feltgate_pkg::LIMITER_INPUT_W;
  localparam int Limit = feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT;

  `include "wave.svh"
  logic armed_q;
  logic [3:0] scene_q;
  always_ff @(posedge clk_i) begin
    armed_q <= armed_i;
    scene_q <= scene_i;
  end
  always_comb begin
    assume (tick_q || !rst_ni || scene_i == scene_q);
    assume (tick_q || !rst_ni || phase_q > 9'(feltgate_map_pkg::EVENT_AT_SELF_TEST_TURN) || armed_i == armed_q);
    assume (phase_q == 9'(Limit - 1) || pulse_i == '0);
  end

  logic signed [DistanceW-1:0] distance;
  logic signed [feltgate_pkg::SCENE_TORQUE_W-1:0] early_term;
  logic signed [TorqueW-1:0] late_term;
  logic signed [feltgate_pkg::WITH_ADDEND_W-1:0] limited;
  logic early_up, late_not, late_up, square, over_limit, law_o;
  scenes u_dut (
      .*,
      .wave_i(wave),
      .over_limit_i(over_limit),
      .distance_o(distance),
      .square_o(square),
      .early_term_o(early_term),
      .early_up_o(early_up),
      .late_term_o(late_term),
      .late_not_o(late_not),
      .late_up_o(late_up)
  );
  // As the core has it, of the scenes' clocks.
  limiter u_limiter (
      .clk_i(clk_i),
      .valid_i(wave[Limit-1]),
      .torque_i(wave[Limit-1]),
      .voltage_i(1'b0),
      .duty_i(1'b0),
      .early_term_i(Wide'(early_term | pulse_i)),
      .early_up_i(early_up),
      .late_term_i(Wide'(late_term)),
      .late_not_i(late_not),
      .late_up_i(late_up),
      .param_i(param_i),
      .addend_i('0),
      .limited_o(limited),
      .over_limit_o(over_limit)
  );
  (* hierconn *) wire signed [PartW-1:0] \u_dut.plus ;
  (* hierconn *) wire signed [PartW-1:0] \u_dut.minus ;
  (* hierconn *) wire signed [PartW:0] \u_dut.sum_q ;
  (* hierconn *) wire signed [TorqueW-1:0] \u_dut.setpoint_plus ;
  (* hierconn *) wire signed [GapW-1:0] \u_dut.gap_q ;
  wire signed [PartW:0] sum = \u_dut.sum_q ;

  // Whether the scene is one that is built.
  logic built, charge, terms, whole_q;
  assign built  = feltgate_pkg::SCENE_MASK[{1'b0, scene_i}] && scene_i >= feltgate_map_pkg::SCENE_SETPOINT &&
                  scene_i <= feltgate_map_pkg::SCENE_LAW;
  assign terms  = built && scene_i != feltgate_map_pkg::SCENE_SETPOINT && scene_i != feltgate_map_pkg::SCENE_LAW;  // that are rounded
  assign charge = scene_i == feltgate_map_pkg::SCENE_CHARGE_ATTRACT || scene_i == feltgate_map_pkg::SCENE_CHARGE_REPEL;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) whole_q <= 1'b0;
    else if (wave[feltgate_map_pkg::EVENT_AT_SCENE_DISTANCE]) whole_q <= 1'b1;
  end

  // The torque as the limiter gets it, in two clocks; limit, terms and words as they came by.
  logic signed [Wide-1:0] early_q, x;
  logic signed [PartW+1:0] terms_q;
  logic [LimiterW-1:0] limit_q;
  logic signed [TorqueW-1:0] word_q, program_q;
  logic signed [GapW-1:0] whole;
  logic signed [OffsetW:0] gap, gap_q;
  logic new_q, now;
  assign now   = whole_q && wave[Limit];
  assign x     = early_q + (late_not ? -1 - Wide'(late_term) : Wide'(late_term)) + Wide'({1'b0, late_up});  // one is 0
  assign whole = GapW'($signed(param_i[OffsetW-1:OffsetF])) - GapW'(position_i);
  assign gap   = (OffsetW + 1)'($signed(param_i[OffsetW-1:0])) - ((OffsetW + 1)'(position_i) <<< OffsetF);
  always_ff @(posedge clk_i) begin
    early_q <= Wide'(early_term) + Wide'({1'b0, early_up});
    new_q   <= now;
    if (wave[feltgate_map_pkg::EVENT_AT_SCENE_SUM]) terms_q <= (PartW + 2)'(\u_dut.plus ) - (PartW + 2)'(\u_dut.minus );
    if (wave[feltgate_map_pkg::PARAM_AT_SETPOINT_TORQUE]) word_q <= param_i[TorqueW-1:0];
    if (wave[feltgate_map_pkg::EVENT_AT_LAW_TORQUE]) program_q <= law_late_i ? '0 : law_torque_i;
    if (wave[Limit]) limit_q <= ((param_i[LimiterW-1:0] >> (TorqueW - 1)) != '0) ? '0 : param_i[LimiterW-1:0];
    if (wave[feltgate_map_pkg::EVENT_AT_SCENE_DISTANCE])
      gap_q <= charge ? {gap[OffsetW:OffsetF], {OffsetF{1'b0}}} : gap;
  end
  logic signed [PartW+3:0] error;  // in the terms' bits, of a torque that no word is in
  assign error = ((PartW + 4)'(x) <<< Guard) - (PartW + 4)'(terms_q);
  localparam logic signed [PartW+3:0] Half = (PartW + 4)'(1) << (Guard - 1);
  logic of_distance;
  assign of_distance = wave[feltgate_map_pkg::EVENT_AT_SCENE_DISTANCE+1] || wave[feltgate_map_pkg::EVENT_AT_SCENE_DISTANCE+2];

  always_comb begin
    if (past_ok_q && rst_ni && whole_q) begin
      if (now) begin
        free_is_0: assert (built || x == '0);
        disarmed_is_0: assert (armed_i || x == '0);
        wall_never_pulls: assert (scene_i != feltgate_map_pkg::SCENE_WALL || x <= 0);
        setpoint_is_its_word: assert (scene_i != feltgate_map_pkg::SCENE_SETPOINT || !armed_i || x == Wide'(word_q));
        law_is_its_torque: assert (scene_i != feltgate_map_pkg::SCENE_LAW || !built || !armed_i || x == Wide'(program_q));
        rounded_to_half_a_bit: assert (!armed_i || !built || charge || scene_i == feltgate_map_pkg::SCENE_SETPOINT ||
                                       scene_i == feltgate_map_pkg::SCENE_LAW ||
                                       scene_i == feltgate_map_pkg::SCENE_WALL || (error <= Half && error >= -Half));
        renders: cover (x < 0 && scene_i == feltgate_map_pkg::SCENE_WALL);
      end
      within_limit: assert (!new_q || (limited <= $signed({1'b0, limit_q}) && limited >= -$signed({1'b0, limit_q})));
      distance_is_exact: assert (distance == (of_distance ? DistanceW'(gap_q) : '0));
      law_is_told: assert (law_o == (built && scene_i == feltgate_map_pkg::SCENE_LAW));
      square_of_a_charge: assert (square == (charge && built));
      limits: cover (new_q && over_limit && limited > 0);
      inside_word: assert (phase_q <= 9'(feltgate_map_pkg::PARAM_AT_SETPOINT_TORQUE) || phase_q > 9'(Limit) ||
                           \u_dut.setpoint_plus == ((scene_i == feltgate_map_pkg::SCENE_SETPOINT) ? word_q : '0));
      inside_sum: assert (phase_q <= 9'(feltgate_map_pkg::EVENT_AT_SCENE_SUM) || phase_q > 9'(Limit) ||
                          ((PartW + 2)'(sum) == terms_q && (terms || sum == 0)));
      inside_free: assert (terms || phase_q == '0 || phase_q > 9'(feltgate_map_pkg::WAVE_LENGTH - 3) ||
                           (\u_dut.plus == 0 && \u_dut.minus == 0));
    end
  end
endmodule

`default_nettype wire
