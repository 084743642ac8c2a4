// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What is the same on every board: reset, panel, and the device with its link. A board's own top, of
// which this is all but clock, pins and polarities, instantiates it. docs/boards/panel.md

`default_nettype none
`include "device.svh"

module board #(
  parameter int Board           = 0,         // its number: docs/registers.md
  parameter int DebounceBits    = 19,        // an input counts after 2^19 stable clocks: 10.5 ms at 50 MHz
  parameter int LoopBits        = 10,        // the connector's loop after 2^10 stable clocks: 20 us
  parameter int LongPressClocks = cfg::CLOCK_HZ,  // the key held this long sets the zero: 1 s
  parameter int LampBits        = 22,        // a limit's lamp stays lit 2^22 clocks: 84 ms
  parameter int HeartbeatBits   = 26,        // lamp 7: 0.75 Hz
  parameter int EncoderLoop     = 1,         // 0: loop_ni is not wired
  parameter int Baud            = feltgate_link_pkg::BAUD,  // of the host's UART
  /* verilator lint_off UNUSEDPARAM */  // without a pin of a driver
  parameter int DriverFaultLow  = 0,         // 1: the pin of the bridge's driver is low at a fault
  /* verilator lint_on UNUSEDPARAM */
  parameter     ParameterFile   = ""         // parameters.mem of this very design; "": the package has the values
) (
  input  logic       clk_i,
  input  logic       reset_ni,   // asynchronous, as all inputs below; synchronised inside
  input  logic       key_i,      // high while pressed
  input  logic [3:0] switches_i,
  input  logic       loop_ni,    // low while the encoder's connector is plugged in
  input  logic       estop_i,    // high stops, needs no clock
  output logic [7:0] lamps_o,
  input  logic       uart_rx_i,
  output logic       uart_tx_o,
  `PINS(logic)
);
  logic       rst_ni, arm, set_zero, clear_faults, panel_stop, armed, limit;
  logic [3:0] scene;
  logic [7:0] inputs;
  logic [11:0] limits;
  logic [15:0] faults;
  logic [31:0] position;
  logic [ 2:0] lines;
  assign lines = `ENCODER_LINES;
  assign limit = |(limits & ~(12'd1 << map::L_GATES_CLOSED));

  panel_reset #(.HoldBits(DebounceBits)) u_reset (.clk_i(clk_i), .key_ni(reset_ni), .rst_no(rst_ni));

  panel #(
    .DebounceBits(DebounceBits), .LoopBits(LoopBits), .LongPressClocks(LongPressClocks),
    .LampBits(LampBits), .HeartbeatBits(HeartbeatBits), .EncoderLoop(EncoderLoop)
  ) u_panel (
    .clk_i(clk_i), .rst_ni(rst_ni), .key_i(key_i), .switches_i(switches_i), .loop_ni(loop_ni),
    .armed_i(armed), .fault_i(|faults), .limit_i(limit), .count_i(position[1:0]), .angle_i(position[11:9]),
    .arm_o(arm), .set_zero_o(set_zero), .clear_faults_o(clear_faults), .stop_o(panel_stop),
    .enc_a_i(lines[0]), .enc_b_i(lines[1]), .enc_z_i(lines[2]),
    .scene_o(scene), .inputs_o(inputs), .lamps_o(lamps_o)
  );

  /* verilator lint_off PINCONNECTEMPTY */  // nothing shows these
  feltgate_linked #(.AxisCount(1), .Baud(Baud), .Board(Board), .ParameterFile(ParameterFile)) u_linked (
    .arm_i(arm), .stop_i(estop_i || panel_stop), .set_zero_i(set_zero), .clear_faults_i(clear_faults),
    .scene_i(scene), .inputs_i(inputs), .position_o(position), .limits_o(limits), .faults_o(faults),
    .first_fault_o(), .scene_o(), .armed_o(armed), .gates_enable_o(), .snapshot_valid_o(),
`ifdef DRIVER_PIN
    .driver_fault_i(driver_fault_i ^ (DriverFaultLow != 0)),
`endif
    .*  // clock, reset, UART and pins
  );
  /* verilator lint_on PINCONNECTEMPTY */
endmodule

`default_nettype wire
