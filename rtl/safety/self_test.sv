// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Self-test after arming: waits until the lever is at rest, applies a torque pulse and then its
// opposite, and checks the direction of motion before the scene begins. A wrong direction trips, as
// do a lever that is held and one that does not come to rest, unless the design arms then.
// The state changes with start_i; trip_o is high a clock later. docs/blocks/safety.md

`default_nettype none

module self_test (
    input  logic                                  clk_i,
    input  logic                                  rst_ni,
    input  cfg::params_t                          p,
    input  logic                                  armed_i,
    input  logic                                  direct_i,      // voltage mode: no test
    input  logic                                  waits_i,       // an axis of a lower number tests first
    input  logic        [                    1:0] travel_i,      // counts, low bits
    input  logic        [                   31:0] tick_count_i,
    input  logic                                  sample_i,      // a tick begins
    input  logic                                  start_i,       // one clock a tick, after the scene's
    output logic                                  busy_o,        // the scene waits
    output logic signed [cfg::SCENE_TORQUE_W-1:0] torque_o,      // while busy; a pulse is beyond every limit
    output logic        [                    1:0] result_o,
    output logic                                  trip_o         // one clock
);
  localparam int W = map::SELF_TEST_COUNT_BITS;
  localparam logic signed [2:0] Answer = 3'(map::SELF_TEST_COUNTS);
  typedef enum logic [2:0] {Done, Wait, First, Second, Judge} state_t;
  state_t state_q;

  // Motion since the previous tick, in counts modulo 4. Of two counts the direction is unknown.
  logic [1:0] now_q, before_q, step;
  logic still;
  assign step  = now_q - before_q;
  assign still = step == 2'd0;

  // Counts since the first pulse began. They stop at +-Answer. Motion that begins only in the second
  // pulse does not count.
  logic signed [2:0] net_q, net;
  logic pushes, failed;
  assign pushes = state_q == First || state_q == Second;
  always_comb begin
    net = net_q;
    if (step[0] && net_q != Answer && net_q != -Answer && (state_q == First || (state_q == Second && net_q != '0)))
      net = step[1] ? net_q - 3'sd1 : net_q + 3'sd1;
  end
  assign failed = net_q != Answer;

  // Units of 2^SELF_TEST_UNIT_BITS ticks; it stops at its largest value, when every time is over.
  logic [W-1:0] units_q;
  logic unit_q, patience_q, unit, patience, late_q, quiet, over, gives_up, begins;
  assign unit     = tick_count_i[map::SELF_TEST_UNIT_BITS] != unit_q;
  assign patience = tick_count_i[map::SELF_TEST_PATIENCE_BITS] != patience_q;
  assign quiet    = units_q == '1 || units_q >= p.self_test_quiet;
  assign over     = units_q == '1 || units_q >= p.self_test_pulse;
  assign gives_up = patience && late_q;
  assign begins   = quiet && still && !gives_up && !waits_i;

  logic fail_q, at;
  assign busy_o   = armed_i && state_q != Done;
  assign trip_o   = at && fail_q;
  assign torque_o = {state_q == Second, {(cfg::SCENE_TORQUE_W - 1) {state_q == First}}};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {now_q, before_q, net_q, units_q, unit_q, patience_q, late_q, fail_q, at, result_o} <= '0;
      state_q <= Done;
    end else begin
      at <= start_i;
      if (sample_i) {before_q, now_q} <= {now_q, travel_i};
      if (start_i) begin
        unit_q     <= tick_count_i[map::SELF_TEST_UNIT_BITS];
        patience_q <= tick_count_i[map::SELF_TEST_PATIENCE_BITS];
        fail_q     <= 1'b0;
        late_q     <= 1'b0;
        net_q      <= state_q == Wait ? '0 : net;
        units_q    <= '0;
        if (!armed_i) begin
          // A pulse of 0 units means no test.
          state_q <= over || direct_i ? Done : Wait;
          if (over || direct_i) result_o <= 2'd0;
        end else begin
          case (state_q)
            Wait: begin
              result_o <= gives_up ? 2'(map::SELF_TEST_MOVING) : 2'd0;
              late_q   <= !waits_i && (late_q || patience);
              fail_q   <= gives_up && !p.self_test_arms[map::SELF_TEST_MOVING_BIT];
              if (gives_up) state_q <= Done;
              else if (begins) state_q <= First;
              else if (!waits_i && still) units_q <= units_q + W'(unit);
            end
            First, Second: begin
              fail_q <= net == -Answer;
              if (over) state_q <= state_q == First ? Second : Judge;
              else units_q <= units_q + W'(unit);
            end
            Judge: begin
              result_o <= failed ? 2'(map::SELF_TEST_HELD) : 2'(map::SELF_TEST_RIGHT);
              fail_q   <= failed && !p.self_test_arms[map::SELF_TEST_HELD_BIT];
              state_q  <= Done;
            end
            default: ;
          endcase
        end
      end
    end
  end
endmodule

`default_nettype wire
