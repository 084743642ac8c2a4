// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The four gate pins, for any duty, mode, polarity and enable in every clock.
`default_nettype none

module legs_proof (
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
  localparam int DeadBits = (Dead > 1) ? $clog2(Dead) : 1;

  `include "reset.svh"

  logic a_hi, a_lo, b_hi, b_lo, period_start;
  logic signed [12:0] duty_active;
  pwm #(
      .Period(Period),
      .DeadClocks(Dead)
  ) u_dut (
      .*,
      .gate_a_hi_o(a_hi),
      .gate_a_lo_o(a_lo),
      .gate_b_hi_o(b_hi),
      .gate_b_lo_o(b_lo),
      .period_start_o(period_start),
      .duty_active_o(duty_active)
  );
  (* hierconn *) wire [1:0] \u_dut.wanted_q ;
  wire [1:0] wanted = \u_dut.wanted_q ;
  (* hierconn *) wire [1:0] \u_dut.gate_hi_q ;
  wire [1:0] hi = \u_dut.gate_hi_q ;
  (* hierconn *) wire [1:0] \u_dut.gate_lo_q ;
  wire [1:0] lo = \u_dut.gate_lo_q ;
  (* hierconn *) wire [DeadBits:0] \u_dut.g_leg[0].dead_q ;
  wire [DeadBits:0] dead_a = \u_dut.g_leg[0].dead_q ;
  (* hierconn *) wire [DeadBits:0] \u_dut.g_leg[1].dead_q ;
  wire [DeadBits:0] dead_b = \u_dut.g_leg[1].dead_q ;

  // Clocks since a gate was on, up to 127; a reset counts as on. Clocks since enable_i was low.
  logic [6:0] a_hi_off_q, a_lo_off_q, b_hi_off_q, b_lo_off_q, enabled_q;
  function automatic logic [6:0] off_for(input logic on, input logic [6:0] clocks);
    off_for = on ? 7'd0 : (clocks == 7'd127) ? clocks : clocks + 7'd1;
  endfunction
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      a_hi_off_q <= 7'd0;
      a_lo_off_q <= 7'd0;
      b_hi_off_q <= 7'd0;
      b_lo_off_q <= 7'd0;
      enabled_q  <= 7'd0;
    end else begin
      a_hi_off_q <= off_for(a_hi, a_hi_off_q);
      a_lo_off_q <= off_for(a_lo, a_lo_off_q);
      b_hi_off_q <= off_for(b_hi, b_hi_off_q);
      b_lo_off_q <= off_for(b_lo, b_lo_off_q);
      enabled_q  <= off_for(!enable_i, enabled_q);
    end
  end

  always_comb begin
    if (past_ok_q) begin
      never_both: assert (!(a_hi && a_lo) && !(b_hi && b_lo));
      disabled_is_off: assert (enabled_q != 7'd0 || {a_hi, a_lo, b_hi, b_lo} == 4'b0000);
      clear_is_off: assert (!clear_i || {a_hi, a_lo, b_hi, b_lo} == 4'b0000);
      reset_is_off: assert (rst_ni || {a_hi, a_lo, b_hi, b_lo} == 4'b0000);
    end
    if (rst_ni && past_ok_q) begin
      dead_time: assert ((!a_lo || a_hi_off_q >= 7'(Dead)) && (!a_hi || a_lo_off_q >= 7'(Dead)) &&
                         (!b_lo || b_hi_off_q >= 7'(Dead)) && (!b_hi || b_lo_off_q >= 7'(Dead)));
      on_after_dead_time: assert ((!a_hi && !a_lo && !b_hi && !b_lo) || enabled_q >= 7'(Dead));
      diagonal: cover (a_hi && b_lo);
    end
  end

  // The count of the dead time is no further than the time that both gates have been off.
  localparam logic [DeadBits:0] Start = (DeadBits + 1)'(2 ** DeadBits - (Dead - 1));
  logic [7:0] done_a, done_b;  // clocks that have been counted
  assign done_a = 8'(dead_a) - 8'(Start);
  assign done_b = 8'(dead_b) - 8'(Start);
  always_comb begin
    if (rst_ni && past_ok_q) begin
      inside_hi_lo: assert ((hi & lo) == 2'b00);
      inside_hi: assert ((hi & ~wanted) == 2'b00 && (lo & wanted) == 2'b00);
      inside_start: assert (dead_a >= Start && dead_b >= Start && done_a <= 8'(Dead - 1) && done_b <= 8'(Dead - 1));
      inside_side_a: assert (wanted[0] ? 8'(a_lo_off_q) >= done_a : 8'(a_hi_off_q) >= done_a);
      inside_side_b: assert (wanted[1] ? 8'(b_lo_off_q) >= done_b : 8'(b_hi_off_q) >= done_b);
      inside_enabled: assert (8'(enabled_q) >= done_a && 8'(enabled_q) >= done_b);
      inside_on_a: assert (!(hi[0] || lo[0]) || done_a == 8'(Dead - 1) || Dead == 1);
      inside_on_b: assert (!(hi[1] || lo[1]) || done_b == 8'(Dead - 1) || Dead == 1);
      inside_lo_a: assert (!lo[0] || a_hi_off_q >= 7'(Dead));
      inside_hi_a: assert (!hi[0] || a_lo_off_q >= 7'(Dead));
      inside_lo_b: assert (!lo[1] || b_hi_off_q >= 7'(Dead));
      inside_hi_b: assert (!hi[1] || b_lo_off_q >= 7'(Dead));
      inside_enabled_on: assert (hi == 2'b00 && lo == 2'b00 || enabled_q >= 7'(Dead));
    end
  end
endmodule

`default_nettype wire
