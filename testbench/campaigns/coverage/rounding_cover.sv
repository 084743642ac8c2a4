// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of rounding: every tie, beside it on both sides, of a number and of a negated one, in each mode.
// docs/testing.md
`default_nettype none

module rounding_cover #(
  parameter int Drop = 2
) (
  input logic [Drop:0] low_i,
  input logic          negated_i,
  input logic          half,
  input logic          rest
);
  for (genvar n = 0; n < 4; n++) begin : g_kind  // kept bit odd, negated
    logic here;
    assign here = {low_i[Drop], negated_i} == 2'(n);
    if (feltgate_pkg::ROUNDING == 0) begin : g_half_up
      always_comb begin
        half_up_tie:   cover (here && half && !rest);
        half_up_above: cover (here && half && rest);
        half_up_below: cover (here && !half && rest);
        half_up_exact: cover (here && !half && !rest);
      end
    end else if (feltgate_pkg::ROUNDING == 1) begin : g_floor
      always_comb begin
        floor_tie:   cover (here && half && !rest);
        floor_above: cover (here && half && rest);
        floor_below: cover (here && !half && rest);
        floor_exact: cover (here && !half && !rest);
      end
    end else begin : g_even
      always_comb begin
        even_tie:   cover (here && half && !rest);
        even_above: cover (here && half && rest);
        even_below: cover (here && !half && rest);
        even_exact: cover (here && !half && !rest);
      end
    end
  end
endmodule

bind rounding rounding_cover #(.Drop(Drop)) u_cover (.*);

`default_nettype wire
