// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Collects the snapshot's words: some are on the operand bus in known wave clocks, the others come
// from their own inputs. Latency: one clock to the RAM, because the bus is late in the clock; a
// word is held until the next one. Documentation: docs/architecture.md

`default_nettype none

module snapshot #(
    parameter int ReadBack = 1
) (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  logic        [ 5:0] slot_fetch_i,
    input  logic               read_status_i,
    input  logic               read_position_i,
    input  logic               read_tick_i,
    input  logic               read_velocity_i,
    input  logic               read_index_i,
    input  logic               read_encoder_i,
    input  logic               read_tau_hat_i,
    input  logic               read_faults_i,
    input  logic               read_tau_ref_i,
    input  logic               read_current_ref_i,
    input  logic               read_voltage_i,
    input  logic               read_duty_i,
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
    assign word = (read_status_i ? status_i : '0) |
                  (read_faults_i ? faults_i : '0) |
                  (read_position_i ? position_i : '0) |
                  (read_tick_i ? tick_count_i : '0) |
                  (read_index_i ? index_position_i : '0) |
                  (read_encoder_i ? {rejected_count_i, error_count_i} : '0);
    assign valid =
        read_status_i || read_faults_i ||
        read_position_i || read_tick_i || read_index_i ||
        read_encoder_i || read_velocity_i ||
        read_tau_hat_i || read_tau_ref_i ||
        read_current_ref_i || read_voltage_i ||
        read_duty_i;
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
                       index_position_i, error_count_i, rejected_count_i, read_status_i, read_faults_i,
                       read_position_i, read_tick_i, read_index_i, read_encoder_i, read_velocity_i,
                       read_tau_hat_i, read_tau_ref_i, read_current_ref_i, read_voltage_i, read_duty_i};
    assign valid_o = 1'b0;
    assign slot_o  = '0;
    assign data_o  = '0;
  end
  endgenerate
endmodule

`default_nettype wire
