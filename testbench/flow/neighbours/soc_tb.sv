// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The SoC of docs/examples/litex_soc.py: its master reads and writes the core. Ends with "soc: passed".
// Documentation: docs/other-tools.md
`default_nettype none

module soc_tb;
  timeunit 1ns;
  timeprecision 1ns;
  localparam logic [29:0] BASE = 30'h0c00_0000;  // 0x30000000 in words
  logic clk = 1'b0, rst = 1'b0, cyc = 1'b0, we = 1'b0, ack, err, armed;
  logic [29:0] adr = '0;
  logic [ 3:0] gates;
  logic [31:0] dat = '0, got;
  int wrong = 0;

  soc u_soc (
    .clk(clk), .rst(rst),
    .lever_a(1'b0), .lever_b(1'b0), .lever_z(1'b0), .lever_stop(1'b0),
    .lever_gates(gates), .lever_armed(armed),
    .host_adr(adr), .host_bte(2'd0), .host_cti(3'd0), .host_cyc(cyc), .host_stb(cyc),
    .host_dat_r(got), .host_dat_w(dat), .host_sel(4'hf), .host_we(we),
    .host_ack(ack), .host_err(err)
  );
  always #10 clk = !clk;

  task cycle(input logic writes, input logic [29:0] address, input logic [31:0] word, input logic fits);
    @(negedge clk);
    cyc = 1'b1;
    we  = writes;
    adr = address;
    dat = word;
    @(negedge clk);
    while (!ack && !err) @(negedge clk);
    if (err === fits || (!writes && fits && word !== got)) begin
      $display("soc: 0x%08x: 0x%08x, ack %b, err %b", address, got, ack, err);
      wrong++;
    end
    @(posedge clk);
    #1 cyc = 1'b0;
  endtask

  initial begin
    #1 rst = 1'b1;  // an asynchronous reset has an edge
    repeat (5) @(negedge clk);
    rst = 1'b0;
    cycle(1'b1, BASE + 30'(map::A_TORQUE_LIMIT), 32'd6554, 1'b1);
    repeat (120) @(negedge clk);
    cycle(1'b0, BASE + 30'(map::A_TORQUE_LIMIT), 32'd6554, 1'b1);
    cycle(1'b0, BASE + 30'h800, 32'd0, 1'b0);
    cycle(1'b1, BASE + 30'(map::A_CONTROL), 32'd3, 1'b1);
    repeat (120) @(negedge clk);
    if (armed !== 1'b1) wrong++;
    if (wrong == 0) $display("soc: passed");
    else $display("soc: %0d wrong", wrong);
    $finish;
  end

  initial begin
    #1000000 $display("soc: no end");
    $finish;
  end
endmodule

`default_nettype wire
