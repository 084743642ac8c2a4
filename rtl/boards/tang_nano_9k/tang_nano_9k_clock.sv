// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generates the design's clock from the board's 27 MHz with one rPLL of the GW1NR-9C. The phase
// detector needs at least 3 MHz and the oscillator 400 to 1200 MHz, so the clock must be a multiple
// of 27 MHz / n, n <= 9, and at least 12.5 MHz.
// Documentation: docs/boards/tang_nano_9k.md
`default_nettype none

module tang_nano_9k_clock (
  input  logic clk_27mhz_i,
  output logic clk_o,
  output logic locked_o
);

  localparam int C = cfg::CLOCK_HZ;
  // Frequencies are in units of 3 kHz, so that the products below fit 32 bits.
  localparam int STEP_HZ = 3000;
  localparam int K = C / STEP_HZ;
  localparam int N = 27000000 / STEP_HZ;
  localparam int INPUT_DIV = (K % N == 0) ? 1 : (2 * K % N == 0) ? 2 : (3 * K % N == 0) ? 3 :
                             (4 * K % N == 0) ? 4 : (5 * K % N == 0) ? 5 : (6 * K % N == 0) ? 6 :
                             (7 * K % N == 0) ? 7 : (8 * K % N == 0) ? 8 : 9;
  localparam int FEEDBACK_DIV = INPUT_DIV * K / N;
  // The oscillator runs at 600 to 1200 MHz.
  localparam int OUTPUT_DIV = (C >= 300000000) ? 2 : (C >= 150000000) ? 4 : (C >= 75000000) ? 8 :
                              (C >= 37500000) ? 16 : (C >= 18750000) ? 32 : 48;

  generate
  if (!(C % STEP_HZ == 0 && INPUT_DIV * K % N == 0 && FEEDBACK_DIV >= 1 && FEEDBACK_DIV <= 64 &&
        C >= 12500000 && C <= 600000000)) begin : g_check_clock
    the_clock_of_the_design_must_be_made_of_27_MHz_by_the_PLL missing ();
  end
  endgenerate

  // Open pins are not used.
  /* verilator lint_off PINCONNECTEMPTY */
  rPLL #(
    .FCLKIN("27"),
    .DEVICE("GW1NR-9C"),
    .IDIV_SEL(INPUT_DIV - 1),
    .FBDIV_SEL(FEEDBACK_DIV - 1),
    .ODIV_SEL(OUTPUT_DIV)
  ) u_pll (
    .CLKIN(clk_27mhz_i),
    .CLKFB(1'b0),
    .RESET(1'b0),
    .RESET_P(1'b0),
    .FBDSEL(6'd0),
    .IDSEL(6'd0),
    .ODSEL(6'd0),
    .DUTYDA(4'd0),
    .PSDA(4'd0),
    .FDLY(4'd0),
    .CLKOUT(clk_o),
    .CLKOUTP(),
    .CLKOUTD(),
    .CLKOUTD3(),
    .LOCK(locked_o)
  );
  /* verilator lint_on PINCONNECTEMPTY */
endmodule

`default_nettype wire
