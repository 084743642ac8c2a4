// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The two pulses: when, for how long, how large; and the answers that trip. For any motion and any words.
`default_nettype none

module pulses_proof (
    input logic         clk_i,
    input logic         rst_ni,
    input logic [31:0]  first_i,  // the tick in which a reset ends
    input logic         tick_i,   // a tick ends
    input cfg::params_t p,
    input logic         armed_i,
    input logic         direct_i,
    input logic         waits_i,
    input logic [ 1:0]  travel_i,
    input logic         sample_i,
    input logic         start_i
);
  localparam int W = cfg::SCENE_TORQUE_W;
  localparam int UnitBit = map::SELF_TEST_UNIT_BITS;
  localparam int PatienceBit = map::SELF_TEST_PATIENCE_BITS;
  localparam int CountW = map::SELF_TEST_COUNT_BITS;
  localparam logic signed [2:0] Answer = 3'(map::SELF_TEST_COUNTS);
  `include "reset.svh"

  // The block's start comes once a tick; the motor is armed and disarmed between two ticks.
  logic [31:0] ticks_q;
  logic started_q, tick_q, armed_q;
  always_ff @(posedge clk_i) begin
    ticks_q <= !rst_ni ? first_i : ticks_q + 32'(tick_i);
    {tick_q, armed_q} <= {tick_i, armed_i};
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) started_q <= 1'b0;
    else started_q <= start_i || (started_q && !tick_i);
  end
  always_comb begin
    assume (!start_i || !started_q);
    assume (!tick_i || started_q);
    assume (tick_q || !rst_ni || armed_i == armed_q);
  end

  logic busy, trip;
  logic signed [W-1:0] torque;
  logic [1:0] result;
  self_test u_dut (.*, .tick_count_i(ticks_q), .busy_o(busy), .torque_o(torque), .result_o(result), .trip_o(trip));
  (* hierconn *) wire [2:0] \u_dut.state_q ;
  (* hierconn *) wire [CountW-1:0] \u_dut.units_q ;
  (* hierconn *) wire signed [2:0] \u_dut.net_q ;
  (* hierconn *) wire [1:0] \u_dut.now_q ;
  (* hierconn *) wire [1:0] \u_dut.before_q ;
  (* hierconn *) wire \u_dut.unit_q ;
  (* hierconn *) wire \u_dut.patience_q ;
  (* hierconn *) wire \u_dut.late_q ;
  (* hierconn *) wire \u_dut.over ;
  wire [CountW-1:0] units = \u_dut.units_q ;
  wire signed [2:0] net = \u_dut.net_q ;
  wire late = \u_dut.late_q ;
  logic waits, up, down, judges;
  assign waits  = \u_dut.state_q == 3'd1;
  assign up     = \u_dut.state_q == 3'd2;
  assign down   = \u_dut.state_q == 3'd3;
  assign judges = \u_dut.state_q == 3'd4;

  // How the lever moved in the tick, and since the pulses began, up to the answer.
  logic [1:0] now_q, before_q, step;
  logic signed [2:0] law_q, law;
  logic down_seen_q, tested_q;  // a step down since the pulses began; a second pulse in this arming
  assign step = now_q - before_q;
  always_comb begin
    law = law_q;
    if (law_q < Answer && law_q > -Answer && (up || (down && law_q != 0))) begin
      if (step == 2'd1) law = law_q + 3'sd1;
      if (step == 2'd3) law = law_q - 3'sd1;
    end
  end
  // Ticks of a pulse so far, of rest in the wait, of the wait.
  logic [15:0] length_now_q, length_then_q, still_q, still_then_q;
  logic [18:0] waited_q;
  logic after_q, turned_q, turns_ok_q;  // a start was a clock ago; one since the reset
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {now_q, before_q, law_q, down_seen_q, tested_q, after_q, turned_q, turns_ok_q} <= '0;
      {length_now_q, still_q, waited_q} <= '0;
    end else begin
      after_q  <= 1'b1;
      turned_q <= start_i;
      if (sample_i) {before_q, now_q} <= {now_q, travel_i};
      if (start_i) begin
        turns_ok_q   <= 1'b1;
        down_seen_q  <= (up || down) && (down_seen_q || step == 2'd3);
        law_q        <= waits ? '0 : law;
        tested_q     <= armed_i && (tested_q || down);
        length_now_q <= (up || down) && armed_i && ! \u_dut.over ? length_now_q + 16'd1 : 16'd0;
        still_q      <= !(waits && armed_i && step == 2'd0) ? 16'd0 : &still_q ? still_q : still_q + 16'd1;
        waited_q     <= waits && armed_i && !waits_i ? waited_q + 19'd1 : 19'd0;
      end
    end
  end
  logic up_then_q, down_then_q, judges_then_q, waits_then_q, other_then_q, armed_then_q, direct_then_q, down_was_q;
  logic [1:0] step_then_q, result_q, arms_q;
  logic signed [2:0] law_then_q, law_after_q;
  logic [CountW-1:0] length_q, quiet_q;
  always_ff @(posedge clk_i) begin
    result_q <= result;
    if (start_i) begin
      {up_then_q, down_then_q, judges_then_q, waits_then_q, other_then_q} <= {up, down, judges, waits, waits_i};
      {armed_then_q, direct_then_q, down_was_q, step_then_q} <= {armed_i, direct_i, down_seen_q, step};
      {still_then_q, length_then_q, law_then_q, law_after_q} <= {still_q, length_now_q, law_q, law};
      {length_q, quiet_q, arms_q} <= {p.self_test_pulse, p.self_test_quiet, p.self_test_arms};
    end
  end
  always_comb assume (!armed_i || !turns_ok_q || p.self_test_pulse == length_q);  // it is refused while armed
  logic [31:0] turn_tick;  // of the last start
  assign turn_tick = started_q ? ticks_q : ticks_q - 32'd1;
  wire [UnitBit-1:0] part = UnitBit'(turn_tick);

  always_comb begin
    if (rst_ni && past_ok_q) begin
      size_is_beyond: assert (torque == (up ? {1'b0, {(W - 1) {1'b1}}} : down ? {1'b1, {(W - 1) {1'b0}}} : '0));
      inside_state: assert ( \u_dut.state_q <= 3'd4);
      scene_waits: assert (busy == (armed_i && (waits || up || down || judges)));
      trips_in_its_clock: assert (!trip || turned_q);
      pulse_is_bounded: assert (!(armed_i && (up || down)) || length_now_q <= 16'(length_q) << UnitBit);
      inside_travel: assert ( \u_dut.now_q == now_q && \u_dut.before_q == before_q);
      if (turned_q) begin
        in_order: assert ((!up || waits_then_q || up_then_q) && (!down || up_then_q || down_then_q) && (!judges || down_then_q));
        begins_at_rest: assert (!(up && waits_then_q) || (step_then_q == 2'd0 && !other_then_q &&
                                {1'b0, still_then_q} + 17'd127 >= 17'(quiet_q) << UnitBit));
        once_per_arming: assert (!(tested_q && waits));
        second_is_whole: assert (!judges || !armed_then_q || length_then_q + 16'd1 == 16'(length_q) << UnitBit);
      end
      inside_right_way: assert (!trip || judges_then_q || waits_then_q || down_was_q || step_then_q == 2'd3);
      trips_by_its_law: assert (!turned_q || trip == (armed_then_q &&
          (((up_then_q || down_then_q) && law_after_q == -Answer) ||
           (judges_then_q && law_then_q != Answer && !arms_q[map::SELF_TEST_HELD_BIT]) ||
           (waits_then_q && !waits && !up && !arms_q[map::SELF_TEST_MOVING_BIT]))));
      result_in_its_clock: assert (turned_q || !after_q || result == result_q);
      right_is_two_counts: assert (!turned_q || result != 2'(map::SELF_TEST_RIGHT) || result_q == result ||
                                   (judges_then_q && law_then_q == Answer));
      never_in_voltage_mode: assert (!turned_q || !(waits && !waits_then_q) || !direct_then_q);
      patience_ends: assert (!(armed_i && waits) || waited_q <= {1'b0, late, PatienceBit'(turn_tick)});
      inside_net: assert (!(up || down || judges) || (net == law_q && net <= Answer && net >= -Answer));
      inside_units: assert (!turns_ok_q || ( \u_dut.unit_q == turn_tick[UnitBit] && \u_dut.patience_q == turn_tick[PatienceBit]));
      inside_turns: assert (turns_ok_q || !(waits || up || down || judges || late || started_q));
      inside_part: assert (!(armed_i && (up || down)) || (length_now_q <= (16'(units) << UnitBit) + 16'(part) &&
          length_now_q + 16'd127 >= (16'(units) << UnitBit) + 16'(part) &&
          (units < length_q || (units == length_q && part == '0))));
      inside_second: assert (!(armed_i && down) || length_now_q + 16'd1 == (16'(units) << UnitBit) + 16'(part));
      inside_length: assert (!waits || length_q != '0);
      inside_disarmed: assert (armed_i || !started_q || (units == '0 && still_q == '0 && waited_q == '0 && !tested_q &&
                               !up && !down && !judges && !late));
      inside_answer: assert (!(up || down) || law_q >= 0 || down_seen_q);
      inside_pulse: assert (!(armed_i && (up || down)) || length_q != '0);
      inside_still: assert (!(armed_i && waits) || (units == '0 && still_q == '0) ||
                            {1'b0, still_q} + 17'd127 >= (17'(units) << UnitBit) + 17'(part));
      inside_once: assert (!(armed_i && tested_q) || !(waits || up));
      waits_armed: cover (busy && armed_i && waits);
    end
  end
endmodule

`default_nettype wire
