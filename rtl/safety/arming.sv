// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Arms and disarms at the end of a tick. No other block enables the gates. The owner is the host or the
// panel. Only a rising edge of the owner's request arms: the gates open at most ARM_WAIT_MS after this
// edge; later the request must fall and rise again. A change of owner disarms. A trip closes the gates
// in the next clock. docs/blocks/safety.md

`default_nettype none

module arming (
    input  logic clk_i,
    input  logic rst_ni,
    input  logic tick_i,        // last clock of a tick
    input  logic host_i,        // 1: the host has control, 0: the panel
    input  logic host_arm_i,    // its request, a level
    input  logic panel_arm_i,   // the panel's
    input  logic disarm_i,      // requests do not count in this tick
    input  logic fault_i,       // a fault is latched
    input  logic stopped_i,     // the stop is latched
    input  logic kick_missing_i,  // arming waits for the first kick
    input  logic trip_i,        // a cause in this clock
    input  logic wait_i,        // another axis does not request arming, or a sensor starts: a request waits
    input  logic refuse_i,      // another axis or a sensor is not ready: a request is refused
    output logic request_o,     // of the owner, a level
    output logic counts_o,      // and it counts
    output logic ready_o,       // this axis can be armed
    output logic locks_o,       // with tick_i: armed from the next clock on, unless a cause comes in this clock
    output logic arms_o,        // with tick_i: armed from the next clock on
    output logic armed_o,       // changes only at tick_i
    output logic open_o         // the gates are enabled; falls at once at a trip
);
  localparam int WaitTicks = cfg::CLOCK_HZ / 1000 * map::ARM_WAIT_MS / cfg::CLOCKS_PER_TICK - 1;
  localparam int W = $clog2(WaitTicks + 1);
  logic host_q, host_counts_q, panel_counts_q, stopped_q;  // stopped_q: in this tick
  logic [W-1:0] waited_q;  // ticks
  logic handed, counts, may, waits;
  assign request_o = (host_i ? host_arm_i : panel_arm_i) && !disarm_i;
  assign handed    = host_i != host_q;
  assign counts    = (host_i ? host_counts_q : panel_counts_q) && !(open_o && handed);
  assign counts_o  = request_o && counts;
  assign ready_o   = counts && !fault_i && !stopped_i && !stopped_q && !kick_missing_i;
  assign may       = request_o && ready_o && (open_o || (!refuse_i && (handed || waited_q < W'(WaitTicks))));
  assign locks_o   = may && !wait_i;
  assign arms_o    = locks_o && !trip_i;
  assign waits     = may && wait_i && !open_o && !trip_i;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {host_q, host_counts_q, panel_counts_q, stopped_q, waited_q, armed_o, open_o} <= '0;
    end else if (tick_i) begin
      host_q         <= host_i;
      host_counts_q  <= !host_arm_i || (host_i && (arms_o || waits));
      panel_counts_q <= !panel_arm_i || (!host_i && (arms_o || waits));
      stopped_q      <= 1'b0;
      waited_q       <= waits && !handed ? waited_q + 1'b1 : '0;
      armed_o        <= arms_o;
      open_o         <= arms_o;
    end else begin
      stopped_q <= stopped_q || stopped_i;
      if (trip_i) open_o <= 1'b0;
    end
  end
endmodule

`default_nettype wire
