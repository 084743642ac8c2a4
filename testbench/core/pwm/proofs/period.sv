// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The period and the time that a leg is wanted on in it, before the dead time is taken off: a count of these
// clocks beside the carrier.
`default_nettype none

module period_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic               enable_i,
    input logic               clear_i,
    input logic               mode_i,
    input logic               polarity_i,
    input logic signed [12:0] duty_i
);
  localparam int Period = cfg::PWM_PERIOD;
  localparam int Half = Period / 2;

  `include "reset.svh"

  logic period_start;
  logic signed [12:0] duty_active;
  pwm #(
      .Period(Period),
      .DeadClocks(cfg::DEAD_CLOCKS)
  ) u_dut (
      .*,
      .gate_a_hi_o(),
      .gate_a_lo_o(),
      .gate_b_hi_o(),
      .gate_b_lo_o(),
      .period_start_o(period_start),
      .duty_active_o(duty_active)
  );
  (* hierconn *) wire [10:0] \u_dut.level_q ;
  wire [10:0] level = \u_dut.level_q ;
  (* hierconn *) wire \u_dut.rising_q ;
  wire rising = \u_dut.rising_q ;
  (* hierconn *) wire signed [13:0] \u_dut.threshold_q ;
  wire signed [13:0] threshold = \u_dut.threshold_q ;
  (* hierconn *) wire \u_dut.antiphase_q ;
  wire antiphase_taken_q = \u_dut.antiphase_q ;
  (* hierconn *) wire \u_dut.negate_q ;
  wire negate = \u_dut.negate_q ;
  (* hierconn *) wire \u_dut.antiphase_q2 ;
  wire antiphase = \u_dut.antiphase_q2 ;
  (* hierconn *) wire \u_dut.switch_b_q2 ;
  wire switch_b = \u_dut.switch_b_q2 ;
  (* hierconn *) wire [1:0] \u_dut.high_q ;
  wire [1:0] high = \u_dut.high_q ;

  // Clocks of the period before this one, in which the legs were wanted on; mode and polarity as taken.
  logic [11:0] clock_q, on_q;
  logic        on, after_q, twice_q, start_q;
  logic        steady_q;  // enabled since before this period
  logic        enable_q, enable_q2, mode_q, polarity_q, was_mode_q, was_polarity_q;
  logic        on_last_q, antiphase_last_q, switch_b_last_q;
  logic signed [12:0] duty_q, active_q;
  logic signed [13:0] threshold_last_q;
  (* hierconn *) wire \u_dut.above ;
  assign on = !\u_dut.above ;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      clock_q    <= 12'(Period - 2);
      on_q       <= 12'd0;
      after_q    <= 1'b0;
      twice_q    <= 1'b0;
      steady_q   <= 1'b0;
      mode_q     <= 1'b0;
      polarity_q <= 1'b0;
    end else begin
      clock_q <= (clock_q == 12'(Period - 1)) ? 12'd0 : clock_q + 12'd1;
      on_q    <= (clock_q == 12'(Period - 1)) ? 12'd0 : on_q + 12'(on);
      after_q <= 1'b1;
      twice_q <= after_q;
      if (!enable_i) steady_q <= 1'b0;
      else if (clock_q == 12'(Period - 1)) steady_q <= after_q && enable_q;
      if (clock_q == 12'(Period - 2)) begin
        mode_q     <= mode_i;
        polarity_q <= polarity_i;
      end
    end
  end
  always_ff @(posedge clk_i) begin
    duty_q           <= duty_i;
    active_q         <= duty_active;
    enable_q         <= enable_i;
    enable_q2        <= enable_q;
    start_q          <= period_start;
    was_mode_q       <= mode_q;
    was_polarity_q   <= polarity_q;
    on_last_q        <= on;
    threshold_last_q <= threshold;
    antiphase_last_q <= antiphase;
    switch_b_last_q  <= switch_b;
  end

  function automatic logic signed [14:0] on_clocks(input logic signed [12:0] duty, input logic both,
                                                   input logic other);
    logic signed [14:0] d;
    d = 15'(duty);
    if (both) on_clocks = (15'(Period) + (other ? 15'sd0 - d : d)) >>> 1;
    else on_clocks = (d < 0) ? 15'sd0 - d : d;
  endfunction
  logic signed [14:0] wanted, held;
  assign wanted = on_clocks(active_q, was_mode_q, was_polarity_q);
  assign held   = (threshold > 14'(Period)) ? 15'(Period) : (threshold < 0) ? 15'sd0 : 15'(threshold);

  always_comb begin
    if (rst_ni && past_ok_q) begin
      period_is_exact: assert (period_start == (clock_q == 12'(Period - 1) && after_q));
      duty_at_the_boundary: assert (!after_q || duty_active ==
                                    (!enable_q ? 13'sd0 : period_start ? duty_q : active_q));
      threshold_is_the_duty: assert (!after_q || 15'(threshold) == wanted);
      inside_held: assert (!twice_q || start_q || !enable_q2 || threshold == threshold_last_q);
      on_time_is_exact: assert (!steady_q || clock_q != 12'(Period - 1) || 15'(on_q) + 15'(on) == held);
      one_leg_switches: assert (!after_q || high == (on_last_q ?
          {switch_b_last_q && !antiphase_last_q, !switch_b_last_q || antiphase_last_q} :
          {antiphase_last_q, 1'b0}));
      taken: cover (after_q && start_q && threshold == 14'sd7);
      antiphase_taken: cover (after_q && start_q && was_mode_q && was_polarity_q && threshold == 14'sd1);
    end
  end

  // The carrier by the clock, the count so far by carrier and threshold.
  logic signed [14:0] first_on, last_on, so_far, done;
  assign done     = 15'(clock_q);
  assign first_on = (15'(Period) - held + 15'sd1) >>> 1;  // clocks of the falling half that are off
  assign last_on  = (held + 15'sd1) >>> 1;  // clocks of the rising half that are on
  always_comb begin
    if (done <= 15'(Half)) so_far = (done > first_on) ? done - first_on : 15'sd0;
    else so_far = 15'(Half) - first_on + ((done - 15'(Half) < last_on) ? done - 15'(Half) : last_on);
  end
  always_comb begin
    if (rst_ni && past_ok_q) begin
      inside_mode: assert (antiphase_taken_q == mode_q);
      inside_negate: assert (mode_q ? negate == polarity_q : duty_active == 0 || negate == duty_active[12]);
      inside_steady: assert (!steady_q || (after_q && enable_q && (clock_q == 12'(Period - 1) ||
                             15'(threshold) == on_clocks(duty_active, mode_q, polarity_q))));
      inside_threshold: assert (15'(threshold) >= -15'sd2048 && 15'(threshold) <= 15'sd4096);
      inside_clock: assert (clock_q < 12'(Period));
      inside_level: assert (rising ? 15'(level) == done - 15'(Half) : 15'(level) == 15'(Half) - done);
      inside_rising: assert (rising == (done >= 15'(Half)));
      inside_on: assert (!steady_q || 15'(on_q) == so_far);
      inside_after: assert (after_q || clock_q == 12'(Period - 2));
    end
  end
endmodule

`default_nettype wire
