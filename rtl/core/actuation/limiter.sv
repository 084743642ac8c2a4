// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's one limiter: it saturates x to [-limit, limit]. The limit is the word on the parameter
// bus; a negative limit counts as 0, and so does one that does not fit the format of its signal.
// Torque, step of the voltage mode, current, dead voltage, voltage and duty use it in turn. Without valid_i it only compares
// x with a border: over_limit_o is valid, limited_o is 0. Latency: valid_i and early_term_i in clock
// t - 1, late_term_i and the limit in t, limited_o (0 in all other clocks) and over_limit_o in t + 1.
// docs/blocks/limiter.md

`default_nettype none

module limiter (
    input  logic                                            clk_i,
    input  logic                                            valid_i,    // one clock before x
    input  logic                                            torque_i,   // with valid_i: x is torque
    input  logic                                            voltage_i,
    input  logic                                            duty_i,
    input  logic signed [feltgate_pkg::LIMITER_INPUT_W-1:0] early_term_i,  // one clock before x
    input  logic signed [feltgate_pkg::LIMITER_INPUT_W-1:0] late_term_i,   // x = early | late
    input  logic        [                             31:0] param_i,
    output logic signed [      feltgate_pkg::LIMITER_W-1:0] limited_o,
    output logic                                            over_limit_o
);
  localparam int W = feltgate_pkg::LIMITER_W;
  localparam int InputW = feltgate_pkg::LIMITER_INPUT_W;

  // The comparison takes only as many bits as a limit has; an x that needs more is beyond any
  // limit. misfit_q marks the bits that must be 0 in a limit: its sign and the bits above its
  // signal's format.
  localparam logic [W-1:0] Sign = W'(1) << (W - 1);
  logic        [     W-1:0] misfit_q;
  logic                     valid_q, early_over_q, over, negative;
  logic signed [InputW-1:0] early_q, x;
  always_ff @(posedge clk_i) begin
    valid_q      <= valid_i;
    if (duty_i) misfit_q <= {W{1'b1}} << (feltgate_pkg::DUTY_W - 1);
    else if (voltage_i) misfit_q <= {W{1'b1}} << (feltgate_pkg::VOLTAGE_W - 1);
    else if (torque_i) misfit_q <= {W{1'b1}} << (feltgate_pkg::TORQUE_W - 1);
    else misfit_q <= Sign;
    early_q      <= early_term_i;
    early_over_q <= early_term_i[InputW-1:W-1] != {(InputW - W + 1) {early_term_i[InputW-1]}};
  end
  assign x        = early_q | late_term_i;
  assign negative = x[InputW-1];
  assign over     = early_over_q || late_term_i[InputW-1:W-1] != {(InputW - W + 1) {late_term_i[InputW-1]}};

  logic signed [W-1:0] limit, low;
  logic                above, below, misfit;
  assign limit   = param_i[W-1:0];
  assign low     = x[W-1:0];
  assign above   = !negative && (over || (W + 1)'(limit) - (W + 1)'(low) < 0);
  assign below   = negative && (over || (W + 1)'(limit) + (W + 1)'(low) < 0);
  assign misfit  = (limit & misfit_q) != '0;

  // x, and the limit with the sign of x. A register's synchronous clear costs no logic, a
  // multiplexer does. If the limit does not fit, all three are 0, so the output needs no further
  // selection.
  logic signed [W-1:0] low_q, upper_q, lower_q;
  logic                outside_q, unfit_q;
  always_ff @(posedge clk_i) begin
    outside_q <= above || below;
    unfit_q   <= misfit;
    if (!valid_q || misfit) begin
      low_q   <= '0;
      upper_q <= '0;
      lower_q <= '0;
    end else begin
      low_q <= low;
      if (negative) upper_q <= '0;
      else upper_q <= limit;
      if (!negative) lower_q <= '0;
      else lower_q <= -limit;
    end
  end
  assign limited_o    = outside_q ? upper_q | lower_q : low_q;
  assign over_limit_o = outside_q || unfit_q;

  logic unused;
  assign unused = ^param_i;  // a limit may have fewer bits than a word
endmodule

`default_nettype wire
