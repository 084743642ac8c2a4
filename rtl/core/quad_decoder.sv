// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Incremental encoder decoder: synchroniser, glitch filter, x4 decoding, index latch, counters of
// errors and glitches. Position [1,31,0] counts, wraps. Latency: pin to travel_o 3 clocks, pin to
// position_o 4 clocks, plus filter_i clocks. Documentation: docs/blocks/encoder.md
`default_nettype none

module quad_decoder #(
  parameter int ResetPosition = 0,  // test only: start near the wrap
  parameter int IndexCounts   = 0   // counts per revolution, a power of two; 0: index not checked
) (
  input  logic               clk_i,
  input  logic               rst_ni,
  input  logic               a_i,               // asynchronous pins
  input  logic               b_i,
  input  logic               z_i,
  input  logic        [3:0]  filter_i,          // pulses of up to so many clocks are rejected
  input  logic               polarity_i,        // 1: counts in the other direction
  input  logic               set_zero_i,
  input  logic               clear_error_i,
  output logic signed [31:0] position_o,        // counts since the zero, wraps
  output logic        [15:0] travel_o,          // counts, free-running, not set by set_zero_i
  output logic signed [1:0]  step_o,            // change of travel_o with this clock: -1, 0, +1
  output logic        [31:0] count_o,           // the count; position = count - zero
  output logic        [31:0] zero_o,
  output logic        [1:0]  levels_o,          // filtered levels of A (bit 0) and B
  output logic               error_o,           // sticky: both channels changed in one clock
  output logic               illegal_o,         // both channels changed in the previous clock
  output logic        [15:0] error_count_o,     // saturates
  output logic        [15:0] rejected_count_o,  // saturates
  output logic signed [31:0] index_position_o,
  output logic               index_seen_o,
  output logic               index_wrong_o      // sticky: an index came at a wrong count
);

  // Channels: 0 = A, 1 = B, 2 = Z. meta_q can be metastable and drives only sync_q.
  logic [2:0] meta_q, sync_q, previous_q, level_q;
  logic [2:0] changed, rejected;
  logic [1:0] fill_q;
  logic       primed_q;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      meta_q     <= 3'b000;
      sync_q     <= 3'b000;
      previous_q <= 3'b000;
      fill_q     <= 2'b00;
      primed_q   <= 1'b0;
    end else begin
      meta_q     <= {z_i, b_i, a_i};
      sync_q     <= meta_q;
      previous_q <= sync_q;
      fill_q     <= {fill_q[0], 1'b1};
      primed_q   <= fill_q[1];
    end
  end

  // A level that differs from the accepted one must last while its wait_q counts from filter_i to
  // 0. The logic works on whole words, not on bits: a simulator then has a third of the work.
  logic [2:0] differs, elapsed_q, ends, reload, accept;  // elapsed_q: wait_q is 0

  assign differs  = sync_q ^ level_q;
  assign changed  = differs & elapsed_q & {3{primed_q}};
  assign rejected = ~differs & (previous_q ^ sync_q) & {3{primed_q}};
  assign accept   = elapsed_q | {3{!primed_q}};  // the first sample counts as no edge
  assign reload   = ~differs | accept;

  generate
  genvar c;
  for (c = 0; c < 3; c = c + 1) begin : g_filter
    logic [3:0] wait_q;

    assign ends[c] = wait_q == 4'd1;

    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) wait_q <= 4'd0;
      else wait_q <= reload[c] ? filter_i : wait_q - 4'd1;
    end
  end
  endgenerate

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      elapsed_q <= 3'b111;
      level_q   <= 3'b000;
    end else begin
      elapsed_q <= (reload & {3{filter_i == 4'd0}}) | (~reload & ends);
      level_q   <= (accept & sync_q) | (~accept & level_q);
    end
  end

  // Gray order of (A,B): 00 01 11 10 counts up.
  logic              illegal, moved, down;
  logic signed [1:0] step;

  assign illegal = changed[0] && changed[1];
  assign moved   = changed[0] != changed[1];
  assign down    = changed[0] ^ level_q[0] ^ level_q[1] ^ polarity_i;
  assign step    = {moved && down, moved};

  logic signed [31:0] count_q, zero_q, count_d, position_d;

  assign count_d    = count_q + 32'(step);
  assign position_d = count_q - zero_q;

  logic signed [1:0] step_q;
  logic              index_q;

  // set_zero_i moves the zero, not the count, so no edge of the same clock is lost.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      count_q          <= ResetPosition;
      zero_q           <= 32'sd0;
      position_o       <= ResetPosition;
      step_q           <= 2'sd0;
      index_q          <= 1'b0;
      index_position_o <= 32'sd0;
    end else begin
      count_q    <= count_d;
      position_o <= position_d;
      step_q     <= step;
      if (set_zero_i) zero_q <= count_q;
      index_q <= changed[2] && sync_q[2];
      if (index_q) index_position_o <= position_d;
    end
  end

  assign travel_o = count_q[15:0];
  assign step_o   = step_q;
  assign count_o  = count_q;
  assign zero_o   = zero_q;
  assign levels_o = level_q[1:0];

  // Each index must come whole revolutions after the first one. The index rises at the side from
  // which it is entered, so the two directions differ by its width; that much is tolerated.
  generate
  if (IndexCounts > 0) begin : g_index
    localparam int W    = $clog2(IndexCounts);
    localparam int Near = map::INDEX_WIDTH_BITS;

    if (!(IndexCounts == 1 << W && W > Near)) begin : g_check_index
      INDEX_COUNTS_must_be_a_power_of_two missing ();
    end

    logic [W-1:0]    first_q;
    logic [W-1:Near] apart;  // in widths of the index
    logic            wrong;

    assign apart = (W - Near)'((count_q[W-1:0] - first_q) >> Near);
    assign wrong = index_q && index_seen_o && apart != '0 && apart != '1;

    always_ff @(posedge clk_i) if (index_q && !index_seen_o) first_q <= count_q[W-1:0];
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) index_wrong_o <= 1'b0;
      else index_wrong_o <= wrong || (index_wrong_o && !clear_error_i);
    end
  end else begin : g_no_index
    assign index_wrong_o = 1'b0;
  end
  endgenerate

  // One counter is incremented per clock. The rejected counter has priority; an error waits.
  logic error_wait_q, rejected_wait_q, serve_error, serve_rejected;
  logic [15:0] counted, next;

  assign serve_rejected = rejected_wait_q && !clear_error_i;
  assign serve_error    = error_wait_q && !rejected_wait_q && !clear_error_i;
  assign counted        = rejected_wait_q ? rejected_count_o : error_count_o;
  assign next           = clear_error_i ? 16'd0 : counted + 16'd1;

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      error_wait_q     <= 1'b0;
      rejected_wait_q  <= 1'b0;
      error_o          <= 1'b0;
      illegal_o        <= 1'b0;
      index_seen_o     <= 1'b0;
      error_count_o    <= 16'd0;
      rejected_count_o <= 16'd0;
    end else begin
      error_wait_q    <= illegal || (error_wait_q && !serve_error);
      rejected_wait_q <= (rejected != 3'b000) || (rejected_wait_q && !serve_rejected);
      error_o         <= illegal || (error_o && !clear_error_i);
      illegal_o       <= illegal;
      index_seen_o    <= index_q || (index_seen_o && !clear_error_i);
      if (clear_error_i || (serve_error && counted != '1)) error_count_o <= next;
      if (clear_error_i || (serve_rejected && counted != '1)) rejected_count_o <= next;
    end
  end

endmodule

`default_nettype wire
