// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// FIFO of 16 events for the host, oldest first, in a RAM that is read with a clock, so a chip may
// use block RAM. An event that comes while it is full is lost and counted. An event is counted and
// readable from two clocks after event_i on; while count_o is 0 the outputs show what their place
// held before. docs/blocks/engine.md

`default_nettype none

module engine_events (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        event_i,
    input  logic [ 8:0] number_i,
    input  logic [31:0] value_i,
    input  logic [31:0] tick_i,
    input  logic        take_i,    // removes the oldest
    output logic [ 4:0] count_o,
    output logic [ 8:0] number_o,  // of the oldest event, as the next two
    output logic [31:0] value_o,
    output logic [31:0] tick_o,
    output logic [ 7:0] lost_o     // events lost; saturates
);
  logic [72:0] events[0:15];
  logic [ 3:0] first_q, next, place;
  logic [ 4:0] count_q, kept;
  logic        keeps, takes, comes_q;  // comes_q: kept in the clock before, not yet counted
  logic [72:0] read, oldest_q;
  initial begin
    for (int n = 0; n < 16; n = n + 1) events[n] = '0;
    oldest_q = '0;
  end
  assign kept    = count_q + 5'(comes_q);
  assign keeps   = event_i && !kept[4];
  assign takes   = take_i && count_q != 5'd0;
  assign place   = first_q + kept[3:0];
  assign next    = first_q + 4'(takes);
  assign read    = events[next];
  assign count_o = count_q;
  assign {number_o, value_o, tick_o} = oldest_q;
  always @(posedge clk_i) begin  // not always_ff: the initial block writes it too
    if (keeps) events[place] <= {number_i, value_i, tick_i};
    oldest_q <= read;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      first_q <= '0;
      count_q <= '0;
      comes_q <= 1'b0;
      lost_o  <= '0;
    end else begin
      first_q <= next;
      count_q <= kept - 5'(takes);
      comes_q <= keeps;
      if (event_i && kept[4] && lost_o != '1) lost_o <= lost_o + 8'd1;
    end
  end
endmodule

`default_nettype wire
