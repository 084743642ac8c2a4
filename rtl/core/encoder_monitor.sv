// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Encoder monitor. Once a tick, with the sample, it checks whether edges come on one channel only. That
// is either chatter on one edge, which lasts only while a torque drives it, or a dead channel. In
// every clock it checks that count and zero do not change without an edge or a new zero.
// Documentation: docs/blocks/encoder.md
`default_nettype none

module encoder_monitor #(
    parameter int EdgeBits = 6,     // bits of the ticks in which the time between edges is counted; 1 or more
    parameter int Fast     = 0      // 1: at the fastest motion several counts come in a tick
) (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        at_levels_i,
    input  logic [31:0] tick_count_i,
    input  logic [1:0]  levels_i,    // filtered levels of A (bit 0) and B
    input  logic        index_wrong_i,  // sticky: the count at an index does not fit
    input  logic [31:0] count_i,     // the decoder's count
    input  logic [31:0] zero_i,      // the count at which the position is 0
    input  logic [1:0]  step_i,      // change of the count with this clock: -1, 0, +1
    input  logic        set_zero_i,  // the zero changes with the next clock
    output logic        moved_o,     // an edge came since the previous tick
    output logic        chatters_o,  // chatter: the torque must not grow
    output logic        trip_o,      // one clock: a channel is dead
    output logic        index_trip_o, // one clock: the count has slipped
    output logic        flip_trip_o  // one clock: a bit of count or zero has flipped
);
  localparam int RowW = $clog2(map::DEAD_CHANNEL_EDGES);
  localparam int EdgeW = $clog2(map::EDGE_UNITS + 1);
  localparam int ChatterW = $clog2(map::CHATTER_UNITS + 1);
  localparam int ChatterBits = EdgeBits + 2;

  logic sample, edge_unit, chatter_unit;
  assign sample       = at_levels_i;
  assign edge_unit    = tick_count_i[EdgeBits-1:0] == '0;
  assign chatter_unit = edge_unit && tick_count_i[ChatterBits-1:EdgeBits] == '0;

  // Two edges in a row on one channel: the shaft has turned back, or the other channel is broken. Edges of
  // both channels in one tick mean that the channels are shorted, unless the count moved by two or more in
  // this tick: then both channels work.
  logic [1:0] levels_q, changed;
  logic       index_wrong_q, of_b_q, moved, both, of_row, late, far;
  assign changed = levels_i ^ levels_q;
  assign moved   = changed != 2'b00 || far;
  assign both    = changed == 2'b11;
  assign of_row  = (both || changed[1] == of_b_q) && !late && !far;

  generate
  if (Fast != 0) begin : g_fast
    logic [5:0] count_q, travel;
    assign travel = count_i[5:0] - count_q;
    assign far    = travel != 6'd0 && travel != 6'd1 && travel != 6'd63;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) count_q <= '0;
      else if (sample) count_q <= count_i[5:0];
    end
  end else begin : g_slow
    assign far = 1'b0;
  end
  endgenerate

  // row_q: edges in a row on one channel. edge_units_q: time since the last edge. chatter_units_q:
  // time for which the row has been long enough for chatters_o.
  logic [RowW-1:0]     row_q;
  logic [EdgeW-1:0]    edge_units_q;
  logic [ChatterW-1:0] chatter_units_q;
  logic                over, dead;
  assign late       = edge_units_q == EdgeW'(map::EDGE_UNITS);
  assign chatters_o = row_q >= RowW'(map::ONE_CHANNEL_EDGES);
  assign over       = chatters_o && chatter_units_q == ChatterW'(map::CHATTER_UNITS);
  assign dead       = over ? !late && (!moved || of_row)
                           : moved && of_row && row_q == RowW'(map::DEAD_CHANNEL_EDGES - 1);

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      levels_q        <= 2'b00;
      of_b_q          <= 1'b0;
      moved_o         <= 1'b0;
      row_q           <= '0;
      edge_units_q    <= '0;
      trip_o          <= 1'b0;
      index_trip_o    <= 1'b0;
      index_wrong_q   <= 1'b0;
    end else begin
      trip_o       <= sample && dead;
      index_trip_o <= sample && index_wrong_i && !index_wrong_q;
      if (sample) begin
        index_wrong_q <= index_wrong_i;
        levels_q <= levels_i;
        moved_o  <= moved;
        if (moved && !both) of_b_q <= changed[1];
        if (over || dead || (moved && !of_row)) row_q <= '0;
        else if (moved) row_q <= row_q + RowW'(1);
        if (moved) edge_units_q <= '0;
        else if (edge_unit && !late) edge_units_q <= edge_units_q + EdgeW'(1);
      end
    end
  end
  // No reset: without chatter the first sample clears it.
  always_ff @(posedge clk_i) begin
    if (sample) begin
      if (!chatters_o || over) chatter_units_q <= '0;
      else if (chatter_unit) chatter_units_q <= chatter_units_q + ChatterW'(1);
    end
  end

  // The parity of count and zero must stay as it is if neither an edge nor a new zero came.
  logic parity, parity_q, zeroed_q;
  assign parity = ^{count_i, zero_i};

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      parity_q    <= 1'b0;
      zeroed_q    <= 1'b0;
      flip_trip_o <= 1'b0;
    end else begin
      parity_q    <= parity;
      zeroed_q    <= set_zero_i;
      flip_trip_o <= parity != parity_q && step_i == 2'd0 && !zeroed_q;
    end
  end

  logic unused;
  assign unused = ^tick_count_i;  // only some of its bits are used
endmodule

`default_nettype wire
