// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core with the link to its host: encoder and UART in, gates and UART out. A board's top level
// instantiates it. It contains feltgate_core, or feltgate_axes if the design has an engine or more
// than one axis. In each vector, axis n is bit n, or the n-th part from below.
// Documentation: docs/link.md, docs/link.md
`default_nettype none

module feltgate_linked #(
    parameter int AxisCount = feltgate_pkg::AXES,
    parameter int ClockHz = feltgate_pkg::CLOCK_HZ,
    parameter int Baud = feltgate_link_pkg::BAUD,
    parameter int Simulated = 0,
    parameter int Board = 0,       // number of the board: docs/registers.md
    parameter ParameterFile = "",  // as in feltgate_core
    // As in axes_engine; not used if the design has no engine.
    /* verilator lint_off UNUSEDPARAM */
    parameter ProgramContent = "",
    parameter DataContent = "",
    parameter TableContent = "",
    parameter logic [feltgate_engine_pkg::RESET_BITS-1:0] Reset = feltgate_engine_pkg::RESET_EMPTY
    /* verilator lint_on UNUSEDPARAM */
) (
    input  logic clk_i,
    input  logic rst_ni,

    // Encoder, motor
    input  logic [AxisCount-1:0] enc_a_i,
    input  logic [AxisCount-1:0] enc_b_i,
    input  logic [AxisCount-1:0] enc_z_i,
    output logic [AxisCount-1:0] gate_a_hi_o,
    output logic [AxisCount-1:0] gate_a_lo_o,
    output logic [AxisCount-1:0] gate_b_hi_o,
    output logic [AxisCount-1:0] gate_b_lo_o,
    output logic gate_c_hi_o,  // of a bridge with three phases; else 0
    output logic gate_c_lo_o,

    // Sensors and driver of a design with that option, as in feltgate_core; without it the inputs are not used
    input  logic encoder_data_i,
    output logic encoder_select_no,
    output logic encoder_clock_o,
    output logic encoder_command_o,
    input  logic [feltgate_pkg::CURRENT_LOOP*(feltgate_pkg::PHASES-2):0] current_data_i,
    output logic current_clock_o,
    input  logic driver_fault_i,
    output logic heartbeat_o,
    input  logic [2:0] hall_i,

    // Panel
    input  logic       arm_i,
    input  logic       stop_i,
    input  logic [AxisCount-1:0] set_zero_i,  // one clock
    input  logic       clear_faults_i,  // one clock; of all axes
    input  logic [4*AxisCount-1:0] scene_i,

    // Host
    input  logic       uart_rx_i,
    output logic       uart_tx_o,
    input  logic [7:0] inputs_i,  // state of the board for the host; synchronous

    // State, for lamps
    output logic [AxisCount*32-1:0]                                position_o,
    output logic [AxisCount*feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits_o,
    output logic [AxisCount*feltgate_map_pkg::W_FAULTS_SEEN-1:0]   faults_o,
    output logic [AxisCount*feltgate_map_pkg::W_FAULTS_FIRST-1:0]  first_fault_o,
    output logic [AxisCount*4-1:0]                                 scene_o,
    output logic [AxisCount-1:0]                                   armed_o,
    output logic [AxisCount-1:0]                                   gates_enable_o,
    output logic                                                   snapshot_valid_o
);
  localparam int FEATURES = (1 << feltgate_link_pkg::B_FEATURES_CAPTURE) |
                            (1 << feltgate_link_pkg::B_FEATURES_STREAM) |
                            (feltgate_pkg::ENGINE << feltgate_link_pkg::B_FEATURES_ENGINE) |
                            (feltgate_link_pkg::ROWS_LOG2 << feltgate_link_pkg::B_FEATURES_ROWS_LOG2) |
                            (feltgate_link_pkg::COLUMNS << feltgate_link_pkg::B_FEATURES_COLUMNS);

  logic [15:0] reg_addr;
  logic [31:0] reg_wdata, reg_rdata;
  logic        reg_write, reg_busy;
  logic        word_valid;
  logic [ 5:0] word_slot;
  logic [AxisCount*32-1:0] word_data;
  logic        event_valid;
  logic [ 8:0] event_number;

  /* verilator lint_off PINCONNECTEMPTY */  // the host reads these as words
  generate
  if (feltgate_pkg::ENGINE != 0 || AxisCount > 1) begin : g_law
    logic [AxisCount-1:0] leg_c_hi, leg_c_lo, select_n, serial_clock, command;
    // A repeated read must change nothing, so a write to the event's last word removes the event.
    feltgate_axes #(
        .AxisCount(AxisCount), .Engine(feltgate_pkg::ENGINE), .ReadBack(1), .ParameterFile(ParameterFile),
        .ProgramContent(ProgramContent), .DataContent(DataContent), .TableContent(TableContent), .Reset(Reset)
    ) u_axes (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i),
        .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o),
        .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
        .arm_i(arm_i), .stop_i(stop_i), .set_zero_i(set_zero_i), .scene_i(scene_i),
        .law_torque_i({(AxisCount*feltgate_pkg::TORQUE_W){1'b0}}), .law_late_i(1'b0), .law_restart_i(1'b0),
        .measured_o(), .zeroed_o(),
        .reg_addr_i(reg_addr), .reg_wdata_i(reg_wdata), .reg_write_i(reg_write),
        .reg_read_i(reg_write && !reg_busy),
        .reg_busy_o(reg_busy), .reg_rdata_o(reg_rdata),
        .event_valid_o(event_valid), .event_number_o(event_number), .event_value_o(),
        .gate_c_hi_o(leg_c_hi), .gate_c_lo_o(leg_c_lo), .encoder_data_i(AxisCount'(encoder_data_i)),
        .encoder_select_no(select_n), .encoder_clock_o(serial_clock), .encoder_command_o(command),
        .snapshot_valid_o(snapshot_valid_o),
        .tick_count_o(), .velocity_o(), .tau_hat_o(), .tau_ref_o(),
        .current_ref_o(), .voltage_o(), .duty_o(), .duty_active_o(),
        .word_valid_o(word_valid), .word_slot_o(word_slot), .word_data_o(word_data),
        .position_o(position_o), .scene_o(scene_o), .limits_o(limits_o),
        .faults_o(faults_o), .first_fault_o(first_fault_o),
        .armed_o(armed_o), .gates_enable_o(gates_enable_o)
    );
    // Of one axis. The generator refuses these options of several, and a current loop or Hall lines beside an engine.
    assign gate_c_hi_o       = feltgate_pkg::PHASES == 3 && leg_c_hi[0];
    assign gate_c_lo_o       = feltgate_pkg::PHASES == 3 && leg_c_lo[0];
    assign encoder_select_no = feltgate_pkg::ABSOLUTE_ENCODER == 0 || select_n[0];
    assign encoder_clock_o   = feltgate_pkg::ABSOLUTE_ENCODER != 0 && serial_clock[0];
    assign encoder_command_o = feltgate_pkg::ABSOLUTE_ENCODER != 0 && command[0];
    assign current_clock_o   = 1'b0;
    assign heartbeat_o       = 1'b0;
    logic unused;
    assign unused = ^{leg_c_hi, leg_c_lo, select_n, serial_clock, command, current_data_i, driver_fault_i, hall_i};
  end else begin : g_core
    feltgate_core #(.ReadBack(1), .ParameterFile(ParameterFile)) u_core (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .enc_a_i(enc_a_i), .enc_b_i(enc_b_i), .enc_z_i(enc_z_i),
        .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o),
        .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
        .encoder_data_i(encoder_data_i), .encoder_select_no(encoder_select_no),
        .encoder_clock_o(encoder_clock_o), .encoder_command_o(encoder_command_o),
        .current_data_i(current_data_i), .current_clock_o(current_clock_o), .current_o(),
        .driver_fault_i(driver_fault_i), .heartbeat_o(heartbeat_o),
        .arm_i(arm_i), .stop_i(stop_i), .set_zero_i(set_zero_i), .scene_i(scene_i),
        .gate_c_hi_o(gate_c_hi_o), .gate_c_lo_o(gate_c_lo_o),
        .law_torque_i({feltgate_pkg::TORQUE_W{1'b0}}), .law_late_i(1'b0), .law_restart_i(1'b0),
        .axis_fault_i(1'b0), .axis_silent_i(1'b0), .axis_blocked_i(1'b0), .axis_testing_i(1'b0), .axis_waits_i(1'b0),
        .hall_i(hall_i),
        .arm_request_o(), .ready_o(), .testing_o(), .measured_o(), .zeroed_o(),
        .reg_addr_i(reg_addr[11:0]), .reg_wdata_i(reg_wdata), .reg_write_i(reg_write),
        .reg_busy_o(reg_busy), .reg_rdata_o(reg_rdata),
        .snapshot_valid_o(snapshot_valid_o),
        .tick_count_o(), .velocity_o(), .tau_hat_o(), .tau_ref_o(),
        .current_ref_o(), .voltage_o(), .duty_o(), .duty_active_o(),
        .word_valid_o(word_valid), .word_slot_o(word_slot), .word_data_o(word_data),
        .position_o(position_o), .scene_o(scene_o), .limits_o(limits_o),
        .faults_o(faults_o), .first_fault_o(first_fault_o),
        .armed_o(armed_o), .gates_enable_o(gates_enable_o)
    );
    assign event_valid  = 1'b0;
    assign event_number = '0;
    logic unused;
    assign unused = ^reg_addr[15:12];
  end
  endgenerate
  /* verilator lint_on PINCONNECTEMPTY */

  logic [7:0] rx_byte;
  logic       rx_valid, rx_error;
  uart_rx #(.ClockHz(ClockHz), .Baud(Baud)) u_uart_rx (
      .clk_i(clk_i), .rst_ni(rst_ni), .rx_i(uart_rx_i),
      .byte_o(rx_byte), .valid_o(rx_valid), .error_o(rx_error)
  );

  logic        request_valid, request_write, request_taken, good, bad;
  logic [ 7:0] request_sequence;
  logic [13+feltgate_pkg::ENGINE:0] request_address;
  logic [31:0] request_data;
  link_receiver u_link_receiver (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .byte_i(rx_byte), .valid_i(rx_valid), .error_i(rx_error),
      .taken_i(request_taken),
      .valid_o(request_valid), .write_o(request_write), .sequence_o(request_sequence),
      .address_o(request_address), .data_o(request_data),
      .good_o(good), .bad_o(bad)
  );

  logic [15:0] link_addr;
  logic [31:0] link_wdata, link_rdata;
  logic        link_write;
  logic [ 7:0] reply_byte;
  logic        reply_valid, reply_last, reply_ready;
  link_port #(.Simulated(Simulated), .Board(Board), .Features(FEATURES), .Axes(AxisCount)) u_link_port (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .valid_i(request_valid), .write_i(request_write), .sequence_i(request_sequence),
      .address_i(request_address), .data_i(request_data), .good_i(good), .bad_i(bad),
      .taken_o(request_taken),
      .clear_faults_i(clear_faults_i), .inputs_i(inputs_i), .tick_i(snapshot_valid_o),
      .reg_addr_o(reg_addr), .reg_wdata_o(reg_wdata), .reg_write_o(reg_write),
      .reg_busy_i(reg_busy), .reg_rdata_i(reg_rdata),
      .addr_o(link_addr), .wdata_o(link_wdata), .write_o(link_write), .rdata_i(link_rdata),
      .valid_o(reply_valid), .byte_o(reply_byte), .last_o(reply_last), .ready_i(reply_ready)
  );

  // Stream and capture take the words of one axis as they come, those of several from the view.
  logic        view_valid, view_event_valid;
  logic [ 5:0] view_slot;
  logic [31:0] view_data, view_rdata;
  logic [ 8:0] view_event_number;
  generate
  if (AxisCount > 1) begin : g_view
    link_view #(.AxisCount(AxisCount)) u_link_view (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .word_valid_i(word_valid), .word_slot_i(word_slot), .word_data_i(word_data),
        .event_valid_i(event_valid), .event_number_i(event_number),
        .addr_i(link_addr), .wdata_i(link_wdata), .write_i(link_write), .rdata_o(view_rdata),
        .word_valid_o(view_valid), .word_slot_o(view_slot), .word_data_o(view_data),
        .event_valid_o(view_event_valid), .event_number_o(view_event_number)
    );
  end else begin : g_no_view
    assign view_valid        = word_valid;
    assign view_slot         = word_slot;
    assign view_data         = word_data;
    assign view_event_valid  = event_valid;
    assign view_event_number = event_number;
    assign view_rdata        = 32'd0;
  end
  endgenerate

  logic [31:0] stream_rdata, capture_rdata;
  assign link_rdata = stream_rdata | capture_rdata | view_rdata;
  logic [7:0] stream_byte;
  logic       stream_valid, stream_last, stream_ready;
  link_stream u_link_stream (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .word_valid_i(view_valid), .word_slot_i(view_slot), .word_data_i(view_data),
      .addr_i(link_addr), .wdata_i(link_wdata), .write_i(link_write), .rdata_o(stream_rdata),
      .valid_o(stream_valid), .byte_o(stream_byte), .last_o(stream_last), .ready_i(stream_ready)
  );
  link_capture u_link_capture (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .word_valid_i(view_valid), .word_slot_i(view_slot), .word_data_i(view_data),
      .event_valid_i(view_event_valid), .event_number_i(view_event_number),
      .addr_i(link_addr), .wdata_i(link_wdata), .write_i(link_write), .rdata_o(capture_rdata)
  );

  logic [7:0] tx_byte;
  logic       tx_valid, tx_ready;
  link_transmitter u_link_transmitter (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .reply_valid_i(reply_valid), .reply_byte_i(reply_byte), .reply_last_i(reply_last),
      .reply_ready_o(reply_ready),
      .stream_valid_i(stream_valid), .stream_byte_i(stream_byte), .stream_last_i(stream_last),
      .stream_ready_o(stream_ready),
      .valid_o(tx_valid), .byte_o(tx_byte), .ready_i(tx_ready)
  );
  uart_tx #(.ClockHz(ClockHz), .Baud(Baud)) u_uart_tx (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .byte_i(tx_byte), .valid_i(tx_valid), .ready_o(tx_ready), .tx_o(uart_tx_o)
  );
endmodule

`default_nettype wire
