// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// ALU of the engine: one result per clock. Every result is A + W + carry. W is a window of the
// product, or x, or 0; A is y, the table's word, acc, or 0.
// Clocks of an instruction: 2 op and operands from the memories, 3 table word, 4 multiplication,
// 5 window, 6 result. docs/blocks/engine.md

`default_nettype none

module engine_alu (
    input  logic               clk_i,
    input  logic        [ 3:0] op2_i,
    input  logic        [ 1:0] mode2_i,
    input  logic signed [31:0] x2_i,
    input  logic signed [31:0] y2_i,
    input  logic        [35:0] table3_i,
    input  logic        [31:0] extra3_i,    // ORed to y; 0 in turns with an instruction
    input  logic               flag4_i,     // flag of the previous instruction
    output logic               flag5_o,     // flag after this instruction
    input  logic               keep6_i,     // 1: the result is acc of the thread's next instruction
    output logic signed [31:0] result6_o
);
  // Operands. Table instructions have no y.
  logic [3:0] op3_q;
  logic [1:0] mode3_q;
  logic signed [31:0] x3_q, y3_q;
  logic from_table, none;
  assign from_table = op2_i == feltgate_engine_pkg::OP_LRP || op2_i == feltgate_engine_pkg::OP_TAB;
  assign none       = op2_i == feltgate_engine_pkg::OP_NOP;
  always_ff @(posedge clk_i) begin
    op3_q   <= op2_i;
    mode3_q <= mode2_i;
    x3_q    <= x2_i;
    y3_q    <= from_table || none ? '0 : y2_i;
  end

  // Inputs of the multipliers: x or its fraction, times y, a slope, or 1.
  logic        lerp, fraction, multiplies, table_word;
  logic [31:0] word, addend4_q, factored4_q;
  logic [17:0] factor4_q;
  logic less4_q, negative4_q;
  logic signed [32:0] difference;  // only its sign is used
  logic [3:0] op4_q;
  logic [1:0] mode4_q;
  assign difference = 33'(x3_q) - 33'(y3_q);
  assign lerp       = op3_q == feltgate_engine_pkg::OP_LRP;
  assign table_word = op3_q == feltgate_engine_pkg::OP_TAB;
  assign fraction   = lerp || op3_q == feltgate_engine_pkg::OP_FRC;
  assign multiplies = lerp || op3_q == feltgate_engine_pkg::OP_MUL ||
                      op3_q == feltgate_engine_pkg::OP_MAC || op3_q == feltgate_engine_pkg::OP_MLW;
  assign word = {table3_i[31:20] & {12{table_word}}, table3_i[19:0] & {20{lerp || table_word}}};
  always_ff @(posedge clk_i) begin
    factored4_q[11:0]  <= x3_q[11:0];
    factored4_q[31:12] <= fraction ? '0 : x3_q[31:12];
    if (!multiplies) factor4_q <= 18'd1;
    else factor4_q <= y3_q[17:0] | ({{2{table3_i[35]}}, table3_i[35:20]} & {18{lerp}});
    addend4_q   <= y3_q | word | extra3_i;
    less4_q     <= difference[32];
    negative4_q <= x3_q[31];
    op4_q       <= op3_q;
    mode4_q     <= mode3_q;
  end

  // Products of both halves of x, and the decision of the comparison.
  logic signed [34:0] low5_q;
  logic signed [32:0] high5_q;
  logic [31:0] addend5_q;
  always_ff @(posedge clk_i) begin
    low5_q    <= $signed({1'b0, factored4_q[16:0]}) * $signed(factor4_q);
    high5_q   <= $signed(factored4_q[31:17]) * $signed(factor4_q);
    addend5_q <= addend4_q;
    // LRP's value has 20 bits and a sign.
    if (op4_q == feltgate_engine_pkg::OP_LRP && addend4_q[19]) addend5_q[31:20] <= '1;
  end

  logic flag, takes_x;
  always_comb begin
    flag = flag4_i;
    if (op4_q == feltgate_engine_pkg::OP_CMP) begin
      case (mode4_q)
        2'd0: flag = less4_q;
        2'd1: flag = flag4_i || less4_q;
        2'd2: flag = flag4_i && less4_q;
        default: flag = !less4_q;
      endcase
    end
    case (op4_q)
      feltgate_engine_pkg::OP_MIN: takes_x = less4_q;
      feltgate_engine_pkg::OP_MAX: takes_x = !less4_q;
      default: takes_x = flag4_i;  // SEL
    endcase
  end

  // Control bits of the result.
  logic acc5_q, invert5_q, no_addend5_q, no_window5_q, rounds5_q, carry5_q, wraps5_q, inverse5_q;
  logic gray5_q;  // window5_q[1] != window5_q[0]
  logic [1:0] window5_q;
  always_ff @(posedge clk_i) begin
    flag5_o      <= flag;
    acc5_q       <= 1'b0;
    invert5_q    <= 1'b0;
    no_addend5_q <= 1'b0;
    no_window5_q <= 1'b0;
    rounds5_q    <= 1'b0;
    carry5_q     <= 1'b0;
    wraps5_q     <= 1'b0;
    inverse5_q   <= 1'b0;
    window5_q    <= 2'd0;
    gray5_q      <= 1'b0;
    case (op4_q)
      feltgate_engine_pkg::OP_ADD: begin
        acc5_q   <= mode4_q[1];
        wraps5_q <= mode4_q[0];
      end
      feltgate_engine_pkg::OP_SUB: begin
        invert5_q  <= 1'b1;
        wraps5_q   <= mode4_q[0];
        acc5_q     <= mode4_q == 2'd2;  // acc - x = ~(~acc + x)
        inverse5_q <= mode4_q == 2'd2;
        carry5_q   <= mode4_q != 2'd2;
      end
      feltgate_engine_pkg::OP_MUL: begin
        no_addend5_q <= 1'b1;
        rounds5_q    <= 1'b1;
        window5_q    <= mode4_q;
        gray5_q      <= mode4_q[1] != mode4_q[0];
      end
      feltgate_engine_pkg::OP_MAC: begin
        acc5_q    <= 1'b1;
        rounds5_q <= 1'b1;
        window5_q <= mode4_q;
        gray5_q   <= mode4_q[1] != mode4_q[0];
      end
      feltgate_engine_pkg::OP_MLW: begin
        no_addend5_q <= 1'b1;
        wraps5_q     <= 1'b1;
        window5_q    <= mode4_q;
        gray5_q      <= mode4_q[1] != mode4_q[0];
      end
      feltgate_engine_pkg::OP_MIN, feltgate_engine_pkg::OP_MAX, feltgate_engine_pkg::OP_SEL: begin
        no_addend5_q <= takes_x;
        no_window5_q <= !takes_x;
      end
      feltgate_engine_pkg::OP_CMP: begin
        no_addend5_q <= 1'b1;
        no_window5_q <= 1'b1;
        carry5_q     <= flag;
      end
      feltgate_engine_pkg::OP_LRP: begin
        rounds5_q <= 1'b1;
        window5_q <= 2'd1;
        gray5_q   <= 1'b1;
      end
      feltgate_engine_pkg::OP_TST, feltgate_engine_pkg::OP_BRF: begin
        acc5_q       <= 1'b1;
        no_window5_q <= 1'b1;
      end
      feltgate_engine_pkg::OP_FRC: no_addend5_q <= 1'b1;
      feltgate_engine_pkg::OP_ABS: begin
        no_window5_q <= 1'b1;
        invert5_q    <= negative4_q;
        carry5_q     <= negative4_q;
      end
      default: no_window5_q <= 1'b1;  // TAB, NOP
    endcase
  end

  // Product, window and addend.
  logic signed [32:0] upper;
  logic [49:0] product;
  logic [32:0] lesser, window;  // lesser: of the shifts 0 and 1, or which of 2 and 3
  logic half;
  assign upper   = high5_q + 33'(low5_q >>> 17);
  assign product = {upper, low5_q[16:0]};
  // One of four windows takes two LUT4 per bit.
  assign lesser  = gray5_q != window5_q[0] ? {33{window5_q[0]}} : window5_q[0] ? product[44:12] : product[32:0];
  assign window  = window5_q[1] ? (lesser & {{10{product[49]}}, product[49:27]}) | (~lesser & product[49:17]) : lesser;
  assign half   = window5_q[1] ? (window5_q[0] ? product[26] : product[16])
                               : (window5_q[0] && product[11]);

  logic signed [31:0] addend6_q, kept5_q;
  logic signed [32:0] window6_q;
  logic [17:0] top6_q;
  logic carry6_q, wraps6_q, inverse6_q;
  logic [1:0] shift6_q;
  always_ff @(posedge clk_i) begin
    addend6_q  <= no_addend5_q ? '0 : (acc5_q ? kept5_q : addend5_q) ^ {32{invert5_q}};
    window6_q  <= no_window5_q ? '0 : window;
    carry6_q   <= carry5_q || (half && rounds5_q);
    top6_q     <= no_window5_q ? '0 : product[49:32];
    shift6_q   <= window5_q;
    wraps6_q   <= wraps5_q;
    inverse6_q <= inverse5_q;
  end

  // Sum and saturation.
  logic signed [33:0] sum;
  logic sum_below;
  logic beyond_low, beyond_high, beyond, limited, sign;
  // One adder: the bit below the operands carries in.
  assign {sum, sum_below} = {34'(addend6_q), 1'b1} + {34'(window6_q), carry6_q};
  assign beyond_high = top6_q[17:12] != {6{top6_q[17]}};
  assign beyond_low  = top6_q[11:0] != {12{top6_q[17]}};
  assign beyond      = (shift6_q == 2'd0 && (beyond_low || beyond_high)) ||
                       (shift6_q == 2'd1 && beyond_high);
  assign limited     = !wraps6_q && (beyond || sum[33] != sum[32] || sum[32] != sum[31]);
  assign sign        = (beyond ? top6_q[17] : sum[33]) ^ inverse6_q;
  assign result6_o   = limited ? {sign, {31{!sign}}} : sum[31:0] ^ {32{inverse6_q}};

  // acc: the result, delayed until the same thread is in clock 5 again.
  logic signed [31:0] acc1_q, acc2_q, acc3_q, acc4_q;
  logic keep1_q;
  always_ff @(posedge clk_i) begin
    keep1_q <= keep6_i;
    acc1_q  <= result6_o;
    acc2_q  <= keep1_q ? acc1_q : '0;
    acc3_q  <= acc2_q;
    acc4_q  <= acc3_q;
    kept5_q <= acc4_q;
  end
endmodule

`default_nettype wire
