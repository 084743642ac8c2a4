// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_transmitter between two sources and a reader of the bytes that come out: which frames it makes of which
// bytes, whatever the sources and the wire do.
`default_nettype none

module frames_proof (
    input logic       clk_i,
    input logic       rst_ni,
    input logic       reply_valid_i,
    input logic [7:0] reply_byte_i,
    input logic       reply_last_i,
    input logic       stream_valid_i,
    input logic [7:0] stream_byte_i,
    input logic       stream_last_i,
    input logic       ready_i
);
`include "reset.svh"

  logic reply_ready, stream_ready, valid;
  logic [7:0] out;
  link_transmitter u_dut (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .reply_valid_i(reply_valid_i), .reply_byte_i(reply_byte_i), .reply_last_i(reply_last_i),
      .reply_ready_o(reply_ready),
      .stream_valid_i(stream_valid_i), .stream_byte_i(stream_byte_i), .stream_last_i(stream_last_i),
      .stream_ready_o(stream_ready),
      .valid_o(valid), .byte_o(out), .ready_i(ready_i)
  );
  (* hierconn *) wire [2:0] \u_dut.state_q ;
  (* hierconn *) wire \u_dut.stream_q ;
  (* hierconn *) wire \u_dut.last_q ;
  (* hierconn *) wire \u_dut.tail_q ;
  (* hierconn *) wire [1:0] \u_dut.at_q ;
  (* hierconn *) wire [2:0] \u_dut.bit_q ;
  (* hierconn *) wire [7:0] \u_dut.byte_q ;
  (* hierconn *) wire [31:0] \u_dut.crc_q ;

`include "crc.svh"

  // The sources: a byte that was taken and is not yet through, the CRC of all that were.
  logic takes, takes_stream, sent, last_q, owed_q, of_stream_q, any_q;
  logic [7:0] take, owed_byte_q;
  logic [31:0] crc_q;
  assign takes_stream = stream_valid_i && stream_ready;
  assign takes        = takes_stream || (reply_valid_i && reply_ready);
  assign take         = takes_stream ? stream_byte_i : reply_byte_i;
  // The reader of the bytes: between ENDs, after an escape; so many bytes of the CRC came.
  logic inside_q, escaped_q, is_end, is_escape, is_plain;
  logic [2:0] tail_q;
  logic [7:0] plain;
  assign sent      = valid && ready_i;
  assign is_end    = sent && out == 8'hc0;
  assign is_escape = sent && out == 8'hdb;
  assign is_plain  = sent && !is_end && !is_escape;
  assign plain     = !escaped_q ? out : out == 8'hdc ? 8'hc0 : 8'hdb;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {inside_q, escaped_q, owed_q, last_q, any_q} <= 5'b00000;
      tail_q <= 3'd0;
      crc_q  <= '1;
    end else begin
      if (sent) escaped_q <= is_escape;
      if (takes) begin
        owed_q      <= 1'b1;
        owed_byte_q <= take;
        last_q      <= takes_stream ? stream_last_i : reply_last_i;
        of_stream_q <= takes_stream;
        any_q       <= 1'b1;
        crc_q       <= crc_after(crc_q, take, 4'd8);
      end
      if (is_plain) begin
        owed_q <= 1'b0;
        if (!owed_q) tail_q <= tail_q + 3'd1;
      end
      if (is_end) begin
        inside_q <= !inside_q;
        tail_q   <= 3'd0;
        crc_q    <= '1;
        last_q   <= 1'b0;
        any_q    <= 1'b0;
      end
    end
  end

  // Clocks on end without a byte for the wire, though a source or the frame has one.
  logic has;
  logic [3:0] silent_q;
  assign has = !inside_q || reply_ready ? reply_valid_i || (!inside_q && stream_valid_i) :
               stream_ready ? stream_valid_i : 1'b1;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) silent_q <= '0;
    else if (valid || !has) silent_q <= '0;
    else if (silent_q != '1) silent_q <= silent_q + 4'd1;
  end

  logic after_q, stood_q, replies_q;
  logic [7:0] out_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end
  always_ff @(posedge clk_i) begin
    stood_q   <= valid && !ready_i;
    out_q     <= out;
    if (!valid && !inside_q) replies_q <= reply_valid_i;
  end

  wire [2:0] state = \u_dut.state_q ;
  wire [2:0] bits = \u_dut.bit_q ;
  wire [3:0] rest = 4'd8 - {1'b0, bits};
  wire shifts = state == 3'd3;
  logic [31:0] tail;  // what of the CRC is still to come, its bits the lowest
  assign tail = ~crc_q >> {tail_q[1:0], 3'd0};
  always_comb begin
    if (past_ok_q && rst_ni) begin
      // What comes out.
      end_by_frames: assert (!is_end || (!escaped_q && (!inside_q || (any_q && last_q && !owed_q && tail_q == 3'd4))));
      begins_with_end: assert (!sent || inside_q || is_end);
      bytes_in_order: assert (!(is_plain && owed_q) || plain == owed_byte_q);
      crc_in_the_tail: assert (!(is_plain && !owed_q) || (last_q && tail_q < 3'd4 && plain == tail[7:0]));
      escape_of_two: assert (!(sent && escaped_q) || out == 8'hdc || out == 8'hdd);
      nothing_overtaken: assert (!takes || (inside_q && !owed_q && !last_q && !escaped_q));
      one_source: assert (!(reply_ready && stream_ready) && (!takes || !any_q || takes_stream == of_stream_q));
      reply_first: assert (!takes || any_q || takes_stream == !replies_q);
      stands_until_taken: assert (!after_q || !stood_q || (valid && out == out_q));
      silent_for_nine_clocks: assert (silent_q < 4'd10);

      inside_state: assert (state <= 3'd6 && (shifts || bits == 3'd0) && inside_q == (state != 3'd0 && state != 3'd1));
      inside_escape: assert (escaped_q == (state == 3'd5) && (!escaped_q || \u_dut.byte_q == 8'hc0 || \u_dut.byte_q == 8'hdb));
      inside_source: assert (state < 3'd1 || state == 3'd6 || ((!any_q || of_stream_q == \u_dut.stream_q ) && \u_dut.stream_q == !replies_q));
      inside_owed: assert (owed_q == ((shifts || state == 3'd4 || state == 3'd5) && !\u_dut.tail_q ));
      inside_any: assert (state <= 3'd1 ? !any_q : state == 3'd2 || any_q);
      inside_last: assert (state <= 3'd2 ? !last_q : last_q == \u_dut.last_q );
      inside_tail: assert (state == 3'd6 ? last_q && tail_q == 3'd4 :
                           tail_q == (state != 3'd0 && \u_dut.tail_q ? {1'b0, \u_dut.at_q } : 3'd0));
      inside_at: assert (state == 3'd0 || state == 3'd6 || \u_dut.tail_q || \u_dut.at_q == 2'd0);
      inside_tails: assert (state == 3'd0 || !\u_dut.tail_q || (last_q && state >= 3'd3));
      inside_begin: assert (state == 3'd0 || state > 3'd2 || !\u_dut.tail_q );
      inside_byte: assert (!owed_q || (shifts ? 8'((\u_dut.byte_q << bits) | (\u_dut.byte_q >> rest)) : \u_dut.byte_q ) == owed_byte_q);
      inside_crc: assert (state == 3'd0 || state == 3'd6 || \u_dut.tail_q ||
                          (owed_q && shifts ? crc_after(\u_dut.crc_q , \u_dut.byte_q , rest) : \u_dut.crc_q ) == crc_q);
      inside_begun: assert (state > 3'd1 || &crc_q);
      inside_tail_crc: assert (state < 3'd3 || state == 3'd6 || !\u_dut.tail_q ||
          (\u_dut.crc_q == crc_q >> (6'(\u_dut.at_q ) * 6'd8 + (shifts ? 6'(bits) : 6'd8)) &&
           (shifts ? 8'(\u_dut.byte_q >> rest) | 8'(~\u_dut.crc_q << bits) : \u_dut.byte_q ) == tail[7:0]));
      inside_silent: assert (silent_q <= (shifts ? {1'b0, bits} + 4'd1 : state == 3'd4 ? 4'd9 : state == 3'd1 ? 4'd1 : 4'd0));
      escapes: cover (sent && escaped_q);
      waits: cover (stood_q && inside_q && valid && any_q);
      streams: cover (takes_stream && inside_q);
    end
  end
endmodule

`default_nettype wire
