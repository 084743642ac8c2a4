// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// FIFO of 16 events for the host, oldest first. An event that comes while it is full is lost and
// counted. An event is readable in the clock after event_i. docs/blocks/engine.md

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
  initial begin
    for (int n = 0; n < 16; n = n + 1) events[n] = '0;
  end
  logic [3:0] first_q;
  logic [4:0] count_q;
  logic keeps, takes;
  logic [3:0] place;
  assign keeps   = event_i && !count_q[4];
  assign takes   = take_i && count_q != 5'd0;
  assign place   = first_q + count_q[3:0];
  assign count_o = count_q;
  assign {number_o, value_o, tick_o} = events[first_q];
  always @(posedge clk_i) begin  // not always_ff: the initial block writes it too
    if (keeps) events[place] <= {number_i, value_i, tick_i};
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      first_q <= '0;
      count_q <= '0;
      lost_o  <= '0;
    end else begin
      if (takes) first_q <= first_q + 4'd1;
      if (keeps != takes) count_q <= keeps ? count_q + 5'd1 : count_q - 5'd1;
      if (event_i && count_q[4] && lost_o != '1) lost_o <= lost_o + 8'd1;
    end
  end
endmodule

`default_nettype wire
