// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What moves by less than the low-pass may never trips, what moves by twice as much does.
`default_nettype none

module jump_proof (
    input logic                                           clk_i,
    input logic                                           rst_ni,
    input logic        [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input logic signed [     feltgate_pkg::VELOCITY_W-1:0] velocity_i
);
  localparam int W = feltgate_pkg::VELOCITY_W;
  // A step is the product of a difference of W + 1 bits and a word of COEFFICIENT_BITS, with A1_F fraction bits.
  localparam logic signed [W+2:0] Most =
      (W + 3)'(1) << (W + feltgate_pkg::COEFFICIENT_BITS - feltgate_pkg::P_VELOCITY_A1_F);

  `include "reset.svh"
  logic after_q, now_q;
  logic signed [W-1:0] last_q;  // of the tick before; 0 after a reset
  logic signed [W+2:0] moved, moved_q;
  assign moved = (W + 3)'(velocity_i) - (W + 3)'(last_q);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      after_q <= 1'b0;
      last_q  <= '0;
      moved_q <= '0;
      now_q   <= 1'b0;
    end else begin
      after_q <= 1'b1;
      now_q   <= wave_i[feltgate_map_pkg::EVENT_AT_JUMP];
      moved_q <= moved;
      if (wave_i[feltgate_map_pkg::EVENT_AT_JUMP]) last_q <= velocity_i;
    end
  end

  logic trip;
  velocity_jump u_dut (
      .*,
      .at_jump_i(wave_i[feltgate_map_pkg::EVENT_AT_JUMP]),
      .trip_o(trip)
  );
  (* hierconn *) wire signed [feltgate_pkg::P_VELOCITY_A1_F-feltgate_pkg::COEFFICIENT_BITS-1:0] \u_dut.gen_compare.before_q ;

  always_comb begin
    if (rst_ni && past_ok_q) begin
      in_its_clock: assert (!trip || now_q);
      possible_never_trips: assert (!trip || moved_q >= Most || moved_q <= -Most);
      impossible_trips: assert (!now_q || trip || (moved_q < 2 * Most && moved_q > -2 * Most));
      inside_last: assert (\u_dut.gen_compare.before_q == last_q[W-1-:feltgate_pkg::P_VELOCITY_A1_F-feltgate_pkg::COEFFICIENT_BITS]);
      inside_after: assert (after_q || !trip);
      falls: cover (trip && moved_q < 0);
      rises: cover (trip && moved_q > 0);
    end
  end
endmodule

`default_nettype wire
