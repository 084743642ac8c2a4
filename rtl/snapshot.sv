// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The snapshot's words: which clocks of the wave hold one on the operand bus, and those that are no
// operand of a product. Combinational. Documentation: docs/blocks/snapshot.md

`default_nettype none

module snapshot #(
    parameter int ReadBack = 1
) (
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
    output logic        [31:0] word_o,   // 0 in the clocks of the operands
    output logic               valid_o,
    output logic        [ 5:0] slot_o
);
  assign slot_o = slot_fetch_i - 6'(feltgate_map_pkg::FIRST_WAVE_CLOCK);

  generate
  if (ReadBack != 0) begin : gen_words
    assign word_o = (wave_i[feltgate_map_pkg::R_STATUS] ? status_i : '0) |
                    (wave_i[feltgate_map_pkg::R_FAULTS] ? faults_i : '0) |
                    (wave_i[feltgate_map_pkg::R_POSITION] ? position_i : '0) |
                    (wave_i[feltgate_map_pkg::R_TICK] ? tick_count_i : '0) |
                    (wave_i[feltgate_map_pkg::R_INDEX] ? index_position_i : '0) |
                    (wave_i[feltgate_map_pkg::R_ENCODER] ? {rejected_count_i, error_count_i} : '0);
    assign valid_o =
        wave_i[feltgate_map_pkg::R_STATUS] || wave_i[feltgate_map_pkg::R_FAULTS] || wave_i[feltgate_map_pkg::R_POSITION] ||
        wave_i[feltgate_map_pkg::R_TICK] || wave_i[feltgate_map_pkg::R_INDEX] ||
        wave_i[feltgate_map_pkg::R_ENCODER] || wave_i[feltgate_map_pkg::R_VELOCITY] ||
        wave_i[feltgate_map_pkg::R_TAU_HAT] || wave_i[feltgate_map_pkg::R_TAU_REF] ||
        wave_i[feltgate_map_pkg::R_CURRENT_REF] || wave_i[feltgate_map_pkg::R_VOLTAGE] ||
        wave_i[feltgate_map_pkg::R_DUTY];
  end else begin : gen_none
    logic unused;
    assign unused  = ^{status_i, faults_i, position_i, tick_count_i, index_position_i, error_count_i,
                       rejected_count_i};
    assign word_o  = '0;
    assign valid_o = 1'b0;
  end
  endgenerate
endmodule

`default_nettype wire
