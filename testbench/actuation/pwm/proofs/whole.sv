// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// No leg is wanted on for so few or so many clocks that a gate gets a pulse shorter than the design's
// shortest. `period` says that these clocks are one piece, `legs` that each pulse loses the dead time.
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
  localparam int Period = feltgate_pkg::PWM_PERIOD;
  localparam int Dead = feltgate_pkg::DEAD_CLOCKS;
  localparam int Shortest = feltgate_pkg::SHORTEST_CLOCKS;

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

  // Clocks of the high and of the low gate that are left after the dead time.
  logic signed [14:0] high_left, low_left, duty_left_q;
  assign high_left = 15'(wanted) - 15'(Dead);
  assign low_left  = 15'(Period) - 15'(wanted) - 15'(Dead);
  always_ff @(posedge clk_i) duty_left_q <= 15'(\u_dut.threshold_d ) - 15'(Dead);

  logic after_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end

  always_comb begin
    if (rst_ni && past_ok_q && after_q) begin
      high_is_whole: assert (high_left >= 15'(Shortest) || (high_left <= 0 && !antiphase));
      low_is_whole: assert (low_left >= 15'(Shortest));
      whole_is_kept: assert (duty_left_q < 15'(Shortest) ||
                             duty_left_q > 15'(Period) - 15'(2 * Dead) - 15'(Shortest) || high_left == duty_left_q);
      off_by_less: assert (antiphase || duty_left_q < 0 || duty_left_q >= 15'(Shortest) || high_left == 15'sd0 ||
                           high_left == duty_left_q);
      left_out: cover (!antiphase && duty_left_q == 15'(Shortest) - 15'sd1 && high_left == 15'sd0);
      longer: cover (antiphase && high_left == 15'(Shortest));
    end
  end
endmodule

`default_nettype wire
