// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Clocks of a tick and ticks. The first clocks of a tick are for the words of its scene; then the
// position is sampled and the chain begins. docs/architecture.md

`default_nettype none

module tick_counter (
    input  logic        clk_i,
    input  logic        rst_ni,
    output logic [cfg::TICK_W-1:0] clock_o,  // of the tick, from 0
    output logic        sample_o,  // the clock in which the position is sampled
    output logic        tick_o,    // the last clock of a tick
    output logic [31:0] count_o    // ticks since the reset, wraps
);
  localparam int W = cfg::TICK_W;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {clock_o, sample_o, tick_o, count_o} <= '0;
    end else begin
      clock_o  <= tick_o ? '0 : clock_o + 1'b1;
      sample_o <= clock_o == W'(1);
      tick_o   <= clock_o == W'(cfg::CLOCKS_PER_TICK - 2);
      if (tick_o) count_o <= count_o + 32'd1;
    end
  end
endmodule

`default_nettype wire
