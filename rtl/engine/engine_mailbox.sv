// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Age of the mailbox. If more than max_age_i steps end without a commit, late_o is 1 (torques 0)
// until the next commit. jumps_o reports when torques can jump. One step is 64 ticks. docs/blocks/engine.md

`default_nettype none

module engine_mailbox (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        tick_i,
    input  logic        step_i,     // with tick_i: the age increments
    input  logic        watched_i,  // 1: the law has a mailbox
    input  logic [15:0] max_age_i,  // steps
    input  logic        taken_i,    // one clock: a commit comes into force
    input  logic        differs_i,  // with taken_i: a parameter changes
    output logic        late_o,
    output logic        jumps_o     // one clock
);
  logic [15:0] age_q;
  logic late_q, ends;
  assign late_o = late_q && watched_i;
  assign ends   = tick_i && step_i && age_q >= max_age_i;
  always_ff @(posedge clk_i) begin  // a reset leaves it: late_q is 1 until a commit
    if (taken_i) age_q <= '0;
    else if (tick_i && step_i) age_q <= age_q + 16'd1;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      late_q  <= 1'b1;  // after reset the host has written nothing
      jumps_o <= 1'b0;
    end else begin
      late_q  <= (late_q || ends) && !taken_i;
      jumps_o <= taken_i ? differs_i || late_o : ends && watched_i && !late_q;
    end
  end
endmodule

`default_nettype wire
