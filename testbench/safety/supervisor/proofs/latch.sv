// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Arming, the latch of faults and the gates, for any trips: the causes that the block finds itself may come
// in any clock, since all their inputs are free.
`default_nettype none

module latch_proof (
    input logic                                           clk_i,
    input logic                                           rst_ni,
    input logic                                           tick_i,
    input logic                                           period_start_i,
    input logic                                           host_i,
    input logic                                           host_arm_i,
    input logic                                           arm_i,
    input logic                                           disarm_i,
    input logic                                           stop_i,
    input logic                                           clear_faults_i,
    input logic                                           kick_i,
    input logic                                           encoder_error_i,
    input logic signed [      feltgate_pkg::VELOCITY_W-1:0] velocity_i,
    input logic signed [       feltgate_pkg::CURRENT_W-1:0] current_ref_i,
    input logic        [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input logic        [                             31:0] param_i,
    input logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input logic        [feltgate_map_pkg::W_FAULTS_SEEN-1:0] trips_i,
    input logic                                           axis_silent_i,
    input logic                                           axis_blocked_i
);
  `include "reset.svh"

  `include "supervisor.svh"
  always_comb begin
    assume (!trips_i[0]);  // there is no cause 0
    assume (!clear_faults_i || tick_i);
  end

  (* hierconn *) wire \u_dut.asked_q ;
  wire asked = \u_dut.asked_q ;
  (* hierconn *) wire \u_dut.host_counts_q ;
  (* hierconn *) wire \u_dut.panel_counts_q ;
  (* hierconn *) wire [1:0] \u_dut.stop_q ;
  wire [1:0] stop = \u_dut.stop_q ;

  logic after_q, gates_q, armed_q, arms_q, tick_q, asks_q, silent_q, clear_q, stop_seen_q, unkicked_q, kicked_q, blocked_q;
  logic [2:0] cleared_q;  // gates_clear_o one, two, three clocks ago
  // What the host, the panel and the one of them who has the say ask for: now, and at the end of the last tick.
  // A disarm takes away the request of who has the say.
  logic arm_request, host_asks, panel_asks, asked_then_q, host_then_q, panel_then_q, silent_then_q;
  assign host_asks  = host_arm_i && !(host_i && disarm_i);
  assign panel_asks = arm_i && !(!host_i && disarm_i);
  assign arm_request       = (host_i ? host_asks : panel_asks);
  // Whether a line has been low since a reset, a fault, a stop, a kick that is missing, and since the other had the say.
  logic host_low_q, panel_low_q, able;
  assign able = faults == '0 && !stop[1] && !unkicked;
  logic rose_q, low_since_q;  // what opens the gates now
  logic asked_last_q;
  logic [FaultsW-1:0] faults_q, trip_q, trips_q;
  logic [ FirstW-1:0] first_q;
  always_ff @(posedge clk_i) begin
    gates_q  <= gates;
    armed_q  <= armed;
    tick_q   <= tick_i;
    asks_q   <= arm_request;
    arms_q   <= arms_o;
    silent_q <= axis_silent_i;
    clear_q  <= clear_faults_i && !arm_request;
    rose_q   <= silent_then_q || !(host_i ? host_then_q : panel_then_q);
    low_since_q <= host_i ? host_low_q : panel_low_q;
    faults_q <= faults;
    first_q  <= first;
    trip_q   <= trip;
    trips_q  <= trips_i;
    stop_seen_q  <= stop[1];
    unkicked_q   <= unkicked;
    blocked_q    <= axis_blocked_i;
    asked_last_q <= asked_then_q;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      after_q      <= 1'b0;
      asked_then_q <= 1'b1;
      host_then_q   <= 1'b1;
      panel_then_q  <= 1'b1;
      silent_then_q <= 1'b0;
      host_low_q    <= 1'b0;
      panel_low_q   <= 1'b0;
      cleared_q    <= 3'b000;
      kicked_q     <= 1'b0;
    end else begin
      after_q <= 1'b1;
      if (tick_i) begin
        asked_then_q  <= arm_request && !axis_silent_i;
        host_then_q   <= host_asks;
        panel_then_q  <= panel_asks;
        silent_then_q <= axis_silent_i;
        if (!host_arm_i) host_low_q <= 1'b1;
        else if (!host_i || !able) host_low_q <= 1'b0;
        if (!arm_i) panel_low_q <= 1'b1;
        else if (host_i || !able) panel_low_q <= 1'b0;
      end
      cleared_q <= {cleared_q[1:0], gates_clear};
      if (kick_i) kicked_q <= 1'b1;
    end
  end
  logic signed [feltgate_pkg::CURRENT_ESTIMATE_W-1:0] estimate_q;
  logic estimate_due_q;
  always_ff @(posedge clk_i) begin
    estimate_q     <= estimate;
    estimate_due_q <= wave_i[feltgate_map_pkg::EVENT_AT_CURRENT_ESTIMATE];
  end
  logic [FaultsW-1:0] lowest_bit;
  assign lowest_bit = trip_q & (~trip_q + FaultsW'(1));

  always_comb begin
    if (past_ok_q) begin
      reset_closes_gates: assert (rst_ni || (!gates && !armed && faults == '0));
    end
    if (rst_ni && past_ok_q && after_q) begin
      trip_closes_gates: assert (trip_q == '0 || !gates);
      trip_is_latched: assert ((faults & trip_q) == trip_q);
      others_trip_too: assert ((trip_q & trips_q) == trips_q && (faults & trips_q) == trips_q);
      faults_stay: assert (clear_q || (faults & faults_q) == faults_q);
      no_fault_without_a_trip: assert ((faults & ~(faults_q | trip_q)) == '0);
      first_cause_stays: assert (clear_q || first_q == '0 || first == first_q);
      first_cause_is_the_lowest: assert (!(clear_q || first_q == '0) || trip_q == '0 ||
                                         (FaultsW'(1) << first) == lowest_bit);
      no_gates_beside_a_fault: assert (!gates || faults == '0);
      no_arming_by_itself: assert (!(gates && !gates_q) || (tick_q && asks_q && !silent_q && !asked_last_q &&
                                   faults_q == '0 && trip_q == '0 && !stop_seen_q && !unkicked_q && !blocked_q));
      rising_request_opens: assert (!(gates && !gates_q) || rose_q);
      low_before_it_opens: assert (!(gates && !gates_q) || low_since_q);
      inside_ready: assert (ready_o == (able && (host_i ? host_low_q : panel_low_q)));
      inside_counts: assert (\u_dut.host_counts_q == host_low_q && \u_dut.panel_counts_q == panel_low_q);
      inside_who_asked: assert (((!host_then_q || !host_low_q) && (!panel_then_q || !panel_low_q)) ||
                                asked_then_q || silent_then_q);
      clears_where_nobody_asks: assert (clear_o == (clear_faults_i && !arm_request) && arm_request_o == arm_request);
      disarms_with_the_request: assert (!(tick_q && (!asks_q || silent_q)) || (!gates && !armed));
      armed_in_ticks_only: assert (tick_q || armed == armed_q);
      armed_as_told: assert (!tick_q || armed == arms_q);
      estimate_in_its_clock: assert (estimate_due_q || estimate == estimate_q);
      stop_closes_gates: assert (!cleared_q[2] || !gates);
      unkicked_until_a_kick: assert (unkicked == (feltgate_pkg::REQUIRE_WATCHDOG != 0 && !kicked_q));
      inside_asked: assert (asked == asked_then_q);
      arms: cover (gates && !gates_q);
      trips: cover (!gates && gates_q && faults != '0);
      cleared: cover (faults == '0 && faults_q != '0);
    end
    if (rst_ni && past_ok_q) begin
      inside_reset: assert (after_q || (asked && asked_then_q && !gates && !armed && faults == '0 && first == '0));
      inside_stop: assert ((!cleared_q[0] || stop[0]) && (!cleared_q[1] || stop[1]));
      stop_clears_at_once: assert (!stop_i || gates_clear);
      clear_until_closed: assert (!cleared_q[0] || !gates_q || gates_clear);
      inside_latch: assert ((faults == '0) == (first == '0) && (!gates || (faults == '0 && armed)));
    end
  end
endmodule

`default_nettype wire
