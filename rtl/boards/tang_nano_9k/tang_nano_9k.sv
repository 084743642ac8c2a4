// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Pins of the Tang Nano 9K (Gowin GW1NR-9C). A design has an H-bridge and a line encoder or an
// absolute one; three phases and a current loop do not fit the chip. It has never run on a board.
// docs/boards/tang_nano_9k.md

`default_nettype none
`include "device.svh"

module tang_nano_9k #(
  parameter int DebounceBits    = 19,  // these as in board.sv
  parameter int LoopBits        = 10,
  parameter int LongPressClocks = cfg::CLOCK_HZ,
  parameter int LampBits        = 22,
  parameter int HeartbeatBits   = 26,
  parameter int EncoderLoop     = 1,
  parameter int Baud            = feltgate_link_pkg::BAUD,
  parameter     ParameterFile   = ""
) (
  input  logic       clk_27mhz,
  input  logic       reset_n,    // low while pressed: S1
  input  logic       key_n,      // low while pressed: S2
  output logic [5:0] led_n,      // low lights
  output logic       uart_tx,    // to the USB serial port
  input  logic       uart_rx,    // from the USB serial port
  input  logic [3:0] sw_n,       // low is on: a switch to GND each
  input  logic       enc_loop,   // low while the encoder's connector is plugged in (wire to GND)
  input  logic       estop,      // high stops, needs no clock: normally closed switch to GND, pull-up
  `PINS(logic)
);
  logic clk, locked;
  logic [7:0] lamps;
  assign led_n = ~{lamps[7], lamps[4:0]};  // six LEDs: lamps 5 and 6 are left out
  tang_nano_9k_clock u_clock (.clk_27mhz_i(clk_27mhz), .clk_o(clk), .locked_o(locked));

  // Reset while the PLL is not locked; the first flip-flops of the reset need no clock.
  board #(
    .Board(3),
    .DebounceBits(DebounceBits), .LoopBits(LoopBits), .LongPressClocks(LongPressClocks), .LampBits(LampBits),
    .HeartbeatBits(HeartbeatBits), .EncoderLoop(EncoderLoop), .Baud(Baud), .ParameterFile(ParameterFile)
  ) u_board (
    .clk_i(clk), .reset_ni(locked && reset_n), .key_i(!key_n), .switches_i(~sw_n), .loop_ni(enc_loop), .estop_i(estop),
    .lamps_o(lamps), .uart_rx_i(uart_rx), .uart_tx_o(uart_tx), .*
  );
endmodule

`default_nettype wire
