// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Collects the snapshot's words: some are on the operand bus in known wave clocks, the others come
// from their own inputs. Latency: one clock to the RAM, because the bus is late in the clock; a
// word is held until the next one. Documentation: docs/blocks/snapshot.md

`default_nettype none

module snapshot #(
    parameter int ReadBack = 1
) (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic        [ 5:0] slot_fetch_i,
    /* verilator lint_off UNUSEDSIGNAL */  // the block takes its own clocks off the wave
    input  logic        [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic        [31:0] status_i,
    input  logic        [31:0] faults_i,
    input  logic signed [31:0] position_i,
    input  logic        [31:0] tick_count_i,
    input  logic signed [31:0] index_position_i,
    input  logic        [15:0] error_count_i,
    input  logic        [15:0] rejected_count_i,
    input  logic        [31:0] operand_i,  // operand bus; 0 in the other words' clocks
    output logic               valid_o,    // one clock: data_o is the new word of slot_o
    output logic        [ 5:0] slot_o,
    output logic        [31:0] data_o
);
  generate
  if (!(feltgate_map_pkg::FIRST_WAVE_CLOCK + feltgate_map_pkg::EVENT_AT_SNAPSHOT < feltgate_pkg::CLOCKS_PER_TICK))
  begin : g_check_tick
    the_last_word_must_be_stored_before_the_tick_ends missing ();
  end

  if (ReadBack != 0) begin : gen_words
    logic [31:0] word;
    logic        valid;
    assign word = (wave_i[feltgate_map_pkg::READ_AT_STATUS] ? status_i : '0) |
                  (wave_i[feltgate_map_pkg::READ_AT_FAULTS] ? faults_i : '0) |
                  (wave_i[feltgate_map_pkg::READ_AT_POSITION] ? position_i : '0) |
                  (wave_i[feltgate_map_pkg::READ_AT_TICK] ? tick_count_i : '0) |
                  (wave_i[feltgate_map_pkg::READ_AT_INDEX] ? index_position_i : '0) |
                  (wave_i[feltgate_map_pkg::READ_AT_ENCODER] ? {rejected_count_i, error_count_i} : '0);
    assign valid =
        wave_i[feltgate_map_pkg::READ_AT_STATUS] || wave_i[feltgate_map_pkg::READ_AT_FAULTS] ||
        wave_i[feltgate_map_pkg::READ_AT_POSITION] || wave_i[feltgate_map_pkg::READ_AT_TICK] || wave_i[feltgate_map_pkg::READ_AT_INDEX] ||
        wave_i[feltgate_map_pkg::READ_AT_ENCODER] || wave_i[feltgate_map_pkg::READ_AT_VELOCITY] ||
        wave_i[feltgate_map_pkg::READ_AT_TAU_HAT] || wave_i[feltgate_map_pkg::READ_AT_TAU_REF] ||
        wave_i[feltgate_map_pkg::READ_AT_CURRENT_REF] || wave_i[feltgate_map_pkg::READ_AT_VOLTAGE] ||
        wave_i[feltgate_map_pkg::READ_AT_DUTY];
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        valid_o <= 1'b0;
        slot_o  <= '0;
        data_o  <= '0;
      end else begin
        valid_o <= valid;
        if (valid) begin
          slot_o <= slot_fetch_i - 6'(feltgate_map_pkg::FIRST_WAVE_CLOCK);
          data_o <= operand_i | word;
        end
      end
    end
  end else begin : gen_none
    logic unused;
    assign unused  = ^{clk_i, rst_ni, slot_fetch_i, operand_i, status_i, faults_i, position_i, tick_count_i,
                       index_position_i, error_count_i, rejected_count_i};
    assign valid_o = 1'b0;
    assign slot_o  = '0;
    assign data_o  = '0;
  end
  endgenerate
endmodule

`default_nettype wire
