// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The clocks of a result, and how far its legs are: bounds of the table's words and of their products with the amplitude.
`default_nettype none

module legs_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic               sample_i,
    input logic signed [31:0] position_i,
    input logic        [31:0] gain_i,
    input logic        [31:0] offset_i,
    input logic signed [12:0] amplitude_i,
    input logic               polarity_i
);
  localparam int Period = feltgate_pkg::PWM_PERIOD;
  localparam int Half = Period / 2;
  localparam logic signed [12:0] Most = 13'(Period);
  localparam int Latency = 85;
  // Largest entries of the table. Words between two are 255/256 of them at most: the cosine's below 2^16 + 4, the sine's
  // below 2^16 - 2^13.
  localparam logic signed [31:0] Highest = 32'sd65798;
  localparam logic signed [31:0] HighestSine = 32'sd56983;

  `include "reset.svh"

  logic valid;
  logic [11:0] on_a, on_b, on_c;
  commutation #(
      .Period(Period)
  ) u_dut (
      .*,
      .on_a_o(on_a),
      .on_b_o(on_b),
      .on_c_o(on_c),
      .valid_o(valid)
  );
  (* hierconn *) wire [1:0] \u_dut.state_q ;
  (* hierconn *) wire [5:0] \u_dut.step_q ;
  (* hierconn *) wire [1:0] \u_dut.pass_q ;
  (* hierconn *) wire [16:0] \u_dut.factor_q ;
  (* hierconn *) wire [17:0] \u_dut.sum_q ;
  (* hierconn *) wire [12:0] \u_dut.amplitude_q ;
  (* hierconn *) wire [12:0] \u_dut.difference_q ;
  (* hierconn *) wire [11:0] \u_dut.leg_q ;
  (* hierconn *) wire [11:0] \u_dut.leg_q2 ;
  wire signed [31:0] factor = $signed({15'd0, \u_dut.factor_q });
  wire signed [31:0] sum = 32'($signed(\u_dut.sum_q ));
  wire signed [31:0] difference = 32'($signed(\u_dut.difference_q ));

  // The clocks since a sample was taken, 0: none is.
  logic [6:0] place;
  logic take, due_q;
  assign take = sample_i && place == '0;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      place <= 7'd0;
      due_q <= 1'b0;
    end else begin
      place <= place == 7'(Latency - 1) ? 7'd0 : place != '0 || take ? place + 7'd1 : 7'd0;
      due_q <= place == 7'(Latency - 1);
    end
  end

  // The amplitude as taken, and what a product begins with.
  logic signed [12:0] taken_q;
  logic signed [31:0] begin_q;
  logic [5:0] step;
  logic product, sine;
  assign sine    = place >= 7'd59;
  assign product = place >= 7'd36 && place < 7'd82;
  assign step    = 6'(place - (sine ? 7'd59 : 7'd36));
  always_ff @(posedge clk_i) begin
    if (take) taken_q <= amplitude_i > Most ? Most : amplitude_i < -Most ? -Most : amplitude_i;
    if (product && step == 6'd9) begin_q <= !sine ? 32'sd32768 : difference[0] ? '0 : 32'sd65536;
  end

  // What was there before.
  logic running_q;
  logic [35:0] legs_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) running_q <= 1'b0;
    else running_q <= 1'b1;
  end
  always_ff @(posedge clk_i) legs_q <= {on_a, on_b, on_c};

  always_comb begin
    if (past_ok_q && rst_ni) begin
      result_in_its_clock: assert (valid == due_q);
      within_the_period: assert (on_a <= 12'(Period) && on_b <= 12'(Period) && on_c <= 12'(Period));
      held_between_results: assert (valid || !running_q || {on_a, on_b, on_c} == legs_q);
      nothing_is_no_voltage: assert (!valid || taken_q != '0 || {on_a, on_b, on_c} == {3{12'(Half)}});
      limited: cover (place == 7'd1 && taken_q == -Most);
      under_way: cover (place == 7'd10 && taken_q > 13'sd0);
    end
    if (past_ok_q && !rst_ni) begin
      reset_is_no_voltage: assert ({on_a, on_b, on_c} == {3{12'(Half)}} && !valid);
    end
  end

  // Inside: the state by the clock. A product's sum after n bits of the amplitude, low as a number, lies between bounds of
  // low times the largest word; the last bit subtracts.
  logic [12:0] turned;  // the amplitude's bits as they have gone round
  logic [3:0] gone;
  logic signed [31:0] low, rest, one, most, least, first;
  logic summed, done, cosine;
  function automatic logic signed [31:0] bound(input logic signed [31:0] times, input logic of_cosine);
    bound = (times <<< 16) + (of_cosine ? times <<< 2 : -(times <<< 13));
  endfunction
  assign summed = product && step > 6'd9;
  assign done   = place == 7'd59 || place >= 7'd82;
  assign cosine = place <= 7'd59;
  assign gone   = summed ? 4'(step - 6'd10) : 4'd0;
  assign turned = 13'({taken_q, taken_q} >> gone);
  assign one    = 32'sd1 <<< gone;
  assign low    = 32'($signed({1'b0, taken_q})) & (one - 32'sd1);
  assign rest   = one - low;
  assign most   = bound(low, cosine) + begin_q;
  assign least  = bound(rest, cosine) - begin_q + one;
  assign first  = bound(32'(taken_q), cosine) + begin_q;
  always_comb begin
    if (past_ok_q && rst_ni) begin
      inside_place: assert (place < 7'(Latency) && (!due_q || place == '0));
      inside_state: assert (\u_dut.state_q == (place == '0 ? 2'd0 : place < 7'd36 ? 2'd1 : place < 7'd82 ? 2'd2 : 2'd3));
      inside_step: assert (7'(\u_dut.step_q ) == (place == '0 ? 7'd0 : place < 7'd36 ? place - 7'd1 : product ? 7'(step) :
                                                  place - 7'd82));
      inside_pass: assert (!product || \u_dut.pass_q == (sine ? 2'd2 : 2'd0));
      inside_taken: assert (place == '0 || (taken_q <= Most && taken_q >= -Most));
      inside_turned: assert (place == '0 || \u_dut.amplitude_q == turned);
      inside_node: assert (!(product && step > 6'd0 && step < 6'd9) || factor <= (sine ? HighestSine : Highest));
      inside_words: assert (!(product && step > 6'd0 && step < 6'd10) || (sum >= 0 &&
          (sum <<< (step[3:0] - 4'd1)) <= (sine ? (HighestSine <<< (step[3:0] - 4'd1)) - HighestSine :
                                                  (Highest <<< (step[3:0] - 4'd1)) - Highest)));
      inside_factor: assert (!summed || factor <= bound(32'sd1, cosine));
      inside_begin: assert (!(summed || done) || begin_q == (cosine ? 32'sd32768 : difference[0] ? '0 : 32'sd65536));
      inside_most: assert (!summed || (sum >= 0 && sum <= 32'sd65540 && (sum <<< gone) <= most));
      inside_least: assert (!summed || ((factor - sum) <<< gone) <= least);
      inside_beyond: assert (!summed || ((sum - factor) <<< gone) <= begin_q);
      inside_zero: assert (!(summed || done) || taken_q != '0 || sum == (begin_q >>> (done ? 4'd13 : gone)));
      inside_done: assert (!done || (sum <= 32'sd65540 && sum >= -32'sd65540 && (taken_q[12] ?
          (sum <<< 13) <= begin_q && (sum <<< 13) >= first - 32'sd8192 : sum >= 0 && (sum <<< 13) <= first)));
      inside_difference: assert (place < 7'd60 || (difference <= 32'(Most) && difference >= -(32'(Most))));
      inside_no_difference: assert (place < 7'd60 || taken_q != '0 || difference == '0);
      inside_leg: assert (place < 7'd83 || (\u_dut.leg_q <= 12'(Period) && (taken_q != '0 || \u_dut.leg_q == 12'(Half))));
      inside_leg2: assert (place < 7'd84 || (\u_dut.leg_q2 <= 12'(Period) && (taken_q != '0 || \u_dut.leg_q2 == 12'(Half))));
    end
  end
endmodule

`default_nettype wire
