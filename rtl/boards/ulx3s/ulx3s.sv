// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Pins of the ULX3S (ECP5 LFE5U-85F). Those of the board have its own names. It has never run on a
// board. docs/boards/ulx3s.md

`default_nettype none
`include "device.svh"

module ulx3s #(
  parameter int DebounceBits    = 19,  // these as in board.sv
  parameter int LoopBits        = 10,
  parameter int LongPressClocks = cfg::CLOCK_HZ,
  parameter int LampBits        = 22,
  parameter int HeartbeatBits   = 26,
  parameter int EncoderLoop     = 1,
  parameter int Baud            = feltgate_link_pkg::BAUD,
  parameter     ParameterFile   = ""
) (
  input  logic       clk_25mhz,
  input  logic [2:1] btn,        // high while pressed: FIRE1, FIRE2
  input  logic [3:0] sw,
  output logic [7:0] led,
  output logic       ftdi_rxd,   // to the USB serial port
  input  logic       ftdi_txd,   // from the USB serial port
  output logic       wifi_gpio0, // high: the ESP32 leaves the FPGA alone
  input  logic       enc_loop,   // low while the encoder's connector is plugged in (wire to GND)
  input  logic       estop,      // high stops, needs no clock: normally closed switch to GND, pull-up
  `PINS(logic)
);
  logic clk, locked;
  assign wifi_gpio0 = 1'b1;
  ulx3s_clock u_clock (.clk_25mhz_i(clk_25mhz), .clk_o(clk), .locked_o(locked));

  // Reset while the PLL is not locked; the first flip-flops of the reset need no clock.
  board #(
    .Board(2), .DriverFaultLow(1),
    .DebounceBits(DebounceBits), .LoopBits(LoopBits), .LongPressClocks(LongPressClocks), .LampBits(LampBits),
    .HeartbeatBits(HeartbeatBits), .EncoderLoop(EncoderLoop), .Baud(Baud), .ParameterFile(ParameterFile)
  ) u_board (
    .clk_i(clk), .reset_ni(locked && !btn[2]), .key_i(btn[1]), .switches_i(sw), .loop_ni(enc_loop), .estop_i(estop),
    .lamps_o(led), .uart_rx_i(ftdi_txd), .uart_tx_o(ftdi_rxd), .*
  );
endmodule

`default_nettype wire
