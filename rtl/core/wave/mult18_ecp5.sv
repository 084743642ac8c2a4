// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Signed 18 x 18 multiplier in one ECP5 MULT18X18D; its pipeline and output registers are used. The
// operand registers are in the fabric, near the logic that drives them: the route to the cell is
// long. Only with FELTGATE_ECP5, because Yosys infers the cell but packs no registers into it.
// Latency: operands in clock t, product in clock t + 3. docs/architecture.md, docs/synthesis.md

`default_nettype none

module mult18_ecp5 (
    input  logic               clk_i,
    input  logic signed [17:0] a_i,
    input  logic signed [17:0] b_i,
    output logic signed [35:0] product_o
);
  logic signed [17:0] a_q, b_q;
  always_ff @(posedge clk_i) begin
    a_q <= a_i;
    b_q <= b_i;
  end

  // No reset: the power-up contents have left the registers before the first wave. Open pins: the
  // shift chains (SRI*, SRO*) and the operand copies (RO*), which have no route to the fabric; C,
  // which SOURCEB_MODE does not use; SIGNEDP; clocks, enables and resets 1 to 3.
  /* verilator lint_off PINMISSING */
  MULT18X18D #(
      .REG_INPUTA_CLK("NONE"),
      .REG_INPUTA_CE("CE0"),
      .REG_INPUTA_RST("RST0"),
      .REG_INPUTB_CLK("NONE"),
      .REG_INPUTB_CE("CE0"),
      .REG_INPUTB_RST("RST0"),
      .REG_INPUTC_CLK("NONE"),
      .REG_PIPELINE_CLK("CLK0"),
      .REG_PIPELINE_CE("CE0"),
      .REG_PIPELINE_RST("RST0"),
      .REG_OUTPUT_CLK("CLK0"),
      .REG_OUTPUT_CE("CE0"),
      .REG_OUTPUT_RST("RST0"),
      .CLK0_DIV("ENABLED"),
      .CLK1_DIV("ENABLED"),
      .CLK2_DIV("ENABLED"),
      .CLK3_DIV("ENABLED"),
      .HIGHSPEED_CLK("NONE"),
      .GSR("DISABLED"),
      .CAS_MATCH_REG("FALSE"),
      .SOURCEB_MODE("B_SHIFT"),
      .MULT_BYPASS("DISABLED"),
      .RESETMODE("SYNC")
  ) u_mult (
      .CLK0(clk_i),
      .CE0(1'b1),
      .RST0(1'b0),
      .SIGNEDA(1'b1),
      .SIGNEDB(1'b1),
      .SOURCEA(1'b0),
      .SOURCEB(1'b0),
      .A0(a_q[0]), .A1(a_q[1]), .A2(a_q[2]), .A3(a_q[3]),
      .A4(a_q[4]), .A5(a_q[5]), .A6(a_q[6]), .A7(a_q[7]),
      .A8(a_q[8]), .A9(a_q[9]), .A10(a_q[10]), .A11(a_q[11]),
      .A12(a_q[12]), .A13(a_q[13]), .A14(a_q[14]), .A15(a_q[15]),
      .A16(a_q[16]), .A17(a_q[17]),
      .B0(b_q[0]), .B1(b_q[1]), .B2(b_q[2]), .B3(b_q[3]),
      .B4(b_q[4]), .B5(b_q[5]), .B6(b_q[6]), .B7(b_q[7]),
      .B8(b_q[8]), .B9(b_q[9]), .B10(b_q[10]), .B11(b_q[11]),
      .B12(b_q[12]), .B13(b_q[13]), .B14(b_q[14]), .B15(b_q[15]),
      .B16(b_q[16]), .B17(b_q[17]),
      .P0(product_o[0]), .P1(product_o[1]), .P2(product_o[2]), .P3(product_o[3]),
      .P4(product_o[4]), .P5(product_o[5]), .P6(product_o[6]), .P7(product_o[7]),
      .P8(product_o[8]), .P9(product_o[9]), .P10(product_o[10]), .P11(product_o[11]),
      .P12(product_o[12]), .P13(product_o[13]), .P14(product_o[14]), .P15(product_o[15]),
      .P16(product_o[16]), .P17(product_o[17]), .P18(product_o[18]), .P19(product_o[19]),
      .P20(product_o[20]), .P21(product_o[21]), .P22(product_o[22]), .P23(product_o[23]),
      .P24(product_o[24]), .P25(product_o[25]), .P26(product_o[26]), .P27(product_o[27]),
      .P28(product_o[28]), .P29(product_o[29]), .P30(product_o[30]), .P31(product_o[31]),
      .P32(product_o[32]), .P33(product_o[33]), .P34(product_o[34]), .P35(product_o[35])
  );
  /* verilator lint_on PINMISSING */
endmodule

`default_nettype wire
