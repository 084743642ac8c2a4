// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Fixed-point arithmetic of all blocks. A value of any format comes sign-extended to 64 bits; the
// caller casts the result to the width of its register, and synthesis removes the bits that nobody
// reads. No function calls another one, which Quartus is said to refuse. docs/boards/quartus.md,
// docs/fixed-point.md

`default_nettype none

package fx;
  // 1: x without its lowest `drop` bits is rounded up. `odd` is the lowest bit of what is rounded.
  function automatic logic rounds_up(input logic signed [63:0] x, input int drop, input logic odd);
    logic half, rest;
    half = 1'((x >>> (drop - 1)) & 64'sd1);
    rest = (x & ((64'sd1 <<< (drop - 1)) - 64'sd1)) != 64'sd0;
    rounds_up = half && (cfg::ROUNDING == 0 || (cfg::ROUNDING == 2 && (rest || odd)));  // half up, down, half to even
  endfunction

  // y + x * 2^-drop, rounded as above. One adder: the bit below the operands carries the rounding in.
  function automatic logic signed [63:0] add_rounded(input logic signed [63:0] y,
                                                     input logic signed [63:0] x, input int drop);
    logic half, rest, odd;
    logic signed [63:0] whole;
    logic signed [64:0] twice;
    whole = x >>> drop;
    half  = 1'((x >>> (drop - 1)) & 64'sd1);
    rest  = (x & ((64'sd1 <<< (drop - 1)) - 64'sd1)) != 64'sd0;
    odd   = y[0] ^ whole[0];
    half  = half && (cfg::ROUNDING == 0 || (cfg::ROUNDING == 2 && (rest || odd)));
    twice = {y, 1'b1} + {whole, half};
    add_rounded = twice[64:1];
  endfunction

  // x * 2^exponent, truncated.
  function automatic logic signed [63:0] scale(input logic signed [63:0] x, input int exponent);
    scale = exponent >= 0 ? x <<< exponent : x >>> -exponent;
  endfunction

  // x * 2^-drop, truncated, with the lowest bit set where a dropped bit was: to be rounded once more.
  function automatic logic signed [63:0] scale_sticky(input logic signed [63:0] x, input int drop);
    scale_sticky = x >>> drop;
    if ((x & ((64'sd1 <<< drop) - 64'sd1)) != 64'sd0) scale_sticky[0] = 1'b1;
  endfunction

  // x does not fit a signed format of so many bits.
  function automatic logic overflows(input logic signed [63:0] x, input int bits);
    overflows = (x >>> (bits - 1)) != 64'sd0 && (x >>> (bits - 1)) != -64'sd1;
  endfunction

  // The nearest value of a signed format of so many bits.
  function automatic logic signed [63:0] saturate(input logic signed [63:0] x, input int bits);
    if ((x >>> (bits - 1)) == 64'sd0 || (x >>> (bits - 1)) == -64'sd1) saturate = x;
    else saturate = x[63] ? -(64'sd1 <<< (bits - 1)) : (64'sd1 <<< (bits - 1)) - 64'sd1;
  endfunction

  // |x| > limit. For a negative x, {~x, 1} = 2|x| - 1, so this needs no adder.
  function automatic logic beyond(input logic signed [63:0] x, input logic [31:0] limit);
    logic [63:0] size;
    size   = x ^ {64{x[63]}};
    beyond = size[63:32] != 32'd0 || {size[31:0], x[63]} > {limit, 1'b0};
  endfunction

  // The nearest value in -limit .. limit.
  function automatic logic signed [63:0] limited(input logic signed [63:0] x, input logic [31:0] limit);
    logic [63:0] size;
    size = x ^ {64{x[63]}};
    if (size[63:32] == 32'd0 && {size[31:0], x[63]} <= {limit, 1'b0}) limited = x;
    else limited = x[63] ? -$signed({32'd0, limit}) : $signed({32'd0, limit});
  endfunction
endpackage

`default_nettype wire
