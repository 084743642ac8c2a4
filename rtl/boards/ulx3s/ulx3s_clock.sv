// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generates the design's clock from the board's 25 MHz with one PLL of the ECP5. The oscillator
// needs 400 to 800 MHz, the phase detector at least 3.125 MHz, so the clock must be a multiple of
// 25 MHz / n, n <= 8.
// Documentation: docs/boards/ulx3s.md
`default_nettype none

module ulx3s_clock (
  input  logic clk_25mhz_i,
  output logic clk_o,
  output logic locked_o
);

  localparam int INPUT_HZ = 25000000;
  localparam int C = cfg::CLOCK_HZ;
  // Frequencies are in units of 25 kHz, so that the products below fit 32 bits.
  localparam int STEP_HZ = 25000;
  localparam int K = C / STEP_HZ;
  localparam int N = INPUT_HZ / STEP_HZ;
  localparam int INPUT_DIV = (K % N == 0) ? 1 : (2 * K % N == 0) ? 2 : (3 * K % N == 0) ? 3 :
                             (4 * K % N == 0) ? 4 : (5 * K % N == 0) ? 5 : (6 * K % N == 0) ? 6 :
                             (7 * K % N == 0) ? 7 : 8;
  localparam int FEEDBACK_DIV = INPUT_DIV * K / N;
  // Aim at 600 MHz, the middle of the oscillator's range.
  localparam int OUTPUT_DIV = (600000000 + C / 2) / C;

  generate
  if (!(C % STEP_HZ == 0 && INPUT_DIV * K % N == 0 && FEEDBACK_DIV >= 1 && FEEDBACK_DIV <= 80 &&
        OUTPUT_DIV >= 1 && OUTPUT_DIV <= 128)) begin : g_check_clock
    the_clock_of_the_design_must_be_made_of_25_MHz_by_the_PLL missing ();
  end
  endgenerate

  // Open pins are not used.
  /* verilator lint_off PINCONNECTEMPTY */
  (* FREQUENCY_PIN_CLKI = "25" *)
  EHXPLLL #(
    .CLKI_DIV(INPUT_DIV),
    .CLKFB_DIV(FEEDBACK_DIV),
    .CLKOP_DIV(OUTPUT_DIV),
    .CLKOP_CPHASE(OUTPUT_DIV - 1),
    .CLKOP_ENABLE("ENABLED"),
    .FEEDBK_PATH("CLKOP")
  ) u_pll (
    .CLKI(clk_25mhz_i),
    .CLKFB(clk_o),
    .PHASESEL1(1'b0),
    .PHASESEL0(1'b0),
    .PHASEDIR(1'b0),
    .PHASESTEP(1'b0),
    .PHASELOADREG(1'b0),
    .STDBY(1'b0),
    .PLLWAKESYNC(1'b0),
    .RST(1'b0),
    .ENCLKOP(1'b0),
    .ENCLKOS(1'b0),
    .ENCLKOS2(1'b0),
    .ENCLKOS3(1'b0),
    .CLKOP(clk_o),
    .CLKOS(),
    .CLKOS2(),
    .CLKOS3(),
    .LOCK(locked_o),
    .INTLOCK(),
    .REFCLK(),
    .CLKINTFB()
  );
  /* verilator lint_on PINCONNECTEMPTY */
endmodule

`default_nettype wire
