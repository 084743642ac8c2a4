// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A ghost shaft turns by at most one count per clock and holds each channel's level for longer than the
// filter rejects. The count is then its angle 3 + filter_i clocks ago, less that of the first sample.
`default_nettype none

module count_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic signed [ 1:0] turn_i,
    input logic        [ 1:0] first_i,  // angle when the reset ends, its lowest bits: any
    input logic        [ 3:0] filter_i,
    input logic               polarity_i,
    input logic               z_i,
    input logic               set_zero_i,
    input logic               clear_error_i
);
  `include "reset.svh"

  // The angle's lowest bits now, and at the last 20 edges: [0] is what the pins showed at the last one.
  logic        fresh_q;  // nothing sampled since the reset
  logic [ 1:0] now, lines;
  logic [ 1:0] at_q [0:19];
  assign now   = fresh_q ? first_i : at_q[0] + turn_i;
  assign lines = {now[1], now[1] ^ now[0]};  // A, B: 00 01 11 10 counts up

  for (genvar i = 0; i < 20; i++) begin : g_history
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) at_q[i] <= 2'd0;
      else if (fresh_q || i == 0) at_q[i] <= now;
      else at_q[i] <= at_q[(i == 0) ? 0 : i - 1];
    end
  end

  // How far the shaft had turned since the first sample, 3 + filter_i clocks ago.
  logic signed [ 1:0] late_turn;
  logic        [31:0] moved_q;
  logic        [ 1:0] base_q;  // of the first sample
  assign late_turn = at_q[5'(filter_i) + 5'd1] - at_q[5'(filter_i) + 5'd2];
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      fresh_q <= 1'b1;
      moved_q <= 32'd0;
      base_q  <= 2'd0;
    end else begin
      fresh_q <= 1'b0;
      if (fresh_q) base_q <= first_i;
      moved_q <= moved_q + 32'(late_turn);
    end
  end

  logic signed [31:0] position;
  logic        [15:0] travel;
  logic signed [ 1:0] step;
  logic signed [31:0] count, zero;
  logic               error, illegal;
  quad_decoder u_dut (
      .*,
      .a_i(lines[1]),
      .b_i(lines[0]),
      .position_o(position),
      .travel_o(travel),
      .step_o(step),
      .count_o(count),
      .zero_o(zero),
      .error_o(error),
      .illegal_o(illegal),
      .error_count_o(),
      .rejected_count_o(),
      .index_position_o(),
      .index_seen_o(),
      .levels_o(),
      .index_wrong_o()
  );
  (* hierconn *) wire [2:0] \u_dut.meta_q ;
  wire [2:0] meta = \u_dut.meta_q ;
  (* hierconn *) wire [2:0] \u_dut.sync_q ;
  wire [2:0] sync = \u_dut.sync_q ;
  (* hierconn *) wire [2:0] \u_dut.level_q ;
  wire [2:0] level = \u_dut.level_q ;
  (* hierconn *) wire [2:0] \u_dut.elapsed_q ;
  wire [2:0] elapsed = \u_dut.elapsed_q ;
  (* hierconn *) wire [1:0] \u_dut.fill_q ;
  wire [1:0] fill = \u_dut.fill_q ;
  (* hierconn *) wire \u_dut.primed_q ;
  wire primed = \u_dut.primed_q ;
  (* hierconn *) wire [3:0] \u_dut.g_filter[0].wait_q ;
  wire [3:0] wait_a = \u_dut.g_filter[0].wait_q ;
  (* hierconn *) wire [3:0] \u_dut.g_filter[1].wait_q ;
  wire [3:0] wait_b = \u_dut.g_filter[1].wait_q ;

  // What the shaft must not do.
  logic [3:0] filter_q;
  logic       polarity_q;
  always_ff @(posedge clk_i) begin
    filter_q   <= filter_i;
    polarity_q <= polarity_i;
  end
  always_comb begin
    if (rst_ni && past_ok_q) begin
      assume (filter_i == filter_q);
      assume (polarity_i == polarity_q);
    end
    assume (turn_i != 2'b10);
  end
  // Channel levels at the last edges, as shift registers: A in [1].
  logic [20:0] a, b;  // [0]: now
  always_comb begin
    a[0] = lines[1];
    b[0] = lines[0];
    for (int i = 0; i < 20; i++) begin
      a[i+1] = at_q[i][1];
      b[i+1] = at_q[i][1] ^ at_q[i][0];
    end
  end
  // A level that has just changed is not given up again within filter_i clocks.
  always_comb begin
    if (!fresh_q) begin
      for (int i = 1; i < 16; i++) begin
        if (i <= filter_i) begin
          if (a[0] != a[1]) assume (a[i+1] == a[1]);
          if (b[0] != b[1]) assume (b[i+1] == b[1]);
        end
      end
    end
  end

  logic [ 1:0] then_angle;
  assign then_angle = at_q[5'(filter_i) + 5'd2];

  logic set_zero_q;
  logic signed [31:0] count_q, zero_q, position_q;
  logic [15:0] travel_q;
  always_ff @(posedge clk_i) begin
    set_zero_q <= set_zero_i;
    count_q    <= count ;
    zero_q     <= zero ;
    position_q <= position;
    travel_q   <= travel;
  end
  logic after_q;  // the clock before was none of a reset
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end

  // The properties.
  always_comb begin
    if (rst_ni && past_ok_q) begin
      count_is_angle: assert (travel == (polarity_i ? 16'(-moved_q) : 16'(moved_q)));
      whole_count_is_angle: assert (count == (polarity_i ? -moved_q : moved_q));
      step_is_turn: assert (step != 2'b10);
      step_is_move: assert (!after_q || travel - travel_q == 16'(step));
      legal_is_no_error: assert (!error && !illegal);
      position_is_count_less_zero: assert (!after_q || position == count_q - zero_q);
      zero_is_count: assert (!after_q || zero == (set_zero_q ? count_q : zero_q));
    end
  end

  always_comb begin
    if (rst_ni && past_ok_q) begin
      turns_at_once: cover (filter_i == 4'd0 && travel == 16'd3);
      turns_through_a_filter: cover (filter_i == 4'd3 && polarity_i && base_q[1:0] == 2'd2 && travel == 16'd2);
      turns_back: cover (travel == 16'hffff && travel_q == 16'd0 && zero != 32'd0);
    end
  end

  // What holds of the inside, by which the above is inductive.
  logic [19:0] run_a, run_b;  // [i]: the level at the last edges 1 .. i is the same
  always_comb begin
    run_a[0] = 1'b1;
    run_b[0] = 1'b1;
    run_a[1] = 1'b1;
    run_b[1] = 1'b1;
    for (int i = 2; i < 20; i++) begin
      run_a[i] = run_a[i-1] && a[i+1] == a[2];
      run_b[i] = run_b[i-1] && b[i+1] == b[2];
    end
  end
  always_comb begin
    if (rst_ni && past_ok_q) begin
      if (fresh_q) begin
        inside_fresh: assert (fill == 2'b00 && !primed );
      end else begin
        inside_meta: assert (meta[1:0] == {b[1], a[1]});
        inside_fill: assert (fill[0] && (!primed || fill[1]));
        if (fill[1]) begin
          inside_sync: assert (sync[1:0] == {b[2], a[2]});
        end
        inside_unmoved: assert (fill[1] || at_q[1] == base_q);
        inside_unprimed: assert (primed || at_q[2] == base_q);
        for (int i = 3; i < 20; i++) begin
          assert (primed || at_q[i] == base_q);
          assert (fill[1] || at_q[i] == base_q);
        end
      end
      if (primed ) begin
        inside_level: assert (level[1:0] == {then_angle[1] ^ then_angle[0], then_angle[1]});
      end
      // The history is that of a legal shaft.
      for (int i = 0; i < 19; i++) begin
        assert (at_q[i] != at_q[i+1] + 2'd2);
        for (int j = 1; j < 16 && i + j < 19; j++) begin
          if (j <= filter_i) begin
            if (a[i+1] != a[i+2]) assert (a[i+2+j] == a[i+2]);
            if (b[i+1] != b[i+2]) assert (b[i+2+j] == b[i+2]);
          end
        end
      end
      for (int j = 1; j < 17; j++) begin
        // Changed j samples ago, and not taken yet.
        if (primed && sync[0] != level[0] && run_a[j] && !run_a[j+1]) begin
          assert (5'(wait_a) == 5'(filter_i) + 5'd1 - 5'(j));
        end
        if (primed && sync[1] != level[1] && run_b[j] && !run_b[j+1]) begin
          assert (5'(wait_b) == 5'(filter_i) + 5'd1 - 5'(j));
        end
      end
      if (primed && sync[0] == level[0]) assert (wait_a == filter_i);
      if (primed && sync[1] == level[1]) assert (wait_b == filter_i);
      inside_moved: assert (fresh_q || then_angle == base_q + moved_q[1:0]);
      inside_elapsed: assert (elapsed[1:0] ==
          {wait_b == 4'd0, wait_a == 4'd0});
    end
  end
endmodule

`default_nettype wire
