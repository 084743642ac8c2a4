// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core behind its Wishbone slave: words are read and written, a motor that stands is armed and disarmed.
// Ends with "smoke: passed". Documentation: docs/other-tools.md
`default_nettype none

module smoke_tb;
  timeunit 1ns;
  timeprecision 1ns;
  logic clk = 1'b0, rst_n = 1'b0, cyc = 1'b0, stb = 1'b0, we = 1'b0, ack, err, stall, armed;
  logic [11:0] adr = '0;
  logic [ 3:0] sel = 4'hf, gates;
  logic [31:0] dat = '0, got;
  int wrong = 0;

  wishbone_core u_core (
    .clk_i(clk), .rst_ni(rst_n),
    .enc_a_i(1'b0), .enc_b_i(1'b0), .enc_z_i(1'b0), .stop_i(1'b0),
    .gates_o(gates), .armed_o(armed),
    .cyc_i(cyc), .stb_i(stb), .we_i(we), .adr_i(adr), .sel_i(sel), .dat_i(dat),
    .dat_o(got), .ack_o(ack), .err_o(err), .stall_o(stall)
  );
  always #10 clk = !clk;

  // A classic cycle; `fits` is whether it is acknowledged.
  task cycle(input logic writes, input logic [11:0] address, input logic [31:0] word, input logic fits);
    @(negedge clk);
    cyc = 1'b1;
    stb = 1'b1;
    we  = writes;
    adr = address;
    dat = word;
    @(negedge clk);
    while (!ack && !err) @(negedge clk);
    if (ack !== fits || stall !== 1'b0) wrong++;
    // The word stands in the clock of the answer.
    if (!writes && fits && word !== got) begin
      $display("smoke: 0x%03x reads 0x%08x instead of 0x%08x", address, got, word);
      wrong++;
    end
    @(posedge clk);
    #1 cyc = 1'b0;
    stb = 1'b0;
  endtask

  initial begin
    repeat (5) @(negedge clk);
    rst_n = 1'b1;
    cycle(1'b0, map::A_TORQUE_LIMIT, cfg::parameter_reset(9'(map::A_TORQUE_LIMIT)), 1'b1);
    cycle(1'b1, map::A_TORQUE_LIMIT, 32'd6554, 1'b1);
    cycle(1'b1, map::A_HOLD_TIME, 32'd77, 1'b1);
    cycle(1'b0, 12'h800, 32'd0, 1'b0);
    repeat (120) @(negedge clk);
    cycle(1'b0, map::A_TORQUE_LIMIT, 32'd6554, 1'b1);
    cycle(1'b0, map::A_HOLD_TIME, 32'd77, 1'b1);
    cycle(1'b1, map::A_CONTROL, 32'd3, 1'b1);
    repeat (120) @(negedge clk);
    if (armed !== 1'b1) wrong++;
    cycle(1'b1, map::A_CONTROL, 32'd1, 1'b1);
    repeat (120) @(negedge clk);
    if (armed !== 1'b0 || gates !== 4'd0) wrong++;
    if (wrong == 0) $display("smoke: passed");
    else $display("smoke: %0d wrong", wrong);
    $finish;
  end

  initial begin
    #1000000 $display("smoke: no end");
    $finish;
  end
endmodule

`default_nettype wire
