// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// CRC-32 (that of zlib) over the program, ranges and constants, and the table below the
// lines; no program can write these. A word of 36 bits counts as five bytes. One bit per clock; the
// whole CRC takes at most 0.96 ms at 50 MHz. docs/blocks/engine.md

`default_nettype none

module engine_crc (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        start_i,
    input  logic        wait_i,       // another reader uses the barrel: do not begin
    input  logic        beat_i,       // this beat's word is read, an earlier one is there
    input  logic [35:0] word_i,
    input  logic [ 9:0] line_base_i,
    input  logic [31:0] wanted_i,
    output logic        busy_o,
    output logic        reads_o,
    output logic        good_o,
    output logic        done_o,       // one clock
    output logic        program_o,    // memory that is read; neither: data
    output logic        table_o,
    output logic [ 8:0] address_o
);
  localparam logic [1:0] Program = 2'd0;
  localparam logic [1:0] Data = 2'd1;
  localparam logic [1:0] Table = 2'd2;

  logic [1:0] part_q;
  logic [8:0] address_q;
  logic [5:0] left_q;  // clocks of the word still to come: its bits, and one for the comparison
  logic waits_q, read_q, ends;
  assign ends      = part_q == 2'd3 || (part_q == Table && {1'b0, address_q} == line_base_i);
  assign program_o = reads_o && part_q == Program;
  assign table_o   = reads_o && part_q == Table;
  assign address_o = address_q;
  assign busy_o    = waits_q || reads_o;

  // A word comes two beats after its address: a program word takes one round more than a data word.
  logic [1:0] beats_q;
  logic loads;
  assign loads = reads_o && beat_i && beats_q == 2'd2 && left_q == 6'd0 && !ends;

  // A word is added to the CRC as it comes, with its upper bits in front of it. So the last step of
  // a word waits for the next word or for the end: one LUT per bit does both. A step after Start is
  // all ones.
  localparam logic [35:0] Polynomial = 36'h0edb88320;
  localparam logic [35:0] Start = {3'd0, ~Polynomial[31:0], 1'b1};
  // The bits of a word, and the comparison.
  localparam logic [5:0] DataClocks = 6'd32 + 6'd1, WideClocks = 6'd40 + 6'd1;
  logic [35:0] crc_q, step;
  logic [15:0] same_q;  // pairs of bits that are as wanted
  logic steps;
  assign steps = left_q[5:2] != '0 || (left_q[1] && (left_q[0] || ends));
  assign step  = {1'b0, crc_q[35:1]} ^ (Polynomial & {36{crc_q[0]}});
  always_ff @(posedge clk_i) begin
    if (!read_q) crc_q <= Start;
    else if (steps || loads) begin
      crc_q[31:0]  <= step[31:0] ^ (word_i[31:0] & {32{loads}});
      crc_q[35:32] <= step[35:32] ^ (word_i[35:32] & {4{loads && part_q != Data}});
    end
    for (int k = 0; k < 16; k = k + 1) same_q[k] <= ~crc_q[2*k+:2] == wanted_i[2*k+:2];
  end

  logic [8:0] next;
  logic wraps;
  assign {wraps, next} = {1'b0, address_q} + 10'd1;
  always_ff @(posedge clk_i) begin
    if (left_q != 6'd0) left_q <= left_q - 6'd1;
    if (beat_i && beats_q != 2'd2) beats_q <= beats_q + 2'd1;
    if (loads) begin
      left_q    <= part_q == Data ? DataClocks : WideClocks;
      beats_q   <= '0;
      part_q    <= part_q + 2'(wraps);
      address_q <= next | (feltgate_engine_pkg::D_LOWER & {9{wraps && part_q == Program}});
    end
    if (!reads_o) {part_q, address_q, left_q, beats_q} <= '0;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {waits_q, read_q, reads_o, good_o, done_o} <= '0;
    else begin
      done_o <= 1'b0;
      if (start_i) waits_q <= 1'b1;
      read_q <= reads_o;
      if (!reads_o && !read_q && waits_q && !wait_i) begin
        waits_q <= 1'b0;  // also for a start in this clock: every read follows it
        reads_o <= 1'b1;
        good_o  <= 1'b0;
      end
      // Without lines the table ends after its last word.
      if (reads_o && left_q == 6'd0 && ends) begin
        reads_o <= 1'b0;
        done_o  <= 1'b1;
        good_o  <= same_q == '1;
      end
    end
  end
endmodule

`default_nettype wire
