// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Centre-aligned PWM for an H-bridge, sign-magnitude or locked-antiphase, with dead time.
// Duty [1,12,0] clocks. It is sampled once per period and is new with period_start_o; it reaches
// the gates 3 clocks later (turn-on: plus the dead time). Disabled, duty 0 is in force. The gate
// outputs are registers.
// Documentation: docs/blocks/pwm.md
`default_nettype none

module pwm #(
  parameter int Period         = 1000,  // clocks, even, 4 to 4094
  parameter int DeadClocks     = 25,    // clocks, 1 to 64
  parameter int ShortestClocks = 1      // shortest pulse at a gate in clocks, 1 to 255
) (
  input  logic               clk_i,
  input  logic               rst_ni,
  input  logic               clear_i,         // asynchronous: every gate off at once, needs no clock
  input  logic               enable_i,        // 0: every gate off with the next edge, duty 0
  input  logic               mode_i,          // 0: sign-magnitude, 1: locked-antiphase
  input  logic               polarity_i,      // 1: the motor's wires are swapped
  input  logic signed [12:0] duty_i,          // clocks; saturates at +-Period
  output logic               gate_a_hi_o,
  output logic               gate_a_lo_o,
  output logic               gate_b_hi_o,
  output logic               gate_b_lo_o,
  output logic               period_start_o,  // one clock: duty_i has just been sampled
  output logic signed [12:0] duty_active_o    // the sampled duty, 0 while disabled
);

  generate
  if (!(Period >= 4 && Period <= 4094 && Period % 2 == 0)) begin : g_check_period
    PWM_PERIOD_must_be_even_and_4_to_4094 missing ();
  end
  if (!(DeadClocks >= 1 && DeadClocks <= 64)) begin : g_check_dead_time
    DEAD_CLOCKS_must_be_1_to_64 missing ();
  end
  if (!(ShortestClocks >= 1 && ShortestClocks <= 255 &&
        (ShortestClocks == 1 || 2 * (DeadClocks + ShortestClocks) <= Period))) begin : g_check_shortest
    SHORTEST_CLOCKS_must_be_1_to_255_and_with_DEAD_CLOCKS_half_a_period_at_most missing ();
  end
  endgenerate

  localparam logic signed [13:0] HALF = 14'(Period / 2);
  localparam logic        [10:0] LAST = 11'(Period / 2 - 1);

  // The carrier {level, rising} runs through Period, Period-2 .. 2, 1, 3 .. Period-1: each number
  // from 1 to Period once. So carrier <= n is true for exactly n clocks, centred to half a clock.
  logic [10:0] level_q;
  logic        rising_q, take, turn;

  assign take = rising_q && level_q == LAST - 11'd1;  // one clock before the end of the period
  assign turn = rising_q ? period_start_o : level_q == 11'd1;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      level_q        <= LAST - 11'd1;  // the first clock after reset takes the first duty
      rising_q       <= 1'b1;
      period_start_o <= 1'b0;
    end else begin
      level_q        <= level_q + {{10{!rising_q}}, 1'b1};
      rising_q       <= rising_q ^ turn;
      period_start_o <= take;
    end
  end

  // On-time in clocks: |duty| in sign-magnitude, floor((Period + duty) / 2) in locked-antiphase.
  logic               antiphase_q, negate_q, switch_b_q;
  logic               increment, unused_sum;
  logic signed [13:0] addend, threshold_d;

  assign addend    = (antiphase_q ? {{2{duty_active_o[12]}}, duty_active_o[12:1]} :
                                    {duty_active_o[12], duty_active_o}) ^ {14{negate_q}};
  assign increment = negate_q && !(antiphase_q && duty_active_o[0]);
  // One carry chain: the bit below the operands carries the increment in.
  assign {threshold_d, unused_sum} = {antiphase_q ? HALF : 14'sd0, 1'b1} + {addend, increment};

  // A duty of one arming must not reach the gates in the next arming, so disabling clears it. Duty
  // 0 needs no sign, so the sign registers are not cleared.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) duty_active_o <= 13'sd0;
    else if (!enable_i) duty_active_o <= 13'sd0;
    else if (take) duty_active_o <= duty_i;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      antiphase_q <= 1'b0;
      negate_q    <= 1'b0;
      switch_b_q  <= 1'b0;
    end else if (take) begin
      antiphase_q <= mode_i;
      negate_q    <= mode_i ? polarity_i : duty_i[12];
      switch_b_q  <= duty_i[12] ^ polarity_i;
    end
  end

  // No gate gets a pulse shorter than ShortestClocks. In sign-magnitude the clocks of a short high
  // pulse wait in debt_q until they make a whole one, so the mean voltage is that of the duty. In
  // antiphase, where both legs always switch, a short high pulse is made longer. A short low pulse
  // is made longer.
  logic signed [13:0] whole_d;

  generate
  if (ShortestClocks == 1) begin : g_any_pulse
    assign whole_d = threshold_d;
  end else begin : g_whole_pulses
    localparam int DEBT_BITS = $clog2(ShortestClocks);
    localparam logic signed [13:0] DEAD_TIME = 14'(DeadClocks);
    localparam logic signed [13:0] LEAST     = 14'(DeadClocks + ShortestClocks);
    localparam logic signed [13:0] MOST      = 14'(Period - DeadClocks - ShortestClocks);
    logic        [DEBT_BITS-1:0] debt_q, debt_d;  // clocks of this direction; 0 in antiphase
    logic signed          [13:0] sum;
    logic                        turns;

    assign sum   = threshold_d + 14'(debt_q);
    assign turns = mode_i || (duty_i[12] ^ polarity_i) != switch_b_q;
    always_comb begin
      whole_d = sum;
      debt_d  = '0;
      if (sum > MOST) whole_d = MOST;
      else if (antiphase_q) whole_d = (sum < LEAST) ? LEAST : sum;
      else if (threshold_d <= DEAD_TIME) begin
        whole_d = threshold_d;
        debt_d  = debt_q;
      end else if (sum < LEAST) begin
        whole_d = DEAD_TIME;
        debt_d  = DEBT_BITS'(sum - DEAD_TIME);
      end
    end
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) debt_q <= '0;
      else if (!enable_i) debt_q <= '0;
      else if (take) debt_q <= turns ? '0 : debt_d;
    end
  end
  endgenerate

  logic signed [13:0] threshold_q;
  logic               antiphase_q2, switch_b_q2;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      threshold_q  <= 14'sd0;
      antiphase_q2 <= 1'b0;
      switch_b_q2  <= 1'b0;
    end else begin
      threshold_q  <= whole_d;
      antiphase_q2 <= antiphase_q;
      switch_b_q2  <= switch_b_q;
    end
  end

  // threshold - carrier lies in -5643..4095, so its sign bit is the comparison.
  logic        above;
  logic [12:0] unused_difference;
  logic [1:0]  high_q;  // bit 0 leg A, bit 1 leg B: to be high

  assign {above, unused_difference} = threshold_q - {2'b00, level_q, rising_q};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) high_q <= 2'b00;
    else if (above) high_q <= {antiphase_q2, 1'b0};
    else high_q <= {switch_b_q2 && !antiphase_q2, !switch_b_q2 || antiphase_q2};
  end

  // Each leg: both gates are off for DeadClocks after each change of the wanted level, and while
  // disabled. The top bit of dead_q marks the end of the count of DeadClocks - 1.
  localparam int DEAD_BITS = (DeadClocks > 1) ? $clog2(DeadClocks) : 1;
  localparam logic [DEAD_BITS:0] DEAD = (DEAD_BITS + 1)'(2 ** DEAD_BITS - (DeadClocks - 1));

  logic [1:0] wanted_q, changes, elapsed;

  assign changes = high_q ^ wanted_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) wanted_q <= 2'b00;
    else wanted_q <= high_q;
  end

  generate
  genvar l;
  for (l = 0; l < 2; l = l + 1) begin : g_leg
    logic [DEAD_BITS:0] dead_q;

    assign elapsed[l] = dead_q[DEAD_BITS];

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) dead_q <= DEAD;
      else if (!enable_i || changes[l]) dead_q <= DEAD;
      else if (!dead_q[DEAD_BITS]) dead_q <= dead_q + 1'b1;
    end
  end
  endgenerate

  // The gates: four registers with one asynchronous clear. They drive only the pins, so the tool
  // can place them in the I/O cells (Quartus reads useioff; for ECP5 docs/boards/ulx3s.md).
  logic       clear;
  logic [1:0] ready;
  (* useioff = 1 *) logic [1:0] gate_hi_q = 2'b00;  // off at power-up, before any reset
  (* useioff = 1 *) logic [1:0] gate_lo_q = 2'b00;

  assign clear = !rst_ni || clear_i;
  assign ready = {2{enable_i}} & ~changes & elapsed;

  always_ff @(posedge clk_i or posedge clear) begin
    if (clear) begin
      gate_hi_q <= 2'b00;
      gate_lo_q <= 2'b00;
    end else begin
      gate_hi_q <= ready & wanted_q;
      gate_lo_q <= ready & ~wanted_q;
    end
  end

  assign gate_a_hi_o = gate_hi_q[0];
  assign gate_a_lo_o = gate_lo_q[0];
  assign gate_b_hi_o = gate_hi_q[1];
  assign gate_b_lo_o = gate_lo_q[1];

endmodule

`default_nettype wire
