// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The serial products: each is the sum of its factor's multiples by 2^k where bit k of its word is 1. That factor and
// word are those of the law says field.sv.
`default_nettype none

module products_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic               armed_i,
    input logic               valid_i,
    input logic               direct_i,
    input logic signed [18:0] reference_i,
    input logic signed [18:0] current_a_i,
    input logic signed [18:0] current_b_i,
    input logic signed [17:0] emf_i,
    input logic signed [31:0] position_i,
    input logic        [31:0] gain_i,
    input logic        [31:0] offset_i,
    input logic               polarity_i,
    input logic        [16:0] proportional_i,
    input logic        [16:0] integral_i,
    input logic        [16:0] limit_i
);

  `include "reset.svh"

  field_oriented u_dut (
      .*,
      .current_q_o(), .resistive_o(), .across_o(), .open_o(), .on_a_o(), .on_b_o(), .on_c_o(), .saturated_o(), .valid_o()
  );
  (* hierconn *) wire [3:0] \u_dut.op_q ;
  (* hierconn *) wire [5:0] \u_dut.step_q ;
  (* hierconn *) wire [23:0] \u_dut.factor_q , \u_dut.upper_q ;
  (* hierconn *) wire [16:0] \u_dut.word_q ;
  wire [5:0] step = \u_dut.step_q ;
  wire signed [40:0] factor = 41'($signed(\u_dut.factor_q ));
  wire signed [23:0] upper = $signed(\u_dut.upper_q );
  wire signed [40:0] product = $signed({\u_dut.upper_q , \u_dut.word_q });

  localparam logic [3:0] Park = 4'd2, AcrossP = 4'd3, AlongP = 4'd4, Polar = 4'd5, Turned = 4'd8, Applied = 4'd12;
  wire [3:0] op = \u_dut.op_q ;
  logic turns, rounded, under_way, done;
  assign turns     = op == Park || op == Polar || op == Turned || op == Applied;
  assign rounded   = op == AcrossP || op == AlongP;
  assign under_way = !turns && step >= 6'd1;
  assign done      = !turns && step == 6'd18;

  // The sum of the multiples so far, the next multiple, and the bits of the word that are left.
  logic signed [40:0] sum_q, multiple_q, sum, multiple, begins;
  logic [16:0] left_q, left, whole_q, whole;
  assign begins   = rounded ? 41'sd4096 : '0;
  assign sum      = step != 6'd1 ? sum_q : begins;
  assign multiple = step != 6'd1 ? multiple_q : factor;
  assign left     = step != 6'd1 ? left_q : \u_dut.word_q ;
  assign whole    = step != 6'd1 ? whole_q : \u_dut.word_q ;
  always_ff @(posedge clk_i) begin
    sum_q      <= left[0] ? sum + multiple : sum;
    multiple_q <= multiple <<< 1;
    left_q     <= left >> 1;
    whole_q    <= whole;
  end

  logic [17:0] is_sum, inside_left, inside_multiple;
  genvar n;
  generate
    for (n = 0; n <= 17; n++) begin : g_bits  // that are summed
      assign is_sum[n]          = !(under_way && step == 6'(n + 1)) || product >>> (17 - n) == sum;
      assign inside_multiple[n] = !(under_way && step == 6'(n + 1)) || multiple == factor <<< n;
      assign inside_left[n]     = !(under_way && step == 6'(n + 1)) ||
          (left == whole >> n && (\u_dut.word_q & 17'((1 << (17 - n)) - 1)) == left);
    end
  endgenerate

  always_comb begin
    if (past_ok_q && rst_ni) begin
      products_begin: assert (turns || step != 6'd1 || 41'($signed(\u_dut.upper_q )) == begins);
      products_are_sums: assert (&is_sum && (!done || product == sum));
      products_have_a_direction: assert (!under_way || rounded || (factor < 0 ? upper <= 0 : upper >= 0));
      a_product_below_zero: cover (done && op == 4'd0 && product < -41'sd131072);
      inside_step: assert (op <= 4'd14 && step <= (turns ? 6'd34 : 6'd18));
      inside_multiples: assert (&inside_multiple);
      inside_bits: assert (&inside_left);
      inside_bound: assert (!under_way || rounded || (factor < 0 ? sum <= 0 && sum > multiple :
                                                      factor == 0 ? sum == 0 : sum >= 0 && sum < multiple));
    end
  end
endmodule

`default_nettype wire
