// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Counts the clocks of a tick, starts one wave per tick and fetches the parameter slots ahead of
// it. Clock c of a tick fetches slot c and is wave clock c - FIRST_WAVE_CLOCK.
// Documentation: docs/architecture.md
`default_nettype none

module sequencer #(
  parameter int ClocksPerTick = feltgate_pkg::CLOCKS_PER_TICK,  // at least WaveLength
  parameter int WaveLength    = feltgate_map_pkg::WAVE_LENGTH,
  parameter int ResetTicks    = 0  // test only: start near the wrap of the tick count
) (
  input  logic                  clk_i,
  input  logic                  rst_ni,
  output logic                  tick_o,              // last clock of a tick
  output logic [5:0]            slot_fetch_o,        // its word is on the bus 2 clocks later
  output logic                  scene_slot_fetch_o,  // this slot is in the scene's bank
  output logic [WaveLength-1:0] wave_o,              // one-hot: bit n is clock n of the wave
  output logic [31:0]           tick_count_o
);

  localparam int CLOCK_W = (ClocksPerTick > 64) ? $clog2(ClocksPerTick) : 6;
  localparam logic [CLOCK_W-1:0] BEFORE_LAST = CLOCK_W'(ClocksPerTick - 2);
  localparam int BEFORE_WAVE = feltgate_map_pkg::FIRST_WAVE_CLOCK - 1;

  generate
  if (!(ClocksPerTick >= WaveLength && WaveLength >= feltgate_map_pkg::WAVE_LENGTH))
  begin : g_check_tick
    CLOCKS_PER_TICK_must_hold_the_wave missing ();
  end
  if (!(!feltgate_map_pkg::SCENE_SLOTS[0] && !feltgate_map_pkg::SCENE_SLOTS[63])) begin : g_check_slots
    slots_0_and_63_must_not_be_a_scenes missing ();
  end
  endgenerate

  logic [CLOCK_W-1:0] clock_q;
  logic [5:0]         next_slot;

  assign next_slot = clock_q[5:0] + 6'd1;

  generate
  if (CLOCK_W > 6) begin : g_long_tick
    // After the last slot, fetch slot 63, which no block uses.
    assign slot_fetch_o = (clock_q[CLOCK_W-1:6] != '0) ? 6'd63 : clock_q[5:0];
  end else begin : g_short_tick
    assign slot_fetch_o = clock_q[5:0];
  end
  endgenerate

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      clock_q            <= '0;
      tick_o             <= 1'b0;
      scene_slot_fetch_o <= 1'b0;
      wave_o             <= '0;
      tick_count_o       <= ResetTicks;
    end else begin
      clock_q <= tick_o ? '0 : clock_q + CLOCK_W'(1);
      tick_o  <= clock_q == BEFORE_LAST;
      // Slot 0, which follows the tick, is not in a scene's bank; nor are slot 63 and later clocks.
      scene_slot_fetch_o <= feltgate_map_pkg::SCENE_SLOTS[next_slot] && !tick_o && (clock_q < CLOCK_W'(63));
      wave_o             <= {wave_o[WaveLength-2:0], clock_q == CLOCK_W'(BEFORE_WAVE)};
      if (tick_o) tick_count_o <= tick_count_o + 32'd1;
    end
  end

endmodule

`default_nettype wire
