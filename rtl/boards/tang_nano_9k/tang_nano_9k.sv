// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Top level for the Tang Nano 9K (Gowin GW1NR-9C): pins, panel and clock around feltgate_linked. A design has an
// H bridge and a line encoder or an absolute one; three phases and a current loop do not fit the chip.
// It has never run on a board. Documentation: docs/boards/tang_nano_9k.md
`default_nettype none

module tang_nano_9k #(
  parameter int DebounceBits    = 19,        // an input counts after 2^19 stable clocks
  parameter int LoopBits        = 10,        // the connector's loop after 2^10 stable clocks
  parameter int LongPressClocks = feltgate_pkg::CLOCK_HZ,  // key_n held this long sets the zero: 1 s
  parameter int LampBits        = 22,        // the limit lamp stays lit 2^22 clocks
  parameter int HeartbeatBits   = 26,        // led_n[5]
  parameter int EncoderLoop     = 1,         // 0: enc_loop is not wired
  parameter int Baud            = feltgate_link_pkg::BAUD,  // of the host's UART
  parameter     ParameterFile   = ""         // parameters.mem of this very design; "": the package has the values
) (
  input  logic       clk_27mhz,
  input  logic       reset_n,    // low while pressed: S1
  input  logic       key_n,      // low while pressed: S2
  output logic [5:0] led_n,      // low lights
  output logic       uart_tx,    // to the USB serial port
  input  logic       uart_rx,    // from the USB serial port
  input  logic [3:0] sw_n,       // low is on: a switch to GND each; asynchronous, as all inputs below
  input  logic       enc_a,
  input  logic       enc_b,
  input  logic       enc_z,
  input  logic       enc_loop,   // low while the encoder's connector is plugged in (wire to GND)
  input  logic       estop,      // high stops, needs no clock: normally closed switch to GND, pull-up
  output logic       gate_a_hi,
  output logic       gate_a_lo,
  output logic       gate_b_hi,
  output logic       gate_b_lo,
  input  logic       encoder_data, // of an absolute encoder; unused without it
  output logic       encoder_select_n,
  output logic       encoder_clock,
  output logic       encoder_command
);

  logic       clk, locked;
  logic       rst_n;
  logic       arm, set_zero, clear_faults, panel_stop;
  logic       armed, fault, limit;
  logic [3:0] scene;
  logic [7:0] inputs, lamps;
  logic [feltgate_map_pkg::W_FAULTS_SEEN-1:0] faults;
  logic [feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits;
  logic signed [31:0] position;

  // A gate without a pin would leave its leg to chance.
  generate
  if (feltgate_pkg::PHASES == 3 || feltgate_pkg::CURRENT_LOOP != 0 || feltgate_pkg::HALL != 0) begin : g_check
    three_phases_and_a_current_loop_do_not_fit_this_board missing ();
  end
  endgenerate

  tang_nano_9k_clock u_clock (
    .clk_27mhz_i(clk_27mhz),
    .clk_o(clk),
    .locked_o(locked)
  );

  // Reset while the PLL is not locked; the first flip-flops of the reset need no clock.
  panel_reset #(.HoldBits(DebounceBits)) u_reset (
    .clk_i(clk),
    .key_ni(locked && reset_n),
    .rst_no(rst_n)
  );

  // Open pins are not used on this board.
  /* verilator lint_off PINCONNECTEMPTY */
  feltgate_linked #(.Baud(Baud), .Board(3), .ParameterFile(ParameterFile)) u_linked (
    .clk_i(clk),
    .rst_ni(rst_n),
    .enc_a_i(enc_a),
    .enc_b_i(enc_b),
    .enc_z_i(enc_z),
    .gate_a_hi_o(gate_a_hi),
    .gate_a_lo_o(gate_a_lo),
    .gate_b_hi_o(gate_b_hi),
    .gate_b_lo_o(gate_b_lo),
    .encoder_data_i(encoder_data),
    .encoder_select_no(encoder_select_n),
    .encoder_clock_o(encoder_clock),
    .encoder_command_o(encoder_command),
    .current_data_i(1'b1),
    .current_clock_o(),
    .driver_fault_i(1'b0),
    .heartbeat_o(),
    .gate_c_hi_o(),
    .gate_c_lo_o(),
    .hall_i(3'b000),
    .arm_i(arm),
    .stop_i(estop || panel_stop),
    .set_zero_i(set_zero),
    .clear_faults_i(clear_faults),
    .scene_i(scene),
    .uart_rx_i(uart_rx),
    .uart_tx_o(uart_tx),
    .inputs_i(inputs),
    .position_o(position),
    .limits_o(limits),
    .faults_o(faults),
    .first_fault_o(),
    .scene_o(),
    .armed_o(armed),
    .gates_enable_o(),
    .snapshot_valid_o()
  );
  /* verilator lint_on PINCONNECTEMPTY */

  assign fault = |faults;
  assign limit = |(limits & ~(feltgate_map_pkg::W_STATUS_LIMITS'(1) << feltgate_map_pkg::L_GATES_CLOSED));

  panel #(
    .DebounceBits(DebounceBits), .LoopBits(LoopBits), .LongPressClocks(LongPressClocks),
    .LampBits(LampBits), .HeartbeatBits(HeartbeatBits), .EncoderLoop(EncoderLoop)
  ) u_panel (
    .clk_i(clk),
    .rst_ni(rst_n),
    .key_i(!key_n),
    .switches_i(~sw_n),
    .loop_ni(enc_loop),
    .enc_a_i(enc_a),
    .enc_b_i(enc_b),
    .enc_z_i(enc_z),
    .armed_i(armed),
    .fault_i(fault),
    .limit_i(limit),
    .count_i(position[1:0]),
    .angle_i(position[11:9]),
    .arm_o(arm),
    .set_zero_o(set_zero),
    .clear_faults_o(clear_faults),
    .stop_o(panel_stop),
    .scene_o(scene),
    .inputs_o(inputs),
    .lamps_o(lamps)
  );

  // The board has six LEDs: the panel's lamps 5 and 6 are left out.
  assign led_n = ~{lamps[7], lamps[4:0]};

  logic unused;
  assign unused = ^{limits, position, lamps[6:5]};  // not all of their bits are shown
endmodule

`default_nettype wire
