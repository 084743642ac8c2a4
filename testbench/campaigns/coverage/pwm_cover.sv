// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of pwm: duties and pulses at every end, in both modes, and what may meet a gate that is on.
// docs/testing.md
`default_nettype none

module pwm_cover #(
  parameter int Period     = 1000,
  parameter int DeadClocks = 25
) (
  input logic               clk_i,
  input logic               rst_ni,
  input logic               clear_i,
  input logic               enable_i,
  input logic               mode_i,
  input logic               polarity_i,
  input logic               take,
  input logic signed [12:0] duty_i,
  input logic signed [13:0] threshold_q,
  input logic        [1:0]  gate_hi_q,
  input logic        [1:0]  gate_lo_q,
  input logic        [1:0]  changes,
  input logic        [1:0]  elapsed
);
  localparam logic signed [13:0] FULL = 14'(Period);
  localparam logic signed [13:0] DEAD = 14'(DeadClocks);

  logic signed [13:0] duty;
  logic               taken, running;
  logic        [3:0]  gates;
  assign duty    = 14'(duty_i);
  assign taken   = take && enable_i;
  assign running = enable_i && !clear_i;
  assign gates   = {gate_hi_q, gate_lo_q};

  for (genvar n = 0; n < 4; n++) begin : g_mode  // both modes, both polarities
    logic here;
    assign here = taken && {mode_i, polarity_i} == 2'(n);
    duty_zero:          cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == 0);
    duty_one:           cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == 1);
    duty_minus_one:     cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == -1);
    duty_full:          cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == FULL);
    duty_minus_full:    cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == -FULL);
    duty_nearly_full:   cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == FULL - 1);
    duty_minus_nearly:  cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == 1 - FULL);
    duty_beyond:        cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty > FULL);
    duty_minus_beyond:  cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty < -FULL);
    duty_dead_time:     cover property (@(posedge clk_i) disable iff (!rst_ni) here && duty == DEAD);
    duty_below_dead:    cover property (@(posedge clk_i) disable iff (!rst_ni)
                                        here && duty > 0 && duty < DEAD);
  end

  for (genvar l = 0; l < 2; l++) begin : g_leg
    logic hi, lo;
    assign hi = gate_hi_q[l];
    assign lo = gate_lo_q[l];
    // A level wanted for less than the dead time: the gate stays off.
    pulse_swallowed:  cover property (@(posedge clk_i) disable iff (!rst_ni)
                                      running && changes[l] && !elapsed[l] && !hi && !lo);
    disabled_in_high: cover property (@(posedge clk_i) disable iff (!rst_ni) hi && !enable_i && !clear_i);
    disabled_in_low:  cover property (@(posedge clk_i) disable iff (!rst_ni) lo && !enable_i && !clear_i);
    both_off_running: cover property (@(posedge clk_i) disable iff (!rst_ni) running && !hi && !lo && elapsed[l]);
  end

  // The raw clear comes between the clocks.
  cleared_in_high:     cover property (@(posedge clear_i) rst_ni && gate_hi_q != 2'b00);
  cleared_in_low:      cover property (@(posedge clear_i) rst_ni && gate_hi_q == 2'b00 && gate_lo_q != 2'b00);
  disabled_at_take:    cover property (@(posedge clk_i) disable iff (!rst_ni) take && !enable_i && duty != 0);
  driven_forward:      cover property (@(posedge clk_i) disable iff (!rst_ni) gates == 4'b0110);
  driven_backward:     cover property (@(posedge clk_i) disable iff (!rst_ni) gates == 4'b1001);
  both_low:            cover property (@(posedge clk_i) disable iff (!rst_ni) gates == 4'b0011);
  never_above_carrier: cover property (@(posedge clk_i) disable iff (!rst_ni) running && threshold_q <= 0);
  always_above:        cover property (@(posedge clk_i) disable iff (!rst_ni) running && threshold_q >= FULL);
endmodule

bind pwm pwm_cover #(.Period(Period), .DeadClocks(DeadClocks)) u_cover (.*);

`default_nettype wire
