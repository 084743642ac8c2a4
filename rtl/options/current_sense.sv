// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Current from a sigma-delta bit stream: a sinc3 filter in step with the PWM, the offset measured while disarmed, and
// faults; an over-current is latched within 5 us. Latency: Divider + 7 clocks from the
// modulator's clock edge that launches a bit. Format: current [1,1,3*DecimationLog2-1] of the clipping input,
// threshold [0,0,3*FastLog2-1]. docs/blocks/current.md

`default_nettype none

module current_sense #(
    parameter int Divider        = 4,    // clocks of a modulator clock
    parameter int DecimationLog2 = 6,    // of the sinc3 for the current
    parameter int FastLog2       = 3,    // of the sinc3 for over-current
    parameter int Hits           = 3,    // fast results in a row at the threshold or above
    parameter int StuckClocks    = 256,  // modulator clocks without a transition
    parameter int OffsetLog2     = 8,    // results in an average
    parameter int OffsetLimit    = 4096  // LSB of the current
) (
    input  logic                             clk_i,
    input  logic                             rst_ni,
    output logic                             modulator_clock_o,
    input  logic                             data_i,         // changes after a rising edge of that clock
    input  logic                             strobe_i,       // a window begins
    input  logic                             armed_i,        // the offset is kept
    input  logic                             clear_i,        // of the over-current
    input  logic        [  3*FastLog2-2:0]   threshold_i,
    output logic signed [3*DecimationLog2:0] current_o,
    output logic                             aligned_o,      // one clock: current_o is new, and its window began at a strobe
    output logic                             overcurrent_o,  // latched
    output logic                             calibrated_o,   // an offset was measured
    output logic                             offset_fault_o, // the last one was beyond OffsetLimit
    output logic                             stuck_o,
    output logic                             saturated_o     // the last result is at an end of the range
);
  // The sinc3 gain is 2^(3 log2): one more bit holds every result from 0 to it. The sums wrap.
  localparam int W = 3 * DecimationLog2 + 1;
  localparam int SumW = W + OffsetLog2;
  localparam int DividerW = $clog2(Divider);
  localparam int StuckW = $clog2(StuckClocks + 1);
  localparam logic [W-1:0] Half = W'(1) << (W - 2);
  localparam logic signed [W-1:0] End = $signed(Half - (W'(1) << (2 * DecimationLog2)));
  localparam logic signed [W-1:0] Limit = W'(OffsetLimit);

  generate
  if (!(Divider >= 3 && Divider <= 16 && DecimationLog2 >= 5 && DecimationLog2 <= 7 && FastLog2 >= 3 &&
        FastLog2 <= 4 && Hits >= 1 && OffsetLog2 >= 1 && OffsetLog2 <= 12 && StuckClocks >= 2 &&
        OffsetLimit >= 1 && OffsetLimit < 2 ** (3 * DecimationLog2 - 2) &&
        Divider * (Hits + 3) * 2 ** FastLog2 + 7 <= cfg::CLOCK_HZ / 200000)) begin : g_check
    an_over_current_must_be_latched_within_5_us_and_all_parameters_be_in_range missing ();
  end
  endgenerate

  // The modulator's clock rises with the edge after divider_q = 0. The bit that this edge launches is captured with the
  // last clock before the next one, and taken two clocks later.
  logic [DividerW-1:0] divider_q;
  logic                meta_q, bit_q, take, take_q, take_q2;
  assign take = divider_q == DividerW'(1);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      divider_q         <= '0;
      modulator_clock_o <= 1'b0;
      meta_q            <= 1'b0;
      bit_q             <= 1'b0;
      take_q            <= 1'b0;
      take_q2           <= 1'b0;
    end else begin
      divider_q         <= (divider_q == DividerW'(Divider - 1)) ? '0 : divider_q + 1'b1;
      modulator_clock_o <= divider_q < DividerW'(Divider / 2);
      meta_q            <= data_i;
      bit_q             <= meta_q;
      take_q            <= take;
      take_q2           <= take_q;
    end
  end

  // Three integrators, one a clock, for both filters.
  logic [W-1:0] first_q, second_q, third_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      first_q  <= '0;
      second_q <= '0;
      third_q  <= '0;
    end else begin
      if (take) first_q <= first_q + W'(bit_q);
      if (take_q) second_q <= second_q + first_q;
      if (take_q2) third_q <= third_q + second_q;
    end
  end

  // When the third integrator is sampled: each 2^DecimationLog2 modulator clocks, from a strobe on. A strobe counts
  // when the window of the last one is over.
  logic [DecimationLog2-1:0] phase_q;
  logic [1:0] samples_q;  // since the window began, up to 3
  logic [2:0] strobed_q;  // the last three samples were at a strobe
  logic pending_q, due, restart, sample_q, whole_q, aligned_q, whole_q2, aligned_q2;
  logic [3:0] steps_q;
  assign due     = &phase_q;
  assign restart = pending_q && !due && samples_q == 2'd3;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      pending_q  <= 1'b0;
      phase_q    <= '0;
      samples_q  <= 2'd0;
      strobed_q  <= 3'd0;
      sample_q   <= 1'b0;
      whole_q    <= 1'b0;
      aligned_q  <= 1'b0;
      whole_q2   <= 1'b0;
      aligned_q2 <= 1'b0;
      steps_q    <= 4'd0;
    end else begin
      pending_q <= strobe_i || (pending_q && !take);
      steps_q   <= {steps_q[2:0], take_q2 && sample_q};
      if (take) begin
        phase_q   <= restart ? '0 : phase_q + 1'b1;
        sample_q  <= due || restart;
        whole_q   <= due && samples_q[1];
        aligned_q <= strobed_q[2];
        if (restart) samples_q <= 2'd0;
        else if (due && samples_q != 2'd3) samples_q <= samples_q + 2'd1;
        if (due || restart) strobed_q <= {strobed_q[1:0], pending_q};
      end
      if (steps_q[0]) begin
        whole_q2   <= whole_q;
        aligned_q2 <= aligned_q;
      end
    end
  end

  // Three combs, one a clock: what the last sample has left is taken off, and the delays go round.
  logic [W-1:0] comb_q, comb_in, delay_q, delay_q2, delay_q3;
  assign comb_in = steps_q[0] ? third_q : comb_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      comb_q   <= '0;
      delay_q  <= '0;
      delay_q2 <= '0;
      delay_q3 <= '0;
    end else if (steps_q[2:0] != 3'd0) begin
      comb_q   <= comb_in - delay_q;
      delay_q  <= delay_q2;
      delay_q2 <= delay_q3;
      delay_q3 <= comb_in;
    end
  end

  // The offset: of two averages in a row while disarmed the second, since the current falls in the first.
  logic                        result, last, settled_q, in_limit;
  logic signed [        W-1:0] value, offset_q, average;
  logic signed [     SumW-1:0] sum_q, sum;
  logic        [OffsetLog2-1:0] count_q;
  assign result   = steps_q[3] && whole_q2;
  assign value    = $signed(comb_q - Half);
  assign last     = &count_q;
  assign sum      = sum_q + SumW'(value);
  assign average  = sum[SumW-1-:W];
  assign in_limit = average >= -Limit && average <= Limit;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      current_o      <= '0;
      aligned_o      <= 1'b0;
      saturated_o    <= 1'b0;
      offset_q       <= '0;
      calibrated_o   <= 1'b0;
      offset_fault_o <= 1'b0;
      settled_q      <= 1'b0;
      count_q        <= '0;
      sum_q          <= SumW'(1) << (OffsetLog2 - 1);
    end else begin
      aligned_o <= result && aligned_q2;
      if (result) begin
        current_o   <= value - offset_q;
        saturated_o <= value >= End || value <= -End;
      end
      if (armed_i) begin
        settled_q <= 1'b0;
        count_q   <= '0;
        sum_q     <= SumW'(1) << (OffsetLog2 - 1);
      end else if (result) begin
        count_q <= count_q + 1'b1;
        sum_q   <= last ? SumW'(1) << (OffsetLog2 - 1) : sum;
        if (last) settled_q <= 1'b1;
        if (last && settled_q) begin
          offset_fault_o <= !in_limit;
          if (in_limit) begin
            offset_q     <= average;
            calibrated_o <= 1'b1;
          end
        end
      end
    end
  end

  overcurrent #(.FilterLog2(FastLog2), .Hits(Hits)) u_overcurrent (
      .clk_i(clk_i), .rst_ni(rst_ni), .take_i(take), .integrated_i(take_q2), .integral_i(third_q[3*FastLog2:0]),
      .threshold_i(threshold_i), .clear_i(clear_i), .overcurrent_o(overcurrent_o)
  );

  // A modulator without transitions.
  logic                last_bit_q;
  logic [StuckW-1:0] quiet_q;
  assign stuck_o = quiet_q == StuckW'(StuckClocks);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      last_bit_q <= 1'b0;
      quiet_q    <= '0;
    end else if (take) begin
      last_bit_q <= bit_q;
      if (bit_q != last_bit_q) quiet_q <= '0;
      else if (!stuck_o) quiet_q <= quiet_q + 1'b1;
    end
  end
endmodule

`default_nettype wire
