// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// When bits are added and sampled, what the combs give, which results count, the offset, the over-current's latch
// and the faults: counts of the modulator's clocks and of results beside those of the block.
`default_nettype none

module sense_proof (
    input logic       clk_i,
    input logic       rst_ni,
    input logic       data_i,
    input logic       strobe_i,
    input logic       armed_i,
    input logic       clear_i,
    input logic [7:0] threshold_i
);
  localparam int Divider = 4;
  localparam int M = 64;
  localparam int F = 8;
  localparam int Hits = 3;
  localparam int Stuck = 256;
  localparam int AverageLog2 = 8;
  localparam int Average = 256;
  localparam int W = 19;
  localparam int FastW = 10;

  `include "reset.svh"

  logic modulator_clock, aligned, overcurrent, calibrated, offset_fault, stuck, saturated;
  logic signed [W-1:0] current;
  current_sense u_dut (
      .*,
      .modulator_clock_o(modulator_clock),
      .current_o(current),
      .aligned_o(aligned),
      .overcurrent_o(overcurrent),
      .calibrated_o(calibrated),
      .offset_fault_o(offset_fault),
      .stuck_o(stuck),
      .saturated_o(saturated)
  );
  (* hierconn *) wire [1:0] \u_dut.divider_q ;
  (* hierconn *) wire \u_dut.meta_q ;
  (* hierconn *) wire \u_dut.bit_q ;
  (* hierconn *) wire \u_dut.take_q ;
  (* hierconn *) wire \u_dut.take_q2 ;
  (* hierconn *) wire [W-1:0] \u_dut.first_q ;
  (* hierconn *) wire [W-1:0] \u_dut.second_q ;
  (* hierconn *) wire [W-1:0] \u_dut.third_q ;
  (* hierconn *) wire [5:0] \u_dut.phase_q ;
  (* hierconn *) wire [1:0] \u_dut.samples_q ;
  (* hierconn *) wire [2:0] \u_dut.strobed_q ;
  (* hierconn *) wire \u_dut.pending_q ;
  (* hierconn *) wire \u_dut.due ;
  (* hierconn *) wire \u_dut.restart ;
  (* hierconn *) wire \u_dut.sample_q ;
  (* hierconn *) wire \u_dut.whole_q ;
  (* hierconn *) wire \u_dut.aligned_q ;
  (* hierconn *) wire \u_dut.whole_q2 ;
  (* hierconn *) wire \u_dut.aligned_q2 ;
  (* hierconn *) wire [3:0] \u_dut.steps_q ;
  (* hierconn *) wire [W-1:0] \u_dut.comb_q ;
  (* hierconn *) wire [W-1:0] \u_dut.delay_q ;
  (* hierconn *) wire [W-1:0] \u_dut.delay_q2 ;
  (* hierconn *) wire [W-1:0] \u_dut.delay_q3 ;
  (* hierconn *) wire \u_dut.result ;
  (* hierconn *) wire \u_dut.settled_q ;
  (* hierconn *) wire signed [W-1:0] \u_dut.offset_q ;
  (* hierconn *) wire signed [W+AverageLog2-1:0] \u_dut.sum_q ;
  (* hierconn *) wire [AverageLog2-1:0] \u_dut.count_q ;
  (* hierconn *) wire [2:0] \u_dut.u_overcurrent.phase_q ;
  (* hierconn *) wire [1:0] \u_dut.u_overcurrent.samples_q ;
  (* hierconn *) wire \u_dut.u_overcurrent.sample_q ;
  (* hierconn *) wire [3:0] \u_dut.u_overcurrent.steps_q ;
  (* hierconn *) wire [FastW-1:0] \u_dut.u_overcurrent.comb_q ;
  (* hierconn *) wire [FastW-1:0] \u_dut.u_overcurrent.delay_q ;
  (* hierconn *) wire [FastW-1:0] \u_dut.u_overcurrent.delay_q2 ;
  (* hierconn *) wire [FastW-1:0] \u_dut.u_overcurrent.delay_q3 ;
  (* hierconn *) wire \u_dut.u_overcurrent.result ;
  (* hierconn *) wire \u_dut.u_overcurrent.hit ;
  (* hierconn *) wire \u_dut.u_overcurrent.hit_q ;
  (* hierconn *) wire [1:0] \u_dut.u_overcurrent.hits_q ;
  (* hierconn *) wire \u_dut.last_bit_q ;
  (* hierconn *) wire [8:0] \u_dut.quiet_q ;
  wire [3:0] steps = \u_dut.steps_q ;
  wire [3:0] fast_steps = \u_dut.u_overcurrent.steps_q ;
  wire [W-1:0] third = \u_dut.third_q ;
  wire result = \u_dut.result ;
  wire fast_result = \u_dut.u_overcurrent.result ;
  wire signed [W-1:0] offset = \u_dut.offset_q ;

  // A bit is added in the first clock in which the modulator's clock is high.
  logic after_q, high_q, rise, rise_q, rise_q2, rise_q3, data_q, data_q2;
  logic [2:0] since_rise_q;
  logic [W-1:0] first_q, second_q, third_q;
  assign rise = modulator_clock && !high_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      after_q      <= 1'b0;
      high_q       <= 1'b0;
      rise_q       <= 1'b0;
      rise_q2      <= 1'b0;
      rise_q3      <= 1'b0;
      data_q       <= 1'b0;
      data_q2      <= 1'b0;
      since_rise_q <= 3'(Divider - 1);
    end else begin
      after_q      <= 1'b1;
      high_q       <= modulator_clock;
      rise_q       <= rise;
      rise_q2      <= rise_q;
      rise_q3      <= rise_q2;
      data_q       <= data_i;
      data_q2      <= data_q;
      since_rise_q <= rise ? 3'd1 : since_rise_q + 3'(since_rise_q != '1);
    end
  end
  always_ff @(posedge clk_i) begin
    first_q  <= \u_dut.first_q ;
    second_q <= \u_dut.second_q ;
    third_q  <= third;
  end

  // Bits since the last sample and since the window began; strobes.
  logic [6:0] bits_q;
  logic [7:0] window_q;
  logic       strobe_q, due, begins;
  logic [2:0] places_q;
  logic [6:0] sample_q, whole_q, aligned_q;  // on the way to the outputs
  assign due    = bits_q == 7'(M - 1);
  assign begins = strobe_q && !due && window_q >= 8'(3 * M);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      bits_q    <= '0;
      window_q  <= '0;
      strobe_q  <= 1'b0;
      places_q  <= '0;
      sample_q  <= '0;
      whole_q   <= '0;
      aligned_q <= '0;
    end else begin
      strobe_q  <= strobe_i || (strobe_q && !rise);
      sample_q  <= {sample_q[5:0], rise && (due || begins)};
      whole_q   <= {whole_q[5:0], rise && due && window_q >= 8'(3 * M - 1)};
      aligned_q <= {aligned_q[5:0], rise && due && places_q[2]};
      if (rise) begin
        bits_q   <= (due || begins) ? 7'd0 : bits_q + 7'd1;
        window_q <= begins ? 8'd0 : window_q + 8'(window_q != 8'(3 * M));
        if (due || begins) places_q <= {places_q[1:0], strobe_q};
      end
    end
  end

  // The third differences of both filters, in one step.
  logic [W-1:0] one_q, two_q, three_q, last_two_q, last_three_q, wanted_q, one, two;
  logic [FastW-1:0] fast_one_q, fast_two_q, fast_three_q, fast_last_two_q, fast_last_three_q, fast_wanted_q;
  logic [FastW-1:0] fast_one, fast_two;
  assign one      = third - one_q;
  assign two      = one - two_q;
  assign fast_one = FastW'(third) - fast_one_q;
  assign fast_two = fast_one - fast_two_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {one_q, two_q, three_q, last_two_q, last_three_q, wanted_q}                               <= '0;
      {fast_one_q, fast_two_q, fast_three_q, fast_last_two_q, fast_last_three_q, fast_wanted_q} <= '0;
    end else begin
      if (steps[0]) begin
        one_q    <= third;
        two_q    <= one;
        three_q  <= two;
        last_two_q   <= two_q;
        last_three_q <= three_q;
        wanted_q     <= two - three_q;
      end
      if (fast_steps[0]) begin
        fast_one_q    <= FastW'(third);
        fast_two_q    <= fast_one;
        fast_three_q  <= fast_two;
        fast_last_two_q   <= fast_two_q;
        fast_last_three_q <= fast_three_q;
        fast_wanted_q     <= fast_two - fast_three_q;
      end
    end
  end

  // Results since the disarming, and the sum of the last of them.
  localparam logic signed [27:0] HalfRange = 28'sd131072, End = HalfRange - 28'sd4096, Limit = 28'sd4096;
  logic signed [27:0] value, sum_q, total, average_q;
  logic [9:0] results_q;
  logic result_q, armed_q, whole_average_q, was_calibrated_q;
  logic signed [27:0] value_q;
  logic signed [W-1:0] offset_q, current_q;
  logic saturated_q, fault_q;
  logic signed [W-1:0] wanted_current;
  assign wanted_current = value_q[W-1:0] - offset_q;
  assign value = 28'($signed(\u_dut.comb_q - W'(HalfRange)));
  assign total = sum_q + value;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      results_q        <= '0;
      sum_q            <= '0;
      result_q         <= 1'b0;
      armed_q          <= 1'b0;
      whole_average_q  <= 1'b0;
      was_calibrated_q <= 1'b0;
      offset_q         <= '0;
      current_q        <= '0;
      saturated_q      <= 1'b0;
      fault_q          <= 1'b0;
    end else begin
      result_q         <= result;
      armed_q          <= armed_i;
      offset_q         <= offset;
      current_q        <= current;
      saturated_q      <= saturated;
      fault_q          <= offset_fault;
      was_calibrated_q <= calibrated;
      whole_average_q  <= !armed_i && result && results_q[7:0] == '1 && results_q >= 10'(2 * Average - 1);
      if (armed_i) begin
        results_q <= '0;
        sum_q     <= '0;
      end else if (result) begin
        results_q <= (results_q == 10'(3 * Average - 1)) ? 10'(2 * Average) : results_q + 10'd1;
        sum_q     <= (results_q[7:0] == '1) ? 28'sd0 : total;
      end
    end
  end
  always_ff @(posedge clk_i) begin
    value_q   <= value;
    average_q <= (total + 28'sd128) >>> AverageLog2;
  end

  // Results of the fast filter in a row at the threshold or above; clocks since the last below it, from a first on.
  localparam int Interval = F * Divider;
  logic [2:0] fast_bits_q;
  logic [5:0] fast_sample_q;
  logic [2:0] row_q;
  logic [5:0] since_fast_q;
  logic [7:0] above_q;
  logic [1:0] fast_known_q;
  logic last_hit_q, began_q, overcurrent_q, clear_q, hit, latch_q;
  logic signed [11:0] fast_value;
  assign fast_value = 12'($signed(\u_dut.u_overcurrent.comb_q - FastW'(256)));
  assign hit = fast_value >= $signed({4'd0, threshold_i}) || -fast_value >= $signed({4'd0, threshold_i});
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      fast_bits_q   <= '0;
      fast_sample_q <= '0;
      fast_known_q  <= '0;
      row_q         <= '0;
      since_fast_q  <= '0;
      above_q       <= '0;
      last_hit_q    <= 1'b0;
      began_q       <= 1'b0;
      overcurrent_q <= 1'b0;
      clear_q       <= 1'b0;
      latch_q       <= 1'b0;
    end else begin
      overcurrent_q <= overcurrent;
      clear_q       <= clear_i && !last_hit_q && !(fast_result && hit);
      latch_q       <= fast_result && hit && row_q >= 3'(Hits - 1);
      if (rise) begin
        fast_bits_q <= fast_bits_q + 3'd1;
        if (fast_bits_q == '1 && fast_known_q != 2'd3) fast_known_q <= fast_known_q + 2'd1;
      end
      fast_sample_q <= {fast_sample_q[4:0], rise && fast_bits_q == '1};
      since_fast_q <= fast_result ? 6'd1 : since_fast_q + 6'(since_fast_q != '1);
      if (fast_result) begin
        began_q    <= 1'b1;
        last_hit_q <= hit;
        row_q      <= !hit ? 3'd0 : row_q + 3'(row_q != 3'(Hits));
      end
      if (fast_result && !hit) above_q <= 8'd1;
      else if (began_q) above_q <= above_q + 8'(above_q != '1);
      else if (fast_result) above_q <= 8'(Interval + 1);
    end
  end

  logic [9:0] quiet_q;  // bits without a transition
  logic       bit_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      quiet_q <= '0;
      bit_q   <= 1'b0;
    end else if (rise) begin
      bit_q   <= data_q2;
      quiet_q <= (data_q2 != bit_q) ? 10'd0 : quiet_q + 10'(quiet_q != '1);
    end
  end

  always_comb begin
    if (past_ok_q && rst_ni) begin
      clock_period: assert (!rise || since_rise_q == 3'(Divider));
      clock_half: assert (!(high_q && !modulator_clock) || since_rise_q == 3'(Divider / 2));
      bit_in_its_clock: assert (!after_q || \u_dut.first_q == first_q + W'(rise_q && bit_q));
      integrators: assert (!after_q || (\u_dut.second_q == second_q + (rise_q2 ? first_q : '0) &&
                           third == third_q + (rise_q3 ? second_q : '0)));
      decimation_period: assert (!rise || \u_dut.due == due);
      strobe_begins_a_window: assert (!rise || \u_dut.restart == begins);
      result_of_a_whole_window: assert (result_q == whole_q[6]);
      aligned_to_a_strobe: assert (aligned == (whole_q[6] && aligned_q[6]));
      third_difference: assert (!steps[3] || \u_dut.comb_q == wanted_q);
      current_less_offset: assert (!result_q || current == wanted_current);
      current_is_held: assert (!after_q || result_q || (current == current_q && saturated == saturated_q));
      saturated_at_the_ends: assert (!result_q || saturated == (value_q >= End || value_q <= -End));
      offset_by_whole_averages: assert (!after_q || whole_average_q || (offset == offset_q &&
                                        offset_fault == fault_q && calibrated == was_calibrated_q));
      offset_is_the_average: assert (!whole_average_q || (offset_fault ? offset == offset_q : calibrated &&
                                     28'(offset) == average_q));
      offset_in_its_range: assert (28'(offset) <= Limit && 28'(offset) >= -Limit);
      offset_fault_is_told: assert (!whole_average_q || offset_fault == (average_q > Limit || average_q < -Limit));
      fast_period: assert (!began_q || !fast_result || since_fast_q == 6'(Interval));
      fast_third_difference: assert (!fast_steps[3] || \u_dut.u_overcurrent.comb_q == fast_wanted_q);
      fast_of_whole_windows: assert (fast_result == (fast_sample_q[5] && fast_known_q == 2'd3));
      hit_at_the_threshold: assert (\u_dut.u_overcurrent.hit == hit);
      hits_in_a_row: assert (\u_dut.u_overcurrent.hits_q == 2'(row_q) && row_q <= 3'(Hits));
      latched_by_the_last_hit: assert (!latch_q || overcurrent);
      latched_by_hits_only: assert (!after_q || latch_q || !overcurrent || overcurrent_q);
      latched_in_time: assert (above_q <= 8'(Hits * Interval) || overcurrent);
      cleared_below_only: assert (!after_q || overcurrent || !overcurrent_q || clear_q);
      cleared_when_below: assert (!clear_q || !overcurrent);
      stuck_without_a_transition: assert (stuck == (quiet_q >= 10'(Stuck)));
      armed_strobe: cover (armed_q && strobe_q);
      adds: cover (third != 0);
    end
  end
  // Where the modulator's clock is, by the divider; where the fast filter is, in clocks of its interval.
  logic [1:0] div;
  logic [4:0] place;
  logic signed [27:0] most;  // of the sum
  logic [1:0] since;
  assign div   = \u_dut.divider_q ;
  assign since = div - 2'd1;
  assign place = {fast_bits_q, since - 2'd1};
  assign most  = $signed({2'b0, results_q[7:0], 18'd0});
  always_comb begin
    if (past_ok_q && rst_ni) begin
      inside_clock: assert (modulator_clock == (div == 2'd1 || div == 2'd2) && high_q == div[1] &&
          rise_q == (div == 2'd2) && rise_q2 == (div == 2'd3) && rise_q3 == (div == 2'd0 && after_q) &&
          \u_dut.take_q == rise_q && \u_dut.take_q2 == rise_q2 && (after_q || div == 2'd0));
      inside_since: assert (since_rise_q == (div == 2'd1 ? 3'd4 : {1'b0, since}));
      inside_data: assert (\u_dut.meta_q == data_q && \u_dut.bit_q == data_q2 && \u_dut.last_bit_q == bit_q);
      inside_bits: assert (bits_q < 7'(M) && \u_dut.phase_q == 6'(bits_q) && \u_dut.pending_q == strobe_q &&
                           \u_dut.strobed_q == places_q);
      inside_window: assert (window_q == 8'(3 * M) ? \u_dut.samples_q == 2'd3 :
                             \u_dut.samples_q != 2'd3 && window_q == {\u_dut.samples_q , 6'(bits_q)});
      inside_sample: assert (div == 2'd2 ? \u_dut.sample_q == sample_q[0] :
                             div != 2'd3 || \u_dut.sample_q == sample_q[1]);
      inside_places: assert (((sample_q & 7'b0010001) == '0 || div == 2'd2) &&
                             ((sample_q & 7'b0100010) == '0 || div == 2'd3) &&
                             ((sample_q & 7'b1000100) == '0 || div == 2'd0) && (!sample_q[3] || div == 2'd1));
      inside_steps: assert (steps == sample_q[5:2] && (whole_q & ~sample_q) == '0);
      inside_whole: assert ((sample_q[2:0] == '0 || \u_dut.whole_q == (whole_q[2:0] != '0)) &&
                            (sample_q[5:3] == '0 || \u_dut.whole_q2 == (whole_q[5:3] != '0)));
      inside_aligned: assert ((whole_q[2:0] == '0 || \u_dut.aligned_q == ((aligned_q & whole_q & 7'h07) != '0)) &&
                              (whole_q[5:3] == '0 || \u_dut.aligned_q2 == ((aligned_q & whole_q & 7'h38) != '0)));
      inside_combs: assert (
          steps[1] ? {\u_dut.comb_q , \u_dut.delay_q , \u_dut.delay_q2 , \u_dut.delay_q3 } ==
                     {two_q, last_two_q, last_three_q, one_q} :
          steps[2] ? {\u_dut.comb_q , \u_dut.delay_q , \u_dut.delay_q2 , \u_dut.delay_q3 } ==
                     {three_q, last_three_q, one_q, two_q} :
                     {\u_dut.delay_q , \u_dut.delay_q2 , \u_dut.delay_q3 } == {one_q, two_q, three_q});
      inside_wanted: assert (wanted_q == three_q - last_three_q && three_q == two_q - last_two_q &&
          fast_wanted_q == fast_three_q - fast_last_three_q && fast_three_q == fast_two_q - fast_last_two_q);
      inside_results: assert (results_q < 10'(3 * Average) && \u_dut.count_q == results_q[7:0] &&
                              \u_dut.settled_q == (results_q[9:8] != '0));
      inside_sum: assert (28'(\u_dut.sum_q ) == sum_q + 28'sd128 && sum_q <= most && sum_q >= -most);
      inside_fast_places: assert (\u_dut.u_overcurrent.phase_q == fast_bits_q && (fast_sample_q[0] ? place == 5'd0 : 1'b1) &&
          (fast_known_q == '0 ? fast_sample_q == '0 : fast_sample_q == (place < 5'd6 ? 6'd1 << place : 6'd0)));
      inside_fast_sample: assert (div == 2'd2 ? \u_dut.u_overcurrent.sample_q == fast_sample_q[0] :
                                  div != 2'd3 || \u_dut.u_overcurrent.sample_q == fast_sample_q[1]);
      inside_fast_steps: assert (fast_steps == fast_sample_q[5:2]);
      inside_fast_known: assert (fast_sample_q[2:0] == '0 ? fast_known_q == \u_dut.u_overcurrent.samples_q :
                                 fast_known_q == \u_dut.u_overcurrent.samples_q + 2'(\u_dut.u_overcurrent.samples_q != 2'd3));
      inside_fast_combs: assert (
          fast_steps[1] ? {\u_dut.u_overcurrent.comb_q , \u_dut.u_overcurrent.delay_q , \u_dut.u_overcurrent.delay_q2 , \u_dut.u_overcurrent.delay_q3 } ==
                          {fast_two_q, fast_last_two_q, fast_last_three_q, fast_one_q} :
          fast_steps[2] ? {\u_dut.u_overcurrent.comb_q , \u_dut.u_overcurrent.delay_q , \u_dut.u_overcurrent.delay_q2 , \u_dut.u_overcurrent.delay_q3 } ==
                          {fast_three_q, fast_last_three_q, fast_one_q, fast_two_q} :
                          {\u_dut.u_overcurrent.delay_q , \u_dut.u_overcurrent.delay_q2 , \u_dut.u_overcurrent.delay_q3 } ==
                          {fast_one_q, fast_two_q, fast_three_q});
      inside_fast_since: assert (!began_q || (fast_known_q == 2'd3 && \u_dut.u_overcurrent.samples_q == 2'd3 &&
                                 since_fast_q == (place > 5'd5 ? 6'(place) - 6'd5 : 6'(place) + 6'd27)));
      inside_above: assert (began_q ? row_q == 3'(Hits) || above_q == {row_q, 5'd0} + 8'(since_fast_q) :
                            above_q == '0 && row_q == '0);
      inside_row: assert (\u_dut.u_overcurrent.hit_q == last_hit_q && last_hit_q == (row_q != '0) && (row_q != 3'(Hits) || overcurrent));
      inside_quiet: assert (\u_dut.quiet_q == (quiet_q >= 10'(Stuck) ? 9'(Stuck) : 9'(quiet_q)));
    end
  end
endmodule

`default_nettype wire
