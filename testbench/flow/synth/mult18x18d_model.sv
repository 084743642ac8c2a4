// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Behaviour of the ECP5 cell MULT18X18D as this project uses it: each operand with a sign or without,
// with or without its input, pipeline and output registers, all on CLK0, CE0 and a synchronous RST0. After
// Lattice FPGA-TN-02205 (ECP5 sysDSP usage guide), figure "18x18 multiplier". Another option does not
// elaborate; an operand from the shift chain is wrong on purpose.
// docs/synthesis.md

`default_nettype none

module MULT18X18D #(
    parameter REG_INPUTA_CLK = "NONE",
    parameter REG_INPUTA_CE = "CE0",
    parameter REG_INPUTA_RST = "RST0",
    parameter REG_INPUTB_CLK = "NONE",
    parameter REG_INPUTB_CE = "CE0",
    parameter REG_INPUTB_RST = "RST0",
    parameter REG_INPUTC_CLK = "NONE",
    parameter REG_PIPELINE_CLK = "NONE",
    parameter REG_PIPELINE_CE = "CE0",
    parameter REG_PIPELINE_RST = "RST0",
    parameter REG_OUTPUT_CLK = "NONE",
    parameter REG_OUTPUT_CE = "CE0",
    parameter REG_OUTPUT_RST = "RST0",
    parameter CLK0_DIV = "ENABLED",
    parameter CLK1_DIV = "ENABLED",
    parameter CLK2_DIV = "ENABLED",
    parameter CLK3_DIV = "ENABLED",
    parameter HIGHSPEED_CLK = "NONE",
    parameter GSR = "ENABLED",
    parameter CAS_MATCH_REG = "FALSE",
    parameter SOURCEB_MODE = "B_SHIFT",
    parameter MULT_BYPASS = "DISABLED",
    parameter RESETMODE = "SYNC"
) (
    input wire CLK0, CE0, RST0, SIGNEDA, SIGNEDB, SOURCEA, SOURCEB,
    input wire A0, A1, A2, A3, A4, A5, A6, A7, A8, A9, A10, A11, A12, A13, A14, A15, A16, A17,
    input wire B0, B1, B2, B3, B4, B5, B6, B7, B8, B9, B10, B11, B12, B13, B14, B15, B16, B17,
    input wire C0, C1, C2, C3, C4, C5, C6, C7, C8, C9, C10, C11, C12, C13, C14, C15, C16, C17,
    output wire P0, P1, P2, P3, P4, P5, P6, P7, P8, P9, P10, P11, P12, P13, P14, P15, P16, P17,
    output wire P18, P19, P20, P21, P22, P23, P24, P25, P26, P27, P28, P29, P30, P31, P32, P33,
    output wire P34, P35
);
  localparam IN_A = REG_INPUTA_CLK != "NONE";
  localparam IN_B = REG_INPUTB_CLK != "NONE";
  localparam PIPE = REG_PIPELINE_CLK != "NONE";
  localparam OUT = REG_OUTPUT_CLK != "NONE";
  generate
    if ((IN_A && REG_INPUTA_CLK != "CLK0") || (IN_B && REG_INPUTB_CLK != "CLK0") ||
        (PIPE && REG_PIPELINE_CLK != "CLK0") || (OUT && REG_OUTPUT_CLK != "CLK0") ||
        REG_INPUTC_CLK != "NONE" || HIGHSPEED_CLK != "NONE" || CLK0_DIV != "ENABLED" ||
        REG_INPUTA_CE != "CE0" || REG_INPUTB_CE != "CE0" || REG_PIPELINE_CE != "CE0" ||
        REG_OUTPUT_CE != "CE0" || REG_INPUTA_RST != "RST0" || REG_INPUTB_RST != "RST0" ||
        REG_PIPELINE_RST != "RST0" || REG_OUTPUT_RST != "RST0" || CAS_MATCH_REG != "FALSE" ||
        SOURCEB_MODE != "B_SHIFT" || MULT_BYPASS != "DISABLED" || RESETMODE != "SYNC")
    begin : g_refuse
      this_use_of_the_cell_is_not_modelled refused ();
    end
  endgenerate

  wire signed [18:0] a = {SIGNEDA & A17, A17, A16, A15, A14, A13, A12, A11, A10, A9, A8, A7, A6, A5,
                          A4, A3, A2, A1, A0 ^ SOURCEA};
  wire signed [18:0] b = {SIGNEDB & B17, B17, B16, B15, B14, B13, B12, B11, B10, B9, B8, B7, B6, B5,
                          B4, B3, B2, B1, B0 ^ SOURCEB};
  reg  signed [18:0] a_q = 0, b_q = 0;
  reg  signed [35:0] pipe_q = 0, out_q = 0;
  wire signed [18:0] a_used = IN_A ? a_q : a;
  wire signed [18:0] b_used = IN_B ? b_q : b;
  wire signed [35:0] product = a_used * b_used;
  wire signed [35:0] piped = PIPE ? pipe_q : product;
  wire signed [35:0] p = OUT ? out_q : piped;
  always @(posedge CLK0) begin
    if (RST0) begin
      a_q    <= 0;
      b_q    <= 0;
      pipe_q <= 0;
      out_q  <= 0;
    end else if (CE0) begin
      a_q    <= a;
      b_q    <= b;
      pipe_q <= product;
      out_q  <= piped;
    end
  end
  assign {P35, P34, P33, P32, P31, P30, P29, P28, P27, P26, P25, P24, P23, P22, P21, P20, P19, P18,
          P17, P16, P15, P14, P13, P12, P11, P10, P9, P8, P7, P6, P5, P4, P3, P2, P1, P0} = p;
endmodule

`default_nettype wire
