// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// With Fast, motion of several counts in a tick is never chatter nor a dead channel.
`default_nettype none

module far_proof (
    input logic        clk_i,
    input logic        rst_ni,
    input logic        at_levels_i,
    input logic [31:0] tick_count_i,
    input logic [ 1:0] levels_i,
    input logic        index_wrong_i,
    input logic [31:0] count_i,
    input logic [31:0] zero_i,
    input logic [ 1:0] step_i,
    input logic        set_zero_i
);
  `include "reset.svh"
  logic moved, chatters, trip, index_trip, flip_trip;
  encoder_monitor #(.EdgeBits(2), .Fast(1)) u_dut (
      .*,
      .flip_trip_o(flip_trip),
      .moved_o(moved),
      .chatters_o(chatters),
      .trip_o(trip),
      .index_trip_o(index_trip)
  );
  (* hierconn *) wire [5:0] \u_dut.g_fast.count_q ;

  // The count of the last sample, and whether this one's is two or more away; 64 is taken for none.
  logic [5:0] count_q, travel;
  logic far_q, sampled_q;
  assign travel = count_i[5:0] - count_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      count_q   <= '0;
      far_q     <= 1'b0;
      sampled_q <= 1'b0;
    end else begin
      sampled_q <= at_levels_i;
      if (at_levels_i) begin
        count_q <= count_i[5:0];
        far_q   <= travel >= 6'd2 && travel <= 6'd62;
      end
    end
  end
  always_comb begin
    if (rst_ni && past_ok_q) begin
      inside_count: assert (\u_dut.g_fast.count_q == count_q);
      far_is_no_row: assert (!sampled_q || !far_q || (!chatters && !trip));
      far_is_motion: assert (!sampled_q || !far_q || moved);
      far_away: cover (sampled_q && far_q);
    end
  end
  logic unused;
  assign unused = ^{index_trip, flip_trip};
endmodule

`default_nettype wire
