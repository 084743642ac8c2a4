// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A counter of the clocks of a tick beside the sequencer: everything follows from it.
`default_nettype none

module clocks_proof (
    input logic clk_i,
    input logic rst_ni
);
  localparam int N = feltgate_pkg::CLOCKS_PER_TICK;
  localparam int L = feltgate_map_pkg::WAVE_LENGTH;
  localparam int First = feltgate_map_pkg::FIRST_WAVE_CLOCK;

  `include "reset.svh"

  logic         tick, scene_slot_fetch;
  logic [  5:0] slot_fetch;
  logic [L-1:0] wave;
  logic [ 31:0] tick_count;
  sequencer #(
      .ClocksPerTick(N)
  ) u_dut (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .tick_o(tick),
      .slot_fetch_o(slot_fetch),
      .scene_slot_fetch_o(scene_slot_fetch),
      .wave_o(wave),
      .tick_count_o(tick_count)
  );

  logic [15:0] clock_q;  // of the tick
  logic [31:0] ticks_q, tick_count_q;
  logic        tick_q, started_q, began_q;  // began: the wave of this tick has begun
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      clock_q      <= 16'd0;
      ticks_q      <= 32'd0;
      tick_q       <= 1'b0;
      started_q    <= 1'b0;
      began_q      <= 1'b0;
      tick_count_q <= 32'd0;
    end else begin
      clock_q      <= (clock_q == 16'(N - 1)) ? 16'd0 : clock_q + 16'd1;
      if (clock_q == 16'(N - 1)) ticks_q <= ticks_q + 32'd1;
      tick_q       <= tick;
      started_q    <= 1'b1;
      if (clock_q == 16'(N - 1)) began_q <= 1'b1;
      tick_count_q <= tick_count;
    end
  end
  // Wave clock of this clock: of this tick's wave, or of the one before that still runs.
  logic [15:0] at;
  logic        runs;
  assign at   = (clock_q >= 16'(First)) ? clock_q - 16'(First) : clock_q + 16'(N - First);
  assign runs = clock_q >= 16'(First) || began_q;

  (* hierconn *) wire [((N > 64) ? $clog2(N) : 6)-1:0] \u_dut.clock_q ;
  wire [((N > 64) ? $clog2(N) : 6)-1:0] inner = \u_dut.clock_q ;

  always_comb begin
    if (rst_ni && past_ok_q) begin
      tick_is_the_last_clock: assert (tick == (clock_q == 16'(N - 1)));
      wave_is_one_hot: assert ((wave & (wave - L'(1))) == '0);
      wave_is_its_clock: assert (wave == ((runs && at < 16'(L)) ? L'(1) << at : '0));
      slot_is_its_clock: assert (slot_fetch == ((clock_q < 16'd64) ? clock_q[5:0] : 6'd63));
      scene_slot_is_a_scenes: assert (scene_slot_fetch ==
          (clock_q < 16'd64 && feltgate_map_pkg::SCENE_SLOTS[clock_q[5:0]] && clock_q != 16'd0));
      count_counts_ticks: assert (!started_q || tick_count == tick_count_q + 32'(tick_q));
      inside_clock: assert (16'(inner) == clock_q && clock_q < 16'(N));
      first_wave: cover (ticks_q == 32'd0 && wave[1]);
    end
  end
endmodule

`default_nettype wire
