// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// For a wrapper with clk_i, rst_ni and start_i [8:0], the clock of a tick in which a reset ends: the wave and
// the tick as sequencer.clocks proves them. Bit n of the wave is high in clock n, counted from FIRST_WAVE_CLOCK.

  localparam int Clocks = feltgate_pkg::CLOCKS_PER_TICK;
  logic past_ok_q;  // a clock was before this one
  logic tick, tick_q;
  logic [8:0] phase_q;
  logic [feltgate_map_pkg::WAVE_LENGTH-1:0] wave;
  initial past_ok_q = 1'b0;
  always_ff @(posedge clk_i) begin
    past_ok_q <= 1'b1;
    tick_q    <= tick;
    phase_q   <= !rst_ni ? start_i : phase_q == 9'(Clocks - 1) ? 9'd0 : phase_q + 9'd1;
  end
  assign wave = (phase_q < 9'(feltgate_map_pkg::WAVE_LENGTH)) ? feltgate_map_pkg::WAVE_LENGTH'(1) << phase_q : '0;
  assign tick = phase_q == 9'(Clocks - 1 - feltgate_map_pkg::FIRST_WAVE_CLOCK);
  always_comb begin
    if (!past_ok_q) assume (!rst_ni);
    assume (phase_q < 9'(Clocks) && start_i < 9'(Clocks));
  end
