// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Whatever a program says, it writes its thread's private words, without the inputs, its thread's exchange
// words, and lines. Memories hold anything.
`default_nettype none

module own_words_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic [ 3:0] run_i,
    input logic [ 3:0] request_i,
    input logic [ 3:0] first_i,
    input logic        bank_i,
    input logic        write_data_i,
    input logic        write_program_i,
    input logic        write_table_i,
    input logic [ 8:0] write_address_i,
    input logic [31:0] write_word_i,
    input logic [ 3:0] write_high_i,
    input logic [ 3:0] read_op_i,
    input logic        keeps_i,
    input logic [ 8:0] read_data_i,
    input logic [ 8:0] read_address_i
);
  `include "reset.svh"
  (* anyconst *) logic [9:0] line_base_i;
  logic free, free_q;
  /* verilator lint_off PINMISSING */
  engine_barrel u_dut (
      .*,
      .started_o(), .ended_o(), .thread5_o(), .result_o(), .output_o(), .event_o(), .last_o(),
      .thread7_o(), .number_o(), .free_o(free), .read_o(), .program_o(), .high_read_o(), .table_high_o()
  );
  /* verilator lint_on PINMISSING */
  (* hierconn *) wire \u_dut.valid6_q ;
  (* hierconn *) wire \u_dut.data6_q ;
  (* hierconn *) wire \u_dut.program6_q ;
  (* hierconn *) wire \u_dut.stores6_q ;
  (* hierconn *) wire [2:0] \u_dut.turn6_q ;
  (* hierconn *) wire [8:0] \u_dut.d6_q ;
  (* hierconn *) wire [8:0] \u_dut.table6_q ;

  // The system writes in the clock after a free one.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) free_q <= 1'b0;
    else free_q <= free;
  end
  always_comb assume (free_q || !(write_data_i || write_program_i || write_table_i));

  logic [1:0] thread;
  logic [8:0] word;
  logic own, exchange;
  assign thread   = \u_dut.turn6_q [1:0];
  assign word     = \u_dut.d6_q ;
  assign own      = word[8:6] == {1'b0, thread} && word[5:4] != 2'd3;
  assign exchange = word[8:4] == {3'b100, thread};
  always_comb begin
    if (rst_ni && past_ok_q) begin
      own_words: assert (!\u_dut.valid6_q || !\u_dut.data6_q || own || exchange);
      no_program: assert (!\u_dut.valid6_q || !\u_dut.program6_q );
      lines_only: assert (!\u_dut.valid6_q || !\u_dut.stores6_q || {1'b0, \u_dut.table6_q } >= line_base_i);
      writes_own: cover (\u_dut.valid6_q && \u_dut.data6_q && own);
      writes_a_line: cover (\u_dut.valid6_q && \u_dut.stores6_q );
    end
  end
endmodule

`default_nettype wire
