// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Block RAM of 512 words with one write port and one read port. After power-up it holds the words
// of a file, or 0. Latency: address in clock t, word in clock t + 1. A word must not be read in the
// clock in which it is written, because block RAM does not define that result.
// docs/blocks/engine.md

`default_nettype none

module engine_memory #(
    parameter int Width = 32,
    parameter     Content = ""  // $readmemh file; "": all 0
) (
    input  logic             clk_i,
    input  logic [      8:0] read_address_i,
    output logic [Width-1:0] word_o,
    input  logic             write_i,
    input  logic [      8:0] write_address_i,
    input  logic [Width-1:0] data_i
);
  (* no_rw_check, ram_style = "block", ramstyle = "no_rw_check" *)
  logic [Width-1:0] words[0:511];

  initial begin
    for (int n = 0; n < 512; n = n + 1) words[n] = '0;
    if (Content != "") $readmemh(Content, words);
  end

  always @(posedge clk_i) begin  // not always_ff: the initial block writes it too
    word_o <= words[read_address_i];
    if (write_i) words[write_address_i] <= data_i;
  end
endmodule

`default_nettype wire
