// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core's rounding: up_o tells whether to add 1 after the lowest Drop bits are dropped. The
// design selects half up, down (floor), or half to even. With negated_i the input is -x, and up_o
// makes the result -round(x). Combinational. docs/architecture.md, docs/fixed-point.md

`default_nettype none

module rounding #(
    parameter int Drop = 2
) (
    input  logic [Drop:0] low_i,      // the dropped bits and the lowest kept bit
    input  logic          negated_i,
    output logic          up_o
);
  localparam logic [Drop-1:0] Below = (Drop'(1) << (Drop - 1)) - Drop'(1);
  logic half, rest;
  assign half = low_i[Drop-1];
  assign rest = (low_i[Drop-1:0] & Below) != '0;  // dropped bits below the half

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
