// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Core and link put together: who gets what from whom, whatever each of them does; of them only the ports
// are read. LAW: the design has an engine, and its cores are the axes of feltgate_axes. VIEW: it has more than one.
`default_nettype none

module wires_proof (
    input logic       clk_i,
    input logic       rst_ni,
    input logic [cfg::AXES-1:0] enc_a_i,
    input logic [cfg::AXES-1:0] enc_b_i,
    input logic [cfg::AXES-1:0] enc_z_i,
    input logic       encoder_data_i,
    input logic [cfg::CURRENT_LOOP*(cfg::PHASES-2):0] current_data_i,
    input logic       driver_fault_i,
    input logic [2:0] hall_i,
    input logic       arm_i,
    input logic       stop_i,
    input logic [cfg::AXES-1:0] set_zero_i,
    input logic       clear_faults_i,
    input logic [4*cfg::AXES-1:0] scene_i,
    input logic       uart_rx_i,
    input logic [7:0] inputs_i
);

  localparam int A = cfg::AXES;

  `include "reset.svh"

  // Outputs.
  logic [A-1:0] a_hi, a_lo, b_hi, b_lo, armed, gates_enable;
  logic c_hi, c_lo, tx, snapshot_valid;
  logic select_n, serial_clock, command, current_clock, heartbeat;
  logic [32*A-1:0] position;
  logic [A*map::W_STATUS_LIMITS-1:0] limits;
  logic [A*map::W_FAULTS_SEEN-1:0] faults;
  logic [A*map::W_FAULTS_FIRST-1:0] first_fault;
  logic [4*A-1:0] scene;
  feltgate_linked u_dut (
      .*,
      .gate_a_hi_o(a_hi), .gate_a_lo_o(a_lo), .gate_b_hi_o(b_hi), .gate_b_lo_o(b_lo),
      .gate_c_hi_o(c_hi), .gate_c_lo_o(c_lo),
      .encoder_select_no(select_n), .encoder_clock_o(serial_clock), .encoder_command_o(command),
      .current_clock_o(current_clock), .heartbeat_o(heartbeat), .uart_tx_o(tx),
      .position_o(position), .limits_o(limits), .faults_o(faults), .first_fault_o(first_fault),
      .scene_o(scene), .armed_o(armed), .gates_enable_o(gates_enable), .snapshot_valid_o(snapshot_valid)
  );
`ifdef LAW
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.enc_a_i ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.enc_b_i ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.enc_z_i ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.encoder_data_i ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.encoder_select_no ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.encoder_clock_o ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.encoder_command_o ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.gate_c_hi_o ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.gate_c_lo_o ;
  (* hierconn *) wire \u_dut.g_law.u_axes.arm_i ;
  (* hierconn *) wire \u_dut.g_law.u_axes.stop_i ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.set_zero_i ;
  (* hierconn *) wire [4*A-1:0] \u_dut.g_law.u_axes.scene_i ;
  (* hierconn *) wire [A*cfg::TORQUE_W-1:0] \u_dut.g_law.u_axes.law_torque_i ;
  (* hierconn *) wire \u_dut.g_law.u_axes.law_late_i ;
  (* hierconn *) wire \u_dut.g_law.u_axes.law_restart_i ;
  (* hierconn *) wire [31:0] \u_dut.g_law.u_axes.reg_wdata_i ;
  (* hierconn *) wire \u_dut.g_law.u_axes.reg_write_i ;
  (* hierconn *) wire \u_dut.g_law.u_axes.reg_busy_o ;
  (* hierconn *) wire [31:0] \u_dut.g_law.u_axes.reg_rdata_o ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.gate_a_hi_o ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.gate_a_lo_o ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.gate_b_hi_o ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.gate_b_lo_o ;
  (* hierconn *) wire \u_dut.g_law.u_axes.snapshot_valid_o ;
  (* hierconn *) wire \u_dut.g_law.u_axes.word_valid_o ;
  (* hierconn *) wire [5:0] \u_dut.g_law.u_axes.word_slot_o ;
  (* hierconn *) wire [32*A-1:0] \u_dut.g_law.u_axes.word_data_o ;
  (* hierconn *) wire [32*A-1:0] \u_dut.g_law.u_axes.position_o ;
  (* hierconn *) wire [4*A-1:0] \u_dut.g_law.u_axes.scene_o ;
  (* hierconn *) wire [A*map::W_STATUS_LIMITS-1:0] \u_dut.g_law.u_axes.limits_o ;
  (* hierconn *) wire [A*map::W_FAULTS_SEEN-1:0] \u_dut.g_law.u_axes.faults_o ;
  (* hierconn *) wire [A*map::W_FAULTS_FIRST-1:0] \u_dut.g_law.u_axes.first_fault_o ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.armed_o ;
  (* hierconn *) wire [A-1:0] \u_dut.g_law.u_axes.gates_enable_o ;
  (* hierconn *) wire [15:0] \u_dut.g_law.u_axes.reg_addr_i ;
  (* hierconn *) wire \u_dut.g_law.u_axes.reg_read_i ;
  (* hierconn *) wire \u_dut.g_law.u_axes.event_valid_o ;
  (* hierconn *) wire [8:0] \u_dut.g_law.u_axes.event_number_o ;
  wire [A-1:0] core_enc_a_i = \u_dut.g_law.u_axes.enc_a_i ;
  wire [A-1:0] core_enc_b_i = \u_dut.g_law.u_axes.enc_b_i ;
  wire [A-1:0] core_enc_z_i = \u_dut.g_law.u_axes.enc_z_i ;
  wire core_arm_i = \u_dut.g_law.u_axes.arm_i ;
  wire core_stop_i = \u_dut.g_law.u_axes.stop_i ;
  wire [A-1:0] core_set_zero_i = \u_dut.g_law.u_axes.set_zero_i ;
  wire [4*A-1:0] core_scene_i = \u_dut.g_law.u_axes.scene_i ;
  wire [A*cfg::TORQUE_W-1:0] core_law_torque_i = \u_dut.g_law.u_axes.law_torque_i ;
  wire core_law_late_i = \u_dut.g_law.u_axes.law_late_i ;
  wire core_law_restart_i = \u_dut.g_law.u_axes.law_restart_i ;
  wire [31:0] core_reg_wdata_i = \u_dut.g_law.u_axes.reg_wdata_i ;
  wire core_reg_write_i = \u_dut.g_law.u_axes.reg_write_i ;
  wire core_reg_busy_o = \u_dut.g_law.u_axes.reg_busy_o ;
  wire [31:0] core_reg_rdata_o = \u_dut.g_law.u_axes.reg_rdata_o ;
  wire [A-1:0] core_gate_a_hi_o = \u_dut.g_law.u_axes.gate_a_hi_o ;
  wire [A-1:0] core_gate_a_lo_o = \u_dut.g_law.u_axes.gate_a_lo_o ;
  wire [A-1:0] core_gate_b_hi_o = \u_dut.g_law.u_axes.gate_b_hi_o ;
  wire [A-1:0] core_gate_b_lo_o = \u_dut.g_law.u_axes.gate_b_lo_o ;
  wire core_snapshot_valid_o = \u_dut.g_law.u_axes.snapshot_valid_o ;
  wire core_word_valid_o = \u_dut.g_law.u_axes.word_valid_o ;
  wire [5:0] core_word_slot_o = \u_dut.g_law.u_axes.word_slot_o ;
  wire [32*A-1:0] core_word_data_o = \u_dut.g_law.u_axes.word_data_o ;
  wire [32*A-1:0] core_position_o = \u_dut.g_law.u_axes.position_o ;
  wire [4*A-1:0] core_scene_o = \u_dut.g_law.u_axes.scene_o ;
  wire [A*map::W_STATUS_LIMITS-1:0] core_limits_o = \u_dut.g_law.u_axes.limits_o ;
  wire [A*map::W_FAULTS_SEEN-1:0] core_faults_o = \u_dut.g_law.u_axes.faults_o ;
  wire [A*map::W_FAULTS_FIRST-1:0] core_first_fault_o = \u_dut.g_law.u_axes.first_fault_o ;
  wire [A-1:0] core_armed_o = \u_dut.g_law.u_axes.armed_o ;
  wire [A-1:0] core_gates_enable_o = \u_dut.g_law.u_axes.gates_enable_o ;
  wire [15:0] core_reg_addr_i = \u_dut.g_law.u_axes.reg_addr_i ;
  wire core_reg_read_i = \u_dut.g_law.u_axes.reg_read_i ;
  wire core_event_valid_o = \u_dut.g_law.u_axes.event_valid_o ;
  wire [8:0] core_event_number_o = \u_dut.g_law.u_axes.event_number_o ;
  localparam logic [15:0] AddressMask = 16'hffff;
`else
  (* hierconn *) wire \u_dut.g_core.u_core.encoder_data_i ;
  (* hierconn *) wire [cfg::CURRENT_LOOP*(cfg::PHASES-2):0] \u_dut.g_core.u_core.current_data_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.driver_fault_i ;
  (* hierconn *) wire [2:0] \u_dut.g_core.u_core.hall_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.encoder_select_no ;
  (* hierconn *) wire \u_dut.g_core.u_core.encoder_clock_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.encoder_command_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.current_clock_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.heartbeat_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.gate_c_hi_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.gate_c_lo_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.enc_a_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.enc_b_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.enc_z_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.arm_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.stop_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.set_zero_i ;
  (* hierconn *) wire [3:0] \u_dut.g_core.u_core.scene_i ;
  (* hierconn *) wire [cfg::TORQUE_W-1:0] \u_dut.g_core.u_core.law_torque_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.law_late_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.law_restart_i ;
  (* hierconn *) wire [31:0] \u_dut.g_core.u_core.reg_wdata_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.reg_write_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.reg_busy_o ;
  (* hierconn *) wire [31:0] \u_dut.g_core.u_core.reg_rdata_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.gate_a_hi_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.gate_a_lo_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.gate_b_hi_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.gate_b_lo_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.snapshot_valid_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.word_valid_o ;
  (* hierconn *) wire [5:0] \u_dut.g_core.u_core.word_slot_o ;
  (* hierconn *) wire [31:0] \u_dut.g_core.u_core.word_data_o ;
  (* hierconn *) wire [31:0] \u_dut.g_core.u_core.position_o ;
  (* hierconn *) wire [3:0] \u_dut.g_core.u_core.scene_o ;
  (* hierconn *) wire [map::W_STATUS_LIMITS-1:0] \u_dut.g_core.u_core.limits_o ;
  (* hierconn *) wire [map::W_FAULTS_SEEN-1:0] \u_dut.g_core.u_core.faults_o ;
  (* hierconn *) wire [map::W_FAULTS_FIRST-1:0] \u_dut.g_core.u_core.first_fault_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.armed_o ;
  (* hierconn *) wire \u_dut.g_core.u_core.gates_enable_o ;
  (* hierconn *) wire [11:0] \u_dut.g_core.u_core.reg_addr_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.axis_fault_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.axis_silent_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.axis_blocked_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.axis_testing_i ;
  (* hierconn *) wire \u_dut.g_core.u_core.axis_waits_i ;
  wire core_enc_a_i = \u_dut.g_core.u_core.enc_a_i ;
  wire core_enc_b_i = \u_dut.g_core.u_core.enc_b_i ;
  wire core_enc_z_i = \u_dut.g_core.u_core.enc_z_i ;
  wire core_arm_i = \u_dut.g_core.u_core.arm_i ;
  wire core_stop_i = \u_dut.g_core.u_core.stop_i ;
  wire core_set_zero_i = \u_dut.g_core.u_core.set_zero_i ;
  wire [3:0] core_scene_i = \u_dut.g_core.u_core.scene_i ;
  wire [cfg::TORQUE_W-1:0] core_law_torque_i = \u_dut.g_core.u_core.law_torque_i ;
  wire core_law_late_i = \u_dut.g_core.u_core.law_late_i ;
  wire core_law_restart_i = \u_dut.g_core.u_core.law_restart_i ;
  wire [31:0] core_reg_wdata_i = \u_dut.g_core.u_core.reg_wdata_i ;
  wire core_reg_write_i = \u_dut.g_core.u_core.reg_write_i ;
  wire core_reg_busy_o = \u_dut.g_core.u_core.reg_busy_o ;
  wire [31:0] core_reg_rdata_o = \u_dut.g_core.u_core.reg_rdata_o ;
  wire core_gate_a_hi_o = \u_dut.g_core.u_core.gate_a_hi_o ;
  wire core_gate_a_lo_o = \u_dut.g_core.u_core.gate_a_lo_o ;
  wire core_gate_b_hi_o = \u_dut.g_core.u_core.gate_b_hi_o ;
  wire core_gate_b_lo_o = \u_dut.g_core.u_core.gate_b_lo_o ;
  wire core_snapshot_valid_o = \u_dut.g_core.u_core.snapshot_valid_o ;
  wire core_word_valid_o = \u_dut.g_core.u_core.word_valid_o ;
  wire [5:0] core_word_slot_o = \u_dut.g_core.u_core.word_slot_o ;
  wire [31:0] core_word_data_o = \u_dut.g_core.u_core.word_data_o ;
  wire [31:0] core_position_o = \u_dut.g_core.u_core.position_o ;
  wire [3:0] core_scene_o = \u_dut.g_core.u_core.scene_o ;
  wire [map::W_STATUS_LIMITS-1:0] core_limits_o = \u_dut.g_core.u_core.limits_o ;
  wire [map::W_FAULTS_SEEN-1:0] core_faults_o = \u_dut.g_core.u_core.faults_o ;
  wire [map::W_FAULTS_FIRST-1:0] core_first_fault_o = \u_dut.g_core.u_core.first_fault_o ;
  wire core_armed_o = \u_dut.g_core.u_core.armed_o ;
  wire core_gates_enable_o = \u_dut.g_core.u_core.gates_enable_o ;
  wire core_axis_fault_i = \u_dut.g_core.u_core.axis_fault_i ;
  wire core_axis_silent_i = \u_dut.g_core.u_core.axis_silent_i ;
  wire core_axis_blocked_i = \u_dut.g_core.u_core.axis_blocked_i ;
  wire core_axis_testing_i = \u_dut.g_core.u_core.axis_testing_i ;
  wire core_axis_waits_i = \u_dut.g_core.u_core.axis_waits_i ;
  wire [15:0] core_reg_addr_i = {4'd0, \u_dut.g_core.u_core.reg_addr_i };
  wire core_event_valid_o = 1'b0;
  wire [8:0] core_event_number_o = 9'd0;
  localparam logic [15:0] AddressMask = 16'h0fff;  // the core has no more
`endif
  (* hierconn *) wire \u_dut.u_uart_rx.rx_i ;
  (* hierconn *) wire [7:0] \u_dut.u_uart_rx.byte_o ;
  (* hierconn *) wire \u_dut.u_uart_rx.valid_o ;
  (* hierconn *) wire \u_dut.u_uart_rx.error_o ;
  (* hierconn *) wire [7:0] \u_dut.u_link_receiver.byte_i ;
  (* hierconn *) wire \u_dut.u_link_receiver.valid_i ;
  (* hierconn *) wire \u_dut.u_link_receiver.error_i ;
  (* hierconn *) wire \u_dut.u_link_receiver.taken_i ;
  (* hierconn *) wire \u_dut.u_link_receiver.valid_o ;
  (* hierconn *) wire \u_dut.u_link_receiver.write_o ;
  (* hierconn *) wire [7:0] \u_dut.u_link_receiver.sequence_o ;
  (* hierconn *) wire [14+cfg::ENGINE-1:0] \u_dut.u_link_receiver.address_o ;
  (* hierconn *) wire [31:0] \u_dut.u_link_receiver.data_o ;
  (* hierconn *) wire \u_dut.u_link_receiver.good_o ;
  (* hierconn *) wire \u_dut.u_link_receiver.bad_o ;
  (* hierconn *) wire \u_dut.u_link_port.valid_i ;
  (* hierconn *) wire \u_dut.u_link_port.write_i ;
  (* hierconn *) wire [7:0] \u_dut.u_link_port.sequence_i ;
  (* hierconn *) wire [14+cfg::ENGINE-1:0] \u_dut.u_link_port.address_i ;
  (* hierconn *) wire [31:0] \u_dut.u_link_port.data_i ;
  (* hierconn *) wire \u_dut.u_link_port.good_i ;
  (* hierconn *) wire \u_dut.u_link_port.bad_i ;
  (* hierconn *) wire \u_dut.u_link_port.taken_o ;
  (* hierconn *) wire \u_dut.u_link_port.clear_faults_i ;
  (* hierconn *) wire [7:0] \u_dut.u_link_port.inputs_i ;
  (* hierconn *) wire \u_dut.u_link_port.tick_i ;
  (* hierconn *) wire [15:0] \u_dut.u_link_port.reg_addr_o ;
  (* hierconn *) wire [31:0] \u_dut.u_link_port.reg_wdata_o ;
  (* hierconn *) wire \u_dut.u_link_port.reg_write_o ;
  (* hierconn *) wire \u_dut.u_link_port.reg_busy_i ;
  (* hierconn *) wire [31:0] \u_dut.u_link_port.reg_rdata_i ;
  (* hierconn *) wire [15:0] \u_dut.u_link_port.addr_o ;
  (* hierconn *) wire [31:0] \u_dut.u_link_port.wdata_o ;
  (* hierconn *) wire \u_dut.u_link_port.write_o ;
  (* hierconn *) wire [31:0] \u_dut.u_link_port.rdata_i ;
  (* hierconn *) wire \u_dut.u_link_port.valid_o ;
  (* hierconn *) wire [7:0] \u_dut.u_link_port.byte_o ;
  (* hierconn *) wire \u_dut.u_link_port.last_o ;
  (* hierconn *) wire \u_dut.u_link_port.ready_i ;
  (* hierconn *) wire \u_dut.u_link_stream.word_valid_i ;
  (* hierconn *) wire [5:0] \u_dut.u_link_stream.word_slot_i ;
  (* hierconn *) wire [31:0] \u_dut.u_link_stream.word_data_i ;
  (* hierconn *) wire [15:0] \u_dut.u_link_stream.addr_i ;
  (* hierconn *) wire [31:0] \u_dut.u_link_stream.wdata_i ;
  (* hierconn *) wire \u_dut.u_link_stream.write_i ;
  (* hierconn *) wire [31:0] \u_dut.u_link_stream.rdata_o ;
  (* hierconn *) wire \u_dut.u_link_stream.valid_o ;
  (* hierconn *) wire [7:0] \u_dut.u_link_stream.byte_o ;
  (* hierconn *) wire \u_dut.u_link_stream.last_o ;
  (* hierconn *) wire \u_dut.u_link_stream.ready_i ;
  (* hierconn *) wire \u_dut.u_link_capture.word_valid_i ;
  (* hierconn *) wire [5:0] \u_dut.u_link_capture.word_slot_i ;
  (* hierconn *) wire [31:0] \u_dut.u_link_capture.word_data_i ;
  (* hierconn *) wire \u_dut.u_link_capture.event_valid_i ;
  (* hierconn *) wire [8:0] \u_dut.u_link_capture.event_number_i ;
  (* hierconn *) wire [15:0] \u_dut.u_link_capture.addr_i ;
  (* hierconn *) wire [31:0] \u_dut.u_link_capture.wdata_i ;
  (* hierconn *) wire \u_dut.u_link_capture.write_i ;
  (* hierconn *) wire [31:0] \u_dut.u_link_capture.rdata_o ;
  (* hierconn *) wire \u_dut.u_link_transmitter.reply_valid_i ;
  (* hierconn *) wire [7:0] \u_dut.u_link_transmitter.reply_byte_i ;
  (* hierconn *) wire \u_dut.u_link_transmitter.reply_last_i ;
  (* hierconn *) wire \u_dut.u_link_transmitter.reply_ready_o ;
  (* hierconn *) wire \u_dut.u_link_transmitter.stream_valid_i ;
  (* hierconn *) wire [7:0] \u_dut.u_link_transmitter.stream_byte_i ;
  (* hierconn *) wire \u_dut.u_link_transmitter.stream_last_i ;
  (* hierconn *) wire \u_dut.u_link_transmitter.stream_ready_o ;
  (* hierconn *) wire \u_dut.u_link_transmitter.valid_o ;
  (* hierconn *) wire [7:0] \u_dut.u_link_transmitter.byte_o ;
  (* hierconn *) wire \u_dut.u_link_transmitter.ready_i ;
  (* hierconn *) wire [7:0] \u_dut.u_uart_tx.byte_i ;
  (* hierconn *) wire \u_dut.u_uart_tx.valid_i ;
  (* hierconn *) wire \u_dut.u_uart_tx.ready_o ;
  (* hierconn *) wire \u_dut.u_uart_tx.tx_o ;

  wire [38:0] stream_word = {\u_dut.u_link_stream.word_valid_i , \u_dut.u_link_stream.word_slot_i , \u_dut.u_link_stream.word_data_i };
  wire [38:0] capture_word = {\u_dut.u_link_capture.word_valid_i , \u_dut.u_link_capture.word_slot_i , \u_dut.u_link_capture.word_data_i };
  wire [9:0] capture_event = {\u_dut.u_link_capture.event_valid_i , \u_dut.u_link_capture.event_number_i };
  wire [48:0] link_write = {\u_dut.u_link_port.addr_o , \u_dut.u_link_port.wdata_o , \u_dut.u_link_port.write_o };
`ifdef VIEW
  (* hierconn *) wire \u_dut.g_view.u_link_view.word_valid_i ;
  (* hierconn *) wire [5:0] \u_dut.g_view.u_link_view.word_slot_i ;
  (* hierconn *) wire [32*A-1:0] \u_dut.g_view.u_link_view.word_data_i ;
  (* hierconn *) wire \u_dut.g_view.u_link_view.event_valid_i ;
  (* hierconn *) wire [8:0] \u_dut.g_view.u_link_view.event_number_i ;
  (* hierconn *) wire [15:0] \u_dut.g_view.u_link_view.addr_i ;
  (* hierconn *) wire [31:0] \u_dut.g_view.u_link_view.wdata_i ;
  (* hierconn *) wire \u_dut.g_view.u_link_view.write_i ;
  (* hierconn *) wire [31:0] \u_dut.g_view.u_link_view.rdata_o ;
  (* hierconn *) wire \u_dut.g_view.u_link_view.word_valid_o ;
  (* hierconn *) wire [5:0] \u_dut.g_view.u_link_view.word_slot_o ;
  (* hierconn *) wire [31:0] \u_dut.g_view.u_link_view.word_data_o ;
  (* hierconn *) wire \u_dut.g_view.u_link_view.event_valid_o ;
  (* hierconn *) wire [8:0] \u_dut.g_view.u_link_view.event_number_o ;
  wire [6+32*A:0] seen = {\u_dut.g_view.u_link_view.word_valid_i , \u_dut.g_view.u_link_view.word_slot_i , \u_dut.g_view.u_link_view.word_data_i };
  wire [9:0] seen_event = {\u_dut.g_view.u_link_view.event_valid_i , \u_dut.g_view.u_link_view.event_number_i };
  wire [48:0] view_write = {\u_dut.g_view.u_link_view.addr_i , \u_dut.g_view.u_link_view.wdata_i , \u_dut.g_view.u_link_view.write_i };
  wire [31:0] view_rdata = \u_dut.g_view.u_link_view.rdata_o ;
  wire [38:0] shown = {\u_dut.g_view.u_link_view.word_valid_o , \u_dut.g_view.u_link_view.word_slot_o , \u_dut.g_view.u_link_view.word_data_o };
  wire [9:0] shown_event = {\u_dut.g_view.u_link_view.event_valid_o , \u_dut.g_view.u_link_view.event_number_o };
`else
  wire [38:0] seen = stream_word;
  wire [9:0] seen_event = capture_event;
  wire [48:0] view_write = link_write;
  wire [31:0] view_rdata = 32'd0;
  wire [38:0] shown = {core_word_valid_o, core_word_slot_o, core_word_data_o};
  wire [9:0] shown_event = {core_event_valid_o, core_event_number_o};
`endif

  always_comb begin
    if (past_ok_q) begin
      gates_are_the_cores: assert ({a_hi, a_lo, b_hi, b_lo} == {core_gate_a_hi_o, core_gate_a_lo_o, core_gate_b_hi_o, core_gate_b_lo_o});
      stop_and_panel_pass: assert ({core_stop_i, core_arm_i, core_set_zero_i, core_scene_i} == {stop_i, arm_i, set_zero_i, scene_i});
      encoder_passes: assert ({core_enc_a_i, core_enc_b_i, core_enc_z_i} == {enc_a_i, enc_b_i, enc_z_i});
`ifdef LAW
      options_pass: assert ({current_clock, heartbeat} == 2'b00 &&
          (cfg::ABSOLUTE_ENCODER == 0 ? {select_n, serial_clock, command} == 3'b100 :
           {select_n, serial_clock, command, encoder_data_i} == {\u_dut.g_law.u_axes.encoder_select_no [0], \u_dut.g_law.u_axes.encoder_clock_o [0],
            \u_dut.g_law.u_axes.encoder_command_o [0], \u_dut.g_law.u_axes.encoder_data_i [0]}) &&
          (cfg::PHASES != 3 ? {c_hi, c_lo} == 2'b00 :
           {c_hi, c_lo} == {\u_dut.g_law.u_axes.gate_c_hi_o [0], \u_dut.g_law.u_axes.gate_c_lo_o [0]}));
`else
      options_pass: assert ({\u_dut.g_core.u_core.encoder_data_i , \u_dut.g_core.u_core.current_data_i , \u_dut.g_core.u_core.driver_fault_i , \u_dut.g_core.u_core.hall_i } ==
          {encoder_data_i, current_data_i, driver_fault_i, hall_i} && {select_n, serial_clock, command, current_clock, heartbeat, c_hi, c_lo} ==
          {\u_dut.g_core.u_core.encoder_select_no , \u_dut.g_core.u_core.encoder_clock_o , \u_dut.g_core.u_core.encoder_command_o ,
           \u_dut.g_core.u_core.current_clock_o , \u_dut.g_core.u_core.heartbeat_o , \u_dut.g_core.u_core.gate_c_hi_o ,
           \u_dut.g_core.u_core.gate_c_lo_o });
`endif
      lamps_pass: assert ({position, scene, limits, faults} == {core_position_o, core_scene_o, core_limits_o, core_faults_o} &&
          {first_fault, armed, gates_enable, snapshot_valid} == {core_first_fault_o, core_armed_o, core_gates_enable_o, core_snapshot_valid_o});
      host_writes: assert ({core_reg_write_i, core_reg_wdata_i} == {\u_dut.u_link_port.reg_write_o , \u_dut.u_link_port.reg_wdata_o });
      host_reads: assert ({\u_dut.u_link_port.reg_busy_i , \u_dut.u_link_port.reg_rdata_i } == {core_reg_busy_o, core_reg_rdata_o});
      request_from_the_wire: assert (\u_dut.u_uart_rx.rx_i  == uart_rx_i &&
          {\u_dut.u_link_receiver.byte_i , \u_dut.u_link_receiver.valid_i , \u_dut.u_link_receiver.error_i } == {\u_dut.u_uart_rx.byte_o , \u_dut.u_uart_rx.valid_o , \u_dut.u_uart_rx.error_o });
      request_to_the_port: assert ({\u_dut.u_link_port.valid_i , \u_dut.u_link_port.write_i , \u_dut.u_link_port.sequence_i , \u_dut.u_link_port.address_i , \u_dut.u_link_port.data_i , \u_dut.u_link_port.good_i , \u_dut.u_link_port.bad_i } == {\u_dut.u_link_receiver.valid_o , \u_dut.u_link_receiver.write_o , \u_dut.u_link_receiver.sequence_o , \u_dut.u_link_receiver.address_o , \u_dut.u_link_receiver.data_o , \u_dut.u_link_receiver.good_o , \u_dut.u_link_receiver.bad_o } &&
          \u_dut.u_link_receiver.taken_i  == \u_dut.u_link_port.taken_o );
      board_to_the_port: assert ({\u_dut.u_link_port.clear_faults_i , \u_dut.u_link_port.inputs_i , \u_dut.u_link_port.tick_i } == {clear_faults_i, inputs_i, core_snapshot_valid_o});
      words_of_all_axes: assert (seen == {core_word_valid_o, core_word_slot_o, core_word_data_o});
      words_to_the_link: assert (stream_word == shown && capture_word == shown);
      writes_to_the_link: assert (view_write == link_write &&
          {\u_dut.u_link_stream.addr_i , \u_dut.u_link_stream.wdata_i , \u_dut.u_link_stream.write_i } == link_write &&
          {\u_dut.u_link_capture.addr_i , \u_dut.u_link_capture.wdata_i , \u_dut.u_link_capture.write_i } == link_write);
      reads_of_the_link: assert (\u_dut.u_link_port.rdata_i  == (\u_dut.u_link_stream.rdata_o | \u_dut.u_link_capture.rdata_o  | view_rdata));
      frames_to_the_wire: assert ({\u_dut.u_link_transmitter.reply_valid_i , \u_dut.u_link_transmitter.reply_byte_i , \u_dut.u_link_transmitter.reply_last_i } == {\u_dut.u_link_port.valid_o , \u_dut.u_link_port.byte_o , \u_dut.u_link_port.last_o } &&
          {\u_dut.u_link_transmitter.stream_valid_i , \u_dut.u_link_transmitter.stream_byte_i , \u_dut.u_link_transmitter.stream_last_i } == {\u_dut.u_link_stream.valid_o , \u_dut.u_link_stream.byte_o , \u_dut.u_link_stream.last_o } &&
          {\u_dut.u_link_port.ready_i , \u_dut.u_link_stream.ready_i } == {\u_dut.u_link_transmitter.reply_ready_o , \u_dut.u_link_transmitter.stream_ready_o } &&
          {\u_dut.u_uart_tx.valid_i , \u_dut.u_uart_tx.byte_i , \u_dut.u_link_transmitter.ready_i } == {\u_dut.u_link_transmitter.valid_o , \u_dut.u_link_transmitter.byte_o , \u_dut.u_uart_tx.ready_o } &&
          tx == \u_dut.u_uart_tx.tx_o );
      all_addresses: assert (core_reg_addr_i == (\u_dut.u_link_port.reg_addr_o & AddressMask));
`ifdef LAW
      nothing_from_elsewhere: assert ({core_law_torque_i, core_law_late_i, core_law_restart_i} == '0);
      events_to_the_host: assert (seen_event == {core_event_valid_o, core_event_number_o} && capture_event == shown_event &&
          core_reg_read_i == (core_reg_write_i && !core_reg_busy_o));
`else
      nothing_from_elsewhere: assert ({core_law_torque_i, core_law_late_i, core_law_restart_i, core_axis_fault_i,
          core_axis_silent_i, core_axis_blocked_i, core_axis_testing_i, core_axis_waits_i} == '0);
      events_to_the_host: assert (seen_event == 10'd0 && capture_event == 10'd0);
`endif
      writes: cover (core_reg_write_i && core_reg_busy_o);
      answers: cover (\u_dut.u_link_transmitter.reply_valid_i && \u_dut.u_link_transmitter.stream_valid_i );
    end
  end
endmodule

`default_nettype wire
