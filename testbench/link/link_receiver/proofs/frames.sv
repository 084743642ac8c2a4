// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// link_receiver beside a reader that takes each byte at once: which frames are requests, for all bytes.
`default_nettype none

module frames_proof (
    input logic       clk_i,
    input logic       rst_ni,
    input logic [7:0] byte_i,
    input logic       valid_i,
    input logic       error_i,
    input logic       taken_i
);
  logic valid, write, good, bad;
  logic [ 7:0] sequence_number;
  logic [13:0] address;
  logic [31:0] data;
  link_receiver u_dut (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .byte_i(byte_i), .valid_i(valid_i), .error_i(error_i), .taken_i(taken_i),
      .valid_o(valid), .write_o(write), .sequence_o(sequence_number), .address_o(address), .data_o(data),
      .good_o(good), .bad_o(bad)
  );
  (* hierconn *) wire [3:0] \u_dut.count_q ;
  (* hierconn *) wire [3:0] \u_dut.bits_q ;
  (* hierconn *) wire [7:0] \u_dut.byte_q ;
  (* hierconn *) wire [31:0] \u_dut.crc_q ;
  (* hierconn *) wire [63:0] \u_dut.frame_q ;
  (* hierconn *) wire \u_dut.escaped_q ;
  (* hierconn *) wire \u_dut.spoiled_q ;

`include "crc.svh"
  function automatic logic [63:0] frame_after(input logic [63:0] frame, input logic [7:0] bits, input logic [3:0] count);
    frame_after = frame;
    for (int k = 0; k < 8; k++) begin
      if (4'(k) < count) frame_after = {bits[k], frame_after[63:1]};
    end
  endfunction

  // The reader: the frame so far.
  logic past_ok_q, escaped_q, spoiled_q, something_q;
  logic [3:0] gap_q, count_q;
  logic [31:0] crc_q;
  logic [63:0] frame_q;
  logic [7:0] plain;
  logic is_end, is_escape, wrong_escape;
  initial past_ok_q = 1'b0;
  assign is_end       = byte_i == 8'hc0;
  assign is_escape    = byte_i == 8'hdb;
  assign plain        = !escaped_q ? byte_i : byte_i == 8'hdc ? 8'hc0 : 8'hdb;
  assign wrong_escape = escaped_q && byte_i != 8'hdc && byte_i != 8'hdd;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {escaped_q, spoiled_q, something_q} <= 3'b000;
      gap_q   <= 4'd0;
      count_q <= 4'd0;
      crc_q   <= '1;
      frame_q <= '0;
    end else begin
      if (gap_q != '1) gap_q <= gap_q + 4'd1;
      if (valid_i) gap_q <= 4'd0;
      if (valid_i && is_end) begin
        {escaped_q, spoiled_q, something_q} <= 3'b000;
        count_q <= 4'd0;
        crc_q   <= '1;
      end else if (valid_i) begin
        something_q <= 1'b1;
        escaped_q   <= is_escape;
        if (is_escape ? escaped_q : wrong_escape) spoiled_q <= 1'b1;
        if (!is_escape) begin
          if (count_q < 4'd13) count_q <= count_q + 4'd1;
          crc_q <= crc_after(crc_q, \u_dut.escaped_q && wrong_escape ? byte_i : plain, 4'd8);
          if (count_q < 4'd8) frame_q <= frame_after(frame_q, wrong_escape ? byte_i : plain, 4'd8);
        end
      end
      if (error_i) begin
        spoiled_q   <= 1'b1;
        something_q <= 1'b1;
      end
    end
  end

  // What the page asks of a request.
  logic [15:0] at;
  logic [31:0] words;
  logic [32:0] last;
  logic read_ok, write_ok, sound;
  assign at       = frame_q[31:16];
  assign words    = frame_q[63:32];
  assign last     = {17'd0, at} + {1'b0, words} - 33'd1;
  assign read_ok  = frame_q[7:0] == 8'd1 && words >= 32'd1 && words <= 32'd64 && last < 33'h4000;
  assign write_ok = frame_q[7:0] == 8'd2 && at < 16'h4000;
  assign sound    = count_q == 4'd12 && !escaped_q && !spoiled_q && crc_q == 32'hdebb20e3 && (read_ok || write_ok);

  logic after_q, sound_q, bad_then_q, valid_q, begins_q, write_q;
  logic [63:0] frame_then_q;
  logic [53:0] request_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end
  always_ff @(posedge clk_i) begin
    past_ok_q    <= 1'b1;
    sound_q      <= valid_i && is_end && sound;
    bad_then_q   <= valid_i && is_end && !sound && something_q;
    valid_q      <= valid;
    begins_q     <= valid_i && !is_end && !is_escape;
    frame_then_q <= frame_q;
    request_q    <= {sequence_number, address, data};
    write_q      <= write;
  end

  always_comb begin
    if (!past_ok_q) assume (!rst_ni);
    assume (!valid_i || gap_q >= 4'd9);
  end

  always_comb begin
    if (past_ok_q && rst_ni) begin
      inside_count: assert (\u_dut.count_q == count_q && count_q <= 4'd13);
      inside_flags: assert (\u_dut.escaped_q == escaped_q && \u_dut.spoiled_q == spoiled_q &&
                            something_q == (count_q != 4'd0 || escaped_q || spoiled_q));
      inside_bits: assert (\u_dut.bits_q <= 4'd8 && (\u_dut.bits_q == 4'd0 || {1'b0, gap_q} + {1'b0, \u_dut.bits_q } <= 5'd8));
      inside_crc: assert (crc_after(\u_dut.crc_q , \u_dut.byte_q , \u_dut.bits_q ) == crc_q);
      inside_frame: assert (frame_after(\u_dut.frame_q , \u_dut.byte_q , count_q <= 4'd8 ? \u_dut.bits_q : 4'd0) == frame_q);
      inside_request: assert (!valid || \u_dut.bits_q == 4'd0);
      if (after_q) begin
        good_is_sound: assert (good == sound_q);
        bad_is_not: assert (bad == bad_then_q);
        request_by_good_only: assert (!valid || valid_q || sound_q);
        request_is_the_frame: assert (!good || (valid && write == (frame_then_q[7:0] == 8'd2) &&
            {sequence_number, address, data} == {frame_then_q[15:8], frame_then_q[29:16], frame_then_q[63:32]}));
        request_stands_still: assert (!valid || !valid_q || ({sequence_number, address, data} == request_q && write == write_q));
        gone_with_the_next: assert (!begins_q || !valid);
      end
      begins: cover (begins_q && count_q == 4'd1);
      counts_a_bad_one: cover (bad);
    end
  end
endmodule

`default_nettype wire
