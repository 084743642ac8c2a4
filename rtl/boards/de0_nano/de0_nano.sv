// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Top level for the Terasic DE0-Nano (Cyclone IV E, 50 MHz): pins, keys, switches and lamps around
// feltgate_core. There is no host, so the register port is tied off. Ports bear the names printed
// on the board. Never compiled with Quartus. Documentation: docs/boards/de0_nano.md
`default_nettype none

module de0_nano #(
  parameter int DebounceBits    = 19,        // an input counts after 2^19 clocks at rest: 10.5 ms
  parameter int LongPressClocks = 50000000,  // KEY[1] held this long sets the zero: 1 s
  parameter int LampBits        = 22,        // the limit lamp stays lit 2^22 clocks: 84 ms
  parameter int HeartbeatBits   = 26,        // LED[7]: 0.75 Hz
  parameter     ParameterFile   = ""         // parameters.mem of this very design; "": the package has the values
) (
  input  logic       CLOCK_50,
  input  logic [1:0] KEY,        // low while pressed
  input  logic [3:0] SW,
  output logic [7:0] LED,
  input  logic       ENC_A,      // asynchronous, as ESTOP; feltgate_core synchronises them
  input  logic       ENC_B,
  input  logic       ENC_Z,
  input  logic       ESTOP,      // high stops, without a clock: a normally closed switch to GND, pulled up
  output logic       GATE_A_HI,
  output logic       GATE_A_LO,
  output logic       GATE_B_HI,
  output logic       GATE_B_LO
);

  logic       rst_n;
  logic       arm, set_zero;
  logic       armed, fault, limit;
  logic [feltgate_map_pkg::W_FAULTS_SEEN-1:0] faults;
  // That the gates are off is the armed lamp's business: not used here.
  /* verilator lint_off UNUSEDSIGNAL */
  logic [feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [3:0] scene;

  de0_nano_reset #(.HoldBits(DebounceBits)) u_reset (
    .clk_i(CLOCK_50),
    .key_ni(KEY[0]),
    .rst_no(rst_n)
  );

  // Pins that a finger moves. meta_q may be metastable and feeds nothing but sync_q.
  logic [4:0] meta_q, sync_q;

  always_ff @(posedge CLOCK_50 or negedge rst_n) begin
    if (!rst_n) begin
      meta_q <= 5'b10000;
      sync_q <= 5'b10000;
    end else begin
      meta_q <= {!KEY[1], SW};
      sync_q <= meta_q;
    end
  end

  // As one word, so that no scene between two settings is ever selected.
  de0_nano_debounce #(.Width(4), .HoldBits(DebounceBits), .ResetValue(0)) u_scene (
    .clk_i(CLOCK_50),
    .rst_ni(rst_n),
    .level_i(sync_q[3:0]),
    .level_o(scene)
  );

  de0_nano_key #(.HoldBits(DebounceBits), .LongPressClocks(LongPressClocks)) u_key (
    .clk_i(CLOCK_50),
    .rst_ni(rst_n),
    .down_i(sync_q[4]),
    .fault_i(fault),
    .arm_o(arm),
    .set_zero_o(set_zero)
  );

  // Empty pins: nobody is here to read them.
  /* verilator lint_off PINCONNECTEMPTY */
  feltgate_core #(.ReadBack(0), .ParameterFile(ParameterFile)) u_core (
    .clk_i(CLOCK_50),
    .rst_ni(rst_n),
    .enc_a_i(ENC_A),
    .enc_b_i(ENC_B),
    .enc_z_i(ENC_Z),
    .gate_a_hi_o(GATE_A_HI),
    .gate_a_lo_o(GATE_A_LO),
    .gate_b_hi_o(GATE_B_HI),
    .gate_b_lo_o(GATE_B_LO),
    .arm_i(arm),
    .stop_i(ESTOP),
    .set_zero_i(set_zero),
    .scene_i(scene),
    .reg_addr_i(12'd0),
    .reg_wdata_i(32'd0),
    .reg_write_i(1'b0),
    .reg_busy_o(),
    .reg_rdata_o(),
    .snapshot_valid_o(),
    .tick_count_o(),
    .position_o(),
    .velocity_o(),
    .tau_hat_o(),
    .tau_ref_o(),
    .current_ref_o(),
    .voltage_o(),
    .duty_o(),
    .duty_active_o(),
    .gates_enable_o(),
    .scene_o(),
    .limits_o(limits),
    .faults_o(faults),
    .first_fault_o(),
    .armed_o(armed),
    .word_valid_o(),
    .word_slot_o(),
    .word_data_o()
  );
  /* verilator lint_on PINCONNECTEMPTY */

  assign fault = |faults;
  assign limit = |(limits & ~(feltgate_map_pkg::W_STATUS_LIMITS'(1) << feltgate_map_pkg::L_GATES_CLOSED));

  // A limit may hold for one tick only, so its lamp is stretched.
  logic [LampBits-1:0]      lamp_q;
  logic [HeartbeatBits-1:0] heartbeat_q;
  logic                     limit_lamp_q;

  always_ff @(posedge CLOCK_50 or negedge rst_n) begin
    if (!rst_n) begin
      lamp_q       <= '0;
      limit_lamp_q <= 1'b0;
      heartbeat_q  <= '0;
    end else begin
      if (limit) lamp_q <= '1;
      else if (limit_lamp_q) lamp_q <= lamp_q - 1'b1;
      limit_lamp_q <= limit || (lamp_q > 1);
      heartbeat_q  <= heartbeat_q + 1'b1;
    end
  end

  assign LED = {heartbeat_q[HeartbeatBits-1], scene, limit_lamp_q, fault, armed};
endmodule

`default_nettype wire
