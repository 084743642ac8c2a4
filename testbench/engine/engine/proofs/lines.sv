// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The lines are filled from the last word down to line_base, each once; nothing below is written.
`default_nettype none

module lines_proof (
    input logic clk_i,
    input logic rst_ni,
    input logic enter_i,
    input logic free_i
);
  `include "reset.svh"
  (* anyconst *) logic [9:0] line_base_i;
  logic clearing, taken, entered_q, clearing_q;
  logic [8:0] address;
  engine_lines u_dut (
      .*,
      .clearing_o(clearing),
      .taken_o(taken),
      .address_o(address)
  );

  // Words since the entry.
  logic [9:0] words_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      words_q    <= '0;
      entered_q  <= 1'b0;
      clearing_q <= 1'b0;
    end else begin
      entered_q  <= enter_i;
      clearing_q <= clearing;
      if (enter_i) words_q <= '0;
      else if (taken) words_q <= words_q + 10'd1;
    end
  end

  always_comb begin
    if (rst_ni && past_ok_q) begin
      lines_only: assert (!taken || {1'b0, address} >= line_base_i);
      each_word: assert (!clearing || words_q == 10'd511 - {1'b0, address});
      begins: assert (!entered_q || clearing == !line_base_i[9]);
      to_the_last: assert (!clearing_q || clearing || entered_q || words_q == 10'd512 - line_base_i);
      inside_lines: assert (!clearing || (!line_base_i[9] && {1'b0, address} >= line_base_i));
      fills_two: cover (clearing_q && !clearing && line_base_i == 10'd510);
    end
  end
endmodule

`default_nettype wire
