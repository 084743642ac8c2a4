// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A memory of any content: a word that was written is read a clock later, and neither a read of it nor a clock
// that is about other words changes it. So it stays for any time between.
`default_nettype none

module memory_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic [ 8:0] read_address_i,
    input logic        write_i,
    input logic [ 8:0] write_address_i,
    input logic [35:0] data_i
);
  `include "reset.svh"
  logic [35:0] word;
  engine_memory #(.Width(36)) u_dut (
      .clk_i(clk_i),
      .read_address_i(read_address_i),
      .word_o(word),
      .write_i(write_i),
      .write_address_i(write_address_i),
      .data_i(data_i)
  );
  always_comb assume (!write_i || write_address_i != read_address_i);

  // What was read and written one clock ago, two, and three.
  logic        two_q, three_q;
  logic        wrote_q, wrote2_q;
  logic [ 8:0] read_q, read2_q, read3_q, written_q, written2_q;
  logic [35:0] word_q, word2_q, data_q, data2_q;
  initial {two_q, three_q} = 2'b00;
  always_ff @(posedge clk_i) begin
    {two_q, three_q} <= {past_ok_q, two_q};
    {wrote_q, wrote2_q} <= {write_i, wrote_q};
    {read_q, read2_q, read3_q} <= {read_address_i, read_q, read2_q};
    {written_q, written2_q} <= {write_address_i, written_q};
    {data_q, data2_q} <= {data_i, data_q};
    {word_q, word2_q} <= {word, word_q};
  end

  always_comb begin
    if (two_q) begin
      written_is_read: assert (!wrote2_q || written2_q != read_q || word == data2_q);
      unwritten_stays: assert (read2_q != read_q || word == word_q);
    end
    if (three_q) begin
      unread_stays: assert (read3_q != read_q || (wrote2_q && written2_q == read_q) || word == word2_q);
      overwrites: cover (wrote2_q && written2_q == read_q && word == 36'h5a5a5a5a5);
    end
  end
endmodule

`default_nettype wire
