// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What each instruction gives, as docs/engine-isa.md says it, for all operands; of a product only which
// factors it has. A number behind a name is the clock of the instruction, as in the block.
`default_nettype none

module alu_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic        [ 3:0] op2_i,
    input logic        [ 1:0] mode2_i,
    input logic signed [31:0] x2_i,
    input logic signed [31:0] y2_i,
    input logic        [35:0] table3_i,
    input logic        [31:0] extra3_i,
    input logic               flag4_i,
    input logic               keep6_i
);
  localparam int W = 52;  // no sum of a product and acc overflows

  `include "reset.svh"
  logic flag5;
  logic signed [31:0] result;
  engine_alu u_dut (
      .*,
      .flag5_o(flag5),
      .result6_o(result)
  );
  (* hierconn *) wire [31:0] \u_dut.factored4_q ;
  (* hierconn *) wire [17:0] \u_dut.factor4_q ;
  (* hierconn *) wire signed [34:0] \u_dut.low5_q ;
  (* hierconn *) wire signed [32:0] \u_dut.high5_q ;

  // The instruction's operands beside it.
  logic [3:0] op3_q, op4_q, op5_q, op6_q;
  logic [1:0] mode3_q, mode4_q, mode5_q, mode6_q;
  logic signed [31:0] x3_q, x4_q, x5_q, x6_q, y3_q, y4_q, y5_q, y6_q;
  logic [35:0] table4_q, table5_q, table6_q;
  logic [31:0] extra4_q, extra5_q, extra6_q, factored5_q;
  logic [17:0] factor5_q;
  logic flag5_q, flag6_q, left6_q;
  logic signed [49:0] product6_q;
  logic signed [31:0] acc1_q, acc2_q, acc3_q, acc4_q, acc5_q, acc6_q;
  always_ff @(posedge clk_i) begin
    {op3_q, mode3_q, x3_q, y3_q} <= {op2_i, mode2_i, x2_i, y2_i};
    {op4_q, mode4_q, x4_q, y4_q, table4_q, extra4_q} <= {op3_q, mode3_q, x3_q, y3_q, table3_i, extra3_i};
    {op5_q, mode5_q, x5_q, y5_q, table5_q, extra5_q} <= {op4_q, mode4_q, x4_q, y4_q, table4_q, extra4_q};
    {op6_q, mode6_q, x6_q, y6_q, table6_q, extra6_q} <= {op5_q, mode5_q, x5_q, y5_q, table5_q, extra5_q};
    {flag5_q, flag6_q, left6_q} <= {flag4_i, flag5_q, flag5};
    {factor5_q, factored5_q} <= {\u_dut.factor4_q , \u_dut.factored4_q };
    product6_q <= (50'(\u_dut.high5_q ) <<< 17) + 50'(\u_dut.low5_q );
    // The thread's next instruction is six clocks after this one.
    acc1_q <= keep6_i ? result : '0;
    acc2_q <= acc1_q;
    acc3_q <= acc2_q;
    acc4_q <= acc3_q;
    acc5_q <= acc4_q;
    acc6_q <= acc5_q;
  end
  always_comb begin
    assume (extra3_i == '0 || op3_q == feltgate_engine_pkg::OP_NOP);
    // A multiplication by 1; any other is free.
    assume (factor5_q != 18'd1 || (\u_dut.low5_q == $signed({18'd0, factored5_q[16:0]}) &&
                                   \u_dut.high5_q == 33'($signed(factored5_q[31:17]))));
  end

  localparam logic signed [W-1:0] Most = 52'sh7fffffff, Least = -52'sh80000000;
  function automatic logic signed [31:0] nearest(input logic signed [W-1:0] value);
    nearest = value[31:0];
    if (value > Most) nearest = Most[31:0];
    if (value < Least) nearest = Least[31:0];
  endfunction
  // What a mode leaves of a product, rounded half up or cut.
  function automatic logic signed [W-1:0] shifted(input logic [1:0] mode, input logic rounds);
    logic signed [W-1:0] half12, half17, half27;
    half12 = 52'sh800;
    half17 = 52'sh10000;
    half27 = 52'sh4000000;
    shifted = W'(product6_q);
    case (mode)
      2'd0: ;
      2'd1: begin
        if (rounds) shifted = shifted + half12;
        shifted = shifted >>> 12;
      end
      2'd2: begin
        if (rounds) shifted = shifted + half17;
        shifted = shifted >>> 17;
      end
      default: begin
        if (rounds) shifted = shifted + half27;
        shifted = shifted >>> 27;
      end
    endcase
  endfunction

  logic less, multiplies4;
  logic signed [W-1:0] x, y, acc;
  logic signed [19:0] value;
  logic signed [W-1:0] cut, up, between;
  assign less = x6_q < y6_q;
  assign x = W'(x6_q);
  assign y = W'(y6_q);
  assign acc = W'(acc6_q);
  assign value = table6_q[19:0];
  assign cut = shifted(mode6_q, 1'b0);
  assign up = shifted(mode6_q, 1'b1);
  assign between = W'(value) + shifted(2'd1, 1'b1);
  assign multiplies4 = op4_q == feltgate_engine_pkg::OP_MUL || op4_q == feltgate_engine_pkg::OP_MAC ||
                       op4_q == feltgate_engine_pkg::OP_MLW;

  logic [2:0] clocks_q;  // that all of the pipeline has been fed for
  initial clocks_q = '0;
  always_ff @(posedge clk_i) if (clocks_q != 3'd7) clocks_q <= clocks_q + 3'd1;

  always_comb begin
    if (clocks_q >= 3'd2) begin
      factors_of_a_product: assert (!multiplies4 || (\u_dut.factored4_q == x4_q && \u_dut.factor4_q == y4_q[17:0]));
      factors_of_a_table: assert (op4_q != feltgate_engine_pkg::OP_LRP ||
          (\u_dut.factored4_q == {20'd0, x4_q[11:0]} && \u_dut.factor4_q == {{2{table4_q[35]}}, table4_q[35:20]}));
    end
    if (clocks_q == 3'd7) begin
      case (op6_q)
        feltgate_engine_pkg::OP_ADD: begin
          sums: assert (mode6_q[0] || result == nearest(x + (mode6_q[1] ? acc : y)));
          sums_that_wrap: assert (!mode6_q[0] || result == 32'(x + (mode6_q[1] ? acc : y)));
        end
        feltgate_engine_pkg::OP_SUB: begin
          differences: assert (mode6_q[0] || result == nearest(mode6_q[1] ? acc - x : x - y));
          differences_that_wrap: assert (!mode6_q[0] || result == 32'(x - y));
        end
        feltgate_engine_pkg::OP_MUL: products: assert (result == nearest(up));
        feltgate_engine_pkg::OP_MAC: accumulated: assert (result == nearest(acc + up));
        feltgate_engine_pkg::OP_MLW: cut_products: assert (result == cut[31:0]);
        feltgate_engine_pkg::OP_MIN: the_smaller: assert (result == (less ? x6_q : y6_q));
        feltgate_engine_pkg::OP_MAX: the_larger: assert (result == (less ? y6_q : x6_q));
        feltgate_engine_pkg::OP_SEL: chosen: assert (result == (flag6_q ? x6_q : y6_q));
        feltgate_engine_pkg::OP_CMP: begin
          compared: assert (left6_q == (mode6_q == 2'd0 ? less : mode6_q == 2'd1 ? flag6_q || less :
                                        mode6_q == 2'd2 ? flag6_q && less : !less));
          compared_as_a_number: assert (result == {31'd0, left6_q});
        end
        feltgate_engine_pkg::OP_LRP: between_words: assert (result == nearest(between));
        feltgate_engine_pkg::OP_TAB: word_of_a_table: assert (result == table6_q[31:0]);
        feltgate_engine_pkg::OP_TST, feltgate_engine_pkg::OP_BRF: acc_stays: assert (result == acc6_q);
        feltgate_engine_pkg::OP_FRC: fraction_of_x: assert (result == {20'd0, x6_q[11:0]});
        feltgate_engine_pkg::OP_ABS: sign_of_x: assert (result == (x6_q < 0 ? nearest(-y) : y6_q));
        default: nothing: assert (result == extra6_q);
      endcase
      if (op6_q != feltgate_engine_pkg::OP_CMP) flag_stays: assert (left6_q == flag6_q);
    end
    saturates: cover (clocks_q == 3'd7 && op6_q == feltgate_engine_pkg::OP_MAC && result == 32'sh7fffffff && acc6_q < 0);
    of_its_own_acc: cover (clocks_q == 3'd7 && op6_q == feltgate_engine_pkg::OP_SUB && mode6_q == 2'd2 && acc6_q != '0);
  end
endmodule

`default_nettype wire
