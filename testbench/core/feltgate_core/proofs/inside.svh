// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Wires inside the core that both proofs of the register port name, reads and writes. For a wrapper with core.svh.

  // Of the registers: what goes to the RAMs, and what waits there.
  (* hierconn *) wire \u_core.u_wave.u_registers.lands ;
  (* hierconn *) wire [35:0] \u_core.u_wave.u_registers.written ;
  (* hierconn *) wire [8:0] \u_core.u_wave.u_registers.address_q ;
  (* hierconn *) wire [5:0] \u_core.u_wave.u_registers.least_at_q ;
  (* hierconn *) wire [31:0] \u_core.u_wave.u_registers.data_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.to_parameter_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.to_control_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.to_command_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.disarm_o ;
  (* hierconn *) wire \u_core.u_wave.u_registers.stop_o ;
  (* hierconn *) wire \u_core.u_wave.u_registers.zero_q ;
  (* hierconn *) wire \u_core.u_wave.u_registers.warm_q ;
  (* hierconn *) wire [8:0] \u_core.u_wave.u_registers.fetch_address ;
  (* hierconn *) wire [35:0] \u_core.u_wave.u_registers.fetch_q ;
  // What the blocks get.
  (* hierconn *) wire [31:0] \u_core.u_actuation.u_torque_control.param_i ;
  (* hierconn *) wire [31:0] \u_core.u_scenes.param_i ;
  (* hierconn *) wire [31:0] \u_core.u_actuation.u_limiter.param_i ;
  (* hierconn *) wire [31:0] \u_core.u_actuation.u_ramp.param_i ;
  (* hierconn *) wire [31:0] \u_core.u_safety.u_supervisor.param_i ;
  (* hierconn *) wire [31:0] \u_core.u_safety.u_self_test.param_i ;
  (* hierconn *) wire [31:0] \u_core.u_safety.u_hold_timer.param_i ;
  (* hierconn *) wire [31:0] \u_core.u_wave.u_multipliers.param_i ;
  (* hierconn *) wire [1:0] \u_core.u_actuation.u_torque_control.mode_i ;
  (* hierconn *) wire \u_core.u_safety.u_self_test.direct_i ;
  (* hierconn *) wire \u_core.u_actuation.g_two_legs.u_pwm.mode_i ;
  (* hierconn *) wire \u_core.u_actuation.g_two_legs.u_pwm.polarity_i ;
  (* hierconn *) wire [3:0] \u_core.u_encoder.u_quad_decoder.filter_i ;
  (* hierconn *) wire \u_core.u_encoder.u_quad_decoder.polarity_i ;
  (* hierconn *) wire \u_core.u_encoder.u_quad_decoder.clear_error_i ;
  (* hierconn *) wire \u_core.u_encoder.u_quad_decoder.set_zero_i ;
  (* hierconn *) wire \u_core.u_encoder.u_encoder_monitor.set_zero_i ;
  (* hierconn *) wire [3:0] \u_core.u_scenes.scene_i ;
  (* hierconn *) wire [3:0] \u_core.u_actuation.u_ramp.scene_i ;
  (* hierconn *) wire \u_core.u_safety.u_supervisor.clear_faults_i ;
  (* hierconn *) wire \u_core.u_safety.u_supervisor.kick_i ;
  (* hierconn *) wire \u_core.arm_request_o ;
  (* hierconn *) wire \u_core.region_high ;
  (* hierconn *) wire \u_core.derated ;
  (* hierconn *) wire \u_core.testing_o ;
