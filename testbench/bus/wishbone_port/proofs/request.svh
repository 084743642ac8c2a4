// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// For a wrapper with the slave's inputs as ports and a localparam Pipelined: the first reset, the slave, and
// what a request may do by the map.
  `include "reset.svh"

  logic [31:0] dat, reg_wdata;
  logic [11:0] reg_addr;
  logic ack, err, stall, reg_write;
  wishbone_port #(
      .Pipelined(Pipelined)
  ) u_dut (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .cyc_i(cyc_i),
      .stb_i(stb_i),
      .we_i(we_i),
      .adr_i(adr_i),
      .sel_i(sel_i),
      .dat_i(dat_i),
      .dat_o(dat),
      .ack_o(ack),
      .err_o(err),
      .stall_o(stall),
      .reg_addr_o(reg_addr),
      .reg_wdata_o(reg_wdata),
      .reg_write_o(reg_write),
      .reg_rdata_i(reg_rdata_i),
      .reg_busy_i(reg_busy_i)
  );
  (* hierconn *) wire [2:0] \u_dut.good_q ;
  (* hierconn *) wire [2:0] \u_dut.bad_q ;

  logic writable, readable, fits, answer;
  assign writable = adr_i < 12'h200 || adr_i == map::A_CONTROL || adr_i == map::A_COMMAND;
  assign readable = writable || (adr_i >= map::A_SNAPSHOT &&
                                 adr_i < map::A_SNAPSHOT + 12'd64);
  assign fits     = we_i ? writable && sel_i == 4'b1111 : readable;
  assign answer   = ack || err;
