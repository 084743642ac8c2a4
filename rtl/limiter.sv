// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's one limiter: x to [-limit, limit], the limit being the word on the parameter bus; a
// negative limit counts as 0, and so does one that the format of its signal does not hold. It serves torque, current, dead voltage, voltage and duty in turn, and
// without valid_i tells whether x is beyond a border and gives nothing to the operand bus.
// Latency: valid and what is ahead in clock t - 1, the rest of x and the limit in t, the result in
// t + 1 and only there, beyond in t + 1. docs/blocks/limiter.md

`default_nettype none

module limiter (
    input  logic                                            clk_i,
    input  logic                                            valid_i,    // a clock before x
    input  logic                                            torque_i,   // with valid_i: x is one
    input  logic                                            voltage_i,
    input  logic                                            duty_i,
    input  logic signed [feltgate_pkg::LIMITER_INPUT_W-1:0] ahead_i,  // a clock before x, and ored
    input  logic signed [feltgate_pkg::LIMITER_INPUT_W-1:0] late_i,   // with this to x
    /* verilator lint_off UNUSEDSIGNAL */  // as many bits as a limit has
    input  logic        [                             31:0] param_i,
    /* verilator lint_on UNUSEDSIGNAL */
    output logic signed [      feltgate_pkg::LIMITER_W-1:0] limited_o,
    output logic                                            beyond_o
);
  localparam int W = feltgate_pkg::LIMITER_W;
  localparam int InputW = feltgate_pkg::LIMITER_INPUT_W;

  // Only as many bits are compared as a limit has: an x that needs more is beyond any limit.
  logic                     valid_q, torque_q, voltage_q, duty_q, ahead_over_q, over, negative;
  logic signed [InputW-1:0] ahead_q, x;
  always_ff @(posedge clk_i) begin
    valid_q      <= valid_i;
    torque_q     <= torque_i;
    voltage_q    <= voltage_i;
    duty_q       <= duty_i;
    ahead_q      <= ahead_i;
    ahead_over_q <= ahead_i[InputW-1:W-1] != {(InputW - W + 1) {ahead_i[InputW-1]}};
  end
  assign x        = ahead_q | late_i;
  assign negative = x[InputW-1];
  assign over     = ahead_over_q || late_i[InputW-1:W-1] != {(InputW - W + 1) {late_i[InputW-1]}};

  logic signed [W-1:0] limit, low;
  logic signed [W  :0] upper_gap, lower_gap;
  logic                above, below, misfit, nothing;
  assign limit     = param_i[W-1:0];
  assign low       = x[W-1:0];
  assign upper_gap = (W + 1)'(limit) - (W + 1)'(low);
  assign lower_gap = (W + 1)'(limit) + (W + 1)'(low);
  assign above     = !negative && (over || upper_gap[W]);
  assign below     = negative && (over || lower_gap[W]);
  assign misfit    = (torque_q && limit[W-1:feltgate_pkg::TORQUE_W-1] != '0) ||
                     (voltage_q && limit[W-1:feltgate_pkg::VOLTAGE_W-1] != '0) ||
                     (duty_q && limit[W-1:feltgate_pkg::DUTY_W-1] != '0);
  assign nothing   = limit[W-1] || misfit || !valid_q;

  // x, and the limit that is on its side; clearing a register costs no logic, selecting does.
  logic signed [W-1:0] low_q, upper_q, lower_q;
  always_ff @(posedge clk_i) begin
    beyond_o <= above || below || misfit;
    if (nothing) low_q <= '0;
    else low_q <= low;
    if (negative || nothing) upper_q <= '0;
    else upper_q <= limit;
    if (!negative || nothing) lower_q <= '0;
    else lower_q <= -limit;
  end
  assign limited_o = beyond_o ? upper_q | lower_q : low_q;

  logic unused;
  assign unused = ^{upper_gap[W-1:0], lower_gap[W-1:0]};
endmodule

`default_nettype wire
