// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's one rounding: whether a number goes up when its lowest Drop bits are dropped, as the
// design says: half up, down, or half to even. With negated_i the number is the negative of one that
// is meant to be rounded so, and the negative of that rounding comes out.
// Combinational. docs/blocks/rounding.md, docs/fixed-point.md

`default_nettype none

module rounding #(
    parameter int Drop = 2
) (
    input  logic [Drop:0] low_i,      // the bits that are dropped and the lowest that is kept
    input  logic          negated_i,
    output logic          up_o
);
  localparam logic [Drop-1:0] Below = (Drop'(1) << (Drop - 1)) - Drop'(1);
  logic half, rest;
  assign half = low_i[Drop-1];
  assign rest = (low_i[Drop-1:0] & Below) != '0;  // beyond the half

  generate
  if (feltgate_pkg::ROUNDING == 0) begin : gen_half_up
    assign up_o = half && (rest || !negated_i);
  end else if (feltgate_pkg::ROUNDING == 1) begin : gen_floor
    assign up_o = negated_i && (half || rest);
  end else begin : gen_to_even
    assign up_o = half && (rest || low_i[Drop]);
  end
  endgenerate

  logic unused;
  assign unused = ^{low_i, negated_i, rest};
endmodule

`default_nettype wire
