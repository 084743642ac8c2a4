// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// An open phase: its current stays below 2^-9 of full scale while the angle moves by a 32nd of a turn, and all the while
// another has 2^-5 or more. A current of that amplitude is as low only for 7.2 degrees. docs/blocks/three_phase.md

`default_nettype none

module open_phase (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic               armed_i,
    input  logic               valid_i,      // one clock: takes the currents
    input  logic signed [18:0] current_a_i,  // [1,1,17] of full scale
    input  logic signed [18:0] current_b_i,
    input  logic               judge_i,      // one clock, later: angle_i is that of the currents
    input  logic        [ 7:0] angle_i,      // 2^-8 turn
    output logic               open_o        // held while armed
);
  localparam int Low = 8;  // bits of an LSB
  localparam int High = 12;
  logic signed [19:0] both;  // -C
  logic [2:0] low_q, quiet, quiet_q;  // phases whose current is low: of this sample; since the angle was start_q
  logic high_q;
  logic [7:0] start_q, moved;
  assign both  = 20'(current_a_i) + 20'(current_b_i);
  assign quiet = quiet_q & low_q;
  assign moved = angle_i - start_q;
  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      low_q  <= {!fx::overflows(64'(both), Low + 1), !fx::overflows(64'(current_b_i), Low + 1),
                 !fx::overflows(64'(current_a_i), Low + 1)};
      high_q <= fx::overflows(64'(both), High + 1) || fx::overflows(64'(current_b_i), High + 1) ||
                fx::overflows(64'(current_a_i), High + 1);
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {quiet_q, start_q, open_o} <= '0;
    end else if (!armed_i) begin
      quiet_q <= '0;
      open_o  <= 1'b0;
    end else if (judge_i && (!high_q || quiet == '0)) begin
      quiet_q <= '1;
      start_q <= angle_i;
    end else if (judge_i) begin
      quiet_q <= quiet;
      if (moved[7:3] != 5'd0 && moved[7:3] != 5'd31) open_o <= 1'b1;
    end
  end
endmodule

`default_nettype wire
