// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// raw = counts between two edges of one kind, so whole encoder cycles, over the clocks between them; as many cycles as
// the window takes. At a turn raw is 0. Between edges |raw| is at most 1.5 counts over the time since the last one;
// 2^(StampW-3) clocks after it raw is 0, and still_o comes after 2^(StampW-1). A division takes VELOCITY_W + 2 clocks
// from sample_i on; its quotient is held from then on. docs/blocks/velocity.md

`default_nettype none

module span_meter #(
    parameter int StampW = 26  // bits of an edge's time, in clocks
) (
    input  logic                              clk_i,
    input  logic                              rst_ni,
    input  logic                              sample_i,     // one clock a tick
    input  logic signed [               15:0] travel_i,     // counts, wraps; of each clock
    output logic signed [cfg::VELOCITY_W-1:0] raw_o,        // rad/s
    output logic                              saturated_o,  // raw_o is too small
    output logic                              still_o       // new one clock after sample_i
);
  localparam int SizeW     = cfg::VELOCITY_W - 1;
  localparam int PlaceW    = cfg::MT_DOUBLINGS + 3;  // of an edge in the memory
  localparam int DividendW = StampW + SizeW;
  localparam int Longest   = 4 << cfg::MT_DOUBLINGS;  // span, counts
  // rad/s of half a count in a clock, times 2^VELOCITY_F.
  localparam logic [127:0] Pi   = 128'h6487_ed51_10b4_611a;  // 2^61
  localparam logic [127:0] Half = ((Pi * 128'(cfg::CLOCK_HZ)) << cfg::VELOCITY_F) / (128'(cfg::MT_COUNTS) << 61);

  logic [1:0] at;  // clocks since sample_i

  // Edges. A run is the counts since an edge, without a turn, a rest or two counts in a clock, which no decoder gives.
  logic [PlaceW-1:0] place, place_q, run_q;
  logic [1:0] change;
  logic moved, jumped, up, up_q, turned, resting_q, fresh_q, rests;
  logic [StampW-1:0] now_q, newest_q, age;
  assign place  = travel_i[PlaceW-1:0];
  assign change = place[1:0] - place_q[1:0];
  assign moved  = change[0];
  assign jumped = change == 2'd2;
  assign up     = !change[1];
  assign turned = resting_q || up != up_q;
  assign age    = now_q - newest_q;
  assign rests  = age[StampW-1-:3] != '0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {at, now_q, newest_q, place_q, run_q, up_q, fresh_q, still_o} <= '0;
      resting_q <= 1'b1;  // no edge to count from
    end else begin
      at      <= {at[0], sample_i};
      now_q   <= now_q + 1'b1;
      place_q <= place;
      fresh_q <= moved || (fresh_q && !sample_i && !jumped);  // an edge since the last sample
      still_o <= !moved && (still_o || (sample_i && resting_q && age[StampW-1]));
      if (moved) begin
        newest_q  <= now_q;
        up_q      <= up;
        resting_q <= 1'b0;
        if (turned) run_q <= '0;
        else if (run_q != PlaceW'(Longest)) run_q <= run_q + 1'b1;
      end else if (jumped || (sample_i && !fresh_q && rests)) begin
        resting_q <= 1'b1;
      end
    end
  end

  // The span: less than a cycle if the run has no more; else 2^doublings_q cycles, twice as many if they take less time
  // than the window, half as many if they take twice the window.
  logic [2:0] doublings_q;
  logic [PlaceW-1:0] counts, oldest;
  logic [StampW-1:0] stamps[2**PlaceW];  // when the edge to a count came
  logic [StampW-1:0] stamp_q, span_q;
  logic measured_q, zero_q;
  assign counts = run_q < PlaceW'(4) ? run_q : PlaceW'(4) << doublings_q;
  assign oldest = up_q ? place_q - counts : place_q + counts;
  always_ff @(posedge clk_i) begin
    if (moved) stamps[place] <= now_q;
    stamp_q <= stamps[oldest];
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      doublings_q <= '0;
    end else if (moved && turned) begin
      doublings_q <= '0;
    end else if (at[1] && measured_q && !zero_q) begin
      if ($signed(32'(span_q)) < cfg::MT_WINDOW && 32'(doublings_q) != cfg::MT_DOUBLINGS &&
          32'(run_q) >= 32'd8 << doublings_q)
        doublings_q <= doublings_q + 1'b1;
      else if ($signed(32'(span_q)) >= 2 * cfg::MT_WINDOW && doublings_q != '0)
        doublings_q <= doublings_q - 1'b1;
    end
  end

  // Half counts over clocks: those of the span if an edge came in the tick, else 3 over the age.
  logic [PlaceW:0] halves_q;
  logic negative_q, too_large_q, done_q;
  logic [$clog2(SizeW+1)-1:0] left_q;  // bits of the quotient
  logic [StampW-1:0] rest_q;
  logic [SizeW-1:0] low_q;  // the dividend's bits to come, then the quotient's
  logic [StampW:0] next, difference;
  assign next       = {rest_q, low_q[SizeW-1]};
  assign difference = next - {1'b0, span_q};
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {left_q, done_q} <= '0;
    end else begin
      if (at[0])             left_q <= $clog2(SizeW + 1)'(SizeW);
      else if (left_q != '0) left_q <= left_q - 1'b1;
      done_q <= 32'(left_q) == 32'd1;
    end
  end
  always_ff @(posedge clk_i) begin
    if (sample_i) begin
      measured_q <= fresh_q;
      zero_q     <= fresh_q ? run_q == '0 : resting_q || rests;
      negative_q <= !up_q;
      halves_q   <= fresh_q ? {counts, 1'b0} : (PlaceW + 1)'(3);
      span_q     <= fresh_q ? newest_q : age;
    end
    if (at[0]) begin
      if (measured_q) span_q <= span_q - stamp_q;
      {rest_q, low_q} <= DividendW'(Half) * DividendW'(halves_q);
    end else begin
      rest_q <= difference[StampW] ? next[StampW-1:0] : difference[StampW-1:0];
      low_q  <= {low_q[SizeW-2:0], !difference[StampW]};
    end
    if (at[1]) too_large_q <= rest_q >= span_q;
  end

  // A span that has ended gives a new velocity. The age of a span that lasts gives only an upper bound.
  logic [SizeW-1:0] size_q;
  logic negative_size_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {size_q, saturated_o, negative_size_q} <= '0;
    end else if (done_q) begin
      if (measured_q) negative_size_q <= negative_q;
      if (zero_q)
        {saturated_o, size_q} <= '0;
      else if (measured_q || (!too_large_q && low_q < size_q))
        {saturated_o, size_q} <= {too_large_q, low_q | {SizeW{too_large_q}}};
    end
  end
  assign raw_o = negative_size_q ? -$signed({1'b0, size_q}) : $signed({1'b0, size_q});
endmodule

`default_nettype wire
