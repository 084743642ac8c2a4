// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// External stop. The pin clears the gates and sets the latch, with or without a clock. The latch,
// through two flip-flops, is a cause of fault. It is released once the cause was seen, the gates are
// off and no fault is latched. It powers up set and has no reset, because few devices have a
// flip-flop with asynchronous set and reset. docs/blocks/safety.md

`default_nettype none

module stop_latch (
    input  logic clk_i,
    input  logic rst_ni,
    input  logic stop_i,         // asynchronous, a pulse of any width
    input  logic open_i,         // the gates are enabled
    input  logic fault_i,        // a fault is latched
    output logic gates_clear_o,  // asynchronous: from the stop's edge until it is released
    output logic stopped_o,      // the latch, two clocks later
    output logic trip_o
);
  logic latch_q = 1'b1;
  logic [1:0] stop_q;
  assign stopped_o     = stop_q[1];
  assign gates_clear_o = stop_i || latch_q;
  assign trip_o        = stopped_o && open_i;
  always_ff @(posedge clk_i or posedge stop_i) begin
    if (stop_i)                                 latch_q <= 1'b1;
    else if (stopped_o && !open_i && !fault_i) latch_q <= 1'b0;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) stop_q <= 2'b11;
    else         stop_q <= {stop_q[0], latch_q};
  end
endmodule

`default_nettype wire
