// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The arithmetic of all blocks: the nearest value that fits, the nearest within a limit, a power of two, and
// one rounding, in 16 bits.
`default_nettype none

module values_proof (
    input logic               clk_i,
    input logic               rst_ni,
    input logic signed [15:0] x_i,
    input logic signed [15:0] y_i,
    input logic        [15:0] limit_i
);
  localparam int Bits = 9;  // of a format
  localparam int Drop = 5;  // of a rounding
  `include "reset.svh"
  logic signed [63:0] x, y, most, least, limit, rest, rounded, whole;
  assign x       = 64'(x_i);
  assign y       = 64'(y_i);
  assign most    = (64'sd1 <<< (Bits - 1)) - 64'sd1;
  assign least   = -64'sd1 - most;
  assign limit   = $signed({48'd0, limit_i});
  assign rounded = fx::add_rounded(y, x, Drop);
  assign whole   = rounded - y;
  assign rest    = (whole <<< Drop) - x;  // what the rounding adds, in 2^-Drop
  always_comb begin
    if (rst_ni && past_ok_q) begin
      saturates: assert (fx::saturate(x, Bits) == (x > most ? most : x < least ? least : x));
      overflow_is_told: assert (fx::overflows(x, Bits) == (x > most || x < least));
      limits: assert (fx::limited(x, 32'(limit_i)) == (x > limit ? limit : x < -limit ? -limit : x));
      beyond_is_told: assert (fx::beyond(x, 32'(limit_i)) == (x > limit || x < -limit));
      scales: assert (fx::scale(x, Drop) == x <<< Drop && fx::scale(x, -Drop) == x >>> Drop);
      sticky_keeps_what_is_lost: assert ((fx::scale_sticky(x, Drop) | 64'sd1) == (x >>> Drop | 64'sd1) &&
          ((fx::scale_sticky(x, Drop) & 64'sd1) != '0) == (((x >>> Drop) & 64'sd1) != '0 || (x & 64'sd31) != '0));
      rounds: assert (cfg::ROUNDING == 0 ? rest > -64'sd16 && rest <= 64'sd16 :
                      cfg::ROUNDING == 1 ? rest > -64'sd32 && rest <= 64'sd0 :
                      rest >= -64'sd16 && rest <= 64'sd16 && (rest != 64'sd16 && rest != -64'sd16 || (rounded & 64'sd1) == '0));
      one_rounding: assert (fx::add_rounded(64'sd0, x, Drop) == (x >>> Drop) + $signed({63'd0, fx::rounds_up(x, Drop, x[Drop])}));
      rounds_off: cover (rest == -64'sd7);
      limits_down: cover (x < -limit);
    end
  end
endmodule

`default_nettype wire
