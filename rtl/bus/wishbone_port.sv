// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Wishbone B4 slave on the core's register port. A request is on the port in the same clock as on
// the bus. Reads and writes are answered in order, three clocks after they were accepted.
// Documentation: docs/other-tools.md
`default_nettype none

module wishbone_port #(
  parameter int Pipelined = 1  // 0: classic cycles, one request at a time
) (
  input  logic        clk_i,
  input  logic        rst_ni,

  input  logic        cyc_i,
  input  logic        stb_i,
  input  logic        we_i,
  input  logic [11:0] adr_i,        // word address
  input  logic [ 3:0] sel_i,        // for writes; a read gives whole words
  input  logic [31:0] dat_i,
  output logic [31:0] dat_o,        // valid with ack_o of a read
  output logic        ack_o,
  output logic        err_o,        // error: the request had no effect
  output logic        stall_o,      // pipelined only: a write waits for the core

  output logic [11:0] reg_addr_o,
  output logic [31:0] reg_wdata_o,
  output logic        reg_write_o,
  input  logic [31:0] reg_rdata_i,  // three clocks after the address
  input  logic        reg_busy_i
);

  logic at_word, at_snapshot, good, asks, waits, keep;
  logic [2:0] good_q, bad_q;  // requests in progress, the oldest in bit 2

  // Errors: an address without a word, a write to a read-only word, a write of a part of a word.
  assign at_word     = reg_addr_o[11:9] == 3'd0 || reg_addr_o == map::A_CONTROL ||
                       reg_addr_o == map::A_COMMAND;
  assign at_snapshot = reg_addr_o[11:6] == map::A_SNAPSHOT[11:6];
  assign good        = we_i ? at_word && sel_i == 4'hf : at_word || at_snapshot;

  generate
  if (Pipelined != 0) begin : g_pipelined
    assign keep    = cyc_i;
    assign asks    = cyc_i && stb_i;
    assign stall_o = waits;
  end else begin : g_classic
    assign keep    = cyc_i && stb_i;
    assign asks    = cyc_i && stb_i && (good_q | bad_q) == 3'd0;
    assign stall_o = 1'b0;
  end
  endgenerate

  // A write is on the port also while the core is busy, so a disarm or a stop does not wait.
  assign reg_addr_o  = adr_i;
  assign reg_wdata_o = dat_i;
  assign reg_write_o = asks && we_i && good;
  assign waits       = we_i && good && reg_busy_i;

  // A cycle that ends early gets no further answers.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      good_q <= 3'd0;
      bad_q  <= 3'd0;
    end else begin
      good_q <= keep ? {good_q[1:0], asks && good && !waits} : 3'd0;
      bad_q  <= keep ? {bad_q[1:0], asks && !good} : 3'd0;
    end
  end

  assign dat_o = reg_rdata_i;
  assign ack_o = good_q[2] && keep;
  assign err_o = bad_q[2] && keep;

endmodule

`default_nettype wire
