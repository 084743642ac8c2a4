// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Any levels on the pins: what the filter lets through, and what is flagged, counted and latched.
`default_nettype none

module flags_proof (
    input logic       clk_i,
    input logic       rst_ni,
    input logic [2:0] pins_i,  // Z, B, A
    input logic [3:0] filter_i,
    input logic       polarity_i,
    input logic       set_zero_i,
    input logic       clear_error_i
);
  `include "reset.svh"

  logic signed [31:0] position, index_position;
  logic        [15:0] travel, error_count, rejected_count;
  logic signed [ 1:0] step;
  logic               error, illegal, index_seen;
  localparam int N = 4096;  // of the index: any power of two
  localparam int W = $clog2(N);
  logic [1:0] levels;
  logic       index_wrong;
  quad_decoder #(
      .IndexCounts(N)
  ) u_dut (
      .*,
      .a_i(pins_i[0]),
      .b_i(pins_i[1]),
      .z_i(pins_i[2]),
      .position_o(position),
      .travel_o(travel),
      .count_o(),
      .zero_o(),
      .step_o(step),
      .error_o(error),
      .illegal_o(illegal),
      .error_count_o(error_count),
      .rejected_count_o(rejected_count),
      .index_position_o(index_position),
      .index_seen_o(index_seen),
      .levels_o(levels),
      .index_wrong_o(index_wrong)
  );
  (* hierconn *) wire signed [31:0] \u_dut.count_q ;
  wire signed [31:0] count = \u_dut.count_q ;
  (* hierconn *) wire signed [31:0] \u_dut.zero_q ;
  wire signed [31:0] zero = \u_dut.zero_q ;
  (* hierconn *) wire [2:0] \u_dut.meta_q ;
  wire [2:0] meta = \u_dut.meta_q ;
  (* hierconn *) wire [2:0] \u_dut.sync_q ;
  wire [2:0] sync = \u_dut.sync_q ;
  (* hierconn *) wire [2:0] \u_dut.previous_q ;
  wire [2:0] previous = \u_dut.previous_q ;
  (* hierconn *) wire [2:0] \u_dut.level_q ;
  wire [2:0] level = \u_dut.level_q ;
  (* hierconn *) wire [2:0] \u_dut.elapsed_q ;
  wire [2:0] elapsed = \u_dut.elapsed_q ;
  (* hierconn *) wire \u_dut.primed_q ;
  wire primed = \u_dut.primed_q ;
  (* hierconn *) wire \u_dut.index_q ;
  wire index = \u_dut.index_q ;
  (* hierconn *) wire [3:0] \u_dut.g_filter[0].wait_q ;
  (* hierconn *) wire [3:0] \u_dut.g_filter[1].wait_q ;
  (* hierconn *) wire [3:0] \u_dut.g_filter[2].wait_q ;
  wire [11:0] waits = {\u_dut.g_filter[2].wait_q , \u_dut.g_filter[1].wait_q , \u_dut.g_filter[0].wait_q };

  logic [ 3:0] filter_q;
  logic        after_q, twice_q;  // no reset in the clock before, in the two before
  logic        primed_q, clear_q, error_q, seen_q, rose_q, illegal_q;
  logic [ 2:0] level_q;
  logic [15:0] travel_q, errors_q, rejects_q;
  logic signed [31:0] count_q, zero_q, latched_q;
  always_ff @(posedge clk_i) begin
    filter_q  <= filter_i;
    primed_q  <= primed;
    clear_q   <= clear_error_i;
    error_q   <= error;
    seen_q    <= index_seen;
    rose_q    <= rises;
    illegal_q <= illegal;
    level_q   <= level;
    travel_q  <= travel;
    errors_q  <= error_count;
    rejects_q <= rejected_count;
    count_q   <= count;
    zero_q    <= zero;
    latched_q <= index_position;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      after_q <= 1'b0;
      twice_q <= 1'b0;
    end else begin
      after_q <= 1'b1;
      twice_q <= after_q;
    end
  end
  always_comb if (rst_ni && past_ok_q) assume (filter_i == filter_q);

  logic [2:0] taken;  // a new level was taken in the clock before
  logic       rises;
  assign taken = (after_q && primed_q) ? level ^ level_q : 3'b000;
  assign rises = taken[2] && level[2];

  // The count at the first index, and how far an index is from a whole revolution after it.
  (* hierconn *) wire [W-1:0] \u_dut.g_index.first_q ;
  wire [W-1:0] first = \u_dut.g_index.first_q ;
  logic        [W-1:0] first_q;
  logic signed [W-1:0] slip, slip_q;
  logic                wrong_q, had_seen_q;
  assign slip = count[W-1:0] - first_q;
  always_ff @(posedge clk_i) begin
    if (rises && after_q && !index_seen) first_q <= count[W-1:0];
    slip_q     <= slip;
    wrong_q    <= index_wrong;
    had_seen_q <= index_seen;
  end

  // The synchronised levels of the last clocks, the newest in [0].
  logic [16:0] seen_a_q, seen_b_q, seen_z_q;
  always_ff @(posedge clk_i) begin
    seen_a_q <= {seen_a_q[15:0], sync[0]};
    seen_b_q <= {seen_b_q[15:0], sync[1]};
    seen_z_q <= {seen_z_q[15:0], sync[2]};
  end


  always_comb begin
    if (rst_ni && past_ok_q && after_q) begin
      illegal_is_both: assert (illegal == (taken[0] && taken[1]));
      illegal_does_not_move: assert (!illegal || (step == 2'sd0 && travel == travel_q));
      error_is_sticky: assert (error == (illegal || (error_q && !clear_q)));
      errors_count_up: assert (clear_q ? error_count == 16'd0 :
                               error_count == errors_q || (errors_q != 16'hffff && error_count == errors_q + 16'd1));
      rejects_count_up: assert (clear_q ? rejected_count == 16'd0 : rejected_count == rejects_q ||
                                (rejects_q != 16'hffff && rejected_count == rejects_q + 16'd1));
      index_latches_position: assert (index_position == (rose_q && twice_q ? count_q - zero_q : latched_q));
      index_seen_is_sticky: assert (index_seen == ((rose_q && twice_q) || (seen_q && !clear_q)));
      slipped_index_is_flagged: assert (index_wrong == ((rose_q && twice_q && had_seen_q &&
          (slip_q >= (13'sd1 <<< map::INDEX_WIDTH_BITS) ||
           slip_q < -(13'sd1 <<< map::INDEX_WIDTH_BITS))) || (wrong_q && !clear_q)));
      levels_are_taken: assert (levels == level[1:0]);
      inside_first: assert (!index_seen || first == first_q);
      inside_index: assert (index == rises);
    end
  end
  // A level is taken only after it has lasted filter_i + 1 clocks.
  logic [2:0] lasted, waited;
  always_comb begin
    lasted = 3'b111;
    for (int i = 1; i < 16; i++) begin
      if (i <= filter_i) begin
        if (seen_a_q[i] != seen_a_q[0]) lasted[0] = 1'b0;
        if (seen_b_q[i] != seen_b_q[0]) lasted[1] = 1'b0;
        if (seen_z_q[i] != seen_z_q[0]) lasted[2] = 1'b0;
      end
    end
    waited = 3'b111;  // what has been waited for already was all of one level
    for (int i = 0; i < 16; i++) begin
      if (6'(i) + 6'(waits[3:0]) < 6'(filter_i) && seen_a_q[i] != sync[0]) waited[0] = 1'b0;
      if (6'(i) + 6'(waits[7:4]) < 6'(filter_i) && seen_b_q[i] != sync[1]) waited[1] = 1'b0;
      if (6'(i) + 6'(waits[11:8]) < 6'(filter_i) && seen_z_q[i] != sync[2]) waited[2] = 1'b0;
    end
  end
  always_comb begin
    if (rst_ni && past_ok_q) begin
      glitch_is_rejected: assert ((taken & ~lasted) == 3'b000);
      inside_seen: assert (!primed || {seen_z_q[0], seen_b_q[0], seen_a_q[0]} == previous);
      inside_waited: assert (!primed || ((sync ^ level) & ~waited) == 3'b000);
      inside_elapsed: assert (elapsed == {waits[11:8] == 4'd0, waits[7:4] == 4'd0, waits[3:0] == 4'd0});
      inside_wait: assert (!primed || (waits[3:0] <= filter_i && waits[7:4] <= filter_i &&
                                       waits[11:8] <= filter_i));
      cleared: cover (after_q && error_q && !error);
      counted: cover (after_q && error_count == 16'd2 && rejected_count == 16'd1 && filter_i == 4'd1);
      latched: cover (after_q && index_seen && index_position == -32'sd1);
    end
  end
endmodule

`default_nettype wire
