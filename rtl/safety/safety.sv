// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// All causes of fault, the latch that keeps them, and arming, the only block that enables the gates.
// Some causes are checked once a tick, each in a clock of its own: first velocity, heat and polarity,
// then, after the chain, self-test and watchdog. docs/blocks/safety.md

`default_nettype none

module safety (
    input  logic                                       clk_i,
    input  logic                                       rst_ni,
    input  cfg::params_t                               p,
    input  cfg::tick_t                                 tick_i,        // when
    input  cfg::commands_t                             commands_i,    // of host and panel
    input  cfg::position_t                             position_i,    // of the encoder
    input  cfg::bridge_t                               bridge_i,
    input  cfg::peers_t                                peers_i,       // the other axes
    input  logic        [                        15:0] trips_i,       // of the host's words and of a law, by number of the cause
    input  logic signed [         cfg::VELOCITY_W-1:0] velocity_i,    // rad/s
    input  logic signed [           cfg::TORQUE_W-1:0] tau_ref_i,     // Nm
    input  logic signed [          cfg::CURRENT_W-1:0] current_i,     // A
    input  logic signed [          cfg::VOLTAGE_W-1:0] voltage_i,     // V
    output cfg::safety_t                               safety_o
);
  logic trip_errors, trip_speed, trip_jump, trip_polarity, trip_heat, trip_watchdog, trip_ticks, trip_stop, trip_test;
  logic awake, stopped, request, counts, able, starts, unfit;
  /* verilator lint_off UNOPTFLAT */  // with several axes the others' `ready` goes into `locks` and nothing back; the struct hides that
  logic armed, locks, arms, gates_enable, gates_clear, clear, arm_request, ready, unkicked, derated, testing;
  logic signed [cfg::SCENE_TORQUE_W-1:0] test_torque;
  logic [1:0] test_result;
  logic [15:0] faults;
  logic [4:0] first_fault;
  /* verilator lint_on UNOPTFLAT */
  logic signed [cfg::CURRENT_ESTIMATE_W-1:0] current_estimate;
  logic [15:0] trips;

  encoder_errors u_encoder_errors (
      .clk_i(clk_i), .rst_ni(rst_ni), .tick_i(tick_i.last), .illegal_i(position_i.illegal), .trip_o(trip_errors)
  );
  overspeed u_overspeed (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .start_i(tick_i.velocity), .velocity_i(velocity_i),
      .trip_o(trip_speed), .jump_o(trip_jump)
  );
  motor_heat u_motor_heat (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .armed_i(armed), .start_i(tick_i.sample), .voltage_i(voltage_i),
      .velocity_i(velocity_i), .measured_i(bridge_i.measured), .measured_current_i(bridge_i.current),
      .current_o(current_estimate), .trip_o(trip_heat)
  );
  polarity u_polarity (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .open_i(gates_enable), .start_i(tick_i.scene), .velocity_i(velocity_i),
      .current_i(current_i), .trip_o(trip_polarity)
  );
  hold_timer u_hold_timer (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .armed_i(armed), .tick_count_i(tick_i.count), .start_i(tick_i.duty),
      .tau_ref_i(tau_ref_i), .moved_i(position_i.moved), .derated_o(derated)
  );
  self_test u_self_test (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .armed_i(armed),
      .direct_i(commands_i.mode == 2'(map::MODE_VOLTAGE)), .waits_i(peers_i.waits),
      .travel_i(position_i.travel[cfg::SELF_TEST_DROP+:2]), .tick_count_i(tick_i.count), .sample_i(tick_i.sample),
      .start_i(tick_i.duty), .busy_o(testing), .torque_o(test_torque), .result_o(test_result), .trip_o(trip_test)
  );
  watchdog u_watchdog (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .open_i(gates_enable), .tick_i(tick_i.last), .arms_i(arms),
      .kick_i(commands_i.kick), .start_i(tick_i.duty), .awake_o(awake), .trip_o(trip_watchdog)
  );
  tick_monitor u_tick_monitor (
      .clk_i(clk_i), .rst_ni(rst_ni), .tick_i(tick_i.last), .period_start_i(bridge_i.period_start), .trip_o(trip_ticks)
  );
  stop_latch u_stop_latch (
      .clk_i(clk_i), .rst_ni(rst_ni), .stop_i(commands_i.stop), .open_i(gates_enable),
      .fault_i(first_fault != '0), .gates_clear_o(gates_clear), .stopped_o(stopped), .trip_o(trip_stop)
  );

  always_comb begin
    trips = trips_i;
    trips[map::FAULT_ENCODER]   = trip_errors || (gates_enable && position_i.why != '0);
    trips[map::FAULT_SPEED]     = trip_speed;
    trips[map::FAULT_POLARITY]  = trip_polarity;
    trips[map::FAULT_I2T]       = trip_heat;
    trips[map::FAULT_WATCHDOG]  = trip_watchdog;
    trips[map::FAULT_STOP]      = trip_stop || commands_i.host_stop;
    trips[map::FAULT_SELF_TEST] = trip_test;
    trips[map::FAULT_CHANNEL]   = position_i.trip_channel;
    trips[map::FAULT_TICK]      = trip_ticks;
    trips[map::FAULT_INDEX]     = position_i.trip_index;
    trips[map::FAULT_WORD]      = trips_i[map::FAULT_WORD] || position_i.trip_flip;
    trips[map::FAULT_JUMP]      = trip_jump;
    trips[map::FAULT_ENGINE]    = trips_i[map::FAULT_ENGINE] && gates_enable;
    trips[map::FAULT_AXIS]      = peers_i.fault && gates_enable;
    trips[map::FAULT_CURRENT]   = gates_enable && bridge_i.why != '0;
  end
  fault_latch u_fault_latch (
      .clk_i(clk_i), .rst_ni(rst_ni), .clear_i(clear), .trips_i(trips), .faults_o(faults), .first_o(first_fault)
  );

  // The top bit of a sensor's reasons: it starts, and has no first reading or offset yet. A request
  // waits for it; every other reason refuses the request.
  assign starts = position_i.why[5] || bridge_i.why[4];
  assign unfit  = position_i.why[4:0] != '0 || {bridge_i.why[6:5], bridge_i.why[3:0]} != '0;
  arming u_arming (
      .clk_i(clk_i), .rst_ni(rst_ni), .tick_i(tick_i.last), .host_i(commands_i.host), .host_arm_i(commands_i.host_arm),
      .panel_arm_i(commands_i.panel_arm), .disarm_i(commands_i.disarm), .fault_i(first_fault != '0),
      .stopped_i(stopped), .kick_missing_i(unkicked), .trip_i(trips != '0), .wait_i(peers_i.silent || starts),
      .refuse_i(peers_i.blocked || unfit), .request_o(request), .counts_o(counts), .ready_o(able), .locks_o(locks), .arms_o(arms),
      .armed_o(armed), .open_o(gates_enable)
  );
  assign clear         = commands_i.clear_faults && !request;
  assign arm_request = counts && !starts;
  assign ready       = able && !unfit;
  assign unkicked    = cfg::REQUIRE_WATCHDOG != 0 && !awake;
  assign safety_o    = {armed, locks, gates_enable, gates_clear, clear, arm_request, ready, unkicked, derated, testing,
                        test_torque, test_result, faults, first_fault, current_estimate};
endmodule

`default_nettype wire
