// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cause of fault: the host is silent, no kick in watchdog_ticks ticks. It sleeps until the first
// kick. trip_o one clock after start_i. docs/blocks/safety.md

`default_nettype none

module watchdog (
    input  logic         clk_i,
    input  logic         rst_ni,
    input  cfg::params_t p,
    input  logic         open_i,   // the gates are enabled
    input  logic         tick_i,   // last clock of a tick
    input  logic         arms_i,   // with tick_i: the gates stay open, or open
    input  logic         kick_i,   // with tick_i
    input  logic         start_i,  // one clock a tick
    output logic         awake_o,  // a kick has come
    output logic         trip_o    // one clock
);
  localparam int W = map::KICKLESS_BITS + 1;
  logic [W-1:0] ticks_q;  // since the last kick, or since arming
  logic silent_q, at;
  assign trip_o = at && open_i && awake_o && silent_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {ticks_q, silent_q, at, awake_o} <= '0;
    end else begin
      at <= start_i;
      if (start_i) silent_q <= ticks_q >= W'(p.watchdog_ticks);
      if (kick_i) awake_o <= 1'b1;
      if (tick_i) ticks_q <= open_i && arms_i && !kick_i ? ticks_q + 1'b1 : '0;
    end
  end
endmodule

`default_nettype wire
