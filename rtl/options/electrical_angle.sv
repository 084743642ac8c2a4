// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// angle = gain * count + offset, modulo an electrical turn. valid_o 33 clocks after start_i, which comes no sooner again;
// the angle holds. Angles and gain are 2^-32 electrical turn. docs/blocks/three_phase.md

`default_nettype none

module electrical_angle (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               start_i,   // one clock: takes the next three
    input  logic signed [31:0] count_i,   // wraps
    input  logic        [31:0] gain_i,    // per count
    input  logic        [31:0] offset_i,
    output logic        [31:0] angle_o,
    output logic               valid_o    // one clock
);
  localparam logic [5:0] Last = 6'd33;
  logic [5:0] step_q;
  logic [63:0] sum;
  assign angle_o = sum[31:0];
  assign valid_o = step_q == Last;
  serial_multiplier #(.FactorW(32), .WordW(32)) u_serial_multiplier (
      .clk_i(clk_i), .start_i(start_i), .factor_i(gain_i), .word_i(count_i), .value_i(offset_i),
      .hold_i(step_q == '0 || valid_o), .product_o(sum)
  );
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni)            step_q <= '0;
    else if (start_i)       step_q <= 6'd1;
    else if (valid_o)       step_q <= '0;
    else if (step_q != '0)  step_q <= step_q + 6'd1;
  end
endmodule

`default_nettype wire
