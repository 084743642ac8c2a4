// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The two pulses: when, for how long, how large; and the answers that trip. For any motion and any words.
`default_nettype none

module pulses_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic [ 8:0] start_i,  // where in a tick a reset ends
    input logic [31:0] first_i,  // and in which tick
    input logic        armed_i,
    input logic        direct_i,
    input logic        waits_i,
    input logic [ 1:0] travel_i,
    input logic [31:0] param_i
);
  localparam int W = feltgate_pkg::SCENE_TORQUE_W;
  localparam int UnitBit = feltgate_map_pkg::SELF_TEST_UNIT_BITS;
  localparam int PatienceBit = feltgate_map_pkg::SELF_TEST_PATIENCE_BITS;
  localparam int CountW = feltgate_map_pkg::SELF_TEST_COUNT_BITS;
  localparam int ResultW = feltgate_map_pkg::W_STATUS_SELF_TEST;
  localparam logic signed [2:0] Answer = 3'(feltgate_map_pkg::SELF_TEST_COUNTS);

  `include "wave.svh"
  logic turn;
  logic [31:0] ticks_q;
  always_ff @(posedge clk_i) ticks_q <= !rst_ni ? first_i : ticks_q + 32'(tick);
  assign turn = wave[feltgate_map_pkg::EVENT_AT_SELF_TEST_TURN];

  // The length of a pulse stays as it is while armed.
  logic armed_q;
  logic [CountW-1:0] length_q, quiet_q, length;
  assign length = param_i > 32'd255 ? 8'd255 : param_i[7:0];
  always_ff @(posedge clk_i) begin
    armed_q <= armed_i;
    if (wave[feltgate_map_pkg::EVENT_AT_SELF_TEST_QUIET]) quiet_q <= length;
    if (wave[feltgate_map_pkg::EVENT_AT_SELF_TEST_OVER]) length_q <= length;
  end
  always_comb begin
    assume (tick_q || !rst_ni || armed_i == armed_q);
    assume (!wave[feltgate_map_pkg::EVENT_AT_SELF_TEST_OVER] || !armed_i || length == length_q);
  end

  logic busy, trip;
  logic signed [W-1:0] early_term;
  logic [ResultW-1:0] result;
  self_test u_dut (
      .*,
      .tick_count_i(ticks_q),
      .at_sample_i(wave[feltgate_map_pkg::EVENT_AT_SAMPLE]),
      .at_scene_rounded_i(wave[feltgate_map_pkg::EVENT_AT_SCENE_ROUNDED]),
      .at_self_test_quiet_i(wave[feltgate_map_pkg::EVENT_AT_SELF_TEST_QUIET]),
      .at_self_test_over_i(wave[feltgate_map_pkg::EVENT_AT_SELF_TEST_OVER]),
      .at_self_test_turn_i(wave[feltgate_map_pkg::EVENT_AT_SELF_TEST_TURN]),
      .at_self_test_i(wave[feltgate_map_pkg::EVENT_AT_SELF_TEST]),
      .busy_o(busy),
      .early_term_o(early_term),
      .result_o(result),
      .trip_o(trip)
  );
  (* hierconn *) wire \u_dut.wait_q ;
  (* hierconn *) wire \u_dut.first_q ;
  (* hierconn *) wire \u_dut.second_q ;
  (* hierconn *) wire \u_dut.rest_q ;
  wire waits = \u_dut.wait_q ;
  wire up = \u_dut.first_q ;
  wire down = \u_dut.second_q ;
  wire rests = \u_dut.rest_q ;
  (* hierconn *) wire [CountW-1:0] \u_dut.count_q ;
  wire [CountW-1:0] units = \u_dut.count_q ;
  (* hierconn *) wire signed [2:0] \u_dut.net_q ;
  wire signed [2:0] net = \u_dut.net_q ;
  (* hierconn *) wire [1:0] \u_dut.now_q ;
  (* hierconn *) wire [1:0] \u_dut.before_q ;
  (* hierconn *) wire \u_dut.unit_q ;
  (* hierconn *) wire \u_dut.patience_q ;
  (* hierconn *) wire \u_dut.late_q ;
  (* hierconn *) wire \u_dut.over_q ;

  // Ticks of a pulse so far, of both together, of the wait; how the lever moved in the tick.
  logic [1:0] now_q, before_q, step;
  assign step = now_q - before_q;
  logic [15:0] length_now_q, length_then_q, still_q, still_then_q;  // and of rest, in the wait
  logic [18:0] waited_q;
  logic down_seen_q, turned_q, turns_ok_q, tested_q, after_q;
  logic signed [2:0] law_q, law;  // counts since the pulses began, up to the answer
  always_comb begin
    law = law_q;
    if (law_q < Answer && law_q > -Answer && (up || (down && law_q != 0))) begin
      if (step == 2'd1) law = law_q + 3'sd1;
      if (step == 2'd3) law = law_q - 3'sd1;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      law_q       <= '0;
      now_q       <= '0;
      before_q    <= '0;
      down_seen_q <= 1'b0;
      tested_q    <= 1'b0;
    end else begin
      if (wave[feltgate_map_pkg::EVENT_AT_SAMPLE]) begin
        now_q    <= travel_i;
        before_q <= now_q;
      end
      if (turn) begin
        // Since the pulses began.
        down_seen_q <= (up || down) && (down_seen_q || step == 2'd3);
        law_q       <= waits ? '0 : law;
        tested_q    <= armed_i && (tested_q || down);  // in this arming
      end
    end
  end
  logic up_then_q, down_then_q, rests_then_q, waits_then_q, other_then_q, down_was_q, armed_then_q, direct_then_q, held_word_q,
      moving_word_q;
  logic [1:0] step_then_q;
  logic signed [2:0] law_then_q, law_after_q;
  logic [ResultW-1:0] result_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      after_q      <= 1'b0;
      turned_q     <= 1'b0;
      turns_ok_q   <= 1'b0;  // a turn since the reset: the units are counted from there
      length_now_q <= '0;
      still_q      <= '0;
      waited_q     <= '0;
    end else begin
      after_q  <= 1'b1;
      turned_q <= turn;
      if (turn) begin
        turns_ok_q   <= 1'b1;
        length_now_q <= ((up || down) && armed_i && !\u_dut.over_q ) ? length_now_q + 16'd1 : 16'd0;
        still_q      <= !(waits && armed_i && step == 2'd0) ? 16'd0 : (&still_q) ? still_q : still_q + 16'd1;
        waited_q     <= (waits && armed_i && !waits_i) ? waited_q + 19'd1 : 19'd0;
      end
    end
  end
  always_ff @(posedge clk_i) begin
    result_q <= result;
    if (turn) begin
      up_then_q     <= up;
      down_then_q   <= down;
      rests_then_q  <= rests;
      waits_then_q  <= waits;
      other_then_q  <= waits_i;
      armed_then_q  <= armed_i;
      step_then_q   <= step;
      still_then_q  <= still_q;
      length_then_q <= length_now_q;
      direct_then_q <= direct_i;
      law_then_q    <= law_q;
      law_after_q   <= law;
      held_word_q   <= param_i[feltgate_map_pkg::SELF_TEST_HELD_BIT];
      moving_word_q <= param_i[feltgate_map_pkg::SELF_TEST_MOVING_BIT];
      down_was_q    <= down_seen_q;
    end
  end
  logic pulse_up_q, pulse_down_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      pulse_up_q   <= 1'b0;
      pulse_down_q <= 1'b0;
    end else begin
      pulse_up_q   <= wave[feltgate_map_pkg::EVENT_AT_SCENE_ROUNDED] && armed_i && up;
      pulse_down_q <= wave[feltgate_map_pkg::EVENT_AT_SCENE_ROUNDED] && armed_i && down;
    end
  end
  logic [31:0] turn_tick;  // of the last turn
  assign turn_tick = (phase_q > 9'(feltgate_map_pkg::EVENT_AT_SELF_TEST_TURN) &&
      !(phase_q > 9'(Clocks - 1 - feltgate_map_pkg::FIRST_WAVE_CLOCK)))
                     ? ticks_q : ticks_q - 32'd1;
  wire [6:0] part = UnitBit'(turn_tick);
  wire [PatienceBit-1:0] part_of_patience = PatienceBit'(turn_tick);

  always_comb begin
    if (rst_ni && past_ok_q) begin
      size_is_beyond: assert (early_term == (pulse_up_q ? {1'b0, {(W - 1) {1'b1}}} : pulse_down_q ? {1'b1,
          {(W - 1) {1'b0}}} : '0));
      inside_one: assert (!(waits && (up || down || rests)) && !(up && (down || rests)) && !(down && rests));
      scene_waits: assert (busy == (armed_i && (waits || up || down || rests)));
      trips_in_its_clock: assert (!trip || wave[feltgate_map_pkg::EVENT_AT_SELF_TEST]);
      pulse_is_bounded: assert (!(armed_i && (up || down)) || length_now_q <= 16'(length_q) << UnitBit);
      inside_travel: assert (\u_dut.now_q == now_q && \u_dut.before_q == before_q);
      if (turned_q) begin
        in_order: assert ((!up || waits_then_q || up_then_q) && (!down || up_then_q || down_then_q) && (!rests ||
            down_then_q));
        begins_at_rest: assert (!(up && waits_then_q) || (step_then_q == 2'd0 && !other_then_q &&
                                {1'b0, still_then_q} + 17'd127 >= 17'(quiet_q) << UnitBit));
        once_per_arming: assert (!(tested_q && waits));
        second_is_whole: assert (!rests || !armed_then_q || length_then_q + 16'd1 == 16'(length_q) << UnitBit);
      end
      inside_right_way: assert (!trip || rests_then_q || waits_then_q || down_was_q || step_then_q == 2'd3);
      trips_by_its_law: assert (!wave[feltgate_map_pkg::EVENT_AT_SELF_TEST] || !turned_q || trip == (armed_then_q &&
          (((up_then_q || down_then_q) && law_after_q == -Answer) || (rests_then_q && law_then_q != Answer &&
              !held_word_q) ||
           (waits_then_q && !waits && !up && !moving_word_q))));
      result_in_its_clock: assert (turned_q || !after_q || result == result_q);
      right_is_two_counts: assert (!turned_q || result != ResultW'(feltgate_map_pkg::SELF_TEST_RIGHT) ||
          result_q == result ||
                                   (rests_then_q && law_then_q == Answer));
      inside_net: assert (!(up || down || rests) || (net == law_q && net <= Answer && net >= -Answer));
      inside_units: assert (!turns_ok_q || (\u_dut.unit_q == turn_tick[UnitBit] &&
          \u_dut.patience_q == turn_tick[PatienceBit]));
      inside_turns: assert (turns_ok_q || !(waits || up || down || rests || \u_dut.late_q ));
      inside_part: assert (!(armed_i && (up || down)) ||
          (length_now_q <= (16'(units) << UnitBit) + 16'(part) &&
              length_now_q + 16'd127 >= (16'(units) << UnitBit) + 16'(part) &&
           (units < length_q || (units == length_q && part == '0))));
      inside_second: assert (!(armed_i && down) || length_now_q + 16'd1 == (16'(units) << UnitBit) + 16'(part));
      inside_length: assert (!waits || length_q != '0 || (!armed_i &&
          phase_q > 9'(feltgate_map_pkg::EVENT_AT_SELF_TEST_OVER) &&
                                                        phase_q <= 9'(feltgate_map_pkg::EVENT_AT_SELF_TEST_TURN)));
      inside_disarmed: assert (armed_i || phase_q <= 9'(feltgate_map_pkg::EVENT_AT_SELF_TEST_TURN) ||
                               phase_q > 9'(Clocks - 1 - feltgate_map_pkg::FIRST_WAVE_CLOCK) ||
                               !turns_ok_q || (units == '0 && still_q == '0 && waited_q == '0 && !tested_q && !up &&
                                   !down && !rests && !\u_dut.late_q ));
      inside_answer: assert (!(up || down) || law_q >= 0 || down_seen_q);
      inside_pulse: assert (!(armed_i && (up || down)) || length_q != '0);
      inside_still: assert (!(armed_i && waits) || (units == '0 && still_q == '0) ||
                            {1'b0, still_q} + 17'd127 >= (17'(units) << UnitBit) + 17'(part));
      patience_ends: assert (!(armed_i && waits) || waited_q <= {1'b0, \u_dut.late_q , part_of_patience});
      inside_once: assert (!(armed_i && tested_q) || !(waits || up));
      waits_armed: cover (busy && armed_i && waits);
      never_in_voltage_mode: assert (!turned_q || !(waits && !waits_then_q) || !direct_then_q);
    end
  end
endmodule

`default_nettype wire
