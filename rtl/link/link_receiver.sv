// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Receives requests: decodes SLIP, checks the CRC-32 and the rules of a request. An invalid frame
// is reported on bad_o and has no other effect. A request is held until it is taken or the next
// frame begins. Timing: one bit per clock, so a byte takes eight clocks.
// Documentation: docs/link.md
`default_nettype none

module link_receiver #(
    parameter int Engine = cfg::ENGINE  // 1: the map also has the engine's words, on top
) (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic [ 7:0] byte_i,
    input  logic        valid_i,     // one clock, at least ten clocks after the previous one
    input  logic        error_i,     // one clock: a byte with a framing error
    input  logic        taken_i,     // the request is no longer needed
    output logic        valid_o,     // a request is valid
    output logic        write_o,
    output logic [ 7:0] sequence_o,
    output logic [13+Engine:0] address_o,
    output logic [31:0] data_o,      // of a write; of a read: the number of words
    output logic        good_o,      // one clock: a frame was a valid request
    output logic        bad_o        // one clock: a frame was not
);
  localparam logic [7:0] END = 8'(feltgate_link_pkg::FRAME_END);
  localparam logic [7:0] ESCAPE = 8'(feltgate_link_pkg::FRAME_ESCAPE);
  localparam logic [7:0] ESCAPED_END = 8'(feltgate_link_pkg::ESCAPED_END);
  localparam logic [7:0] ESCAPED_ESCAPE = 8'(feltgate_link_pkg::ESCAPED_ESCAPE);
  localparam logic [3:0] BYTES = 4'(feltgate_link_pkg::REQUEST_BYTES);

  logic [ 3:0] count_q;     // bytes of the frame; saturates at one too many
  logic        escaped_q;   // the last byte was ESCAPE
  logic        spoiled_q;   // the frame is already invalid
  logic [ 7:0] byte_q;      // shifts bit by bit into CRC and frame
  logic [ 3:0] bits_q;      // bits of byte_q still to shift
  logic [31:0] crc_q;
  logic [63:0] frame_q;     // the first eight bytes

  logic ends, escapes, stuffed_end, stuffed_escape, empty;
  assign ends           = valid_i && byte_i == END;
  assign escapes        = valid_i && byte_i == ESCAPE;
  assign stuffed_end    = escaped_q && byte_i == ESCAPED_END;
  assign stuffed_escape = escaped_q && byte_i == ESCAPED_ESCAPE;
  assign empty          = count_q == 4'd0 && !escaped_q && !spoiled_q;

  // Rules of a request.
  logic reads, writes, words_ok, beyond, in_map, whole, sound;
  logic [6:0] over;
  assign reads    = frame_q[7:0] == 8'(feltgate_link_pkg::KIND_READ);
  assign writes   = frame_q[7:0] == 8'(feltgate_link_pkg::KIND_WRITE);
  assign words_ok = frame_q[63:39] == '0 && (frame_q[38] ? frame_q[37:32] == '0 : frame_q[37:32] != '0);
  assign over     = {1'b0, frame_q[21:16]} + frame_q[38:32];
  assign beyond   = frame_q[29:22] == '1 && over > 7'd64;
  assign in_map   = !frame_q[31] && (Engine != 0 || !frame_q[30]);
  assign whole    = count_q == BYTES && !escaped_q && !spoiled_q && crc_q == feltgate_link_pkg::CRC_GOOD;
  assign sound    = whole && in_map && (writes || (reads && words_ok && !beyond));

  assign write_o    = writes;
  assign sequence_o = frame_q[15:8];
  assign address_o  = frame_q[29+Engine:16];
  assign data_o     = frame_q[63:32];

  logic shifting, feedback;
  assign shifting = bits_q != 4'd0;
  assign feedback = crc_q[0] ^ byte_q[0];

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      count_q   <= 4'd0;
      escaped_q <= 1'b0;
      spoiled_q <= 1'b0;
      byte_q    <= 8'd0;
      bits_q    <= 4'd0;
      crc_q     <= '1;
      frame_q   <= '0;
      valid_o   <= 1'b0;
      good_o    <= 1'b0;
      bad_o     <= 1'b0;
    end else begin
      good_o <= ends && sound;
      bad_o  <= ends && !sound && !empty;
      if (taken_i) valid_o <= 1'b0;
      if (shifting) begin
        bits_q <= bits_q - 4'd1;
        byte_q <= {1'b0, byte_q[7:1]};
        crc_q  <= {1'b0, crc_q[31:1]} ^ (feedback ? feltgate_link_pkg::CRC_POLYNOMIAL : 32'd0);
        if (count_q <= 4'd8) frame_q <= {byte_q[0], frame_q[63:1]};
      end
      if (ends) begin
        count_q   <= 4'd0;
        escaped_q <= 1'b0;
        spoiled_q <= 1'b0;
        crc_q     <= '1;
        if (sound) valid_o <= 1'b1;
      end else if (escapes) begin
        escaped_q <= 1'b1;
        if (escaped_q) spoiled_q <= 1'b1;
      end else if (valid_i) begin
        escaped_q <= 1'b0;
        if (escaped_q && !stuffed_end && !stuffed_escape) spoiled_q <= 1'b1;
        byte_q  <= stuffed_end ? END : stuffed_escape ? ESCAPE : byte_i;
        bits_q  <= 4'd8;
        valid_o <= 1'b0;
        if (count_q <= BYTES) count_q <= count_q + 4'd1;
      end
      if (error_i) spoiled_q <= 1'b1;
    end
  end
endmodule

`default_nettype wire
