// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The events beside a count of those that were kept and of those that were taken, and one of them,
// whichever it is: for any events and any reader.
`default_nettype none

module events_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic        event_i,
    input logic [ 8:0] number_i,
    input logic [31:0] value_i,
    input logic [31:0] tick_i,
    input logic        take_i
);
  localparam logic [4:0] Places = 5'd16;
  `include "reset.svh"
  logic [4:0] count;
  logic [72:0] oldest;
  logic [7:0] lost;
  engine_events u_dut (
      .*,
      .count_o(count),
      .number_o(oldest[72:64]),
      .value_o(oldest[63:32]),
      .tick_o(oldest[31:0]),
      .lost_o(lost)
  );
  (* hierconn *) wire [3:0] \u_dut.first_q ;
  (* hierconn *) wire [3:0] \u_dut.place ;
  (* hierconn *) wire [3:0] \u_dut.next ;
  (* hierconn *) wire \u_dut.keeps ;
  (* hierconn *) wire \u_dut.comes_q ;
  (* hierconn *) wire [72:0] \u_dut.read ;

  // The RAM is taken out: of one place, whichever it is, it gives what was written there last.
  (* anyconst *) logic [3:0] any_place;
  logic [72:0] written_q;
  always_ff @(posedge clk_i) begin
    if (\u_dut.keeps && \u_dut.place == any_place) written_q <= {number_i, value_i, tick_i};
  end
  always_comb if (\u_dut.next == any_place) assume (\u_dut.read == written_q);

  // Events are numbered as they come; of one of 16 in a row the words are kept.
  logic [4:0] kept_q, taken_q, waiting;
  logic [72:0] event_q;
  logic keeps, takes, comes_q;  // comes_q: kept in the clock before
  logic [8:0] lost_q;
  assign waiting = kept_q - taken_q;
  assign keeps   = event_i && waiting != Places;
  assign takes   = take_i && waiting != 5'(comes_q);
  always_ff @(posedge clk_i) if (keeps && kept_q[3:0] == any_place) event_q <= {number_i, value_i, tick_i};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      kept_q  <= '0;
      taken_q <= '0;
      comes_q <= 1'b0;
      lost_q  <= '0;
    end else begin
      comes_q <= keeps;
      if (keeps) kept_q <= kept_q + 5'd1;
      if (takes) taken_q <= taken_q + 5'd1;
      if (event_i && !keeps && lost_q != 9'd255) lost_q <= lost_q + 9'd1;
    end
  end

  always_comb begin
    if (rst_ni && past_ok_q) begin
      count_of_waiting: assert (count == waiting - 5'(comes_q));
      oldest_first: assert (count == 5'd0 || taken_q[3:0] != any_place || oldest == event_q);
      lost_are_counted: assert ({1'b0, lost} == lost_q);
      inside_waiting: assert (waiting <= Places && waiting >= 5'(comes_q));
      inside_comes: assert (\u_dut.comes_q == comes_q);
      inside_first: assert (\u_dut.first_q == taken_q[3:0]);
      inside_kept: assert ({1'b0, any_place - taken_q[3:0]} >= waiting || written_q == event_q);
      loses_one: cover (lost == 8'd1);
      full_in_turn: cover (count == Places && taken_q == 5'd3);
    end
  end
endmodule

`default_nettype wire
