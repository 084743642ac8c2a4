// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// 512 words of block RAM with one port to write and one to read, whose words are those of a file
// after power-up, or 0. Latency: address in clock t, word in clock t + 1. Nobody may read a word in the
// clock in which it is written: there the block RAM promises nothing. docs/blocks/engine.md

`default_nettype none

module engine_memory #(
    parameter int Width = 32,
    parameter     Content = ""  // for $readmemh
) (
    input  logic             clk_i,
    input  logic [      8:0] read_address_i,
    output logic [Width-1:0] word_o,
    input  logic             write_i,
    input  logic [      8:0] write_address_i,
    input  logic [Width-1:0] data_i
);
  (* no_rw_check *)
  logic [Width-1:0] words[0:511];

  initial begin
    for (int n = 0; n < 512; n = n + 1) words[n] = '0;
    if (Content != "") $readmemh(Content, words);
  end

  always @(posedge clk_i) begin  // not always_ff: the content is written by another process
    word_o <= words[read_address_i];
    if (write_i) words[write_address_i] <= data_i;
  end
endmodule

`default_nettype wire
