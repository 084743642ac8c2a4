// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A device with the link to its host: encoder and UART in, gates and UART out. The device is a top of
// rtl/tops, which rtl/tops/device.svh names, in feltgate_axes. In each vector, axis n is bit n, or the
// n-th part from below. docs/link.md

`default_nettype none
`include "device.svh"

module feltgate_linked #(
    parameter int AxisCount = cfg::AXES,
    parameter int ClockHz = cfg::CLOCK_HZ,
    parameter int Baud = feltgate_link_pkg::BAUD,
    parameter int Simulated = 0,
    parameter int Board = 0,       // number of the board: docs/registers.md
    parameter ParameterFile = "",  // as in axis
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
    `PINS(logic [AxisCount-1:0]),

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
    output logic [AxisCount*32-1:0] position_o,
    output logic [AxisCount*12-1:0] limits_o,
    output logic [AxisCount*16-1:0] faults_o,
    output logic [ AxisCount*5-1:0] first_fault_o,
    output logic [ AxisCount*4-1:0] scene_o,
    output logic [   AxisCount-1:0] armed_o,
    output logic [   AxisCount-1:0] gates_enable_o,
    output logic                    snapshot_valid_o  // all belong to one tick
);
  localparam int FEATURES = (1 << feltgate_link_pkg::B_FEATURES_CAPTURE) |
                            (1 << feltgate_link_pkg::B_FEATURES_STREAM) |
                            (cfg::ENGINE << feltgate_link_pkg::B_FEATURES_ENGINE) |
                            (feltgate_link_pkg::ROWS_LOG2 << feltgate_link_pkg::B_FEATURES_ROWS_LOG2) |
                            (feltgate_link_pkg::COLUMNS << feltgate_link_pkg::B_FEATURES_COLUMNS);

  logic [15:0] reg_addr;
  logic [31:0] reg_wdata, reg_rdata;
  logic        reg_write, reg_busy;
  logic [   AxisCount-1:0] word_valid;
  logic [ 6*AxisCount-1:0] word_place;
  logic [32*AxisCount-1:0] word_data;
  logic        last, event_valid;
  logic [ 8:0] event_number;

  // A repeated read must change nothing, so a write to the event's last word removes the event.
  /* verilator lint_off PINCONNECTEMPTY */  // the host reads these as words
  feltgate_axes #(
      .AxisCount(AxisCount), .ParameterFile(ParameterFile),
      .ProgramContent(ProgramContent), .DataContent(DataContent), .TableContent(TableContent), .Reset(Reset)
  ) u_axes (
      .law_torque_i({(AxisCount*cfg::TORQUE_W){1'b0}}), .law_late_i(1'b0), .law_restart_i(1'b0),
      .measured_o(), .last_o(last), .zeroed_o(),
      .reg_addr_i(reg_addr), .reg_wdata_i(reg_wdata), .reg_write_i(reg_write),
      .reg_read_i(reg_write && !reg_busy), .reg_busy_o(reg_busy), .reg_rdata_o(reg_rdata),
      .event_valid_o(event_valid), .event_number_o(event_number), .event_value_o(),
      .tick_count_o(), .velocity_o(), .tau_hat_o(), .tau_ref_o(),
      .current_ref_o(), .voltage_o(), .duty_o(), .duty_active_o(),
      .word_valid_o(word_valid), .word_slot_o(word_place), .word_data_o(word_data),
      .*  // clock, reset, pins, panel, state
  );
  /* verilator lint_on PINCONNECTEMPTY */

  // The snapshot's words by number.
  function automatic logic [3:0] number_of(input logic [5:0] place);
    case (place)
      map::S_STATUS:      number_of = 4'(feltgate_link_pkg::N_STATUS);
      map::S_POSITION:    number_of = 4'(feltgate_link_pkg::N_POSITION);
      map::S_TICK:        number_of = 4'(feltgate_link_pkg::N_TICK);
      map::S_VELOCITY:    number_of = 4'(feltgate_link_pkg::N_VELOCITY);
      map::S_INDEX:       number_of = 4'(feltgate_link_pkg::N_INDEX);
      map::S_ENCODER:     number_of = 4'(feltgate_link_pkg::N_ENCODER);
      map::S_TAU_HAT:     number_of = 4'(feltgate_link_pkg::N_TAU_HAT);
      map::S_FAULTS:      number_of = 4'(feltgate_link_pkg::N_FAULTS);
      map::S_TAU_REF:     number_of = 4'(feltgate_link_pkg::N_TAU_REF);
      map::S_CURRENT_REF: number_of = 4'(feltgate_link_pkg::N_CURRENT_REF);
      map::S_VOLTAGE:     number_of = 4'(feltgate_link_pkg::N_VOLTAGE);
      default:            number_of = 4'(feltgate_link_pkg::N_DUTY);
    endcase
  endfunction
  logic [4*AxisCount-1:0] word_number;
  always_comb begin
    for (int n = 0; n < AxisCount; n++) word_number[4*n+:4] = number_of(word_place[6*n+:6]);
  end

  logic [7:0] rx_byte;
  logic       rx_valid, rx_error;
  uart_rx #(.ClockHz(ClockHz), .Baud(Baud)) u_uart_rx (
      .clk_i(clk_i), .rst_ni(rst_ni), .rx_i(uart_rx_i),
      .byte_o(rx_byte), .valid_o(rx_valid), .error_o(rx_error)
  );

  logic        request_valid, request_write, request_taken, good, bad;
  logic [ 7:0] request_sequence;
  logic [13+cfg::ENGINE:0] request_address;
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
  logic [ 3:0] view_number;
  logic [31:0] view_data, view_rdata;
  logic [ 8:0] view_event_number;
  generate
  if (AxisCount > 1) begin : g_view
    link_view #(.AxisCount(AxisCount)) u_link_view (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .word_valid_i(word_valid), .word_number_i(word_number), .word_data_i(word_data), .last_i(last),
        .event_valid_i(event_valid), .event_number_i(event_number),
        .addr_i(link_addr), .wdata_i(link_wdata), .write_i(link_write), .rdata_o(view_rdata),
        .word_valid_o(view_valid), .word_number_o(view_number), .word_data_o(view_data),
        .event_valid_o(view_event_valid), .event_number_o(view_event_number)
    );
  end else begin : g_no_view
    assign view_valid        = word_valid;
    assign view_number       = word_number;
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
      .word_valid_i(view_valid), .word_number_i(view_number), .word_data_i(view_data),
      .addr_i(link_addr), .wdata_i(link_wdata), .write_i(link_write), .rdata_o(stream_rdata),
      .valid_o(stream_valid), .byte_o(stream_byte), .last_o(stream_last), .ready_i(stream_ready)
  );
  link_capture u_link_capture (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .word_valid_i(view_valid), .word_number_i(view_number), .word_data_i(view_data),
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
