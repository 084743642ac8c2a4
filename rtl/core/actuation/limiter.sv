// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's one limiter: it saturates x, rounded, to [-limit, limit] and adds addend_i. The limit is the word on the
// parameter bus, which fits the format of its signal: registers saturates what is written. A negative limit counts as 0,
// and so does a limit whose LIMITER_W bits do not fit, which a flipped bit makes.
// Torque, step of the voltage mode, current, dead voltage, voltage and duty use it in turn. Without valid_i it only
// compares x with a border: over_limit_o is valid, the limited value is 0. Latency: valid_i and early_*_i in clock
// t - 1, late_*_i and the limit in t; in t + 1 over_limit_o, and limited_o, where the limited value is 0 in all other
// clocks. docs/blocks/torque_control.md

`default_nettype none

module limiter (
    input  logic                                            clk_i,
    input  logic                                            valid_i,    // one clock before x
    input  logic                                            torque_i,   // with valid_i: x is torque
    input  logic                                            voltage_i,
    input  logic                                            duty_i,
    input  logic signed [feltgate_pkg::LIMITER_INPUT_W-1:0] early_term_i,  // one clock before x
    input  logic                                            early_up_i,    // with early_term_i: x = early + 1
    input  logic signed [feltgate_pkg::LIMITER_INPUT_W-1:0] late_term_i,   // x = early + late; one of them is 0
    input  logic                                            late_not_i,    // with late_term_i: its complement
    input  logic                                            late_up_i,     // with late_term_i: + 1
    input  logic        [                             31:0] param_i,
    input  logic signed [  feltgate_pkg::WITH_ADDEND_W-1:0] addend_i,      // with limited_o
    output logic signed [  feltgate_pkg::WITH_ADDEND_W-1:0] limited_o,
    output logic                                            over_limit_o
);
  localparam int W = feltgate_pkg::LIMITER_W;
  localparam int InputW = feltgate_pkg::LIMITER_INPUT_W;

  // The comparison takes only as many bits as a limit has; an x that needs more is beyond any
  // limit. misfit_q marks the bits that must be 0 in a limit: its sign and the bits above its
  // signal's format.
  localparam logic [W-1:0] Sign = W'(1) << (W - 1);
  logic        [     W-1:0] misfit_q;
  logic                     valid_q, early_over_q, early_up_q, over, fold, negative, up;
  logic signed [InputW-1:0] early_q, term;
  always_ff @(posedge clk_i) begin
    valid_q      <= valid_i;
    if (duty_i) misfit_q <= {W{1'b1}} << (feltgate_pkg::DUTY_W - 1);
    else if (voltage_i) misfit_q <= {W{1'b1}} << (feltgate_pkg::VOLTAGE_W - 1);
    else if (torque_i) misfit_q <= {W{1'b1}} << (feltgate_pkg::TORQUE_W - 1);
    else misfit_q <= Sign;
    early_q      <= early_term_i;
    early_up_q   <= early_up_i;
    early_over_q <= early_term_i[InputW-1:W-1] != {(InputW - W + 1) {early_term_i[InputW-1]}};
  end
  assign term     = early_q | late_term_i;
  assign up       = early_up_q || late_up_i;
  assign fold     = term[InputW-1];
  assign negative = fold ^ late_not_i;
  assign over     = early_over_q || late_term_i[InputW-1:W-1] != {(InputW - W + 1) {late_term_i[InputW-1]}};

  // Without up, x is folded, or its complement if negative. So |x| = folded + (negative ^ up), and |x| > limit is a
  // borrow.
  logic [W-1:0] limit, folded;
  logic [W  :0] room;
  logic         misfit;
  assign limit  = param_i[W-1:0];
  assign folded = term[W-1:0] ^ {W{fold}};
  assign room   = {limit, 1'b0} - {folded, negative ^ up};
  assign misfit = (limit & misfit_q) != '0;

  // The result unfolds with the sign of x; the carry of an adder that is there anyway completes it. A register's
  // synchronous clear costs no logic: in a clock without a limited value, and if the limit does not fit, all is 0.
  logic [W-1:0] folded_q, limit_q;
  logic         negative_q, up_q, outside_q, unfit_q;
  always_ff @(posedge clk_i) begin
    outside_q <= over || room[W];
    unfit_q   <= misfit;
    if (!valid_q || misfit) begin
      folded_q   <= '0;
      limit_q    <= '0;
      negative_q <= 1'b0;
      up_q       <= 1'b0;
    end else begin
      folded_q   <= folded;
      limit_q    <= limit;
      negative_q <= negative;
      up_q       <= up;
    end
  end
  logic signed [W-1:0] whole;
  logic                carry;
  assign whole        = (outside_q ? limit_q : folded_q) ^ {W{negative_q}};
  assign carry        = outside_q ? negative_q : up_q;
  assign limited_o    = feltgate_pkg::WITH_ADDEND_W'(whole) + addend_i + feltgate_pkg::WITH_ADDEND_W'({1'b0, carry});
  assign over_limit_o = outside_q || unfit_q;

  logic unused;
  assign unused = ^{param_i, room};  // a limit may have fewer bits than a word
endmodule

`default_nettype wire
