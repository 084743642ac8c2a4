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
    assume (!tick_i || !wave_i[feltgate_map_pkg::PARAM_AT_POLARITY_TICKS]);
  end

  (* hierconn *) wire \u_dut.host_q ;
  (* hierconn *) wire \u_dut.host_counts_q ;
  (* hierconn *) wire \u_dut.panel_counts_q ;
  (* hierconn *) wire \u_dut.stop_seen_q ;
  (* hierconn *) wire [feltgate_map_pkg::KICKLESS_BITS:0] \u_dut.kickless_ticks_q ;
  (* hierconn *) wire [1:0] \u_dut.stop_q ;
  wire [1:0] stop = \u_dut.stop_q ;
  wire [feltgate_map_pkg::KICKLESS_BITS:0] waited = \u_dut.kickless_ticks_q ;

  logic after_q, gates_q, armed_q, arms_q, tick_q, asks_q, silent_q, clear_q, stop_seen_q, unkicked_q, kicked_q, blocked_q;
  logic [2:0] cleared_q;  // gates_clear_o one, two, three clocks ago
  logic arm_request;      // of who has control
  assign arm_request = (host_i ? host_arm_i : arm_i) && !disarm_i;

  // Of either line: the ticks at whose end it was high, since it was low at one; and whether one of them refused it:
  // beside a fault or a trip, a stop since the tick before, a kick that is missing, a disarm, while the other had control,
  // while an axis is blocked and the gates are off, or as the gates closed. Which had control, and whether a stop was seen.
  localparam int AgeW = 27;
  localparam logic [AgeW-1:0] Oldest = AgeW'(feltgate_pkg::CLOCK_HZ / 50 / feltgate_pkg::CLOCKS_PER_TICK - 1);  // 20 ms with the one in which it rose
  logic [AgeW-1:0] host_age_q, panel_age_q, age, age_q;
  logic host_refused_q, panel_refused_q, refused, refused_q, refuses, owner_q, handed, handed_q, stopped_q;
  assign refuses = faults != '0 || trip != '0 || stop[1] || stopped_q || unkicked || disarm_i || (axis_blocked_i && !gates) ||
                   (gates && (axis_silent_i || handed));
  assign handed  = host_i != owner_q;
  assign age     = host_i ? host_age_q : panel_age_q;
  assign refused = host_i ? host_refused_q : panel_refused_q;
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
    age_q     <= age;
    refused_q <= refused;
    handed_q  <= handed;
    faults_q <= faults;
    first_q  <= first;
    trip_q   <= trip;
    trips_q  <= trips_i;
    stop_seen_q  <= stop[1];
    unkicked_q   <= unkicked;
    blocked_q    <= axis_blocked_i;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      after_q         <= 1'b0;
      owner_q         <= 1'b0;
      stopped_q       <= 1'b0;
      host_age_q      <= AgeW'(1);
      panel_age_q     <= AgeW'(1);
      host_refused_q  <= 1'b1;
      panel_refused_q <= 1'b1;
      cleared_q       <= 3'b000;
      kicked_q        <= 1'b0;
    end else begin
      after_q   <= 1'b1;
      stopped_q <= !tick_i && (stopped_q || stop[1]);
      if (tick_i) begin
        owner_q         <= host_i;
        host_age_q      <= !host_arm_i ? '0 : host_age_q + AgeW'(!host_age_q[AgeW-1]);
        panel_age_q     <= !arm_i ? '0 : panel_age_q + AgeW'(!panel_age_q[AgeW-1]);
        host_refused_q  <= host_arm_i && (host_refused_q || !host_i || refuses);
        panel_refused_q <= arm_i && (panel_refused_q || host_i || refuses);
      end
      cleared_q <= {cleared_q[1:0], gates_clear};
      if (kick_i) kicked_q <= 1'b1;
    end
  end
  // What the request of who had control has waited, of closed gates without a fault.
  logic [AgeW-1:0] owner_age;
  logic owner_counts;
  assign owner_age    = owner_q ? host_age_q : panel_age_q;
  assign owner_counts = owner_q ? \u_dut.host_counts_q : \u_dut.panel_counts_q ;
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
      no_arming_by_itself: assert (!(gates && !gates_q) || (tick_q && asks_q && !silent_q &&
                                   faults_q == '0 && trip_q == '0 && !stop_seen_q && !unkicked_q && !blocked_q));
      opens_within_20_ms: assert (!(gates && !gates_q) || age_q <= Oldest);
      opens_unrefused: assert (!(gates && !gates_q) || !refused_q);
      hand_over_closes_gates: assert (!(tick_q && handed_q && gates_q) || !gates);
      asks_while_it_counts: assert ((!arm_request_o || (arm_request && !refused && !(gates && handed))) &&
                                    (!ready_o || (!refused && !(gates && handed) && faults == '0 && !stop[1] && !unkicked)));
      refused_for_a_reason: assert (!(arm_request && !refused && !(gates && handed) && (gates || age <= Oldest)) || arm_request_o);
      inside_counts: assert ((!\u_dut.host_counts_q || !host_refused_q) && (!\u_dut.panel_counts_q || !panel_refused_q) &&
                             (owner_q ? !\u_dut.panel_counts_q || panel_age_q == '0 : !\u_dut.host_counts_q || host_age_q == '0));
      inside_refused: assert ((\u_dut.host_counts_q || host_refused_q || (owner_q && host_age_q > Oldest && !gates)) &&
                              (\u_dut.panel_counts_q || panel_refused_q || (!owner_q && panel_age_q > Oldest && !gates)));
      inside_ages: assert ((host_age_q != '0 || \u_dut.host_counts_q ) &&
                           (panel_age_q != '0 || \u_dut.panel_counts_q ) && (!gates || (owner_counts && owner_age != '0)));
      inside_waited: assert (gates || faults != '0 || !(\u_dut.host_counts_q || \u_dut.panel_counts_q ) || !owner_counts || owner_age == '0 ||
                             AgeW'(waited) == owner_age || AgeW'(waited) + AgeW'(1) == owner_age);
      inside_idle: assert (gates || faults != '0 || !(\u_dut.host_counts_q || \u_dut.panel_counts_q ) ||
                           (owner_counts && owner_age != '0) || waited == '0);
      inside_owner: assert (\u_dut.host_q == owner_q && \u_dut.stop_seen_q == stopped_q);
      clears_where_nobody_asks: assert (clear_o == (clear_faults_i && !arm_request));
      disarms_with_the_request: assert (!(tick_q && (!asks_q || silent_q)) || (!gates && !armed));
      armed_in_ticks_only: assert (tick_q || armed == armed_q);
      armed_as_told: assert (!tick_q || armed == arms_q);
      estimate_in_its_clock: assert (estimate_due_q || estimate == estimate_q);
      stop_closes_gates: assert (!cleared_q[2] || !gates);
      unkicked_until_a_kick: assert (unkicked == (feltgate_pkg::REQUIRE_WATCHDOG != 0 && !kicked_q));
      arms: cover (gates && !gates_q);
      arms_late: cover (gates && !gates_q && age_q == AgeW'(2));
      trips: cover (!gates && gates_q && faults != '0);
      cleared: cover (faults == '0 && faults_q != '0);
    end
    if (rst_ni && past_ok_q) begin
      inside_reset: assert (after_q || (!\u_dut.host_counts_q && !\u_dut.panel_counts_q && !gates && !armed && faults == '0 && first == '0));
      inside_stop: assert ((!cleared_q[0] || stop[0]) && (!cleared_q[1] || stop[1]));
      stop_clears_at_once: assert (!stop_i || gates_clear);
      clear_until_closed: assert (!cleared_q[0] || !gates_q || gates_clear);
      inside_latch: assert ((faults == '0) == (first == '0) && (!gates || (faults == '0 && armed)));
    end
  end
endmodule

`default_nettype wire
