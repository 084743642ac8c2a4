// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of quad_decoder: a reversal in each of the four phases, both ways; events that come together.
// docs/testing.md
`default_nettype none

module quad_decoder_cover (
  input logic               clk_i,
  input logic               rst_ni,
  input logic        [3:0]  filter_i,
  input logic               polarity_i,
  input logic               set_zero_i,
  input logic               clear_error_i,
  input logic        [2:0]  level_q,
  input logic        [2:0]  rejected,
  input logic               moved,
  input logic               down,
  input logic               illegal,
  input logic               index_q,
  input logic               error_wait_q,
  input logic               rejected_wait_q,
  input logic signed [31:0] count_q,
  input logic        [15:0] error_count_o,
  input logic        [15:0] rejected_count_o
);
  // The direction of the last step since the reset.
  logic was_down_q, known_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      was_down_q <= 1'b0;
      known_q    <= 1'b0;
    end else if (moved) begin
      was_down_q <= down;
      known_q    <= 1'b1;
    end
  end

  logic turns_up, turns_down;
  assign turns_up   = moved && known_q && was_down_q && !down;
  assign turns_down = moved && known_q && !was_down_q && down;
  for (genvar n = 0; n < 4; n++) begin : g_phase  // levels of A and B at the reversal
    reversal_up:            cover property (@(posedge clk_i) disable iff (!rst_ni)
                                            turns_up && level_q[1:0] == 2'(n) && filter_i == 4'd0);
    reversal_down:          cover property (@(posedge clk_i) disable iff (!rst_ni)
                                            turns_down && level_q[1:0] == 2'(n) && filter_i == 4'd0);
    filtered_reversal_up:   cover property (@(posedge clk_i) disable iff (!rst_ni)
                                            turns_up && level_q[1:0] == 2'(n) && filter_i != 4'd0);
    filtered_reversal_down: cover property (@(posedge clk_i) disable iff (!rst_ni)
                                            turns_down && level_q[1:0] == 2'(n) && filter_i != 4'd0);
    illegal_here:           cover property (@(posedge clk_i) disable iff (!rst_ni)
                                            illegal && level_q[1:0] == 2'(n));
  end

  for (genvar n = 0; n < 16; n++) begin : g_filter
    counts:  cover property (@(posedge clk_i) disable iff (!rst_ni) moved && filter_i == 4'(n));
    rejects: cover property (@(posedge clk_i) disable iff (!rst_ni) rejected != 3'd0 && filter_i == 4'(n));
  end

  zero_with_step:      cover property (@(posedge clk_i) disable iff (!rst_ni) set_zero_i && moved);
  zero_with_index:     cover property (@(posedge clk_i) disable iff (!rst_ni) set_zero_i && index_q);
  clear_with_error:    cover property (@(posedge clk_i) disable iff (!rst_ni) clear_error_i && illegal);
  both_counters_wait:  cover property (@(posedge clk_i) disable iff (!rst_ni) error_wait_q && rejected_wait_q);
  wraps_up:            cover property (@(posedge clk_i) disable iff (!rst_ni)
                                       moved && !down && count_q == 32'sh7fffffff);
  wraps_down:          cover property (@(posedge clk_i) disable iff (!rst_ni)
                                       moved && down && count_q == -32'sh80000000);
  errors_at_the_end:   cover property (@(posedge clk_i) disable iff (!rst_ni) error_wait_q && error_count_o == '1);
  rejects_at_the_end:  cover property (@(posedge clk_i) disable iff (!rst_ni)
                                       rejected_wait_q && rejected_count_o == '1);
  other_polarity:      cover property (@(posedge clk_i) disable iff (!rst_ni) moved && polarity_i);
endmodule

bind quad_decoder quad_decoder_cover u_cover (.*);

`default_nettype wire
