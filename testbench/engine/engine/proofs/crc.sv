// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The check of an image beside a count of its words and a CRC-32 of those, bit by bit: which it asks for, in
// which order, how many bits of each count, and what it says at the end. For any image and any beats.
`default_nettype none

module crc_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic        start_i,
    input logic        wait_i,
    input logic        beat_i,
    input logic [35:0] word_i,
    input logic [31:0] wanted_i
);
  `include "reset.svh"
`include "crc.svh"
  (* anyconst *) logic [9:0] line_base_i;
  always_comb assume (line_base_i <= 10'd512);
  logic busy, reads, good, done, of_program, of_table;
  logic [8:0] address;
  engine_crc u_dut (
      .*,
      .busy_o(busy),
      .reads_o(reads),
      .good_o(good),
      .done_o(done),
      .program_o(of_program),
      .table_o(of_table),
      .address_o(address)
  );
  (* hierconn *) wire \u_dut.loads ;
  (* hierconn *) wire \u_dut.waits_q ;
  (* hierconn *) wire \u_dut.read_q ;
  (* hierconn *) wire [1:0] \u_dut.part_q ;
  (* hierconn *) wire [1:0] \u_dut.beats_q ;
  (* hierconn *) wire [5:0] \u_dut.left_q ;
  (* hierconn *) wire [35:0] \u_dut.crc_q ;
  (* hierconn *) wire [15:0] \u_dut.same_q ;

  // Words: all of the program, of the data those from the ranges on, of the table those below the lines.
  localparam logic [10:0] PROGRAM_WORDS = 11'd512;
  localparam logic [10:0] TABLE_FIRST = 11'd1024 - {2'd0, feltgate_engine_pkg::D_LOWER};
  logic [10:0] words_q, all_words, in_data, in_table;
  logic in_program, of_data;
  assign all_words  = TABLE_FIRST + {1'b0, line_base_i};
  assign in_program = words_q < PROGRAM_WORDS;
  assign of_data    = !in_program && words_q < TABLE_FIRST;
  assign in_data    = words_q - PROGRAM_WORDS + {2'd0, feltgate_engine_pkg::D_LOWER};
  assign in_table   = words_q - TABLE_FIRST;

  // The check: asked for, under way, how long its address has stood, bits of the word that are to come.
  logic asked_q, checks_q, checked_q, ends, takes, begins, done_q, good_q;
  logic [1:0] stood_q;
  logic [5:0] bits_q;
  logic [39:0] word_q;
  logic [31:0] crc_q, wanted_q;
  assign begins = asked_q && !checks_q && !checked_q && !wait_i;
  assign takes  = checks_q && beat_i && stood_q == 2'd2 && bits_q == 6'd0 && words_q != all_words;
  assign ends   = checks_q && bits_q == 6'd0 && words_q == all_words;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {asked_q, checks_q, checked_q, done_q, good_q} <= '0;
      {words_q, stood_q, bits_q} <= '0;
    end else begin
      asked_q   <= (start_i || asked_q) && !begins;
      checked_q <= checks_q;
      done_q    <= ends;
      if (begins) {checks_q, good_q, words_q, stood_q} <= {1'b1, 1'b0, 11'd0, 2'd0};
      if (ends) {checks_q, good_q} <= {1'b0, (crc_q ^ 32'hffffffff) == wanted_q};
      if (takes) {words_q, stood_q} <= {words_q + 11'd1, 2'd0};
      else if (checks_q && beat_i && stood_q != 2'd2) stood_q <= stood_q + 2'd1;
      if (takes) bits_q <= of_data ? 6'd33 : 6'd41;
      else if (bits_q != 6'd0) bits_q <= bits_q - 6'd1;
    end
  end
  always_ff @(posedge clk_i) begin
    if (takes) word_q <= of_data ? {8'd0, word_i[31:0]} : {4'd0, word_i};
    else word_q <= word_q >> 1;
    if (begins) crc_q <= 32'hffffffff;
    else if (bits_q > 6'd1) crc_q <= crc_after(crc_q, word_q[7:0], 4'd1);
    wanted_q <= wanted_i;
  end

  // The block adds a word as it comes, and makes its last step with the next one or at the end.
  logic [31:0] stepped;
  logic [35:0] whole;
  assign stepped = crc_after(\u_dut.crc_q [31:0], 8'd0, 4'd1);
  assign whole   = {4'd0, crc_q} ^ word_q[35:0];

  always_comb begin
    if (rst_ni && past_ok_q) begin
      begins_when_asked: assert (reads == checks_q);
      asks_in_order: assert (!reads || words_q == all_words || (of_program == in_program &&
          of_table == (words_q >= TABLE_FIRST) && address == 9'(in_program ? words_q : of_table ? in_table : in_data)));
      takes_what_stood: assert (\u_dut.loads == takes);
      ends_behind_all: assert (done == done_q);
      good_if_equal: assert (good == good_q);
      busy_from_the_start: assert (busy == (asked_q || checks_q));

      inside_asked: assert (\u_dut.waits_q == asked_q && \u_dut.read_q == checked_q);
      inside_words: assert (words_q <= all_words && (!checks_q || words_q != all_words || bits_q != 6'd0 || ends));
      inside_part: assert (!checks_q || {\u_dut.part_q , address} == (in_program ? words_q : words_q < TABLE_FIRST
          ? {2'd1, in_data[8:0]} : in_table[9] ? {2'd3, 9'd0} : {2'd2, in_table[8:0]}));
      inside_beats: assert (!checks_q || \u_dut.beats_q == stood_q);
      inside_left: assert (!checks_q || (\u_dut.left_q == bits_q && bits_q <= 6'd41));
      inside_idle: assert (checks_q || bits_q == 6'd0);
      inside_bits: assert (bits_q == 6'd0 || (word_q[39:36] == '0 && (word_q >> (bits_q - 6'd1)) == '0));
      inside_crc: assert (!checks_q || !checked_q || (bits_q > 6'd1 ? \u_dut.crc_q == whole
          : words_q == all_words ? \u_dut.crc_q == {4'd0, crc_q} : \u_dut.crc_q [35:32] == '0 && stepped == crc_q));
      inside_same: assert (!ends || (\u_dut.same_q == '1) == ((crc_q ^ 32'hffffffff) == wanted_q));
      inside_first: assert (!checks_q || words_q != 11'd0 || (crc_q == '1 && bits_q == 6'd0));
      inside_young: assert (!checks_q || checked_q || (words_q == 11'd0 && stood_q == 2'd0));
      takes_one: cover (takes && words_q == 11'd0);
      asks_again: cover (asked_q && checks_q && bits_q == 6'd40);
    end
  end
endmodule

`default_nettype wire
