// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Centre-aligned PWM for three legs, with dead time: the carrier, the dead time and the gates are those of pwm.
// On-times [0,12,0] clocks of the high switch. They are sampled once per period and are new with period_start_o; they
// reach the gates 3 clocks later (turn-on: plus the dead time). Disabled, all six gates are off and the on-times are 0.
// docs/blocks/pwm.md

`default_nettype none

module pwm_three_phase #(
    parameter int Period         = 1000,  // clocks, even, 4 to 4094
    parameter int DeadClocks     = 25,    // clocks, 1 to 64
    parameter int ShortestClocks = 1      // shortest pulse at a gate in clocks, 1 to 255
) (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        clear_i,        // asynchronous: every gate off at once, needs no clock
    input  logic        enable_i,       // 0: every gate off with the next edge, on-times 0
    input  logic [11:0] on_a_i,         // clocks; saturates at Period
    input  logic [11:0] on_b_i,
    input  logic [11:0] on_c_i,
    output logic        gate_a_hi_o,
    output logic        gate_a_lo_o,
    output logic        gate_b_hi_o,
    output logic        gate_b_lo_o,
    output logic        gate_c_hi_o,
    output logic        gate_c_lo_o,
    output logic        period_start_o  // one clock: the on-times have just been sampled
);
  generate
  if (!(Period >= 4 && Period <= 4094 && Period % 2 == 0 && DeadClocks >= 1 && DeadClocks <= 64 && ShortestClocks >= 1 &&
        ShortestClocks <= 255 && (ShortestClocks == 1 || 2 * (DeadClocks + ShortestClocks) <= Period))) begin : g_check
    a_parameter_of_pwm_three_phase_is_out_of_its_range missing ();
  end
  endgenerate

  localparam logic [10:0] Last = 11'(Period / 2 - 1);

  // The carrier {level, rising} runs through Period, Period-2 .. 2, 1, 3 .. Period-1, as in pwm: carrier <= n is true for
  // exactly n clocks, in one piece.
  logic [10:0] level_q;
  logic        rising_q, take, turn;
  assign take = rising_q && level_q == Last - 11'd1;  // one clock before the end of the period
  assign turn = rising_q ? period_start_o : level_q == 11'd1;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      level_q        <= Last - 11'd1;  // the first clock after reset takes the first on-times
      rising_q       <= 1'b1;
      period_start_o <= 1'b0;
    end else begin
      level_q        <= level_q + {{10{!rising_q}}, 1'b1};
      rising_q       <= rising_q ^ turn;
      period_start_o <= take;
    end
  end

  // Legs C, B, A. On-times of one enable must not reach the gates in the next, so disabling clears them.
  logic [35:0] taken_q, threshold_q, whole;
  logic [ 2:0] high_q, wanted_q, changes, elapsed;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) taken_q <= '0;
    else if (!enable_i) taken_q <= '0;
    else if (take) taken_q <= {on_c_i, on_b_i, on_a_i};
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      threshold_q <= '0;
      wanted_q    <= '0;
    end else begin
      threshold_q <= whole;
      wanted_q    <= high_q;
    end
  end
  assign changes = high_q ^ wanted_q;

  // Each leg: both gates are off for DeadClocks after each change of the wanted level, and while disabled. The top bit of
  // dead_q marks the end of the count of DeadClocks - 1. No gate gets a pulse shorter than ShortestClocks: the clocks of a
  // short high pulse wait in debt_q until they make a whole one, a short low pulse is made longer.
  localparam int DeadBits = (DeadClocks > 1) ? $clog2(DeadClocks) : 1;
  localparam logic [DeadBits:0] Dead = (DeadBits + 1)'(2 ** DeadBits - (DeadClocks - 1));

  generate
  genvar l;
  for (l = 0; l < 3; l = l + 1) begin : g_leg
    logic [DeadBits:0] dead_q;
    logic       [11:0] on, unused_difference;
    logic              above;  // carrier > threshold

    assign on = taken_q[12*l+:12];
    if (ShortestClocks == 1) begin : g_any_pulse
      assign whole[12*l+:12] = on;
    end else begin : g_whole_pulses
      localparam int DebtBits = $clog2(ShortestClocks);
      localparam logic [12:0] DeadTime = 13'(DeadClocks);
      localparam logic [12:0] Least = 13'(DeadClocks + ShortestClocks);
      localparam logic [12:0] Most = 13'(Period - DeadClocks - ShortestClocks);
      logic [DebtBits-1:0] debt_q, debt_d;  // clocks
      logic [12:0] sum;
      logic [11:0] given;

      assign sum = {1'b0, on} + 13'(debt_q);
      always_comb begin
        given  = sum[11:0];
        debt_d = '0;
        if (sum > Most) given = Most[11:0];
        else if (on <= DeadTime[11:0]) begin
          given  = on;
          debt_d = debt_q;
        end else if (sum < Least) begin
          given  = DeadTime[11:0];
          debt_d = DebtBits'(sum - DeadTime);
        end
      end
      always_ff @(posedge clk_i or negedge rst_ni) begin
        if (!rst_ni) debt_q <= '0;
        else if (!enable_i) debt_q <= '0;
        else if (take) debt_q <= debt_d;
      end
      assign whole[12*l+:12] = given;
    end
    assign {above, unused_difference} = {1'b0, threshold_q[12*l+:12]} - {1'b0, level_q, rising_q};
    assign elapsed[l] = dead_q[DeadBits];

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        high_q[l] <= 1'b0;
        dead_q    <= Dead;
      end else begin
        high_q[l] <= !above;
        if (!enable_i || changes[l]) dead_q <= Dead;
        else if (!dead_q[DeadBits]) dead_q <= dead_q + 1'b1;
      end
    end
  end
  endgenerate

  // The gates: six registers with one asynchronous clear. They drive only the pins, so the tool can place them in the I/O
  // cells (Quartus reads useioff; for ECP5 docs/boards/ulx3s.md).
  logic       clear;
  logic [2:0] ready;
  (* useioff = 1 *) logic [2:0] gate_hi_q = 3'b000;  // off at power-up, before any reset
  (* useioff = 1 *) logic [2:0] gate_lo_q = 3'b000;
  assign clear = !rst_ni || clear_i;
  assign ready = {3{enable_i}} & ~changes & elapsed;
  always_ff @(posedge clk_i or posedge clear) begin
    if (clear) begin
      gate_hi_q <= 3'b000;
      gate_lo_q <= 3'b000;
    end else begin
      gate_hi_q <= ready & wanted_q;
      gate_lo_q <= ready & ~wanted_q;
    end
  end
  assign {gate_c_hi_o, gate_b_hi_o, gate_a_hi_o} = gate_hi_q;
  assign {gate_c_lo_o, gate_b_lo_o, gate_a_lo_o} = gate_lo_q;
endmodule

`default_nettype wire
