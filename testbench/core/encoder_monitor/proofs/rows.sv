// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// When edges on one channel are chatter, when they are a dead channel, and that motion is neither.
`default_nettype none

module rows_proof (
    input logic                                      clk_i,
    input logic                                      rst_ni,
    input logic at_levels_i,
    input logic [                              31:0] first_i,  // the tick in which a reset ends
    input logic [                               1:0] levels_i,
    input logic                                      index_wrong_i,
    input logic [                              31:0] count_i,
    input logic [                              31:0] zero_i,
    input logic [                               1:0] step_i,
    input logic                                      set_zero_i
);
  localparam int Chatter = map::ONE_CHANNEL_EDGES;
  localparam int Dead = map::DEAD_CHANNEL_EDGES;
  localparam int EdgeBits = 6;  // the block's own, of 4096 counts in a turn
  localparam int ChatterBits = EdgeBits + 2;
  // Ticks without an edge after which a row may have ended, and surely has; ticks of chatter, likewise.
  localparam int LateMin = (map::EDGE_UNITS - 1) << EdgeBits;
  localparam int LateMax = map::EDGE_UNITS << EdgeBits;
  localparam int LongMax = (map::CHATTER_UNITS << ChatterBits) + 1;

  // One sample per tick; the ticks count on.
  `include "reset.svh"
  logic sample, sampled_q, after_q;
  logic [31:0] ticks_q;
  assign sample = at_levels_i;
  always_ff @(posedge clk_i) ticks_q <= !rst_ni ? first_i : sample ? ticks_q + 32'd1 : ticks_q;

  logic moved, chatters, trip, index_trip, flip_trip;
  encoder_monitor u_dut (
      .*,
      .at_levels_i(at_levels_i),
      .tick_count_i(ticks_q),
      .flip_trip_o(flip_trip),
      .moved_o(moved),
      .chatters_o(chatters),
      .trip_o(trip),
      .index_trip_o(index_trip)
  );
  localparam int RowW = $clog2(Dead);
  localparam int EdgeW = $clog2(map::EDGE_UNITS + 1);
  localparam int ChatterW = $clog2(map::CHATTER_UNITS + 1);
  (* hierconn *) wire [RowW-1:0] \u_dut.row_q ;
  wire [RowW-1:0] row = \u_dut.row_q ;
  (* hierconn *) wire [EdgeW-1:0] \u_dut.edge_units_q ;
  wire [EdgeW-1:0] edge_units = \u_dut.edge_units_q ;
  (* hierconn *) wire [ChatterW-1:0] \u_dut.chatter_units_q ;
  wire [ChatterW-1:0] chatter_units = \u_dut.chatter_units_q ;
  (* hierconn *) wire [1:0] \u_dut.levels_q ;
  (* hierconn *) wire \u_dut.of_b_q ;
  (* hierconn *) wire \u_dut.index_wrong_q ;

  // Edges since one came on the other channel than that before, or since the last fault; ticks since an
  // edge, ticks of chatter. Each stays at its most.
  logic [1:0] levels_q, edges;
  logic last_b_q, wrong_q, other, any_edge, moved_q, wrong_now_q;
  logic [5:0] same_q;
  logic [11:0] still_q;
  logic [13:0] long_q;
  logic chatters_q;
  assign edges    = levels_i ^ levels_q;
  assign any_edge = edges != 2'b00;
  assign other    = (edges == 2'b01 && last_b_q) || (edges == 2'b10 && !last_b_q);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      after_q     <= 1'b0;
      sampled_q   <= 1'b0;
      levels_q    <= 2'b00;
      last_b_q    <= 1'b0;
      same_q      <= '0;
      still_q     <= '0;
      long_q      <= '0;
      wrong_q     <= 1'b0;
      wrong_now_q <= 1'b0;
      moved_q     <= 1'b0;
      chatters_q  <= 1'b0;
    end else begin
      after_q    <= 1'b1;
      sampled_q  <= sample;
      chatters_q <= chatters;
      wrong_now_q <= sample && index_wrong_i && !wrong_q;
      if (sample) begin
        wrong_q  <= index_wrong_i;
        levels_q <= levels_i;
        moved_q  <= any_edge;
        if (edges == 2'b01 || edges == 2'b10) last_b_q <= edges[1];
        if (other) same_q <= '0;
        else if (any_edge && same_q != '1) same_q <= same_q + 6'd1;
        if (any_edge) still_q <= '0;
        else if (still_q != '1) still_q <= still_q + 12'd1;
        long_q <= !chatters ? '0 : long_q + 14'd1;
      end
    end
  end

  // Count and zero as they were a clock ago, and what of it is a flip.
  logic [31:0] count_then_q, zero_then_q;
  logic set_zero_then_q, flip_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      count_then_q    <= 32'd0;
      zero_then_q     <= 32'd0;
      set_zero_then_q <= 1'b0;
      flip_q          <= 1'b0;
    end else begin
      count_then_q    <= count_i;
      zero_then_q     <= zero_i;
      set_zero_then_q <= set_zero_i;
      flip_q <= ^{count_i, zero_i} != ^{count_then_q, zero_then_q} && step_i == 2'd0 && !set_zero_then_q;
    end
  end

  // What the sample before saw.
  logic other_then_q, edge_then_q;
  logic [5:0] same_then_q;
  logic [11:0] still_then_q;
  logic [RowW-1:0] row_then_q;
  always_ff @(posedge clk_i) begin
    other_then_q <= other;
    edge_then_q  <= any_edge;
    same_then_q  <= same_q;
    still_then_q <= still_q;
    row_then_q   <= row;
  end

  always_comb begin
    if (rst_ni && past_ok_q && after_q) begin
      in_its_clock: assert (sampled_q || (!trip && !index_trip && chatters == chatters_q));
      motion_is_none: assert (!sampled_q || !other_then_q || (!chatters && !trip));
      chatter_is_a_row: assert (!chatters || same_q >= 6'(Chatter));
      dead_is_a_row: assert (!trip || (same_q >= 6'(Chatter) && still_then_q < 12'(LateMax)));
      a_row_counts: assert (!sampled_q || !edge_then_q || other_then_q || still_then_q >= 12'(LateMin) || trip ||
                                row == row_then_q + RowW'(1));
      slow_edges_are_none: assert (!sampled_q || !edge_then_q || still_then_q < 12'(LateMax) || (!chatters && !trip));
      chatter_ends: assert (!chatters || long_q < 14'(LongMax));
      lasting_chatter_trips: assert (!sampled_q || !chatters_q || chatters || trip || other_then_q ||
                                     still_then_q >= 12'(LateMin));
      moved_is_an_edge: assert (moved == moved_q);
      index_once: assert (index_trip == wrong_now_q);
      flip_is_a_parity: assert (flip_trip == flip_q);
      dies: cover (trip && edge_then_q);
      wears_out: cover (chatters && long_q == 14'd2);
      inside_row: assert (same_q >= 6'(row) && row < RowW'(Dead));
      inside_edge: assert (edge_units == EdgeW'(map::EDGE_UNITS) ? still_q > 12'(LateMin)
          : edge_units < EdgeW'(map::EDGE_UNITS) &&
            still_q <= (12'(edge_units) << EdgeBits) + 12'(EdgeBits'(ticks_q - 32'd1)) &&
            still_q + 12'd63 >= (12'(edge_units) << EdgeBits) + 12'(EdgeBits'(ticks_q - 32'd1)));
      inside_long: assert ((!chatters || chatter_units <= ChatterW'(map::CHATTER_UNITS)) &&
          (!chatters || long_q <= (14'(chatter_units) << ChatterBits) + 14'(ChatterBits'(ticks_q - 32'd1))) &&
          (!chatters || chatter_units != ChatterW'(map::CHATTER_UNITS) ||
           ChatterBits'(ticks_q) == ChatterBits'(1)) && (chatters || long_q <= 14'(LongMax)));
    end
    if (rst_ni && past_ok_q) begin
      inside_begin: assert (after_q || (!chatters && !trip && !index_trip && !moved && edge_units == '0 && row == '0));
      inside_same: assert (\u_dut.levels_q == levels_q && \u_dut.of_b_q == last_b_q && \u_dut.index_wrong_q == wrong_q);
    end
  end
endmodule

`default_nettype wire
