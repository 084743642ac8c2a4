// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Arming, the latches of faults and of the stop, and the gates, whatever trips and whenever: the blocks
// that judge are cut away, so each of them may trip in any clock.
`default_nettype none

module latch_proof (
    input logic                                 clk_i,
    input logic                                 rst_ni,
    input cfg::params_t                         p,
    input cfg::tick_t                           tick_i,
    input cfg::commands_t                       commands_i,
    input cfg::position_t                       position_i,
    input cfg::bridge_t                         bridge_i,
    input cfg::peers_t                          peers_i,
    input logic        [                  15:0] trips_i,
    input logic signed [   cfg::VELOCITY_W-1:0] velocity_i,
    input logic signed [     cfg::TORQUE_W-1:0] tau_ref_i,
    input logic signed [    cfg::CURRENT_W-1:0] current_i,
    input logic signed [    cfg::VOLTAGE_W-1:0] voltage_i
);
  `include "reset.svh"
  cfg::safety_t safety_o;
  safety u_dut (.*);
  (* hierconn *) wire [15:0] \u_dut.trips ;
  (* hierconn *) wire \u_dut.awake ;
  (* hierconn *) wire \u_dut.u_arming.host_q ;
  (* hierconn *) wire \u_dut.u_arming.host_counts_q ;
  (* hierconn *) wire \u_dut.u_arming.panel_counts_q ;
  (* hierconn *) wire \u_dut.u_arming.stopped_q ;
  localparam int Ticks20ms = cfg::CLOCK_HZ / 50 / cfg::CLOCKS_PER_TICK;
  (* hierconn *) wire [$clog2(Ticks20ms)-1:0] \u_dut.u_arming.waited_q ;
  (* hierconn *) wire [1:0] \u_dut.u_stop_latch.stop_q ;
  wire host_counts = \u_dut.u_arming.host_counts_q ;
  wire panel_counts = \u_dut.u_arming.panel_counts_q ;
  wire [1:0] stop = \u_dut.u_stop_latch.stop_q ;
  wire [15:0] trip = \u_dut.trips ;
  wire tick = tick_i.last;
  wire host = commands_i.host;
  wire gates = safety_o.gates_enable;
  wire armed = safety_o.armed;
  wire [15:0] faults = safety_o.faults;
  wire [4:0] first = safety_o.first_fault;
  wire unkicked = cfg::REQUIRE_WATCHDOG != 0 && ! \u_dut.awake ;
  always_comb begin
    assume (!trips_i[0]);  // there is no cause 0
    assume (!commands_i.clear_faults || tick);
  end

  // The request of the owner; what makes it wait, and what refuses it.
  logic request, starts, unfit, silent, blocked;
  assign request = (host ? commands_i.host_arm : commands_i.panel_arm) && !commands_i.disarm;
  assign starts  = position_i.why[5] || bridge_i.why[4];
  assign unfit   = position_i.why[4:0] != '0 || bridge_i.why[3:0] != '0 || bridge_i.why[6:5] != '0;
  assign silent  = peers_i.silent || starts;
  assign blocked = peers_i.blocked || unfit;

  // Of either line: the ticks at whose end it was high, since it was low at one, and whether one of them refused it:
  // beside a fault or a trip, a stop since the tick before, a missing kick, a disarm, while the other was the owner,
  // while another axis or a sensor is not ready and the gates are off, or as the gates closed.
  localparam int AgeW = 27;
  localparam logic [AgeW-1:0] Oldest = AgeW'(Ticks20ms - 1);  // 20 ms with the tick in which it rose
  logic [AgeW-1:0] host_age_q, panel_age_q, age, age_q;
  logic host_refused_q, panel_refused_q, refused, refused_q, refuses, owner_q, handed, handed_q, stopped_q;
  assign handed  = host != owner_q;
  assign refuses = faults != '0 || trip != '0 || stop[1] || stopped_q || unkicked || commands_i.disarm || (blocked && !gates) ||
                   (gates && (silent || handed));
  assign age     = host ? host_age_q : panel_age_q;
  assign refused = host ? host_refused_q : panel_refused_q;
  logic after_q, gates_q, armed_q, tick_q, request_q, silent_q, clear_q, locks_q, unable_q;
  logic [2:0] cleared_q;  // gates_clear one, two, three clocks ago
  logic [15:0] faults_q, trip_q;
  logic [4:0] first_q;
  always_ff @(posedge clk_i) begin
    {gates_q, armed_q, tick_q, request_q, silent_q} <= {gates, armed, tick, request, silent};
    {age_q, refused_q, handed_q, locks_q} <= {age, refused, handed, safety_o.locks};
    {faults_q, first_q, trip_q} <= {faults, first, trip};
    clear_q  <= commands_i.clear_faults && !request;
    unable_q <= faults != '0 || trip != '0 || stop[1] || unkicked || blocked;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {after_q, owner_q, stopped_q, cleared_q} <= '0;
      {host_age_q, panel_age_q} <= {AgeW'(1), AgeW'(1)};
      {host_refused_q, panel_refused_q} <= 2'b11;
    end else begin
      after_q   <= 1'b1;
      stopped_q <= !tick && (stopped_q || stop[1]);
      if (tick) begin
        owner_q         <= host;
        host_age_q      <= !commands_i.host_arm ? '0 : host_age_q + AgeW'(!host_age_q[AgeW-1]);
        panel_age_q     <= !commands_i.panel_arm ? '0 : panel_age_q + AgeW'(!panel_age_q[AgeW-1]);
        host_refused_q  <= commands_i.host_arm && (host_refused_q || !host || refuses);
        panel_refused_q <= commands_i.panel_arm && (panel_refused_q || host || refuses);
      end
      cleared_q <= {cleared_q[1:0], safety_o.gates_clear};
    end
  end
  logic [AgeW-1:0] owner_age, waited;
  logic owner_counts;
  assign owner_age    = owner_q ? host_age_q : panel_age_q;
  assign owner_counts = owner_q ? host_counts : panel_counts;
  assign waited       = AgeW'( \u_dut.u_arming.waited_q );
  logic [15:0] lowest_bit;
  assign lowest_bit = trip_q & (~trip_q + 16'd1);

  always_comb begin
    if (past_ok_q) begin
      reset_closes_gates: assert (rst_ni || (!gates && !armed && faults == '0));
      others_trip_too: assert ((!position_i.trip_channel || trip[map::FAULT_CHANNEL]) &&
          (!position_i.trip_index || trip[map::FAULT_INDEX]) && (!position_i.trip_flip || trip[map::FAULT_WORD]) &&
          (!trips_i[map::FAULT_WORD] || trip[map::FAULT_WORD]) && (!commands_i.host_stop || trip[map::FAULT_STOP]) &&
          (!gates || ((!trips_i[map::FAULT_ENGINE] || trip[map::FAULT_ENGINE]) && (!peers_i.fault || trip[map::FAULT_AXIS]) &&
          (bridge_i.why == '0 || trip[map::FAULT_CURRENT]) && (position_i.why == '0 || trip[map::FAULT_ENCODER]))));
    end
    if (rst_ni && past_ok_q && after_q) begin
      trip_closes_gates: assert (trip_q == '0 || !gates);
      trip_is_latched: assert ((faults & trip_q) == trip_q);
      faults_stay: assert (clear_q || (faults & faults_q) == faults_q);
      no_fault_without_a_trip: assert ((faults & ~(faults_q | trip_q)) == '0);
      first_cause_stays: assert (clear_q || first_q == '0 || first == first_q);
      first_cause_is_the_lowest: assert (!(clear_q || first_q == '0) || trip_q == '0 || (16'd1 << first) == lowest_bit);
      no_gates_beside_a_fault: assert (!gates || faults == '0);
      no_arming_by_itself: assert (!(gates && !gates_q) || (tick_q && request_q && !silent_q && !unable_q));
      opens_within_20_ms: assert (!(gates && !gates_q) || age_q <= Oldest);
      opens_unrefused: assert (!(gates && !gates_q) || !refused_q);
      hand_over_closes_gates: assert (!(tick_q && handed_q && gates_q) || !gates);
      request_shows_while_it_counts: assert (
          (!safety_o.arm_request || (request && !starts && !refused && !(gates && handed))) &&
          (!safety_o.ready || (!refused && !(gates && handed) && faults == '0 && !stop[1] && !unkicked && !unfit)));
      refused_for_a_reason: assert (!(request && !starts && !refused && !(gates && handed) && (gates || age <= Oldest)) ||
                                    safety_o.arm_request);
      clears_without_a_request: assert (safety_o.clear == (commands_i.clear_faults && !request));
      disarms_with_the_request: assert (!(tick_q && (!request_q || silent_q)) || (!gates && !armed));
      armed_in_ticks_only: assert (tick_q || armed == armed_q);
      locks_before_it_arms: assert (!tick_q || armed == (locks_q && trip_q == '0));
      stop_closes_gates: assert (!cleared_q[2] || !gates);
      inside_counts: assert ((!host_counts || !host_refused_q) && (!panel_counts || !panel_refused_q) &&
                             (owner_q ? !panel_counts || panel_age_q == '0 : !host_counts || host_age_q == '0));
      inside_refused: assert ((host_counts || host_refused_q || (owner_q && host_age_q > Oldest && !gates)) &&
                              (panel_counts || panel_refused_q || (!owner_q && panel_age_q > Oldest && !gates)));
      inside_ages: assert ((host_age_q != '0 || host_counts) && (panel_age_q != '0 || panel_counts) &&
                           (!gates || (owner_counts && owner_age != '0)));
      inside_waited: assert (gates || faults != '0 || !owner_counts || owner_age == '0 ||
                             waited == owner_age || waited + AgeW'(1) == owner_age);
      inside_idle: assert (waited == '0 || (owner_counts && owner_age != '0));
      inside_owner: assert ( \u_dut.u_arming.host_q == owner_q && \u_dut.u_arming.stopped_q == stopped_q);
      arms: cover (gates && !gates_q);
      arms_late: cover (gates && !gates_q && age_q == AgeW'(2));
      trips: cover (!gates && gates_q && faults != '0);
      cleared: cover (faults == '0 && faults_q != '0);
    end
    if (rst_ni && past_ok_q) begin
      inside_reset: assert (after_q || (!host_counts && !panel_counts && !gates && !armed && faults == '0 && first == '0));
      inside_stop: assert ((!cleared_q[0] || stop[0]) && (!cleared_q[1] || stop[1]));
      stop_clears_at_once: assert (!commands_i.stop || safety_o.gates_clear);
      clear_until_closed: assert (!cleared_q[0] || !gates_q || safety_o.gates_clear);
      inside_latch: assert ((faults == '0) == (first == '0) && (!gates || (faults == '0 && armed)));
    end
  end
endmodule

`default_nettype wire
