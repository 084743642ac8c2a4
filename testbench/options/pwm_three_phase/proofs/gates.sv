// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The gate pins of any leg, for any on-times, enable and clear in every clock, and the length of their pulses.
`default_nettype none

module gates_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic        enable_i,
    input logic        clear_i,
    input logic [11:0] on_a_i,
    input logic [11:0] on_b_i,
    input logic [11:0] on_c_i
);
  localparam int Period = cfg::PWM_PERIOD;
  localparam int Dead = cfg::DEAD_CLOCKS;
  localparam int Shortest = cfg::SHORTEST_CLOCKS;
  localparam int Half = Period / 2;
  localparam logic [11:0] Most = 12'(Period - Dead - Shortest);
  localparam int DebtBits = $clog2(Shortest);
  localparam int DeadBits = (Dead > 1) ? $clog2(Dead) : 1;

  `include "reset.svh"

  logic period_start;
  logic [2:0] hi_gates, lo_gates;
  pwm_three_phase #(
      .Period(Period),
      .DeadClocks(Dead),
      .ShortestClocks(Shortest)
  ) u_dut (
      .*,
      .gate_a_hi_o(hi_gates[0]),
      .gate_a_lo_o(lo_gates[0]),
      .gate_b_hi_o(hi_gates[1]),
      .gate_b_lo_o(lo_gates[1]),
      .gate_c_hi_o(hi_gates[2]),
      .gate_c_lo_o(lo_gates[2]),
      .period_start_o(period_start)
  );
  (* hierconn *) wire [10:0] \u_dut.level_q ;
  (* hierconn *) wire \u_dut.rising_q ;
  (* hierconn *) wire [35:0] \u_dut.taken_q ;
  (* hierconn *) wire [35:0] \u_dut.threshold_q ;
  (* hierconn *) wire [2:0] \u_dut.high_q ;
  (* hierconn *) wire [2:0] \u_dut.wanted_q ;
  (* hierconn *) wire [DeadBits:0] \u_dut.g_leg[0].dead_q ;
  (* hierconn *) wire [DeadBits:0] \u_dut.g_leg[1].dead_q ;
  (* hierconn *) wire [DeadBits:0] \u_dut.g_leg[2].dead_q ;
  (* hierconn *) wire [2:0] \u_dut.gate_hi_q ;
  (* hierconn *) wire [2:0] \u_dut.gate_lo_q ;
  wire [10:0] level = \u_dut.level_q ;
  wire rising = \u_dut.rising_q ;

  // Any leg.
  (* anyconst *) logic [1:0] leg;
  always_comb assume (leg < 2'd3);
  logic hi, lo, hi_reg, lo_reg, high, wanted;
  logic [11:0] taken, threshold, asked;
  logic [DeadBits:0] dead;
  assign hi        = hi_gates[leg];
  assign lo        = lo_gates[leg];
  assign hi_reg    = \u_dut.gate_hi_q [leg];
  assign lo_reg    = \u_dut.gate_lo_q [leg];
  assign high      = \u_dut.high_q [leg];
  assign wanted    = \u_dut.wanted_q [leg];
  assign taken     = leg == 2'd0 ? \u_dut.taken_q [11:0] : leg == 2'd1 ? \u_dut.taken_q [23:12] : \u_dut.taken_q [35:24];
  assign threshold = leg == 2'd0 ? \u_dut.threshold_q [11:0] : leg == 2'd1 ? \u_dut.threshold_q [23:12] :
                     \u_dut.threshold_q [35:24];
  assign dead      = leg == 2'd0 ? \u_dut.g_leg[0].dead_q : leg == 2'd1 ? \u_dut.g_leg[1].dead_q : \u_dut.g_leg[2].dead_q ;
  assign asked     = leg == 2'd0 ? on_a_i : leg == 2'd1 ? on_b_i : on_c_i;

  // The clocks of short pulses that wait, and the on-time of the period with them.
  logic [12:0] debt, sum;
  logic [11:0] given;
  (* hierconn *) wire [DebtBits-1:0] \u_dut.g_leg[0].g_whole_pulses.debt_q ;
  (* hierconn *) wire [DebtBits-1:0] \u_dut.g_leg[1].g_whole_pulses.debt_q ;
  (* hierconn *) wire [DebtBits-1:0] \u_dut.g_leg[2].g_whole_pulses.debt_q ;
  assign debt  = 13'(leg == 2'd0 ? \u_dut.g_leg[0].g_whole_pulses.debt_q :
                     leg == 2'd1 ? \u_dut.g_leg[1].g_whole_pulses.debt_q : \u_dut.g_leg[2].g_whole_pulses.debt_q );
  assign sum   = 13'(taken) + debt;
  assign given = taken <= 12'(Dead) ? taken : sum < 13'(Dead + Shortest) ? 12'(Dead) :
                 sum > 13'(Most) ? Most : sum[11:0];

  // Clocks since a gate of the leg was on, and since enable_i was low, up to 127; a reset counts as both.
  logic [6:0] hi_off_q, lo_off_q, enabled_q;
  function automatic logic [6:0] off_for(input logic on, input logic [6:0] clocks);
    off_for = on ? 7'd0 : (clocks == 7'd127) ? clocks : clocks + 7'd1;
  endfunction
  // The clock of the period, and for how long high_q has been as it is: this clock too.
  logic [11:0] clock_q, length_q;
  logic on;  // high_q in the next clock
  assign on = {level, rising} <= threshold;
  // Pulses of the leg since its gates opened, up to two; clocks of the one that is on.
  logic [8:0] run_q, run;
  logic [1:0] count_q, count;
  logic cut, clear_q;
  assign cut   = enabled_q == 7'd0 || clear_i || clear_q;
  assign run   = hi || lo ? (run_q == '1 ? run_q : run_q + 9'd1) : 9'd0;
  assign count = cut ? 2'd0 : run == 9'd1 && count_q != 2'd2 ? count_q + 2'd1 : count_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      hi_off_q  <= 7'd0;
      lo_off_q  <= 7'd0;
      enabled_q <= 7'd0;
      clock_q   <= 12'(Period - 2);
      length_q  <= 12'd4095;
      run_q     <= 9'd0;
      count_q   <= 2'd0;
      clear_q   <= 1'b1;
    end else begin
      hi_off_q  <= off_for(hi, hi_off_q);
      lo_off_q  <= off_for(lo, lo_off_q);
      enabled_q <= off_for(!enable_i, enabled_q);
      clock_q   <= clock_q == 12'(Period - 1) ? 12'd0 : clock_q + 12'd1;
      length_q  <= on != high ? 12'd1 : length_q == '1 ? length_q : length_q + 12'd1;
      run_q     <= run;
      count_q   <= count;
      clear_q   <= clear_i;
    end
  end
  logic after_q, asked_enabled_q;
  logic [11:0] taken_q, asked_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end
  always_ff @(posedge clk_i) begin
    taken_q         <= taken;
    asked_q         <= asked;
    asked_enabled_q <= enable_i;
  end

  always_comb begin
    if (past_ok_q) begin
      never_both: assert (!(hi && lo));
      disabled_is_off: assert (enabled_q != 7'd0 || (!hi && !lo));
      clear_is_off: assert (!clear_i || (!hi && !lo));
      reset_is_off: assert (rst_ni || (!hi && !lo));
    end
    if (past_ok_q && rst_ni) begin
      dead_time: assert ((!lo || hi_off_q >= 7'(Dead)) && (!hi || lo_off_q >= 7'(Dead)));
      on_after_dead_time: assert ((!hi && !lo) || enabled_q >= 7'(Dead));
      no_pulse_too_short: assert (hi || lo || run_q == '0 || cut || count_q != 2'd2 || run_q >= 9'(Shortest));
      taken_at_the_boundary: assert (!after_q || taken == (!asked_enabled_q ? 12'd0 : period_start ? asked_q : taken_q));
      period_is_exact: assert (period_start == (clock_q == 12'(Period - 1) && after_q));
      braked: cover (lo);
      waits: cover (lo && threshold == 12'(Dead) && taken != 12'(Dead));
    end
  end

  // The carrier by the clock; where a leg begins to be high, and the fewest clocks that it is low at an end of a period.
  localparam logic [13:0] LowHalf = 14'((Dead + Shortest) / 2);
  logic [13:0] done, first_on, length;
  assign done     = 14'(clock_q);
  assign length   = 14'(length_q);
  assign first_on = (14'(Period) - 14'(threshold) + 14'd1) >> 1;
  // The count of the dead time is no further than the time that both gates have been off.
  localparam logic [DeadBits:0] Start = (DeadBits + 1)'(2 ** DeadBits - (Dead - 1));
  logic [7:0] waited;
  assign waited = 8'(dead) - 8'(Start);
  always_comb begin
    if (rst_ni && past_ok_q) begin
      inside_hi_lo: assert (!(hi_reg && lo_reg) && !(hi_reg && !wanted) && !(lo_reg && wanted));
      inside_start: assert (dead >= Start && waited <= 8'(Dead - 1));
      inside_side: assert (wanted ? 8'(lo_off_q) >= waited : 8'(hi_off_q) >= waited);
      inside_enabled: assert (8'(enabled_q) >= waited);
      inside_on: assert (!(hi_reg || lo_reg) || waited == 8'(Dead - 1) || Dead == 1);

      inside_clock: assert (clock_q < 12'(Period) && (after_q || clock_q == 12'(Period - 2)));
      inside_rising: assert (rising == (done >= 14'(Half)));
      inside_level: assert (rising ? 14'(level) == done - 14'(Half) : 14'(level) == 14'(Half) - done);
      inside_whole: assert (threshold <= Most &&
                            (threshold <= 12'(Dead) || threshold >= 12'(Dead + Shortest)));
      inside_cleared: assert (enabled_q > 7'd1 || !after_q || enabled_q == 7'd0 || threshold == '0);
      inside_taken: assert (period_start || enabled_q == '0 || threshold == given);
      inside_debt: assert (debt < 13'(Shortest) && (enabled_q != 7'd0 || debt == '0));
      inside_high: assert (!high || enabled_q < 7'd2 || (length + first_on == done && done <= first_on + 14'(threshold)));
      inside_low_end: assert (high || length + 14'(Period) >= done + LowHalf);
      inside_high_end: assert (!high || done + LowHalf <= 14'(Period));
      inside_low: assert (high || threshold == '0 || done > first_on || length >= done + LowHalf);
      inside_length: assert (length_q != '0 && (wanted == high) == (length_q != 12'd1));
      inside_waited: assert (wanted != high || 14'(waited) + 14'd2 <= length);
      inside_opens: assert (count == '0 || hi || lo || wanted != high || length <= 14'(waited) + 14'd2);
      inside_run: assert (count != 2'd2 || !(hi || lo) || run >= 9'(Shortest) ||
                          (wanted == high && length <= 14'(run) + 14'(Dead + 1)));
      inside_lasts: assert (!(hi_reg || lo_reg) || wanted != high || length >= 14'(Dead + 2));
      inside_count: assert (count == '0 || enabled_q >= 7'(Dead));
      inside_count_q: assert (count_q != 2'd3);
    end
  end
endmodule

`default_nettype wire
