// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Pins of the Terasic DE0-Nano (Cyclone IV E, 50 MHz). Those of the board have the names printed on
// it. Never compiled with Quartus. docs/boards/de0_nano.md

`default_nettype none
`include "device.svh"

module de0_nano #(
  parameter int DebounceBits    = 19,  // these as in board.sv
  parameter int LoopBits        = 10,
  parameter int LongPressClocks = cfg::CLOCK_HZ,
  parameter int LampBits        = 22,
  parameter int HeartbeatBits   = 26,
  parameter int EncoderLoop     = 1,
  parameter int Baud            = feltgate_link_pkg::BAUD,
  parameter     ParameterFile   = ""
) (
  input  logic       CLOCK_50,
  input  logic [1:0] KEY,        // low while pressed
  input  logic [3:0] SW,
  output logic [7:0] LED,
  input  logic       enc_loop,   // low while the encoder's connector is plugged in (wire to GND)
  input  logic       estop,      // high stops, needs no clock: normally closed switch to GND, pull-up
  input  logic       uart_rx,    // from the host
  output logic       uart_tx,    // to the host
  `PINS(logic)
);
  generate
  if (cfg::CLOCK_HZ != 50000000) begin : g_check_clock
    the_clock_of_the_design_must_be_the_50_MHz_of_the_board missing ();
  end
  endgenerate

  board #(
    .Board(1),
    .DebounceBits(DebounceBits), .LoopBits(LoopBits), .LongPressClocks(LongPressClocks), .LampBits(LampBits),
    .HeartbeatBits(HeartbeatBits), .EncoderLoop(EncoderLoop), .Baud(Baud), .ParameterFile(ParameterFile)
  ) u_board (
    .clk_i(CLOCK_50), .reset_ni(KEY[0]), .key_i(!KEY[1]), .switches_i(SW), .loop_ni(enc_loop), .estop_i(estop),
    .lamps_o(LED), .uart_rx_i(uart_rx), .uart_tx_o(uart_tx), .*
  );
endmodule

`default_nettype wire
