// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One axis, from the encoder's socket to the bridge's, once a tick in the order of the data:
//   position -> velocity_estimator -> observer -> tau_hat
//                      |                            |
//                      +------> scene -> ramp -> torque_law -> duty
// safety watches it and alone enables the gates; host has the words. Sampled position to duty: 25
// clocks, of a charge 43. docs/architecture.md

`default_nettype none

module axis #(
    parameter ParameterFile = ""  // $readmemh file of the parameters; "": values of the package
) (
    input  logic                  clk_i,
    input  logic                  rst_ni,
    // Sockets
    output cfg::encoder_t         encoder_o,
    input  cfg::position_t        position_i,
    output cfg::drive_t           drive_o,
    input  cfg::bridge_t          bridge_i,
    // Panel, program of the scene law, other axes
    input  cfg::panel_t           panel_i,
    input  cfg::law_t             law_i,
    input  cfg::peers_t           peers_i,
    // Register port
    input  logic           [11:0] reg_addr_i,
    input  logic           [31:0] reg_wdata_i,
    input  logic                  reg_write_i,
    output logic                  reg_busy_o,
    output logic           [31:0] reg_rdata_o,
    // Results
    output cfg::tick_t            tick_o,      // when they are new
    output cfg::snapshot_t        snapshot_o,
    output cfg::safety_t          safety_o,
    output cfg::word_t            word_o,      // of the snapshot, one at a time
    output cfg::params_t          p_o,
    output logic                  zeroed_o     // the position becomes 0
);
  cfg::tick_t tick;
  cfg::params_t p;
  cfg::control_t control;
  cfg::commands_t commands;
  cfg::safety_t safe;
  cfg::snapshot_t values;
  logic [3:0] scene_number;
  logic [11:0] limits;
  logic set_zero, restart, word_trip, testing, law_selected, velocity_saturated, tau_hat_saturated;
  logic limit_torque, limit_ramp, limit_hold, limit_current, limit_voltage, limit_duty, torque_valid, tau_ref_valid;
  logic signed [cfg::CURRENT_W-1:0] motor_current;
  logic signed [cfg::FEED_W-1:0] feed;
  logic signed [31:0] position_q;
  logic signed [17:0] scene_position_q;
  logic position_valid_q, others_test_q;
  logic signed [cfg::SCENE_TORQUE_W-1:0] scene_torque, torque;
  assign {tick_o, p_o, safety_o, zeroed_o} = {tick, p, safe, set_zero};

  tick_counter u_tick_counter (
      .clk_i(clk_i), .rst_ni(rst_ni), .clock_o(tick.clock), .sample_o(tick.sample), .tick_o(tick.last), .count_o(tick.count)
  );

  // The encoder, and its position at the beginning of a tick.
  assign encoder_o = {tick.sample, tick.count, control.filter, control.encoder_polarity, set_zero, safe.clear, safe.gates_enable};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {position_q, scene_position_q, position_valid_q, others_test_q} <= '0;
    end else begin
      position_valid_q <= tick.sample;
      if (tick.sample) position_q       <= position_i.position;
      if (tick.sample) others_test_q    <= peers_i.testing;  // the same for the whole chain
      if (tick.sample) scene_position_q <= 18'(fx::saturate(64'(position_i.position), 18));
    end
  end
  assign values.position = position_q;

  velocity_estimator u_velocity_estimator (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .sample_i(tick.sample), .travel_i(position_i.travel),
      .velocity_o(values.velocity), .saturated_o(velocity_saturated), .valid_o(tick.velocity)
  );

  assign motor_current = bridge_i.measured ? bridge_i.current : values.current;  // of the tick before
  observer u_observer (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .armed_i(safe.armed), .start_i(tick.velocity), .current_i(motor_current),
      .velocity_i(values.velocity), .tau_hat_o(values.tau_hat), .saturated_o(tau_hat_saturated), .valid_o(tick.tau_hat)
  );

  assign testing = safe.testing || others_test_q;
  scene u_scene (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .armed_i(safe.armed && !testing), .scene_i(scene_number),
      .start_i(position_valid_q), .velocity_valid_i(tick.velocity), .position_i(scene_position_q),
      .velocity_i(values.velocity), .law_i(law_i),
      .torque_o(scene_torque), .valid_o(torque_valid)
  );
  assign tick.scene   = torque_valid;
  assign tick.tau_ref = tau_ref_valid;
  assign torque     = safe.testing ? safe.test_torque : scene_torque;

  assign law_selected = cfg::SCENE_MASK[map::SCENE_LAW] && scene_number == map::SCENE_LAW;
  ramp u_ramp (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .armed_i(safe.armed && !testing), .scene_i(scene_number),
      .restart_i(restart || (tick.last && law_selected && law_i.restart)), .frozen_i(position_i.chatters),
      .derated_i(safe.derated), .testing_i(safe.testing), .sample_i(tick.sample), .start_i(torque_valid),
      .torque_i(torque), .tau_ref_o(values.tau_ref), .limit_torque_o(limit_torque), .limit_ramp_o(limit_ramp),
      .limit_hold_o(limit_hold), .valid_o(tau_ref_valid)
  );

  torque_law u_torque_law (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .armed_i(safe.armed), .mode_i(control.mode), .start_i(tau_ref_valid),
      .tau_ref_i(values.tau_ref), .tau_hat_i(values.tau_hat), .velocity_i(values.velocity), .current_o(values.current),
      .voltage_o(values.voltage), .feed_o(feed), .duty_o(values.duty), .limit_current_o(limit_current),
      .limit_voltage_o(limit_voltage), .limit_duty_o(limit_duty), .valid_o(tick.duty)
  );
  assign drive_o = {safe.gates_enable, safe.gates_clear, safe.clear, control.pwm_mode, control.motor_polarity,
                    control.mode == 2'(map::MODE_VOLTAGE), tick.sample, tick.duty, values.current, feed, values.duty};

  safety u_safety (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .tick_i(tick), .commands_i(commands), .position_i(position_i),
      .bridge_i(bridge_i), .peers_i(peers_i),
      .trips_i(16'(word_trip) << map::FAULT_WORD | 16'(law_selected && law_i.late) << map::FAULT_ENGINE),
      .velocity_i(values.velocity), .tau_ref_i(values.tau_ref), .current_i(values.current), .voltage_i(values.voltage),
      .safety_o(safe)
  );

  // Bits of the word `limits`.
  always_comb begin
    limits = '0;
    limits[map::L_TORQUE]       = limit_torque;
    limits[map::L_RAMP]         = limit_ramp;
    limits[map::L_CURRENT]      = limit_current;
    limits[map::L_VOLTAGE]      = limit_voltage;
    limits[map::L_DUTY]         = limit_duty;
    limits[map::L_VELOCITY]     = velocity_saturated;
    limits[map::L_TAU_HAT]      = tau_hat_saturated;
    limits[map::L_GATES_CLOSED] = !safe.gates_enable;
    limits[map::L_HOLD]         = limit_hold;
    limits[map::L_CHATTER]      = position_i.chatters;
  end
  assign values.limits  = limits;
  assign values.tick    = tick.count;
  assign values.scene   = scene_number;
  assign values.index   = position_i.index_position;
  assign values.encoder = {position_i.rejected_count, position_i.error_count};
  assign {values.faults, values.status} = '0;  // host makes them
  host #(.ParameterFile(ParameterFile)) u_host (
      .clk_i(clk_i), .rst_ni(rst_ni), .tick_i(tick), .panel_i(panel_i), .reg_addr_i(reg_addr_i), .reg_wdata_i(reg_wdata_i),
      .reg_write_i(reg_write_i), .reg_busy_o(reg_busy_o), .reg_rdata_o(reg_rdata_o), .position_i(position_i),
      .bridge_i(bridge_i), .safety_i(safe), .testing_i(testing), .values_i(values), .p_o(p), .control_o(control),
      .commands_o(commands), .scene_o(scene_number), .set_zero_o(set_zero), .restart_o(restart), .trip_o(word_trip),
      .snapshot_o(snapshot_o), .word_o(word_o)
  );
endmodule

`default_nettype wire
