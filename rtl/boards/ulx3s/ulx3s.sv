// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Top level for the ULX3S (ECP5 LFE5U-85F): pins, panel and clock around feltgate_linked. It has
// never run on a board. Documentation: docs/boards/ulx3s.md
`default_nettype none

module ulx3s #(
  parameter int DebounceBits    = 19,        // an input counts after 2^19 stable clocks
  parameter int LoopBits        = 10,        // the connector's loop after 2^10 stable clocks
  parameter int LongPressClocks = feltgate_pkg::CLOCK_HZ,  // btn[1] held this long sets the zero: 1 s
  parameter int LampBits        = 22,        // the limit lamp stays lit 2^22 clocks
  parameter int HeartbeatBits   = 26,        // led[7]
  parameter int EncoderLoop     = 1,         // 0: enc_loop is not wired
  parameter int Baud            = feltgate_link_pkg::BAUD,  // of the host's UART
  parameter     ParameterFile   = ""         // parameters.mem of this very design; "": the package has the values
) (
  input  logic       clk_25mhz,
  input  logic [2:1] btn,        // high while pressed: FIRE1, FIRE2
  input  logic [3:0] sw,
  output logic [7:0] led,
  output logic       ftdi_rxd,   // to the USB serial port
  input  logic       ftdi_txd,   // from the USB serial port
  output logic       wifi_gpio0, // high: the ESP32 leaves the FPGA alone
  input  logic       enc_a,      // asynchronous, as all inputs below; synchronised inside
  input  logic       enc_b,
  input  logic       enc_z,
  input  logic       enc_loop,   // low while the encoder's connector is plugged in (wire to GND)
  input  logic       estop,      // high stops, needs no clock: normally closed switch to GND, pull-up
  output logic       gate_a_hi,
  output logic       gate_a_lo,
  output logic       gate_b_hi,
  output logic       gate_b_lo,
  // Of the design's options; without them the inputs are not used
  input  logic       encoder_data, // absolute encoder
  output logic       encoder_select_n,
  output logic       encoder_clock,
  output logic       encoder_command,
  input  logic       current_data, // modulator of the motor's current
  output logic       current_clock,
  input  logic       current_data_b, // of a second modulator, at phase B
  output logic       current_clock_b, // the same clock
  input  logic       driver_fault_n, // low: the bridge's driver has a fault, or it is not plugged in
  output logic       heartbeat,  // to a watchdog outside
  output logic       gate_c_hi,  // third leg, of a motor with three phases
  output logic       gate_c_lo,
  input  logic [2:0] hall        // Hall lines of such a motor
);

  logic       clk, locked;
  logic       rst_n;
  logic       arm, set_zero, clear_faults, panel_stop;
  logic       armed, fault, limit;
  logic [3:0] scene;
  logic [7:0] inputs;
  logic [feltgate_map_pkg::W_FAULTS_SEEN-1:0] faults;
  logic [feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits;
  logic signed [31:0] position;

  ulx3s_clock u_clock (
    .clk_25mhz_i(clk_25mhz),
    .clk_o(clk),
    .locked_o(locked)
  );

  // Reset while the PLL is not locked; the first flip-flops of the reset need no clock.
  panel_reset #(.HoldBits(DebounceBits)) u_reset (
    .clk_i(clk),
    .key_ni(locked && !btn[2]),
    .rst_no(rst_n)
  );

  assign wifi_gpio0 = 1'b1;

  localparam int Modulators = 1 + feltgate_pkg::CURRENT_LOOP * (feltgate_pkg::PHASES - 2);
  logic [1:0] shunts;
  assign shunts = {current_data_b, current_data};
  assign current_clock_b = current_clock;

  // Open pins are not used on this board.
  /* verilator lint_off PINCONNECTEMPTY */
  feltgate_linked #(.Baud(Baud), .Board(2), .ParameterFile(ParameterFile)) u_linked (
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
    .current_data_i(shunts[Modulators-1:0]),
    .current_clock_o(current_clock),
    .driver_fault_i(!driver_fault_n),
    .heartbeat_o(heartbeat),
    .hall_i(hall),
    .gate_c_hi_o(gate_c_hi),
    .gate_c_lo_o(gate_c_lo),
    .arm_i(arm),
    .stop_i(estop || panel_stop),
    .set_zero_i(set_zero),
    .clear_faults_i(clear_faults),
    .scene_i(scene),
    .uart_rx_i(ftdi_txd),
    .uart_tx_o(ftdi_rxd),
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
    .key_i(btn[1]),
    .switches_i(sw),
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
    .lamps_o(led)
  );

  logic unused;
  assign unused = ^{limits, position, shunts};  // not all of their bits are shown
endmodule

`default_nettype wire
