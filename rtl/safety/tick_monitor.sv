// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cause of fault: the ticks stand still, with tick_i stuck low or high. The PWM's carrier does not
// depend on them. It trips where one period more begins without a tick than a tick can take.
// docs/blocks/safety.md

`default_nettype none

module tick_monitor (
    input  logic clk_i,
    input  logic rst_ni,
    input  logic tick_i,
    input  logic period_start_i,  // one clock a period of the PWM
    output logic trip_o
);
  localparam int Periods = (cfg::CLOCKS_PER_TICK + cfg::PWM_PERIOD - 1) / cfg::PWM_PERIOD;
  localparam int W = $clog2(Periods + 1);
  logic [W-1:0] periods_q;  // that began since the last tick
  logic tick_q, many;
  assign many   = periods_q == W'(Periods);
  assign trip_o = period_start_i && many;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {tick_q, periods_q} <= '0;
    end else begin
      tick_q <= tick_i;
      if (tick_i && !tick_q)            periods_q <= '0;
      else if (period_start_i && !many) periods_q <= periods_q + 1'b1;
    end
  end
endmodule

`default_nettype wire
