// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Which words of the snapshot are stored in which clock, and that all of one tick are of that tick.
`default_nettype none

module words_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic        [31:0] status_i,
    input logic        [31:0] faults_i,
    input logic signed [31:0] position_i,
    input logic signed [31:0] index_position_i,
    input logic        [15:0] error_count_i,
    input logic        [15:0] rejected_count_i,
    input logic        [31:0] operand_i
);
  // The real clocks.
  logic tick, unused;
  logic [5:0] slot_fetch;
  logic [31:0] tick_count;
  logic [feltgate_map_pkg::WAVE_LENGTH-1:0] wave;
  sequencer u_sequencer (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .tick_o(tick),
      .slot_fetch_o(slot_fetch),
      .scene_slot_fetch_o(unused),
      .wave_o(wave),
      .tick_count_o(tick_count)
  );
  logic [31:0] data;
  logic valid;
  logic [5:0] slot;
  snapshot u_dut (
      .*,
      .slot_fetch_i(slot_fetch),
      .read_status_i(wave[feltgate_map_pkg::READ_AT_STATUS]),
      .read_position_i(wave[feltgate_map_pkg::READ_AT_POSITION]),
      .read_tick_i(wave[feltgate_map_pkg::READ_AT_TICK]),
      .read_velocity_i(wave[feltgate_map_pkg::READ_AT_VELOCITY]),
      .read_index_i(wave[feltgate_map_pkg::READ_AT_INDEX]),
      .read_encoder_i(wave[feltgate_map_pkg::READ_AT_ENCODER]),
      .read_tau_hat_i(wave[feltgate_map_pkg::READ_AT_TAU_HAT]),
      .read_faults_i(wave[feltgate_map_pkg::READ_AT_FAULTS]),
      .read_tau_ref_i(wave[feltgate_map_pkg::READ_AT_TAU_REF]),
      .read_current_ref_i(wave[feltgate_map_pkg::READ_AT_CURRENT_REF]),
      .read_voltage_i(wave[feltgate_map_pkg::READ_AT_VOLTAGE]),
      .read_duty_i(wave[feltgate_map_pkg::READ_AT_DUTY]),
      .tick_count_i(tick_count),
      .valid_o(valid),
      .slot_o(slot),
      .data_o(data)
  );
  localparam int N = feltgate_pkg::CLOCKS_PER_TICK;
  localparam int First = feltgate_map_pkg::FIRST_WAVE_CLOCK;
  (* hierconn *) wire [((N > 64) ? $clog2(N) : 6)-1:0] \u_sequencer.clock_q ;
  wire [8:0] tick_clock = 9'(\u_sequencer.clock_q );

  // The snapshot's words by their slots, which are clocks of the wave.
  localparam logic [63:0] Own = (64'd1 << feltgate_map_pkg::READ_AT_STATUS) | (64'd1 << feltgate_map_pkg::READ_AT_FAULTS) |
      (64'd1 << feltgate_map_pkg::READ_AT_POSITION) | (64'd1 << feltgate_map_pkg::READ_AT_TICK) |
      (64'd1 << feltgate_map_pkg::READ_AT_INDEX) | (64'd1 << feltgate_map_pkg::READ_AT_ENCODER);
  localparam logic [63:0] All = Own | (64'd1 << feltgate_map_pkg::READ_AT_VELOCITY) | (64'd1 << feltgate_map_pkg::READ_AT_TAU_HAT) |
      (64'd1 << feltgate_map_pkg::READ_AT_TAU_REF) | (64'd1 << feltgate_map_pkg::READ_AT_CURRENT_REF) |
      (64'd1 << feltgate_map_pkg::READ_AT_VOLTAGE) | (64'd1 << feltgate_map_pkg::READ_AT_DUTY);

  `include "reset.svh"

  // Slots stored since the last tick ended.
  logic [63:0] stored_q;
  logic whole_q;  // the reset was over before this tick
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      stored_q <= '0;
      whole_q  <= 1'b0;
    end else begin
      stored_q <= tick ? 64'd0 : stored_q | (64'(valid) << slot);
      if (tick) whole_q <= 1'b1;
    end
  end

  // A clock before: where the wave was, and the word that was on its way, the block's own beside an operand of 0.
  logic [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_q;
  logic [31:0] wanted_q;
  logic due_q, after_q;
  logic [63:0] slots;
  assign slots = 64'(wave);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) after_q <= 1'b0;
    else after_q <= 1'b1;
  end
  always_ff @(posedge clk_i) begin
    wave_q   <= wave;
    due_q    <= (slots & All) != '0;
    wanted_q <= wave[feltgate_map_pkg::READ_AT_STATUS] ? status_i : wave[feltgate_map_pkg::READ_AT_FAULTS] ? faults_i :
                wave[feltgate_map_pkg::READ_AT_POSITION] ? position_i : wave[feltgate_map_pkg::READ_AT_TICK] ? tick_count :
                wave[feltgate_map_pkg::READ_AT_INDEX] ? index_position_i :
                wave[feltgate_map_pkg::READ_AT_ENCODER] ? {rejected_count_i, error_count_i} : operand_i;
  end
  always_comb assume ((slots & Own) == '0 || operand_i == '0);
  logic [8:0] at;  // clock of the wave, or of the end of the one before
  assign at = (tick_clock >= 9'(First)) ? tick_clock - 9'(First) : tick_clock + 9'(N - First);
  logic [63:0] came;  // slots whose clock of the tick has come
  always_comb begin
    came = '0;
    for (int n = 0; n < 64; n++) came[n] = 9'(n + feltgate_map_pkg::FIRST_WAVE_CLOCK + 1) < tick_clock;
  end

  always_comb begin
    if (rst_ni && past_ok_q) begin
      slot_is_its_clock: assert (!valid || wave_q == feltgate_map_pkg::WAVE_LENGTH'(1) << slot);
      words_of_the_map: assert (!valid || All[slot]);
      whole_in_its_tick: assert (!tick || !whole_q || (stored_q | (64'(valid) << slot)) == All);
      each_once: assert (!valid || !stored_q[slot]);
      word_is_its_own: assert (!valid || data == wanted_q);
      inside_stored: assert (stored_q == (All & came));
      inside_valid: assert (valid == (after_q && due_q) && (!valid ||
          wave_q == feltgate_map_pkg::WAVE_LENGTH'(1) << slot));
      inside_clock: assert (tick_clock < 9'(N) && tick == (tick_clock == 9'(N - 1)) &&
                            slot_fetch == ((tick_clock < 9'd64) ? tick_clock[5:0] : 6'd63));
      inside_wave: assert (wave == (((whole_q || tick_clock >= 9'(First)) && at < 9'(feltgate_map_pkg::WAVE_LENGTH)) ?
                                    feltgate_map_pkg::WAVE_LENGTH'(1) << at : '0));
      stores: cover (valid && data != 32'd0);
    end
  end
endmodule

`default_nettype wire
