// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What three axes and the engine hear of each other, whatever they do: of them only the ports are read.
`default_nettype none

module together_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic [2:0]  enc_a_i,
    input logic [2:0]  enc_b_i,
    input logic [2:0]  enc_z_i,
    input logic [2:0]  encoder_data_i,
    input logic        arm_i,
    input logic        stop_i,
    input logic [2:0]  set_zero_i,
    input logic [11:0] scene_i,
    input logic [15:0] addr_i,
    input logic [31:0] wdata_i,
    input logic        write_i,
    input logic        read_i
);
  localparam int FirstW = map::W_FAULTS_FIRST;

`include "reset.svh"

  logic busy, measured_o, snapshot_valid_o, event_valid_o, word_valid_o;
  logic [31:0] rdata, tick_count_o, event_value_o;
  logic [8:0] event_number_o;
  logic [5:0] word_slot_o;
  logic [2:0] gate_c_hi_o, gate_c_lo_o, encoder_select_no, encoder_clock_o, encoder_command_o;
  logic [2:0] gate_a_hi_o, gate_a_lo_o, gate_b_hi_o, gate_b_lo_o, armed_o, gates_enable_o, zeroed_o;
  logic [11:0] scene_o;
  logic [95:0] position_o, word_data_o;
  logic [3*cfg::VELOCITY_W-1:0] velocity_o;
  logic [3*cfg::TORQUE_W-1:0] tau_hat_o, tau_ref_o;
  logic [3*cfg::CURRENT_W-1:0] current_ref_o;
  logic [3*cfg::VOLTAGE_W-1:0] voltage_o;
  logic [3*cfg::DUTY_W-1:0] duty_o, duty_active_o;
  logic [3*map::W_STATUS_LIMITS-1:0] limits_o;
  logic [3*map::W_FAULTS_SEEN-1:0] faults_o;
  logic [3*FirstW-1:0] first_fault_o;
  feltgate_axes #(.AxisCount(3), .Engine(1)) u_dut (
      .*,
      .law_torque_i('0), .law_late_i(1'b0), .law_restart_i(1'b0),  // not used with an engine
      .reg_addr_i(addr_i), .reg_wdata_i(wdata_i), .reg_write_i(write_i), .reg_read_i(read_i),
      .reg_busy_o(busy), .reg_rdata_o(rdata)
  );
  (* hierconn *) wire \u_dut.g_axis[0].u_core.axis_fault_i , \u_dut.g_axis[1].u_core.axis_fault_i , \u_dut.g_axis[2].u_core.axis_fault_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.axis_silent_i , \u_dut.g_axis[1].u_core.axis_silent_i , \u_dut.g_axis[2].u_core.axis_silent_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.axis_blocked_i , \u_dut.g_axis[1].u_core.axis_blocked_i , \u_dut.g_axis[2].u_core.axis_blocked_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.axis_testing_i , \u_dut.g_axis[1].u_core.axis_testing_i , \u_dut.g_axis[2].u_core.axis_testing_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.axis_waits_i , \u_dut.g_axis[1].u_core.axis_waits_i , \u_dut.g_axis[2].u_core.axis_waits_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.arm_request_o , \u_dut.g_axis[1].u_core.arm_request_o , \u_dut.g_axis[2].u_core.arm_request_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.ready_o , \u_dut.g_axis[1].u_core.ready_o , \u_dut.g_axis[2].u_core.ready_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.testing_o , \u_dut.g_axis[1].u_core.testing_o , \u_dut.g_axis[2].u_core.testing_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.reg_write_i , \u_dut.g_axis[1].u_core.reg_write_i , \u_dut.g_axis[2].u_core.reg_write_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.reg_busy_o , \u_dut.g_axis[1].u_core.reg_busy_o , \u_dut.g_axis[2].u_core.reg_busy_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.arm_i , \u_dut.g_axis[1].u_core.arm_i , \u_dut.g_axis[2].u_core.arm_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.stop_i , \u_dut.g_axis[1].u_core.stop_i , \u_dut.g_axis[2].u_core.stop_i ;
  (* hierconn *) wire [11:0] \u_dut.g_axis[0].u_core.reg_addr_i , \u_dut.g_axis[1].u_core.reg_addr_i , \u_dut.g_axis[2].u_core.reg_addr_i ;
  (* hierconn *) wire [31:0] \u_dut.g_axis[0].u_core.reg_wdata_i , \u_dut.g_axis[1].u_core.reg_wdata_i , \u_dut.g_axis[2].u_core.reg_wdata_i ;
  (* hierconn *) wire [31:0] \u_dut.g_axis[0].u_core.reg_rdata_o , \u_dut.g_axis[1].u_core.reg_rdata_o , \u_dut.g_axis[2].u_core.reg_rdata_o ;
  (* hierconn *) wire [cfg::VELOCITY_W-1:0] \u_dut.g_axis[0].u_core.velocity_o , \u_dut.g_axis[1].u_core.velocity_o , \u_dut.g_axis[2].u_core.velocity_o ;
  (* hierconn *) wire [cfg::TORQUE_W-1:0] \u_dut.g_axis[0].u_core.tau_hat_o , \u_dut.g_axis[1].u_core.tau_hat_o , \u_dut.g_axis[2].u_core.tau_hat_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.enc_a_i , \u_dut.g_axis[1].u_core.enc_a_i , \u_dut.g_axis[2].u_core.enc_a_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.enc_b_i , \u_dut.g_axis[1].u_core.enc_b_i , \u_dut.g_axis[2].u_core.enc_b_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.enc_z_i , \u_dut.g_axis[1].u_core.enc_z_i , \u_dut.g_axis[2].u_core.enc_z_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.encoder_data_i , \u_dut.g_axis[1].u_core.encoder_data_i , \u_dut.g_axis[2].u_core.encoder_data_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.gate_c_hi_o , \u_dut.g_axis[1].u_core.gate_c_hi_o , \u_dut.g_axis[2].u_core.gate_c_hi_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.gate_c_lo_o , \u_dut.g_axis[1].u_core.gate_c_lo_o , \u_dut.g_axis[2].u_core.gate_c_lo_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.encoder_select_no , \u_dut.g_axis[1].u_core.encoder_select_no , \u_dut.g_axis[2].u_core.encoder_select_no ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.encoder_clock_o , \u_dut.g_axis[1].u_core.encoder_clock_o , \u_dut.g_axis[2].u_core.encoder_clock_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.encoder_command_o , \u_dut.g_axis[1].u_core.encoder_command_o , \u_dut.g_axis[2].u_core.encoder_command_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.set_zero_i , \u_dut.g_axis[1].u_core.set_zero_i , \u_dut.g_axis[2].u_core.set_zero_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.law_late_i , \u_dut.g_axis[1].u_core.law_late_i , \u_dut.g_axis[2].u_core.law_late_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.law_restart_i , \u_dut.g_axis[1].u_core.law_restart_i , \u_dut.g_axis[2].u_core.law_restart_i ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.gate_a_hi_o , \u_dut.g_axis[1].u_core.gate_a_hi_o , \u_dut.g_axis[2].u_core.gate_a_hi_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.gate_a_lo_o , \u_dut.g_axis[1].u_core.gate_a_lo_o , \u_dut.g_axis[2].u_core.gate_a_lo_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.gate_b_hi_o , \u_dut.g_axis[1].u_core.gate_b_hi_o , \u_dut.g_axis[2].u_core.gate_b_hi_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.gate_b_lo_o , \u_dut.g_axis[1].u_core.gate_b_lo_o , \u_dut.g_axis[2].u_core.gate_b_lo_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.armed_o , \u_dut.g_axis[1].u_core.armed_o , \u_dut.g_axis[2].u_core.armed_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.gates_enable_o , \u_dut.g_axis[1].u_core.gates_enable_o , \u_dut.g_axis[2].u_core.gates_enable_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.zeroed_o , \u_dut.g_axis[1].u_core.zeroed_o , \u_dut.g_axis[2].u_core.zeroed_o ;
  (* hierconn *) wire [3:0] \u_dut.g_axis[0].u_core.scene_i , \u_dut.g_axis[1].u_core.scene_i , \u_dut.g_axis[2].u_core.scene_i ;
  (* hierconn *) wire [3:0] \u_dut.g_axis[0].u_core.scene_o , \u_dut.g_axis[1].u_core.scene_o , \u_dut.g_axis[2].u_core.scene_o ;
  (* hierconn *) wire [31:0] \u_dut.g_axis[0].u_core.word_data_o , \u_dut.g_axis[1].u_core.word_data_o , \u_dut.g_axis[2].u_core.word_data_o ;
  (* hierconn *) wire [31:0] \u_dut.g_axis[0].u_core.position_o , \u_dut.g_axis[1].u_core.position_o , \u_dut.g_axis[2].u_core.position_o ;
  (* hierconn *) wire [cfg::TORQUE_W-1:0] \u_dut.g_axis[0].u_core.law_torque_i , \u_dut.g_axis[1].u_core.law_torque_i , \u_dut.g_axis[2].u_core.law_torque_i ;
  (* hierconn *) wire [cfg::TORQUE_W-1:0] \u_dut.g_axis[0].u_core.tau_ref_o , \u_dut.g_axis[1].u_core.tau_ref_o , \u_dut.g_axis[2].u_core.tau_ref_o ;
  (* hierconn *) wire [cfg::CURRENT_W-1:0] \u_dut.g_axis[0].u_core.current_ref_o , \u_dut.g_axis[1].u_core.current_ref_o , \u_dut.g_axis[2].u_core.current_ref_o ;
  (* hierconn *) wire [cfg::VOLTAGE_W-1:0] \u_dut.g_axis[0].u_core.voltage_o , \u_dut.g_axis[1].u_core.voltage_o , \u_dut.g_axis[2].u_core.voltage_o ;
  (* hierconn *) wire [cfg::DUTY_W-1:0] \u_dut.g_axis[0].u_core.duty_o , \u_dut.g_axis[1].u_core.duty_o , \u_dut.g_axis[2].u_core.duty_o ;
  (* hierconn *) wire [cfg::DUTY_W-1:0] \u_dut.g_axis[0].u_core.duty_active_o , \u_dut.g_axis[1].u_core.duty_active_o , \u_dut.g_axis[2].u_core.duty_active_o ;
  (* hierconn *) wire [map::W_STATUS_LIMITS-1:0] \u_dut.g_axis[0].u_core.limits_o , \u_dut.g_axis[1].u_core.limits_o , \u_dut.g_axis[2].u_core.limits_o ;
  (* hierconn *) wire [map::W_FAULTS_SEEN-1:0] \u_dut.g_axis[0].u_core.faults_o , \u_dut.g_axis[1].u_core.faults_o , \u_dut.g_axis[2].u_core.faults_o ;
  (* hierconn *) wire [FirstW-1:0] \u_dut.g_axis[0].u_core.first_fault_o , \u_dut.g_axis[1].u_core.first_fault_o , \u_dut.g_axis[2].u_core.first_fault_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.snapshot_valid_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.measured_o ;
  (* hierconn *) wire \u_dut.g_axis[0].u_core.word_valid_o ;
  (* hierconn *) wire [5:0] \u_dut.g_axis[0].u_core.word_slot_o ;
  (* hierconn *) wire [31:0] \u_dut.g_axis[0].u_core.tick_count_o ;
  (* hierconn *) wire [95:0] \u_dut.g_engine.u_engine.velocity_i ;
  (* hierconn *) wire [95:0] \u_dut.g_engine.u_engine.tau_hat_i ;
  (* hierconn *) wire \u_dut.g_engine.u_engine.unchecked_o ;
  (* hierconn *) wire \u_dut.g_engine.u_engine.unfit_o ;
  (* hierconn *) wire \u_dut.g_engine.u_engine.reg_busy_o ;
  (* hierconn *) wire [31:0] \u_dut.g_engine.u_engine.reg_rdata_o ;
  (* hierconn *) wire [2:0] \u_dut.g_engine.u_engine.arm_request_i ;
  (* hierconn *) wire [15:0] \u_dut.g_engine.u_engine.reg_addr_i ;
  (* hierconn *) wire [31:0] \u_dut.g_engine.u_engine.reg_wdata_i ;
  (* hierconn *) wire \u_dut.g_engine.u_engine.reg_write_i ;
  (* hierconn *) wire \u_dut.g_engine.u_engine.reg_read_i ;
  (* hierconn *) wire [2:0] \u_dut.g_engine.u_engine.law_i ;
  (* hierconn *) wire [2:0] \u_dut.g_engine.u_engine.armed_i ;
  (* hierconn *) wire [2:0] \u_dut.g_engine.u_engine.zeroed_i ;
  (* hierconn *) wire \u_dut.g_engine.u_engine.snapshot_i ;
  (* hierconn *) wire \u_dut.g_engine.u_engine.measured_i ;
  (* hierconn *) wire [31:0] \u_dut.g_engine.u_engine.tick_count_i ;
  (* hierconn *) wire [95:0] \u_dut.g_engine.u_engine.position_i ;
  (* hierconn *) wire [3*cfg::TORQUE_W-1:0] \u_dut.g_engine.u_engine.torque_o ;
  (* hierconn *) wire \u_dut.g_engine.u_engine.late_o ;
  (* hierconn *) wire \u_dut.g_engine.u_engine.restart_o ;
  (* hierconn *) wire \u_dut.g_engine.u_engine.event_valid_o ;
  (* hierconn *) wire [8:0] \u_dut.g_engine.u_engine.event_number_o ;
  (* hierconn *) wire [31:0] \u_dut.g_engine.u_engine.event_value_o ;

  // Axis n is bit n.
  logic [2:0] hears_fault, silent, blocked, beside, waits, arm_requests, ready, testing, writes, busies, arms, stops;
  logic [35:0] addresses;
  logic [95:0] data, words, velocities, torques;
  // A word of the engine, of a number of fewer bits.
  assign velocities = {32'($signed(\u_dut.g_axis[2].u_core.velocity_o )), 32'($signed(\u_dut.g_axis[1].u_core.velocity_o )), 32'($signed(\u_dut.g_axis[0].u_core.velocity_o ))};
  assign torques = {32'($signed(\u_dut.g_axis[2].u_core.tau_hat_o )), 32'($signed(\u_dut.g_axis[1].u_core.tau_hat_o )), 32'($signed(\u_dut.g_axis[0].u_core.tau_hat_o ))};
  assign hears_fault = {\u_dut.g_axis[2].u_core.axis_fault_i , \u_dut.g_axis[1].u_core.axis_fault_i , \u_dut.g_axis[0].u_core.axis_fault_i };
  assign silent = {\u_dut.g_axis[2].u_core.axis_silent_i , \u_dut.g_axis[1].u_core.axis_silent_i , \u_dut.g_axis[0].u_core.axis_silent_i };
  assign blocked = {\u_dut.g_axis[2].u_core.axis_blocked_i , \u_dut.g_axis[1].u_core.axis_blocked_i , \u_dut.g_axis[0].u_core.axis_blocked_i };
  assign beside = {\u_dut.g_axis[2].u_core.axis_testing_i , \u_dut.g_axis[1].u_core.axis_testing_i , \u_dut.g_axis[0].u_core.axis_testing_i };
  assign waits = {\u_dut.g_axis[2].u_core.axis_waits_i , \u_dut.g_axis[1].u_core.axis_waits_i , \u_dut.g_axis[0].u_core.axis_waits_i };
  assign arm_requests = {\u_dut.g_axis[2].u_core.arm_request_o , \u_dut.g_axis[1].u_core.arm_request_o , \u_dut.g_axis[0].u_core.arm_request_o };
  assign ready = {\u_dut.g_axis[2].u_core.ready_o , \u_dut.g_axis[1].u_core.ready_o , \u_dut.g_axis[0].u_core.ready_o };
  assign testing = {\u_dut.g_axis[2].u_core.testing_o , \u_dut.g_axis[1].u_core.testing_o , \u_dut.g_axis[0].u_core.testing_o };
  assign writes = {\u_dut.g_axis[2].u_core.reg_write_i , \u_dut.g_axis[1].u_core.reg_write_i , \u_dut.g_axis[0].u_core.reg_write_i };
  assign busies = {\u_dut.g_axis[2].u_core.reg_busy_o , \u_dut.g_axis[1].u_core.reg_busy_o , \u_dut.g_axis[0].u_core.reg_busy_o };
  assign arms = {\u_dut.g_axis[2].u_core.arm_i , \u_dut.g_axis[1].u_core.arm_i , \u_dut.g_axis[0].u_core.arm_i };
  assign stops = {\u_dut.g_axis[2].u_core.stop_i , \u_dut.g_axis[1].u_core.stop_i , \u_dut.g_axis[0].u_core.stop_i };
  assign addresses = {\u_dut.g_axis[2].u_core.reg_addr_i , \u_dut.g_axis[1].u_core.reg_addr_i , \u_dut.g_axis[0].u_core.reg_addr_i };
  assign data = {\u_dut.g_axis[2].u_core.reg_wdata_i , \u_dut.g_axis[1].u_core.reg_wdata_i , \u_dut.g_axis[0].u_core.reg_wdata_i };
  assign words = {\u_dut.g_axis[2].u_core.reg_rdata_o , \u_dut.g_axis[1].u_core.reg_rdata_o , \u_dut.g_axis[0].u_core.reg_rdata_o };

  (* anyconst *) logic [1:0] n;
  always_comb assume (n <= 2'd2);
  logic addressed;
  assign addressed = addr_i[15:10] == {4'd0, n};

  // Of the others than n.
  logic [2:0] own, faults;
  assign own    = 3'd1 << n;
  assign faults = {first_fault_o[2*FirstW+:FirstW] != '0, first_fault_o[FirstW+:FirstW] != '0, first_fault_o[0+:FirstW] != '0};
  logic engine_busy;
  logic [31:0] engine_word;
  assign engine_busy = \u_dut.g_engine.u_engine.reg_busy_o ;
  assign engine_word = \u_dut.g_engine.u_engine.reg_rdata_o ;

  always_comb begin
    if (past_ok_q) begin
      any_fault_is_heard: assert (hears_fault[n] == ((faults & ~own) != 3'd0));
      stop_for_all: assert (stops == {3{stop_i}} && arms == {3{arm_i}});
      arms_with_all: assert (silent[n] == ((~arm_requests & ~own) != 3'd0 || \u_dut.g_engine.u_engine.unchecked_o ));
      ready_with_all: assert (blocked[n] == ((~ready & ~own) != 3'd0 || \u_dut.g_engine.u_engine.unfit_o ));
      tests_in_turn: assert (waits[n] == ((testing & (own - 3'd1)) != 3'd0));
      nothing_beside_a_test: assert (beside[n] == ((testing & ~own) != 3'd0));
      its_addresses: assert (addresses[12*n+:12] == {{2{!addressed}}, addr_i[9:0]} && writes[n] == write_i &&
                             data[32*n+:32] == wdata_i);
      busy_if_addressed: assert (busy == (engine_busy || (addr_i[15:10] < 6'd3 && busies[addr_i[11:10]])));
      word_of_all: assert (rdata == (words[31:0] | words[63:32] | words[95:64] | engine_word));
      engine_side: assert (\u_dut.g_engine.u_engine.reg_write_i == write_i && \u_dut.g_engine.u_engine.reg_wdata_i == wdata_i &&
                           \u_dut.g_engine.u_engine.reg_read_i == read_i);
      engine_hears_all: assert (\u_dut.g_engine.u_engine.arm_request_i == arm_requests && \u_dut.g_engine.u_engine.reg_addr_i == addr_i);
      engine_is_given_signs: assert (\u_dut.g_engine.u_engine.velocity_i == velocities && \u_dut.g_engine.u_engine.tau_hat_i == torques);
      pins_of_its_axis: assert ({encoder_data_i, gate_c_hi_o, gate_c_lo_o, encoder_select_no, encoder_clock_o, encoder_command_o} == {\u_dut.g_axis[2].u_core.encoder_data_i , \u_dut.g_axis[1].u_core.encoder_data_i , \u_dut.g_axis[0].u_core.encoder_data_i , \u_dut.g_axis[2].u_core.gate_c_hi_o , \u_dut.g_axis[1].u_core.gate_c_hi_o , \u_dut.g_axis[0].u_core.gate_c_hi_o , \u_dut.g_axis[2].u_core.gate_c_lo_o , \u_dut.g_axis[1].u_core.gate_c_lo_o , \u_dut.g_axis[0].u_core.gate_c_lo_o , \u_dut.g_axis[2].u_core.encoder_select_no , \u_dut.g_axis[1].u_core.encoder_select_no , \u_dut.g_axis[0].u_core.encoder_select_no , \u_dut.g_axis[2].u_core.encoder_clock_o , \u_dut.g_axis[1].u_core.encoder_clock_o , \u_dut.g_axis[0].u_core.encoder_clock_o , \u_dut.g_axis[2].u_core.encoder_command_o , \u_dut.g_axis[1].u_core.encoder_command_o , \u_dut.g_axis[0].u_core.encoder_command_o } &&
          {enc_a_i, enc_b_i, enc_z_i} == {\u_dut.g_axis[2].u_core.enc_a_i , \u_dut.g_axis[1].u_core.enc_a_i , \u_dut.g_axis[0].u_core.enc_a_i , \u_dut.g_axis[2].u_core.enc_b_i , \u_dut.g_axis[1].u_core.enc_b_i , \u_dut.g_axis[0].u_core.enc_b_i , \u_dut.g_axis[2].u_core.enc_z_i , \u_dut.g_axis[1].u_core.enc_z_i , \u_dut.g_axis[0].u_core.enc_z_i } &&
          {gate_a_hi_o, gate_a_lo_o} == {\u_dut.g_axis[2].u_core.gate_a_hi_o , \u_dut.g_axis[1].u_core.gate_a_hi_o , \u_dut.g_axis[0].u_core.gate_a_hi_o , \u_dut.g_axis[2].u_core.gate_a_lo_o , \u_dut.g_axis[1].u_core.gate_a_lo_o , \u_dut.g_axis[0].u_core.gate_a_lo_o } &&
          {gate_b_hi_o, gate_b_lo_o} == {\u_dut.g_axis[2].u_core.gate_b_hi_o , \u_dut.g_axis[1].u_core.gate_b_hi_o , \u_dut.g_axis[0].u_core.gate_b_hi_o , \u_dut.g_axis[2].u_core.gate_b_lo_o , \u_dut.g_axis[1].u_core.gate_b_lo_o , \u_dut.g_axis[0].u_core.gate_b_lo_o } &&
          {set_zero_i, scene_i} == {\u_dut.g_axis[2].u_core.set_zero_i , \u_dut.g_axis[1].u_core.set_zero_i , \u_dut.g_axis[0].u_core.set_zero_i , \u_dut.g_axis[2].u_core.scene_i , \u_dut.g_axis[1].u_core.scene_i , \u_dut.g_axis[0].u_core.scene_i });
      snapshot_of_its_axis: assert ({position_o, velocity_o} == {\u_dut.g_axis[2].u_core.position_o , \u_dut.g_axis[1].u_core.position_o , \u_dut.g_axis[0].u_core.position_o , \u_dut.g_axis[2].u_core.velocity_o , \u_dut.g_axis[1].u_core.velocity_o , \u_dut.g_axis[0].u_core.velocity_o } &&
          {tau_hat_o, tau_ref_o} == {\u_dut.g_axis[2].u_core.tau_hat_o , \u_dut.g_axis[1].u_core.tau_hat_o , \u_dut.g_axis[0].u_core.tau_hat_o , \u_dut.g_axis[2].u_core.tau_ref_o , \u_dut.g_axis[1].u_core.tau_ref_o , \u_dut.g_axis[0].u_core.tau_ref_o } &&
          {current_ref_o, voltage_o} == {\u_dut.g_axis[2].u_core.current_ref_o , \u_dut.g_axis[1].u_core.current_ref_o , \u_dut.g_axis[0].u_core.current_ref_o , \u_dut.g_axis[2].u_core.voltage_o , \u_dut.g_axis[1].u_core.voltage_o , \u_dut.g_axis[0].u_core.voltage_o } &&
          {duty_o, duty_active_o} == {\u_dut.g_axis[2].u_core.duty_o , \u_dut.g_axis[1].u_core.duty_o , \u_dut.g_axis[0].u_core.duty_o , \u_dut.g_axis[2].u_core.duty_active_o , \u_dut.g_axis[1].u_core.duty_active_o , \u_dut.g_axis[0].u_core.duty_active_o });
      words_of_its_axis: assert (word_data_o == {\u_dut.g_axis[2].u_core.word_data_o , \u_dut.g_axis[1].u_core.word_data_o , \u_dut.g_axis[0].u_core.word_data_o } &&
          {word_valid_o, word_slot_o} == {\u_dut.g_axis[0].u_core.word_valid_o , \u_dut.g_axis[0].u_core.word_slot_o });
      lamps_of_its_axis: assert ({scene_o, limits_o} == {\u_dut.g_axis[2].u_core.scene_o , \u_dut.g_axis[1].u_core.scene_o , \u_dut.g_axis[0].u_core.scene_o , \u_dut.g_axis[2].u_core.limits_o , \u_dut.g_axis[1].u_core.limits_o , \u_dut.g_axis[0].u_core.limits_o } &&
          {faults_o, first_fault_o} == {\u_dut.g_axis[2].u_core.faults_o , \u_dut.g_axis[1].u_core.faults_o , \u_dut.g_axis[0].u_core.faults_o , \u_dut.g_axis[2].u_core.first_fault_o , \u_dut.g_axis[1].u_core.first_fault_o , \u_dut.g_axis[0].u_core.first_fault_o } &&
          {armed_o, gates_enable_o, zeroed_o} == {\u_dut.g_axis[2].u_core.armed_o , \u_dut.g_axis[1].u_core.armed_o , \u_dut.g_axis[0].u_core.armed_o , \u_dut.g_axis[2].u_core.gates_enable_o , \u_dut.g_axis[1].u_core.gates_enable_o , \u_dut.g_axis[0].u_core.gates_enable_o , \u_dut.g_axis[2].u_core.zeroed_o , \u_dut.g_axis[1].u_core.zeroed_o , \u_dut.g_axis[0].u_core.zeroed_o });
      time_of_axis_0: assert ({snapshot_valid_o, measured_o, tick_count_o} ==
          {\u_dut.g_axis[0].u_core.snapshot_valid_o , \u_dut.g_axis[0].u_core.measured_o , \u_dut.g_axis[0].u_core.tick_count_o });
      torque_of_the_engine: assert ({\u_dut.g_axis[2].u_core.law_torque_i , \u_dut.g_axis[1].u_core.law_torque_i , \u_dut.g_axis[0].u_core.law_torque_i } == \u_dut.g_engine.u_engine.torque_o &&
          {\u_dut.g_axis[2].u_core.law_late_i , \u_dut.g_axis[1].u_core.law_late_i , \u_dut.g_axis[0].u_core.law_late_i , \u_dut.g_axis[2].u_core.law_restart_i , \u_dut.g_axis[1].u_core.law_restart_i , \u_dut.g_axis[0].u_core.law_restart_i } == {{3{\u_dut.g_engine.u_engine.late_o }}, {3{\u_dut.g_engine.u_engine.restart_o }}});
      engine_knows_the_axes: assert (\u_dut.g_engine.u_engine.law_i == {scene_o[11:8] == map::SCENE_LAW, scene_o[7:4] == map::SCENE_LAW,
                                                   scene_o[3:0] == map::SCENE_LAW} &&
          {\u_dut.g_engine.u_engine.armed_i , \u_dut.g_engine.u_engine.zeroed_i , \u_dut.g_engine.u_engine.position_i } == {armed_o, zeroed_o, position_o} &&
          {\u_dut.g_engine.u_engine.snapshot_i , \u_dut.g_engine.u_engine.measured_i , \u_dut.g_engine.u_engine.tick_count_i } == {snapshot_valid_o, measured_o, tick_count_o});
      events_of_the_engine: assert ({event_valid_o, event_number_o, event_value_o} ==
          {\u_dut.g_engine.u_engine.event_valid_o , \u_dut.g_engine.u_engine.event_number_o , \u_dut.g_engine.u_engine.event_value_o });
      a_test: cover (testing[2] && waits == 3'd0 && beside == 3'd3);
      a_fault: cover (faults == 3'd4 && hears_fault == 3'd3);
    end
  end
endmodule

`default_nettype wire
