// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Top level for the Terasic DE0-Nano (Cyclone IV E, 50 MHz): pins and panel around feltgate_linked.
// Ports have the names printed on the board, or those of the wiring table. Never compiled with
// Quartus. Documentation: docs/boards/de0_nano.md
`default_nettype none

module de0_nano #(
  parameter int DebounceBits    = 19,        // an input counts after 2^19 stable clocks: 10.5 ms
  parameter int LoopBits        = 10,        // the connector's loop after 2^10 stable clocks: 20 us
  parameter int LongPressClocks = 50000000,  // KEY[1] held this long sets the zero: 1 s
  parameter int LampBits        = 22,        // the limit lamp stays lit 2^22 clocks: 84 ms
  parameter int HeartbeatBits   = 26,        // LED[7]: 0.75 Hz
  parameter int EncoderLoop     = 1,         // 0: ENC_LOOP is not wired
  parameter int Baud            = feltgate_link_pkg::BAUD,  // of the host's UART
  parameter     ParameterFile   = ""         // parameters.mem of this very design; "": the package has the values
) (
  input  logic       CLOCK_50,
  input  logic [1:0] KEY,        // low while pressed
  input  logic [3:0] SW,
  output logic [7:0] LED,
  input  logic       ENC_A,      // asynchronous, as all inputs below; synchronised inside
  input  logic       ENC_B,
  input  logic       ENC_Z,
  input  logic       ENC_LOOP,   // low while the encoder's connector is plugged in (wire to GND)
  input  logic       ESTOP,      // high stops, needs no clock: normally closed switch to GND, pull-up
  input  logic       UART_RX,    // from the host
  output logic       UART_TX,    // to the host
  output logic       GATE_A_HI,
  output logic       GATE_A_LO,
  output logic       GATE_B_HI,
  output logic       GATE_B_LO,
  // Of the design's options; without them the inputs are not used
  input  logic       ENCODER_DATA, // absolute encoder
  output logic       ENCODER_SELECT_N,
  output logic       ENCODER_CLOCK,
  output logic       ENCODER_COMMAND,
  input  logic       CURRENT_DATA, // modulator of the motor's current
  output logic       CURRENT_CLOCK,
  input  logic       CURRENT_DATA_B,  // of a second modulator, at phase B
  output logic       CURRENT_CLOCK_B, // the same clock
  input  logic       DRIVER_FAULT, // high: the bridge's driver has a fault, or it is not plugged in
  output logic       HEARTBEAT,  // to a watchdog outside
  output logic       GATE_C_HI,  // third leg, of a motor with three phases
  output logic       GATE_C_LO,
  input  logic [2:0] HALL        // Hall lines of such a motor
);

  generate
  if (feltgate_pkg::CLOCK_HZ != 50000000) begin : g_check_clock
    the_clock_of_the_design_must_be_the_50_MHz_of_the_board missing ();
  end
  endgenerate

  logic       rst_n;
  logic       arm, set_zero, clear_faults, panel_stop;
  logic       armed, fault, limit;
  logic [3:0] scene;
  logic [7:0] inputs;
  logic [feltgate_map_pkg::W_FAULTS_SEEN-1:0] faults;
  logic [feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits;
  logic signed [31:0] position;

  panel_reset #(.HoldBits(DebounceBits)) u_reset (
    .clk_i(CLOCK_50),
    .key_ni(KEY[0]),
    .rst_no(rst_n)
  );

  localparam int Modulators = 1 + feltgate_pkg::CURRENT_LOOP * (feltgate_pkg::PHASES - 2);
  logic [1:0] shunts;
  assign shunts = {CURRENT_DATA_B, CURRENT_DATA};
  assign CURRENT_CLOCK_B = CURRENT_CLOCK;

  // Open pins are not used on this board.
  /* verilator lint_off PINCONNECTEMPTY */
  feltgate_linked #(.Baud(Baud), .Board(1), .ParameterFile(ParameterFile)) u_linked (
    .clk_i(CLOCK_50),
    .rst_ni(rst_n),
    .enc_a_i(ENC_A),
    .enc_b_i(ENC_B),
    .enc_z_i(ENC_Z),
    .gate_a_hi_o(GATE_A_HI),
    .gate_a_lo_o(GATE_A_LO),
    .gate_b_hi_o(GATE_B_HI),
    .gate_b_lo_o(GATE_B_LO),
    .encoder_data_i(ENCODER_DATA),
    .encoder_select_no(ENCODER_SELECT_N),
    .encoder_clock_o(ENCODER_CLOCK),
    .encoder_command_o(ENCODER_COMMAND),
    .current_data_i(shunts[Modulators-1:0]),
    .current_clock_o(CURRENT_CLOCK),
    .driver_fault_i(DRIVER_FAULT),
    .heartbeat_o(HEARTBEAT),
    .gate_c_hi_o(GATE_C_HI),
    .gate_c_lo_o(GATE_C_LO),
    .hall_i(HALL),
    .arm_i(arm),
    .stop_i(ESTOP || panel_stop),
    .set_zero_i(set_zero),
    .clear_faults_i(clear_faults),
    .scene_i(scene),
    .uart_rx_i(UART_RX),
    .uart_tx_o(UART_TX),
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
    .clk_i(CLOCK_50),
    .rst_ni(rst_n),
    .key_i(!KEY[1]),
    .switches_i(SW),
    .loop_ni(ENC_LOOP),
    .enc_a_i(ENC_A),
    .enc_b_i(ENC_B),
    .enc_z_i(ENC_Z),
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
    .lamps_o(LED)
  );

  logic unused;
  assign unused = ^{limits, position, shunts};  // not all of their bits are shown
endmodule

`default_nettype wire
