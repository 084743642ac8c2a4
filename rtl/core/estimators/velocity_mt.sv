// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// M/T velocity over whole encoder cycles: counts between two edges of one kind, divided by the clocks between them,
// then low-pass filtered. Between edges it is at most 1.5 counts over the time since the last one; after 2^(StampW-3)
// clocks without an edge 0 before the low-pass, after 2^(StampW-1) behind it. Latency: edges up to EVENT_AT_SAMPLE are
// in the next tick's raw. Formats: travel [1,15,0] counts, wraps; velocity rad/s, the design's. docs/blocks/velocity.md

`default_nettype none

module velocity_mt #(
    parameter int Counts    = 4096,  // in a turn
    parameter int Window    = 0,     // clocks: with a shorter span, twice the cycles are taken
    parameter int Doublings = 0,     // at most 2^Doublings cycles
    parameter int StampW    = 26     // bits of a time stamp
) (
    input  logic                                                  clk_i,
    input  logic                                                  rst_ni,
    input  logic                                                  at_sample_i,
    input  logic                                                  at_velocity_raw_i,
    input  logic                                                  at_velocity_difference_i,
    input  logic                                                  at_velocity_i,
    input  logic signed [feltgate_pkg::TRAVEL_BITS-1:0]           travel_i,  // counts, live, wraps
    output logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] operand_o,
    input  logic signed [feltgate_pkg::PRODUCT_BITS-1:0]          product_i,
    output logic signed [feltgate_pkg::VELOCITY_W-1:0]            velocity_o,  // rad/s
    output logic                                                  saturated_o  // raw_q saturated
);
  localparam int W = feltgate_pkg::VELOCITY_W;
  localparam int F = feltgate_pkg::VELOCITY_F;
  localparam int MagnitudeW = W - 1;
  localparam int PlaceW     = Doublings + 3;  // edges that are remembered, and counts of a run
  localparam int QuotientW  = $clog2(MagnitudeW + 1);
  localparam int DividendW  = StampW + MagnitudeW;
  // rad/s of half a count in a clock, times 2^F.
  localparam logic [127:0] Pi   = 128'h6487_ed51_10b4_611a;  // 2^61
  localparam logic [127:0] Half = ((Pi * 128'(feltgate_pkg::CLOCK_HZ)) << F) / (128'(Counts) << 61);

  generate
  if (!(Counts >= 4 && Doublings >= 0 && Doublings <= 7 && Window >= 0 && StampW <= 32 &&
        Window < 2 ** (StampW - 5) && (Half << (Doublings + 3)) >> DividendW == 0)) begin : g_check
    the_time_stamps_must_hold_the_window missing ();
  end
  endgenerate

  // Edges. Two counts in one clock, which no decoder gives, end what is known.
  logic [PlaceW-1:0] travel_q;
  logic [       1:0] change;
  logic              moved, jumped, up, up_q, turned;
  assign change = travel_i[1:0] - travel_q[1:0];
  assign moved  = change[0];
  assign jumped = change == 2'b10;
  assign up     = !change[1];

  logic [StampW-1:0] now_q, newest_q, age;
  logic [PlaceW-1:0] run_q;      // counts since the run's first edge: without a turn, rest or jump
  logic              resting_q;  // no edge to count from
  logic              still_q;    // for so long that the low-pass has settled
  logic              fresh_q;    // an edge since the last sample
  logic              aged;
  localparam logic [PlaceW-1:0] LongestRun = PlaceW'(4 << Doublings);
  assign age    = now_q - newest_q;
  assign aged   = age[StampW-1-:3] != '0;
  assign turned = resting_q || up != up_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      now_q     <= '0;
      travel_q  <= '0;
      newest_q  <= '0;
      up_q      <= 1'b0;
      run_q     <= '0;
      resting_q <= 1'b1;
      still_q   <= 1'b0;
      fresh_q   <= 1'b0;
    end else begin
      now_q    <= now_q + 1'b1;
      travel_q <= travel_i[PlaceW-1:0];
      if (moved) begin
        newest_q  <= now_q;
        up_q      <= up;
        resting_q <= 1'b0;
        if (turned) run_q <= '0;
        else if (run_q != LongestRun) run_q <= run_q + 1'b1;
      end else if (jumped || (at_sample_i && !fresh_q && aged)) begin
        resting_q <= 1'b1;
      end
      still_q <= !moved && (still_q || (at_sample_i && resting_q && age[StampW-1]));
      fresh_q <= moved || (fresh_q && !at_sample_i && !jumped);
    end
  end

  // The span: of what the run has, below one cycle; else 2^doublings_q cycles, twice as many if it is shorter than
  // the window, half as many if it is twice as long.
  logic [2:0] doublings_q;
  logic       span_known;
  logic [StampW-1:0] divisor_q;
  logic       value_q, zero_q;
  generate
  if (Doublings > 0) begin : g_window
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) doublings_q <= '0;
      else if (moved && turned) doublings_q <= '0;
      else if (span_known && value_q && !zero_q) begin
        if (divisor_q < StampW'(Window) && doublings_q != 3'(Doublings) &&
            run_q >= (PlaceW'(8) << doublings_q))
          doublings_q <= doublings_q + 1'b1;
        else if (divisor_q >= StampW'(2 * Window) && doublings_q != '0)
          doublings_q <= doublings_q - 1'b1;
      end
    end
  end else begin : g_one_cycle
    assign doublings_q = '0;
  end
  endgenerate

  logic [StampW-1:0] stamps[2**PlaceW];  // of the edge that led to a count; a run does not ask for others
  logic [StampW-1:0] stamp_q;
  logic [PlaceW-1:0] counts, oldest;
  logic              partial;
  assign partial = run_q < PlaceW'(4);
  assign counts  = partial ? run_q : PlaceW'(4) << doublings_q;
  assign oldest  = up_q ? travel_q - counts : travel_q + counts;
  always_ff @(posedge clk_i) begin
    if (moved) stamps[travel_i[PlaceW-1:0]] <= now_q;
    stamp_q <= stamps[oldest];
  end

  // Division: with an edge in the tick, counts over the span; else 1.5 counts over the age.
  logic                  begun_q, ended_q, over_q, negative_next_q, three_q;
  logic [           3:0] shift_q;
  logic [ QuotientW-1:0] left_q;
  logic [ DividendW-1:0] dividend;
  logic [    StampW-1:0] remainder_q;
  logic [MagnitudeW-1:0] quotient_q;
  logic [    StampW  :0] doubled, difference;
  assign dividend   = DividendW'(three_q ? 3 * Half : Half) << shift_q;
  assign doubled    = {remainder_q, quotient_q[MagnitudeW-1]};
  assign difference = doubled - {1'b0, divisor_q};
  assign span_known = left_q == QuotientW'(MagnitudeW);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      begun_q <= 1'b0;
      left_q  <= '0;
      ended_q <= 1'b0;
    end else begin
      begun_q <= at_sample_i;
      ended_q <= left_q == QuotientW'(1) && !at_sample_i;
      if (at_sample_i) left_q <= '0;
      else if (begun_q) left_q <= QuotientW'(MagnitudeW);
      else if (left_q != '0) left_q <= left_q - 1'b1;
    end
  end
  // Written before they are read.
  always_ff @(posedge clk_i) begin
    if (at_sample_i) begin
      value_q         <= fresh_q;
      zero_q          <= fresh_q ? run_q == '0 : resting_q || aged;
      negative_next_q <= !up_q;
      three_q         <= !fresh_q || run_q == PlaceW'(3);
      shift_q         <= !fresh_q ? 4'd0 : !partial ? 4'd3 + 4'(doublings_q) : run_q[1:0] == 2'd2 ? 4'd2 : 4'd1;
      divisor_q       <= fresh_q ? newest_q : age;
    end else if (begun_q && value_q) begin
      divisor_q <= divisor_q - stamp_q;
    end
    if (begun_q) begin
      {remainder_q, quotient_q} <= dividend;
    end else begin
      remainder_q <= difference[StampW] ? doubled[StampW-1:0] : difference[StampW-1:0];
      quotient_q  <= {quotient_q[MagnitudeW-2:0], !difference[StampW]};
    end
    if (span_known) over_q <= remainder_q >= divisor_q;
  end

  // Held between edges; what the division gives is a new value, or an upper bound of the one that is held.
  logic [MagnitudeW-1:0] magnitude_q;
  logic                  negative_q, limited_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      magnitude_q <= '0;
      negative_q  <= 1'b0;
      limited_q   <= 1'b0;
    end else if (ended_q) begin
      if (zero_q || value_q || (!over_q && quotient_q < magnitude_q)) begin
        magnitude_q <= zero_q ? '0 : over_q ? '1 : quotient_q;
        limited_q   <= !zero_q && over_q;
      end
      if (value_q) negative_q <= negative_next_q;
    end
  end

  // Only from a velocity whose step to 0 does not trip velocity_jump, which has the same weight.
  localparam int Weight = W + feltgate_pkg::COEFFICIENT_BITS - feltgate_pkg::P_VELOCITY_A1_F;
  logic slow;
  generate
  if (Weight >= 0 && Weight <= W - 2) begin : g_slow
    assign slow = velocity_o[W-1:Weight] == {(W - Weight) {velocity_o[W-1]}};
  end else begin : g_any
    assign slow = 1'b1;
  end
  endgenerate

  logic signed [W-1:0] raw_q;
  logic                follow_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      raw_q       <= '0;
      follow_q    <= 1'b0;
      saturated_o <= 1'b0;
    end else if (at_velocity_raw_i) begin
      raw_q       <= negative_q ? -$signed({1'b0, magnitude_q}) : $signed({1'b0, magnitude_q});
      follow_q    <= still_q && slow;
      saturated_o <= limited_q;
    end
  end

  lowpass #(
      .Width(W),
      .OperandW(feltgate_pkg::VELOCITY_DIFFERENCE_W),
      .ProductDrop(feltgate_pkg::VELOCITY_DIFFERENCE_F + feltgate_pkg::P_VELOCITY_A1_F - F),
      .ProductW(feltgate_pkg::PRODUCT_BITS)
  ) u_lowpass (
      .clk_i(clk_i),
      .rst_ni(rst_ni),
      .valid_i(at_velocity_difference_i),
      .update_i(at_velocity_i),
      .follow_i(follow_q),
      .x_i(raw_q),
      .operand_o(operand_o),
      .product_i(product_i),
      .y_o(velocity_o)
  );

  logic unused;
  assign unused = ^travel_i;  // its low bits are enough
endmodule

`default_nettype wire
