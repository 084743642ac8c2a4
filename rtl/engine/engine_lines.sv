// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Clears the delay lines (the table from line_base on) when states are reset. It writes one word
// per free clock, from word 511 down; no thread runs meanwhile. The whole table takes less than 620
// clocks. docs/blocks/engine.md

`default_nettype none

module engine_lines (
    input  logic       clk_i,
    input  logic       rst_ni,
    input  logic       enter_i,
    input  logic [9:0] line_base_i,
    input  logic       free_i,      // a word can be written in this clock
    output logic       clearing_o,
    output logic       taken_o,     // it is written in this clock
    output logic [8:0] address_o
);
  // Waits two clocks, so that earlier writes of the threads come first.
  logic [1:0] wait_q;
  assign taken_o = clearing_o && !wait_q[1] && free_i && !line_base_i[9];
  always_ff @(posedge clk_i) begin
    if (!clearing_o || enter_i) address_o <= '1;
    else if (taken_o) address_o <= address_o - 9'd1;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      clearing_o <= 1'b0;
      wait_q     <= '0;
    end else begin
      wait_q <= {wait_q[0], 1'b0};
      if (enter_i) begin
        clearing_o <= !line_base_i[9];
        wait_q     <= '1;
      end else if (line_base_i[9] || (taken_o && address_o == line_base_i[8:0])) clearing_o <= 1'b0;
    end
  end
endmodule

`default_nettype wire
