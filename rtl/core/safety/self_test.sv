// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Self-test after arming: waits until the lever is at rest, applies a torque pulse and then its
// opposite, and checks the direction of motion before the scene begins. A wrong direction trips.
// Timing: each word is compared when it is on the bus; the state changes in EVENT_AT_SELF_TEST_TURN;
// trip_o is high in EVENT_AT_SELF_TEST. docs/blocks/supervisor.md

`default_nettype none

module self_test (
    input  logic                                             clk_i,
    input  logic                                             rst_ni,
    input  logic                                             armed_i,
    input  logic                                             direct_i,      // voltage mode: no test
    input  logic                                             waits_i,       // a lower axis tests first
    input  logic        [                               1:0] travel_i,      // counts, low bits
    input  logic        [                              31:0] tick_count_i,
    input  logic                                             at_sample_i,
    input  logic                                             at_scene_rounded_i,
    input  logic                                             at_self_test_quiet_i,
    input  logic                                             at_self_test_over_i,
    input  logic                                             at_self_test_turn_i,
    input  logic                                             at_self_test_i,
    input  logic        [                              31:0] param_i,
    output logic                                             busy_o,        // the scene waits
    output logic signed [feltgate_pkg::SCENE_TORQUE_W-1:0]   early_term_o,       // +-beyond any limit, or 0
    output logic        [feltgate_map_pkg::W_STATUS_SELF_TEST-1:0] result_o,
    output logic                                             trip_o
);
  localparam int UnitBit = feltgate_map_pkg::SELF_TEST_UNIT_BITS;
  localparam int PatienceBit = feltgate_map_pkg::SELF_TEST_PATIENCE_BITS;
  localparam int CountW = feltgate_map_pkg::SELF_TEST_COUNT_BITS;
  localparam int ResultW = feltgate_map_pkg::W_STATUS_SELF_TEST;
  localparam logic [ResultW-1:0] None = '0;
  localparam logic [ResultW-1:0] Right = ResultW'(feltgate_map_pkg::SELF_TEST_RIGHT);
  localparam logic [ResultW-1:0] Held = ResultW'(feltgate_map_pkg::SELF_TEST_HELD);
  localparam logic [ResultW-1:0] Moving = ResultW'(feltgate_map_pkg::SELF_TEST_MOVING);

  // Motion since the previous tick, in counts modulo 4. Of two counts the direction is unknown.
  logic [1:0] now_q, before_q, step;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      now_q    <= '0;
      before_q <= '0;
    end else if (at_sample_i) begin
      now_q    <= travel_i;
      before_q <= now_q;
    end
  end
  assign step = now_q - before_q;

  // Time in units of 2^UnitBit ticks. One comparator serves two words.
  logic [CountW-1:0] count_q;
  logic unit_q, patience_q, unit, impatient, enough, quiet_q, over_q;
  assign unit      = tick_count_i[UnitBit] != unit_q;
  assign impatient = tick_count_i[PatienceBit] != patience_q;
  // A word beyond the counter counts as its end.
  assign enough    = count_q == '1 || (param_i[31:CountW] == '0 && count_q >= param_i[CountW-1:0]);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      quiet_q <= 1'b1;
      over_q  <= 1'b1;
    end else begin
      if (at_self_test_quiet_i) quiet_q <= enough;
      if (at_self_test_over_i) over_q <= enough;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      unit_q     <= 1'b0;
      patience_q <= 1'b0;
    end else if (at_self_test_turn_i) begin
      unit_q     <= tick_count_i[UnitBit];
      patience_q <= tick_count_i[PatienceBit];
    end
  end

  // State: one of wait, first, second, rest; none of them: done.
  logic wait_q, first_q, second_q, rest_q;
  logic still, late_q, gives_up, begins;
  assign still    = step == 2'd0;
  assign gives_up = impatient && late_q;
  assign begins   = quiet_q && still && !gives_up && !waits_i;
  assign busy_o   = armed_i && (wait_q || first_q || second_q || rest_q);

  // net_q: counts since the first pulse began. It stops at +-End, which is the answer. Motion that
  // begins only in the second pulse does not count.
  localparam logic signed [2:0] End = 3'(feltgate_map_pkg::SELF_TEST_COUNTS);
  logic signed [2:0] net_q, net;
  logic              counts, against, failed, fail_q;
  assign counts  = step[0] && net_q != End && net_q != -End && (first_q || (second_q && net_q != '0));
  assign net     = counts ? net_q + $signed({step[1], step[1], 1'b1}) : net_q;
  assign against = (first_q || second_q) && net == -End;
  assign failed  = rest_q && net_q != End;
  assign trip_o  = at_self_test_i && fail_q;

  logic runs;
  assign runs = armed_i && ((wait_q && !waits_i && still && !begins && !gives_up) || ((first_q || second_q) && !over_q));
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {wait_q, first_q, second_q, rest_q} <= '0;
      result_o <= None;
      late_q   <= 1'b0;
      fail_q   <= 1'b0;
    end else if (at_self_test_turn_i) begin
      // A pulse of 0 units (over_q: 0 >= 0) means no test.
      if (!armed_i) wait_q <= !over_q && !direct_i;
      else if (gives_up || begins) wait_q <= 1'b0;
      first_q  <= armed_i && ((wait_q && begins) || (first_q && !over_q));
      second_q <= armed_i && (over_q ? first_q : second_q);
      rest_q   <= armed_i && over_q && second_q;
      late_q   <= armed_i && wait_q && !waits_i && (late_q || impatient);
      fail_q   <= armed_i && (against || (failed && !param_i[feltgate_map_pkg::SELF_TEST_HELD_BIT]) ||
                             (wait_q && gives_up && !param_i[feltgate_map_pkg::SELF_TEST_MOVING_BIT]));
      if (rest_q && armed_i) result_o <= failed ? Held : Right;
      else if (wait_q && armed_i) result_o <= gives_up ? Moving : None;
      else if (!armed_i && (over_q || direct_i)) result_o <= None;
    end
  end

  // No reset: the first wave while disarmed clears count_q, the wait state clears net_q.
  always_ff @(posedge clk_i) begin
    if (at_self_test_turn_i) begin
      if (!runs) count_q <= '0;
      else if (unit) count_q <= count_q + CountW'(1);
      if (wait_q) net_q <= '0;
      else net_q <= net;
    end
  end

  // early_term_o is beyond every limit, so the limiter makes the pulse: +-the word of the test's torque.
  logic up_q, down_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      up_q   <= 1'b0;
      down_q <= 1'b0;
    end else begin
      up_q   <= at_scene_rounded_i && armed_i && first_q;
      down_q <= at_scene_rounded_i && armed_i && second_q;
    end
  end
  assign early_term_o = {down_q, {(feltgate_pkg::SCENE_TORQUE_W - 1) {up_q}}};
endmodule

`default_nettype wire
