// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// No leg is wanted on for so few or so many clocks that a gate gets a pulse shorter than the design's
// shortest, and what a period does not give, a later one does. `period` says that these clocks are one
// piece, `legs` that each pulse loses the dead time.
`default_nettype none

module whole_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic               enable_i,
    input logic               clear_i,
    input logic               mode_i,
    input logic               polarity_i,
    input logic signed [12:0] duty_i
);
  localparam int Period = cfg::PWM_PERIOD;
  localparam int Dead = cfg::DEAD_CLOCKS;
  localparam int Shortest = cfg::SHORTEST_CLOCKS;

  `include "reset.svh"

  logic period_start;
  logic signed [12:0] duty_active;
  pwm #(
      .Period(Period),
      .DeadClocks(Dead),
      .ShortestClocks(Shortest)
  ) u_dut (
      .*,
      .gate_a_hi_o(),
      .gate_a_lo_o(),
      .gate_b_hi_o(),
      .gate_b_lo_o(),
      .period_start_o(period_start),
      .duty_active_o(duty_active)
  );
  (* hierconn *) wire signed [13:0] \u_dut.threshold_q ;
  wire signed [13:0] wanted = \u_dut.threshold_q ;
  (* hierconn *) wire signed [13:0] \u_dut.threshold_d ;
  (* hierconn *) wire \u_dut.antiphase_q2 ;
  wire antiphase = \u_dut.antiphase_q2 ;

  localparam int DebtBits = $clog2(Shortest);
  (* hierconn *) wire [DebtBits-1:0] \u_dut.g_whole_pulses.debt_q ;
  wire [DebtBits-1:0] debt = \u_dut.g_whole_pulses.debt_q ;
  (* hierconn *) wire \u_dut.take ;
  (* hierconn *) wire \u_dut.antiphase_q ;
  (* hierconn *) wire \u_dut.switch_b_q ;

  // Clocks of the high and of the low gate that are left after the dead time, those of the duty of one
  // clock before, and those that waited.
  logic signed [14:0] high_left, low_left, duty_left_q, waited_q, debt_left;
  assign high_left = 15'(wanted) - 15'(Dead);
  assign low_left  = 15'(Period) - 15'(wanted) - 15'(Dead);
  assign debt_left = 15'(debt);
  logic after_q, take_q, turned_q, enable_q, antiphase_taken_q;
  always_ff @(posedge clk_i) begin
    duty_left_q       <= 15'(\u_dut.threshold_d ) - 15'(Dead);
    waited_q          <= debt_left;
    take_q            <= \u_dut.take ;
    enable_q          <= enable_i;
    turned_q          <= mode_i || (duty_i[12] ^ polarity_i) != \u_dut.switch_b_q ;
    antiphase_taken_q <= \u_dut.antiphase_q ;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end

  // What was asked and waited before, is given or waits now. A duty within the dead time asks for nothing.
  logic balanced;
  assign balanced = (duty_left_q <= 0) ? (high_left == duty_left_q && debt_left == waited_q) :
                    high_left + debt_left == duty_left_q + waited_q;

  always_comb begin
    if (rst_ni && past_ok_q) waits_less_than_a_pulse: assert (debt_left < 15'(Shortest));
    if (rst_ni && past_ok_q && after_q) begin
      high_is_whole: assert (high_left >= 15'(Shortest) || (high_left <= 0 && !antiphase));
      low_is_whole: assert (low_left >= 15'(Shortest));
      whole_is_kept: assert (duty_left_q < 15'(Shortest) || waited_q != 0 ||
                             duty_left_q > 15'(Period) - 15'(2 * Dead) - 15'(Shortest) || high_left == duty_left_q);
      nothing_is_lost: assert (!take_q || !enable_q || turned_q || antiphase_taken_q || low_left == 15'(Shortest) ||
                               balanced);
      waits: cover (!antiphase && duty_left_q == 15'(Shortest) - 15'sd1 && high_left == 15'sd0);
      longer: cover (antiphase && high_left == 15'(Shortest));
    end
  end
endmodule

`default_nettype wire
