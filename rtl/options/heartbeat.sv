// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// For a watchdog outside, which cuts the bridge's supply: a pin that changes every HEARTBEAT ticks, a power of two. It
// stands with the clock, with the ticks, and while a fault is latched. docs/blocks/safety.md

`default_nettype none

module heartbeat (
    input  logic         clk_i,
    input  logic         rst_ni,
    input  cfg::tick_t   tick_i,
    input  cfg::safety_t safety_i,
    output logic         heartbeat_o
);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) heartbeat_o <= 1'b0;
    else if (tick_i.last && safety_i.first_fault == '0) heartbeat_o <= (tick_i.count & 32'(cfg::HEARTBEAT)) != '0;
  end
endmodule

`default_nettype wire
