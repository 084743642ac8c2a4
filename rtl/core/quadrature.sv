// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Encoder socket: an incremental encoder with index. docs/blocks/encoder.md

`default_nettype none

module quadrature (
    input  logic           clk_i,
    input  logic           rst_ni,
    input  logic           a_i,        // asynchronous pins
    input  logic           b_i,
    input  logic           z_i,
    input  cfg::encoder_t  encoder_i,
    output cfg::position_t position_o
);
  cfg::position_t s;
  logic signed [1:0] step;
  logic [1:0] levels;
  logic [31:0] zero;
  logic unused_index_seen, index_wrong;
  assign position_o = s;
  assign s.why = '0;
  assign s.polarity_holds = 1'b0;

  quad_decoder #(.IndexCounts(cfg::INDEX_COUNTS)) u_quad_decoder (
      .clk_i(clk_i), .rst_ni(rst_ni), .a_i(a_i), .b_i(b_i), .z_i(z_i), .filter_i(encoder_i.filter),
      .polarity_i(encoder_i.polarity), .set_zero_i(encoder_i.set_zero), .clear_error_i(encoder_i.clear),
      .position_o(s.position), .travel_o(s.travel), .step_o(step), .count_o(s.count), .zero_o(zero), .levels_o(levels),
      .illegal_o(s.illegal), .error_o(s.error), .error_count_o(s.error_count), .rejected_count_o(s.rejected_count),
      .index_position_o(s.index_position), .index_seen_o(unused_index_seen), .index_wrong_o(index_wrong)
  );
  encoder_monitor #(.EdgeBits(cfg::EDGE_UNIT_BITS), .Fast(cfg::FAST_EDGES)) u_encoder_monitor (
      .clk_i(clk_i), .rst_ni(rst_ni), .at_levels_i(encoder_i.sample), .tick_count_i(encoder_i.tick_count),
      .levels_i(levels), .index_wrong_i(index_wrong), .count_i(s.count), .zero_i(zero), .step_i(step),
      .set_zero_i(encoder_i.set_zero), .moved_o(s.moved), .chatters_o(s.chatters), .trip_o(s.trip_channel),
      .index_trip_o(s.trip_index), .flip_trip_o(s.trip_flip)
  );
endmodule

`default_nettype wire
