// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core with the inputs of core_inputs.svh, and beside it a counter of the clocks of a tick, from which the
// real tick and the real wave follow. What the proof cuts of it is in proofs.toml.

  localparam int N = feltgate_pkg::CLOCKS_PER_TICK;
  localparam int L = feltgate_map_pkg::WAVE_LENGTH;
  localparam int First = feltgate_map_pkg::FIRST_WAVE_CLOCK;

  logic busy, snapshot_valid, armed, gates_enable, zeroed;
  logic [31:0] rdata, tick_count;
  logic signed [31:0] position;
  logic signed [feltgate_pkg::VELOCITY_W-1:0] velocity;
  logic signed [feltgate_pkg::TORQUE_W-1:0] tau_hat, tau_ref;
  logic signed [feltgate_pkg::CURRENT_W-1:0] current_ref;
  logic signed [feltgate_pkg::VOLTAGE_W-1:0] voltage;
  logic signed [feltgate_pkg::DUTY_W-1:0] duty, duty_active;
  logic [3:0] scene;
  logic [feltgate_map_pkg::W_FAULTS_SEEN-1:0] faults;
  feltgate_core #(.ParameterFile("parameters.mem")) u_core (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i),
      .encoder_data_i(encoder_data_i), .hall_i(3'b000), .current_data_i(current_data_i), .driver_fault_i(driver_fault_i), .arm_i(arm_i), .stop_i(stop_i), .set_zero_i(set_zero_i), .scene_i(scene_i),
      .law_torque_i(law_torque_i), .law_late_i(law_late_i), .law_restart_i(law_restart_i),
      .axis_fault_i(axis_fault_i), .axis_silent_i(axis_silent_i), .axis_blocked_i(axis_blocked_i),
      .axis_testing_i(axis_testing_i), .axis_waits_i(axis_waits_i),
      .reg_addr_i(reg_addr_i), .reg_wdata_i(reg_wdata_i), .reg_write_i(reg_write_i),
      .reg_busy_o(busy), .reg_rdata_o(rdata),
      .zeroed_o(zeroed), .snapshot_valid_o(snapshot_valid), .tick_count_o(tick_count), .position_o(position),
      .velocity_o(velocity), .tau_hat_o(tau_hat), .tau_ref_o(tau_ref), .current_ref_o(current_ref),
      .voltage_o(voltage), .duty_o(duty), .scene_o(scene), .faults_o(faults), .armed_o(armed),
      .duty_active_o(duty_active), .gates_enable_o(gates_enable)
  );
  localparam int ClockW = (N > 64) ? $clog2(N) : 6;
  (* hierconn *) wire \u_core.tick ;
  (* hierconn *) wire [L-1:0] \u_core.wave ;
  (* hierconn *) wire [5:0] \u_core.u_wave.slot_fetch ;
  (* hierconn *) wire \u_core.u_wave.scene_slot_fetch ;
  (* hierconn *) wire [ClockW-1:0] \u_core.u_wave.u_sequencer.clock_q ;
  wire [L-1:0] wave = \u_core.wave ;

  logic [9:0] phase_q;  // clock of the tick
  logic began_q;        // a tick was before this one since the reset, so its wave may still run
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      phase_q <= 10'd0;
      began_q <= 1'b0;
    end else begin
      phase_q <= last ? 10'd0 : phase_q + 10'd1;
      if (last) began_q <= 1'b1;
    end
  end
  logic last;
  logic [9:0] at;  // clock of the wave
  assign last = phase_q == 10'(N - 1);
  assign at   = (phase_q >= 10'(First)) ? phase_q - 10'(First) : phase_q + 10'(N - First);
  always_comb begin
    if (past_ok_q && rst_ni) begin
      inside_phase: assert (10'(\u_core.u_wave.u_sequencer.clock_q ) == phase_q && phase_q < 10'(N));
      inside_tick: assert (\u_core.tick == last);
      inside_wave: assert (wave == (((phase_q >= 10'(First) || began_q) && at < 10'(L)) ? L'(1) << at : '0));
      inside_slot: assert (\u_core.u_wave.slot_fetch == ((phase_q < 10'd64) ? phase_q[5:0] : 6'd63) &&
          \u_core.u_wave.scene_slot_fetch == (phase_q < 10'd64 && feltgate_map_pkg::SCENE_SLOTS[phase_q[5:0]]));
    end
  end
