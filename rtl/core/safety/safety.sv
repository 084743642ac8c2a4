// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Room: arming, faults, self-test, and the lower torque limit after a long hold.
// Timing: a cause on trips_i disables the gates in the next clock; stop_i clears them without a
// clock; arming is decided in the last clock of a tick. docs/architecture.md, docs/safety.md

`default_nettype none

module safety (
    input  logic                                              clk_i,
    input  logic                                              rst_ni,
    input  logic        [  feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input  logic        [                               31:0] param_i,
    input  logic                                              tick_i,          // last clock of a tick
    input  logic        [                               31:0] tick_count_i,
    input  logic                                              period_start_i,  // of the PWM
    // Who may arm, and the commands
    input  logic        [    feltgate_map_pkg::W_CONTROL-1:0] control_i,
    input  logic                                              host_stop_i,
    input  logic                                              arm_i,           // of the panel
    input  logic                                              stop_i,          // asynchronous
    input  logic                                              disarm_i,
    input  logic                                              clear_faults_i,
    input  logic                                              kick_i,          // the host is alive
    output logic                                              clear_o,         // clear_faults_i while this axis does not request arming
    // Other axes
    input  logic                                              axis_fault_i,
    input  logic                                              axis_silent_i,
    input  logic                                              axis_blocked_i,
    input  logic                                              axis_waits_i,
    output logic                                              arm_request_o,
    output logic                                              ready_o,         // nothing refuses a request
    input  logic        [feltgate_map_pkg::W_FAULTS_CURRENT+1:0] current_state_i,  // of the current loop, 0: ready
    input  logic        [feltgate_map_pkg::W_FAULTS_ABSOLUTE-1:0] absolute_state_i,  // of an absolute encoder, 0: ready
    // What is watched
    input  logic        [ feltgate_map_pkg::W_FAULTS_SEEN-1:0] trips_i,        // causes of other rooms, by bit
    input  logic                                              illegal_i,       // encoder: both channels changed
    input  logic                                              moved_i,         // encoder: an edge since the tick before
    input  logic        [                                1:0] travel_i,        // counts, lowest bits
    input  logic signed [       feltgate_pkg::VELOCITY_W-1:0] velocity_i,      // rad/s
    input  logic signed [        feltgate_pkg::CURRENT_W-1:0] current_ref_i,   // A
    input  logic signed [     feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input  logic                                              over_limit_i,    // of the limiter
    input  logic                                              law_i,           // the scene is a program's
    input  logic                                              law_late_i,      // its torque is not valid
    // What follows
    output logic                                              armed_o,
    output logic                                              arms_o,          // armed in the next tick
    output logic                                              unkicked_o,
    output logic                                              gates_enable_o,
    output logic                                              gates_clear_o,   // asynchronous
    output logic        [ feltgate_map_pkg::W_FAULTS_SEEN-1:0] faults_o,       // bit n: cause n was seen
    output logic        [feltgate_map_pkg::W_FAULTS_FIRST-1:0] first_fault_o,  // number of the first, 0: none
    output logic        [feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits_o,      // bit n: limit n acted
    output logic signed [feltgate_pkg::CURRENT_ESTIMATE_W-1:0] current_estimate_o,  // A
    output logic                                              derated_o,       // hold_limit limits too
    output logic                                              heartbeat_o,     // changes every HEARTBEAT ticks without a fault
    output logic                                              testing_o,       // the self-test runs
    output logic signed [   feltgate_pkg::SCENE_TORQUE_W-1:0] pulse_o,         // its pulse, larger than every limit: the limit in force is the torque
    output logic [feltgate_map_pkg::W_STATUS_SELF_TEST-1:0]   test_result_o
);
  localparam int FaultsW = feltgate_map_pkg::W_FAULTS_SEEN;
  logic self_test_trip, ready, arm_request;

  // The top bit of faults.current and faults.absolute: a sensor starts, it has no first offset or reading yet. A request
  // to arm waits for it, as the axes wait for each other; all other bits refuse the request.
  localparam int CurrentTop = feltgate_map_pkg::W_FAULTS_CURRENT - 1;
  localparam int AbsoluteTop = feltgate_map_pkg::W_FAULTS_ABSOLUTE - 1;
  logic starts, unfit;
  assign starts = current_state_i[CurrentTop] || absolute_state_i[AbsoluteTop];
  assign unfit  = current_state_i[CurrentTop+2:CurrentTop+1] != '0 || current_state_i[CurrentTop-1:0] != '0 ||
                  absolute_state_i[AbsoluteTop-1:0] != '0;
  assign arm_request_o = arm_request && !starts;
  assign ready_o       = ready && !unfit;

  hold_timer u_hold_timer (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(armed_o),
      .at_hold_strong_i(wave_i[feltgate_map_pkg::EVENT_AT_HOLD_STRONG]),
      .at_hold_i(wave_i[feltgate_map_pkg::EVENT_AT_HOLD]),
      .tick_count_i(tick_count_i), .param_i(param_i),
      .moved_i(moved_i), .over_limit_i(over_limit_i),
      .derated_o(derated_o)
  );

  self_test u_self_test (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(armed_o), .waits_i(axis_waits_i),
      .direct_i(control_i[feltgate_map_pkg::B_CONTROL_MODE+:feltgate_map_pkg::W_CONTROL_MODE] ==
                2'(feltgate_map_pkg::MODE_VOLTAGE)),  // voltage mode: no self-test
      .travel_i(travel_i), .tick_count_i(tick_count_i),
      .at_sample_i(wave_i[feltgate_map_pkg::EVENT_AT_SAMPLE]),
      .at_scene_rounded_i(wave_i[feltgate_map_pkg::EVENT_AT_SCENE_ROUNDED]),
      .at_self_test_quiet_i(wave_i[feltgate_map_pkg::EVENT_AT_SELF_TEST_QUIET]),
      .at_self_test_over_i(wave_i[feltgate_map_pkg::EVENT_AT_SELF_TEST_OVER]),
      .at_self_test_turn_i(wave_i[feltgate_map_pkg::EVENT_AT_SELF_TEST_TURN]),
      .at_self_test_i(wave_i[feltgate_map_pkg::EVENT_AT_SELF_TEST]),
      .param_i(param_i),
      .busy_o(testing_o), .early_term_o(pulse_o),
      .result_o(test_result_o), .trip_o(self_test_trip)
  );

  supervisor u_supervisor (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .tick_i(tick_i), .period_start_i(period_start_i),
      .host_i(control_i[feltgate_map_pkg::B_CONTROL_HOST]),
      .host_arm_i(control_i[feltgate_map_pkg::B_CONTROL_ARM]), .arm_i(arm_i), .disarm_i(disarm_i),
      .arm_request_o(arm_request), .arms_o(arms_o), .ready_o(ready),
      .axis_silent_i(axis_silent_i || starts), .axis_blocked_i(axis_blocked_i || unfit),
      .stop_i(stop_i),
      .clear_faults_i(clear_faults_i), .clear_o(clear_o), .kick_i(kick_i),
      .encoder_error_i(illegal_i),
      .velocity_i(velocity_i), .current_ref_i(current_ref_i),
      .at_estimate_part_i(wave_i[feltgate_map_pkg::EVENT_AT_ESTIMATE_PART]),
      .at_current_estimate_i(wave_i[feltgate_map_pkg::EVENT_AT_CURRENT_ESTIMATE]),
      .at_speed_size_i(wave_i[feltgate_map_pkg::EVENT_AT_SPEED_SIZE]),
      .param_is_overspeed_i(wave_i[feltgate_map_pkg::PARAM_AT_OVERSPEED]),
      .at_current_squared_i(wave_i[feltgate_map_pkg::EVENT_AT_CURRENT_SQUARED]),
      .at_nominal_i(wave_i[feltgate_map_pkg::EVENT_AT_NOMINAL]),
      .at_speed_i(wave_i[feltgate_map_pkg::EVENT_AT_SPEED]),
      .at_growth_size_i(wave_i[feltgate_map_pkg::EVENT_AT_GROWTH_SIZE]),
      .param_is_i2t_budget_i(wave_i[feltgate_map_pkg::PARAM_AT_I2T_BUDGET]),
      .at_heat_i(wave_i[feltgate_map_pkg::EVENT_AT_HEAT]),
      .at_strong_size_i(wave_i[feltgate_map_pkg::EVENT_AT_STRONG_SIZE]),
      .param_is_polarity_speed_i(wave_i[feltgate_map_pkg::PARAM_AT_POLARITY_SPEED]),
      .param_is_polarity_current_i(wave_i[feltgate_map_pkg::PARAM_AT_POLARITY_CURRENT]),
      .param_is_polarity_ticks_i(wave_i[feltgate_map_pkg::PARAM_AT_POLARITY_TICKS]),
      .at_polarity_i(wave_i[feltgate_map_pkg::EVENT_AT_POLARITY]),
      .param_is_watchdog_ticks_i(wave_i[feltgate_map_pkg::PARAM_AT_WATCHDOG_TICKS]),
      .at_watchdog_i(wave_i[feltgate_map_pkg::EVENT_AT_WATCHDOG]),
      .param_i(param_i), .product_i(product_i),
      .trips_i(trips_i |
               (FaultsW'(self_test_trip) << feltgate_map_pkg::FAULT_SELF_TEST) |
               (FaultsW'(host_stop_i) << feltgate_map_pkg::FAULT_STOP) |
               (FaultsW'(law_i && law_late_i && gates_enable_o) << feltgate_map_pkg::FAULT_ENGINE) |
               (FaultsW'(axis_fault_i && gates_enable_o) << feltgate_map_pkg::FAULT_AXIS)),
      .current_estimate_o(current_estimate_o),
      .armed_o(armed_o), .unkicked_o(unkicked_o),
      .gates_enable_o(gates_enable_o), .gates_clear_o(gates_clear_o),
      .faults_o(faults_o), .first_fault_o(first_fault_o)
  );

  // For a watchdog outside. It stands with the clock, with the ticks, and while a fault is latched.
  generate
  if (feltgate_pkg::HEARTBEAT == 0) begin : g_no_heartbeat
    assign heartbeat_o = 1'b0;
  end else begin : g_heartbeat
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) heartbeat_o <= 1'b0;
      else if (tick_i && first_fault_o == '0) heartbeat_o <= (tick_count_i & 32'(feltgate_pkg::HEARTBEAT)) != '0;
    end
  end
  endgenerate

  assign limits_o = feltgate_map_pkg::W_STATUS_LIMITS'(!gates_enable_o) << feltgate_map_pkg::L_GATES_CLOSED;

  logic unused;
  assign unused = ^{wave_i, control_i};  // a room takes its own clocks of the wave and its own fields of the control word
endmodule

`default_nettype wire
