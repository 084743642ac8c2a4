// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A read has no side effect: two cores with the same inputs, but that without a write their ports may show any two
// addresses and data. What is then equal in both does not depend on what is read.
`default_nettype none

module reads_proof (
    `include "core_inputs.svh"
    ,
    input logic [11:0] other_addr_i,
    input logic [31:0] other_wdata_i
);
  `include "reset.svh"
  `include "core.svh"
  `include "inside.svh"

  feltgate_core #(.ParameterFile("parameters.mem")) u_other (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i),
      .encoder_data_i(encoder_data_i), .hall_i(3'b000), .current_data_i(current_data_i), .driver_fault_i(driver_fault_i), .arm_i(arm_i), .stop_i(stop_i), .set_zero_i(set_zero_i), .scene_i(scene_i),
      .law_torque_i(law_torque_i), .law_late_i(law_late_i), .law_restart_i(law_restart_i),
      .axis_fault_i(axis_fault_i), .axis_silent_i(axis_silent_i), .axis_blocked_i(axis_blocked_i),
      .axis_testing_i(axis_testing_i), .axis_waits_i(axis_waits_i),
      .reg_addr_i(reg_write_i ? reg_addr_i : other_addr_i), .reg_wdata_i(reg_write_i ? reg_wdata_i : other_wdata_i),
      .reg_write_i(reg_write_i)
  );

  (* hierconn *) wire \u_core.u_wave.u_registers.refused_o ;
  (* hierconn *) wire \u_core.u_wave.u_registers.saturated_o ;
  (* hierconn *) wire [feltgate_pkg::TORQUE_W-1:0] \u_core.u_wave.u_registers.least_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.held_check_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.written_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.written_q2 ;
  (* hierconn *) wire \u_core.u_wave.u_registers.word_error_o ;
  (* hierconn *) wire \u_core.u_wave.u_registers.g_read.write_bank_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.g_read.frozen_q ;
  (* hierconn *) wire [feltgate_map_pkg::W_CONTROL-1:0] \u_core.u_wave.u_registers.control_o ;
  (* hierconn *) wire [31:0] \u_core.u_wave.u_registers.param_o ;
  (* hierconn *) wire [3:0] \u_core.u_wave.u_registers.check_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.snap_valid_i ;
  (* hierconn *) wire [5:0] \u_core.u_wave.u_registers.snap_slot_i ;
  (* hierconn *) wire [31:0] \u_core.u_wave.u_registers.snap_data_i ;
  (* hierconn *) wire \u_core.reg_busy_o ;
  (* hierconn *) wire \u_core.u_wave.u_sequencer.tick_o ;
  (* hierconn *) wire \u_core.u_wave.u_sequencer.scene_slot_fetch_o ;
  (* hierconn *) wire [L-1:0] \u_core.u_wave.u_sequencer.wave_o ;
  (* hierconn *) wire [31:0] \u_core.u_wave.u_sequencer.tick_count_o ;
  (* hierconn *) wire \u_core.u_safety.u_supervisor.tick_i ;
  (* hierconn *) wire [L-1:0] \u_core.u_encoder.wave_i ;
  (* hierconn *) wire [L-1:0] \u_core.u_estimators.wave_i ;
  (* hierconn *) wire [L-1:0] \u_core.u_scenes.wave_i ;
  (* hierconn *) wire [L-1:0] \u_core.u_actuation.wave_i ;
  (* hierconn *) wire [L-1:0] \u_core.u_safety.wave_i ;
  (* hierconn *) wire \u_core.clear ;
  (* hierconn *) wire \u_core.u_safety.u_supervisor.host_i ;
  (* hierconn *) wire \u_core.u_safety.u_supervisor.host_arm_i ;
  (* hierconn *) wire \u_core.zeroed_o ;
  (* hierconn *) wire \u_core.restart ;
  (* hierconn *) wire \u_core.host_stop ;
  (* hierconn *) wire \u_core.u_wave.word_error ;
  (* hierconn *) wire \u_core.u_wave.refused ;
  (* hierconn *) wire [3:0] \u_core.scene_o ;
  (* hierconn *) wire \u_core.armed_o ;
  (* hierconn *) wire \u_core.arms ;
  (* hierconn *) wire \u_core.word_valid_o ;
  (* hierconn *) wire [5:0] \u_core.word_slot_o ;
  (* hierconn *) wire [31:0] \u_core.word_data_o ;
  (* hierconn *) wire \u_other.u_wave.u_registers.to_parameter_q ;
  (* hierconn *) wire \u_other.u_wave.u_registers.to_control_q ;
  (* hierconn *) wire \u_other.u_wave.u_registers.to_command_q ;
  (* hierconn *) wire \u_other.u_wave.u_registers.disarm_o ;
  (* hierconn *) wire \u_other.u_wave.u_registers.stop_o ;
  (* hierconn *) wire \u_other.u_wave.u_registers.zero_q ;
  (* hierconn *) wire \u_other.u_wave.u_registers.refused_o ;
  (* hierconn *) wire \u_other.u_wave.u_registers.saturated_o ;
  (* hierconn *) wire [5:0] \u_other.u_wave.u_registers.least_at_q ;
  (* hierconn *) wire [feltgate_pkg::TORQUE_W-1:0] \u_other.u_wave.u_registers.least_q ;
  (* hierconn *) wire \u_other.u_wave.u_registers.held_check_q ;
  (* hierconn *) wire \u_other.u_wave.u_registers.warm_q ;
  (* hierconn *) wire \u_other.u_wave.u_registers.written_q ;
  (* hierconn *) wire \u_other.u_wave.u_registers.written_q2 ;
  (* hierconn *) wire \u_other.u_wave.u_registers.word_error_o ;
  (* hierconn *) wire \u_other.u_wave.u_registers.g_read.write_bank_q ;
  (* hierconn *) wire \u_other.u_wave.u_registers.g_read.frozen_q ;
  (* hierconn *) wire [8:0] \u_other.u_wave.u_registers.address_q ;
  (* hierconn *) wire [31:0] \u_other.u_wave.u_registers.data_q ;
  (* hierconn *) wire [feltgate_map_pkg::W_CONTROL-1:0] \u_other.u_wave.u_registers.control_o ;
  (* hierconn *) wire [31:0] \u_other.u_wave.u_registers.param_o ;
  (* hierconn *) wire [3:0] \u_other.u_wave.u_registers.check_q ;
  (* hierconn *) wire \u_other.u_wave.u_registers.lands ;
  (* hierconn *) wire [35:0] \u_other.u_wave.u_registers.written ;
  (* hierconn *) wire \u_other.u_wave.u_registers.snap_valid_i ;
  (* hierconn *) wire [5:0] \u_other.u_wave.u_registers.snap_slot_i ;
  (* hierconn *) wire [31:0] \u_other.u_wave.u_registers.snap_data_i ;
  (* hierconn *) wire [35:0] \u_other.u_wave.u_registers.fetch_q ;
  (* hierconn *) wire [8:0] \u_other.u_wave.u_registers.fetch_address ;
  (* hierconn *) wire \u_other.reg_busy_o ;
  (* hierconn *) wire [ClockW-1:0] \u_other.u_wave.u_sequencer.clock_q ;
  (* hierconn *) wire \u_other.u_wave.u_sequencer.tick_o ;
  (* hierconn *) wire \u_other.u_wave.u_sequencer.scene_slot_fetch_o ;
  (* hierconn *) wire [L-1:0] \u_other.u_wave.u_sequencer.wave_o ;
  (* hierconn *) wire [31:0] \u_other.u_wave.u_sequencer.tick_count_o ;
  (* hierconn *) wire \u_other.u_safety.u_supervisor.tick_i ;
  (* hierconn *) wire \u_other.u_safety.u_supervisor.clear_faults_i ;
  (* hierconn *) wire \u_other.u_safety.u_supervisor.kick_i ;
  (* hierconn *) wire [3:0] \u_other.u_encoder.u_quad_decoder.filter_i ;
  (* hierconn *) wire \u_other.u_encoder.u_quad_decoder.polarity_i ;
  (* hierconn *) wire \u_other.u_encoder.u_quad_decoder.set_zero_i ;
  (* hierconn *) wire \u_other.u_encoder.u_quad_decoder.clear_error_i ;
  (* hierconn *) wire \u_other.u_encoder.u_encoder_monitor.set_zero_i ;
  (* hierconn *) wire \u_other.u_actuation.g_two_legs.u_pwm.mode_i ;
  (* hierconn *) wire \u_other.u_actuation.g_two_legs.u_pwm.polarity_i ;
  (* hierconn *) wire [1:0] \u_other.u_actuation.u_torque_control.mode_i ;
  (* hierconn *) wire \u_other.u_safety.u_self_test.direct_i ;
  (* hierconn *) wire [3:0] \u_other.u_scenes.scene_i ;
  (* hierconn *) wire [3:0] \u_other.u_actuation.u_ramp.scene_i ;
  (* hierconn *) wire [31:0] \u_other.u_scenes.param_i ;
  (* hierconn *) wire [31:0] \u_other.u_actuation.u_ramp.param_i ;
  (* hierconn *) wire [31:0] \u_other.u_actuation.u_limiter.param_i ;
  (* hierconn *) wire [31:0] \u_other.u_actuation.u_torque_control.param_i ;
  (* hierconn *) wire [31:0] \u_other.u_safety.u_supervisor.param_i ;
  (* hierconn *) wire [31:0] \u_other.u_safety.u_self_test.param_i ;
  (* hierconn *) wire [31:0] \u_other.u_safety.u_hold_timer.param_i ;
  (* hierconn *) wire [31:0] \u_other.u_wave.u_multipliers.param_i ;
  (* hierconn *) wire [L-1:0] \u_other.u_encoder.wave_i ;
  (* hierconn *) wire [L-1:0] \u_other.u_estimators.wave_i ;
  (* hierconn *) wire [L-1:0] \u_other.u_scenes.wave_i ;
  (* hierconn *) wire [L-1:0] \u_other.u_actuation.wave_i ;
  (* hierconn *) wire [L-1:0] \u_other.u_safety.wave_i ;
  (* hierconn *) wire \u_other.arm_request_o ;
  (* hierconn *) wire \u_other.clear ;
  (* hierconn *) wire \u_other.u_safety.u_supervisor.host_i ;
  (* hierconn *) wire \u_other.u_safety.u_supervisor.host_arm_i ;
  (* hierconn *) wire \u_other.zeroed_o ;
  (* hierconn *) wire \u_other.restart ;
  (* hierconn *) wire \u_other.host_stop ;
  (* hierconn *) wire \u_other.u_wave.word_error ;
  (* hierconn *) wire \u_other.u_wave.refused ;
  (* hierconn *) wire [3:0] \u_other.scene_o ;
  (* hierconn *) wire \u_other.armed_o ;
  (* hierconn *) wire \u_other.arms ;
  (* hierconn *) wire \u_other.region_high ;
  (* hierconn *) wire \u_other.derated ;
  (* hierconn *) wire \u_other.testing_o ;
  (* hierconn *) wire \u_other.word_valid_o ;
  (* hierconn *) wire [5:0] \u_other.word_slot_o ;
  (* hierconn *) wire [31:0] \u_other.word_data_o ;

  // What the blocks that are cut give, and the words that the RAM gives for the same address, is equal as long as
  // all that they got is; that is asserted below.
  always_comb begin
    assume (
        \u_core.armed_o == \u_other.armed_o && \u_core.arms == \u_other.arms &&
        \u_core.region_high == \u_other.region_high &&
        \u_core.derated == \u_other.derated && \u_core.testing_o == \u_other.testing_o &&
        \u_core.word_valid_o == \u_other.word_valid_o && \u_core.word_slot_o == \u_other.word_slot_o &&
        \u_core.word_data_o == \u_other.word_data_o && \u_core.clear == \u_other.clear &&
        \u_core.arm_request_o == \u_other.arm_request_o );
    if (past_ok_q) assume (\u_core.u_wave.u_registers.fetch_q == \u_other.u_wave.u_registers.fetch_q );
  end

  always_comb begin
    if (past_ok_q && rst_ni) begin
      reads_change_no_register: assert (
          \u_core.reg_busy_o == \u_other.reg_busy_o &&
          \u_core.u_wave.u_registers.to_parameter_q == \u_other.u_wave.u_registers.to_parameter_q &&
          \u_core.u_wave.u_registers.to_control_q == \u_other.u_wave.u_registers.to_control_q &&
          \u_core.u_wave.u_registers.to_command_q == \u_other.u_wave.u_registers.to_command_q &&
          \u_core.u_wave.u_registers.disarm_o == \u_other.u_wave.u_registers.disarm_o &&
          \u_core.u_wave.u_registers.stop_o == \u_other.u_wave.u_registers.stop_o &&
          \u_core.u_wave.u_registers.zero_q == \u_other.u_wave.u_registers.zero_q &&
          \u_core.u_wave.u_registers.refused_o == \u_other.u_wave.u_registers.refused_o &&
          \u_core.u_wave.u_registers.saturated_o == \u_other.u_wave.u_registers.saturated_o &&
          \u_core.u_wave.u_registers.least_at_q == \u_other.u_wave.u_registers.least_at_q &&
          \u_core.u_wave.u_registers.least_q == \u_other.u_wave.u_registers.least_q &&
          \u_core.u_wave.u_registers.held_check_q == \u_other.u_wave.u_registers.held_check_q &&
          \u_core.u_wave.u_registers.warm_q == \u_other.u_wave.u_registers.warm_q &&
          \u_core.u_wave.u_registers.written_q == \u_other.u_wave.u_registers.written_q &&
          \u_core.u_wave.u_registers.written_q2 == \u_other.u_wave.u_registers.written_q2 &&
          \u_core.u_wave.u_registers.word_error_o == \u_other.u_wave.u_registers.word_error_o &&
          \u_core.u_wave.u_registers.g_read.write_bank_q == \u_other.u_wave.u_registers.g_read.write_bank_q &&
          \u_core.u_wave.u_registers.g_read.frozen_q == \u_other.u_wave.u_registers.g_read.frozen_q &&
          \u_core.u_wave.u_registers.address_q == \u_other.u_wave.u_registers.address_q &&
          \u_core.u_wave.u_registers.data_q == \u_other.u_wave.u_registers.data_q &&
          \u_core.u_wave.u_registers.control_o == \u_other.u_wave.u_registers.control_o &&
          \u_core.u_wave.u_registers.param_o == \u_other.u_wave.u_registers.param_o &&
          \u_core.u_wave.u_registers.check_q == \u_other.u_wave.u_registers.check_q );
      reads_store_nothing: assert (
          \u_core.u_wave.u_registers.lands == \u_other.u_wave.u_registers.lands &&
          \u_core.u_wave.u_registers.written == \u_other.u_wave.u_registers.written &&
          \u_core.u_wave.u_registers.snap_valid_i == \u_other.u_wave.u_registers.snap_valid_i &&
          \u_core.u_wave.u_registers.snap_slot_i == \u_other.u_wave.u_registers.snap_slot_i &&
          \u_core.u_wave.u_registers.snap_data_i == \u_other.u_wave.u_registers.snap_data_i &&
          \u_core.u_wave.u_registers.fetch_address == \u_other.u_wave.u_registers.fetch_address );
      reads_reach_no_block: assert (
          \u_core.u_safety.u_supervisor.tick_i == \u_other.u_safety.u_supervisor.tick_i &&
          \u_core.u_safety.u_supervisor.clear_faults_i == \u_other.u_safety.u_supervisor.clear_faults_i &&
          \u_core.u_safety.u_supervisor.kick_i == \u_other.u_safety.u_supervisor.kick_i &&
          \u_core.u_encoder.u_quad_decoder.filter_i == \u_other.u_encoder.u_quad_decoder.filter_i &&
          \u_core.u_encoder.u_quad_decoder.polarity_i == \u_other.u_encoder.u_quad_decoder.polarity_i &&
          \u_core.u_encoder.u_quad_decoder.set_zero_i == \u_other.u_encoder.u_quad_decoder.set_zero_i &&
          \u_core.u_encoder.u_quad_decoder.clear_error_i == \u_other.u_encoder.u_quad_decoder.clear_error_i &&
          \u_core.u_encoder.u_encoder_monitor.set_zero_i == \u_other.u_encoder.u_encoder_monitor.set_zero_i &&
          \u_core.u_actuation.g_two_legs.u_pwm.mode_i == \u_other.u_actuation.g_two_legs.u_pwm.mode_i && \u_core.u_actuation.g_two_legs.u_pwm.polarity_i == \u_other.u_actuation.g_two_legs.u_pwm.polarity_i &&
          \u_core.u_actuation.u_torque_control.mode_i == \u_other.u_actuation.u_torque_control.mode_i &&
          \u_core.u_safety.u_self_test.direct_i == \u_other.u_safety.u_self_test.direct_i &&
          \u_core.u_scenes.scene_i == \u_other.u_scenes.scene_i &&
          \u_core.u_actuation.u_ramp.scene_i == \u_other.u_actuation.u_ramp.scene_i &&
          \u_core.u_scenes.param_i == \u_other.u_scenes.param_i &&
          \u_core.u_actuation.u_ramp.param_i == \u_other.u_actuation.u_ramp.param_i &&
          \u_core.u_actuation.u_limiter.param_i == \u_other.u_actuation.u_limiter.param_i &&
          \u_core.u_actuation.u_torque_control.param_i == \u_other.u_actuation.u_torque_control.param_i &&
          \u_core.u_safety.u_supervisor.param_i == \u_other.u_safety.u_supervisor.param_i &&
          \u_core.u_safety.u_self_test.param_i == \u_other.u_safety.u_self_test.param_i &&
          \u_core.u_safety.u_hold_timer.param_i == \u_other.u_safety.u_hold_timer.param_i &&
          \u_core.u_wave.u_multipliers.param_i == \u_other.u_wave.u_multipliers.param_i &&
          \u_core.u_encoder.wave_i == \u_other.u_encoder.wave_i &&
          \u_core.u_estimators.wave_i == \u_other.u_estimators.wave_i &&
          \u_core.u_scenes.wave_i == \u_other.u_scenes.wave_i &&
          \u_core.u_actuation.wave_i == \u_other.u_actuation.wave_i &&
          \u_core.u_safety.wave_i == \u_other.u_safety.wave_i &&
          \u_core.u_safety.u_supervisor.host_i == \u_other.u_safety.u_supervisor.host_i &&
          \u_core.u_safety.u_supervisor.host_arm_i == \u_other.u_safety.u_supervisor.host_arm_i &&
          \u_core.zeroed_o == \u_other.zeroed_o && \u_core.restart == \u_other.restart &&
          \u_core.host_stop == \u_other.host_stop && \u_core.u_wave.word_error == \u_other.u_wave.word_error &&
          \u_core.u_wave.refused == \u_other.u_wave.refused && \u_core.scene_o == \u_other.scene_o );
      inside_same_clock: assert (
          \u_core.u_wave.u_sequencer.clock_q == \u_other.u_wave.u_sequencer.clock_q &&
          \u_core.u_wave.u_sequencer.tick_o == \u_other.u_wave.u_sequencer.tick_o &&
          \u_core.u_wave.u_sequencer.scene_slot_fetch_o == \u_other.u_wave.u_sequencer.scene_slot_fetch_o &&
          \u_core.u_wave.u_sequencer.wave_o == \u_other.u_wave.u_sequencer.wave_o &&
          \u_core.u_wave.u_sequencer.tick_count_o == \u_other.u_wave.u_sequencer.tick_count_o );
      reads_apart: cover (\u_core.u_wave.u_registers.to_control_q && other_addr_i != reg_addr_i);
    end
  end
endmodule

`default_nettype wire
