// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Stands in for the PLL of a Gowin GW1N where frequencies do not matter: passes its clock on and is locked
// unless it is reset. Parameters and ports as Yosys has them (gowin/cells_sim.v); Gowin UG286.
`default_nettype none

/* verilator lint_off UNUSEDPARAM */
/* verilator lint_off UNUSEDSIGNAL */
module rPLL #(
  parameter FCLKIN = "100.0",
  parameter DEVICE = "GW1N-1",
  parameter int IDIV_SEL = 0,
  parameter int FBDIV_SEL = 0,
  parameter int ODIV_SEL = 8
) (
  input  logic       CLKIN,
  input  logic       CLKFB,
  input  logic       RESET,
  input  logic       RESET_P,
  input  logic [5:0] FBDSEL,
  input  logic [5:0] IDSEL,
  input  logic [5:0] ODSEL,
  input  logic [3:0] DUTYDA,
  input  logic [3:0] PSDA,
  input  logic [3:0] FDLY,
  output logic       CLKOUT,
  output logic       CLKOUTP,
  output logic       CLKOUTD,
  output logic       CLKOUTD3,
  output logic       LOCK
);

  assign CLKOUT = CLKIN;
  assign LOCK = !RESET;
  assign {CLKOUTP, CLKOUTD, CLKOUTD3} = '0;
endmodule
/* verilator lint_on UNUSEDSIGNAL */
/* verilator lint_on UNUSEDPARAM */

`default_nettype wire
