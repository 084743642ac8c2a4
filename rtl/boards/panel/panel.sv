// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Panel: a key, four switches and eight lamps around the core, the same on every board. With all
// switches on, the lamps show the encoder and the key cannot arm.
// Documentation: docs/boards/panel.md
`default_nettype none

module panel #(
  parameter int DebounceBits    = 19,        // an input counts after 2^19 stable clocks
  parameter int LoopBits        = 10,        // the connector's loop after 2^10 stable clocks
  parameter int LongPressClocks = 50000000,  // clocks of a long press of the key
  parameter int LampBits        = 22,        // a short event stays lit 2^22 clocks
  parameter int HeartbeatBits   = 26,        // lamp 7 blinks with this bit of a counter
  parameter int EncoderLoop     = 1          // 0: no loop wire; it counts as plugged in
) (
  input  logic       clk_i,
  input  logic       rst_ni,
  input  logic       key_i,       // high while pressed; inputs to enc_z_i: asynchronous
  input  logic [3:0] switches_i,
  input  logic       loop_ni,     // low while the encoder's connector is plugged in
  input  logic       enc_a_i,
  input  logic       enc_b_i,
  input  logic       enc_z_i,
  input  logic       armed_i,
  input  logic       fault_i,
  input  logic       limit_i,
  input  logic [1:0] count_i,     // lowest bits of the position
  input  logic [2:0] angle_i,     // higher bits of the position, for the lamps
  output logic       arm_o,
  output logic       set_zero_o,
  output logic       clear_faults_o,
  output logic       stop_o,      // connector not plugged in, or the key stops a host
  output logic [3:0] scene_o,
  output logic [7:0] inputs_o,    // state of the inputs for a host
  output logic [7:0] lamps_o
);

  // meta_q can be metastable and drives only sync_q.
  logic [8:0] meta_q, sync_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      meta_q <= 9'b110000000;
      sync_q <= 9'b110000000;
    end else begin
      meta_q <= {key_i, loop_ni && EncoderLoop != 0, enc_z_i, enc_b_i, enc_a_i, switches_i};
      sync_q <= meta_q;
    end
  end

  // The switches are debounced as one word, so no scene between two settings is selected.
  panel_debounce #(.Width(4), .HoldBits(DebounceBits), .ResetValue(0)) u_scene (
    .clk_i(clk_i),
    .rst_ni(rst_ni),
    .level_i(sync_q[3:0]),
    .level_o(scene_o)
  );

  logic unplugged, key_stop;
  panel_debounce #(.Width(1), .HoldBits(LoopBits), .ResetValue(1)) u_loop (
    .clk_i(clk_i),
    .rst_ni(rst_ni),
    .level_i(sync_q[7]),
    .level_o(unplugged)
  );

  logic look;
  assign look = &scene_o;

  panel_key #(.HoldBits(DebounceBits), .LongPressClocks(LongPressClocks)) u_key (
    .clk_i(clk_i),
    .rst_ni(rst_ni),
    .down_i(sync_q[8]),
    .armed_i(armed_i),
    .fault_i(fault_i),
    .blocked_i(look || unplugged),
    .arm_o(arm_o),
    .stop_o(key_stop),
    .set_zero_o(set_zero_o),
    .clear_faults_o(clear_faults_o)
  );

  assign stop_o = unplugged || key_stop;

  // A limit or an index can last for one tick only, so its lamp is stretched. The position changes
  // by one count at a time, so its two lowest bits give the direction.
  logic [LampBits-1:0]      lamp_q;
  logic [HeartbeatBits-1:0] heartbeat_q;
  logic                     lit_q, up_q, event_now;
  logic [1:0]               before_q, step;

  assign event_now = look ? sync_q[6] : limit_i;
  assign step = count_i - before_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      lamp_q      <= '0;
      lit_q       <= 1'b0;
      heartbeat_q <= '0;
      before_q    <= '0;
      up_q        <= 1'b0;
    end else begin
      if (event_now) lamp_q <= '1;
      else if (lit_q) lamp_q <= lamp_q - 1'b1;
      lit_q       <= event_now || (lamp_q > 1);
      heartbeat_q <= heartbeat_q + 1'b1;
      before_q    <= count_i;
      if (step != 2'd0) up_q <= !step[1];
    end
  end

  // Lit: a fault. Blinking four times as fast as the heartbeat: the encoder is not plugged in.
  logic fault_lamp;
  assign fault_lamp = unplugged ? heartbeat_q[HeartbeatBits-3] : fault_i;

  assign lamps_o = look ? {angle_i, sync_q[5], sync_q[4], lit_q, fault_lamp, up_q} :
                          {heartbeat_q[HeartbeatBits-1], scene_o, lit_q, fault_lamp, armed_i};
  assign inputs_o = {scene_o, 2'b00, sync_q[8], !unplugged};
endmodule

`default_nettype wire
