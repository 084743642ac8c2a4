// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Room: encoder pins to position, with the checks of the encoder.
// Timing: the wave samples the position in EVENT_AT_SAMPLE; trips_o is high for one clock.
// docs/architecture.md

`default_nettype none

module encoder (
    input  logic                                             clk_i,
    input  logic                                             rst_ni,
    input  logic        [ feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input  logic        [                              31:0] tick_count_i,
    input  logic                                             enc_a_i,
    input  logic                                             enc_b_i,
    input  logic                                             enc_z_i,
    input  logic        [feltgate_map_pkg::W_CONTROL_FILTER-1:0] filter_i,
    input  logic                                             polarity_i,
    input  logic                                             set_zero_i,        // the position becomes 0
    input  logic                                             clear_i,           // clears errors and index evidence
    output logic signed [                              31:0] position_o,        // counts; sampled, wraps
    output logic signed [feltgate_pkg::SCENE_POSITION_W-1:0] scene_position_o,  // the same, saturated
    output logic signed [     feltgate_pkg::TRAVEL_BITS-1:0] travel_o,          // counts, live: its readers sample it; never zeroed, wraps
    output logic                                             moved_o,           // an edge since the tick before
    output logic                                             chatters_o,        // edges on one channel only
    output logic                                             illegal_o,         // one clock: both channels changed
    output logic                                             error_o,           // sticky: an illegal edge was seen
    output logic        [                              15:0] error_count_o,
    output logic        [                              15:0] rejected_count_o,
    output logic signed [                              31:0] index_position_o,  // counts at the last index
    output logic        [feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits_o,        // bit n: limit n acted
    output logic        [feltgate_map_pkg::W_FAULTS_SEEN-1:0] trips_o            // bit n: cause n, one clock
);
  localparam int SceneW = feltgate_pkg::SCENE_POSITION_W;
  localparam int FaultsW = feltgate_map_pkg::W_FAULTS_SEEN;

  logic signed [31:0] position, count, zero;
  logic signed [1:0] step;
  logic [1:0] levels;
  logic unused_index_seen, index_wrong, channel_trip, index_trip, flip_trip, position_over;

  quad_decoder #(.IndexCounts(feltgate_pkg::INDEX_COUNTS)) u_quad_decoder (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .a_i(enc_a_i), .b_i(enc_b_i), .z_i(enc_z_i),
      .filter_i(filter_i), .polarity_i(polarity_i),
      .set_zero_i(set_zero_i),
      .clear_error_i(clear_i),
      .position_o(position), .travel_o(travel_o),
      .step_o(step), .count_o(count), .zero_o(zero),
      .levels_o(levels), .illegal_o(illegal_o),
      .error_o(error_o),
      .error_count_o(error_count_o), .rejected_count_o(rejected_count_o),
      .index_position_o(index_position_o),
      .index_seen_o(unused_index_seen), .index_wrong_o(index_wrong)
  );

  encoder_monitor u_encoder_monitor (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .at_levels_i(wave_i[feltgate_map_pkg::EVENT_AT_LEVELS]), .tick_count_i(tick_count_i),
      .levels_i(levels), .index_wrong_i(index_wrong),
      .count_i(count), .zero_i(zero), .step_i(step), .set_zero_i(set_zero_i),
      .moved_o(moved_o), .chatters_o(chatters_o),
      .trip_o(channel_trip), .index_trip_o(index_trip), .flip_trip_o(flip_trip)
  );

  assign position_over = position[31:SceneW-1] != {(33 - SceneW) {position[31]}};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      position_o       <= '0;
      scene_position_o <= '0;
    end else if (wave_i[feltgate_map_pkg::EVENT_AT_SAMPLE]) begin
      position_o       <= position;
      scene_position_o <= position_over ? {position[31], {(SceneW - 1) {~position[31]}}} : position[SceneW-1:0];
    end
  end

  assign limits_o = feltgate_map_pkg::W_STATUS_LIMITS'(chatters_o) << feltgate_map_pkg::L_CHATTER;
  assign trips_o = (FaultsW'(channel_trip) << feltgate_map_pkg::FAULT_CHANNEL) |
                   (FaultsW'(index_trip) << feltgate_map_pkg::FAULT_INDEX) |
                   (FaultsW'(flip_trip) << feltgate_map_pkg::FAULT_WORD);

  logic unused;
  assign unused = ^wave_i;  // a room takes its own clocks of the wave
endmodule

`default_nettype wire
