// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Both widths in use: the guard bits of a scene's sum, and the fraction of the duty. r is what the block
// makes of a number v of the product's width; the error r * 2^Drop - v is bounded as an inequality.
`default_nettype none

module nearest_proof (
    input logic                                  clk_i,
    input logic signed [feltgate_pkg::PRODUCT_BITS-1:0] v_i,
    input logic                                  negated_i
);
  localparam int W = feltgate_pkg::PRODUCT_BITS;
  localparam int Guard = feltgate_pkg::SCENE_GUARD_BITS;
  localparam int Duty = feltgate_pkg::VOLTAGE_F + feltgate_pkg::P_DUTY_GAIN_F;

  logic guard_up, duty_up;
  rounding #(
      .Drop(Guard)
  ) u_guard (
      .low_i(v_i[Guard:0]),
      .negated_i(negated_i),
      .up_o(guard_up)
  );
  rounding #(
      .Drop(Duty)
  ) u_duty (
      .low_i(v_i[Duty:0]),
      .negated_i(negated_i),
      .up_o(duty_up)
  );

  // The error, in units of the number's last bit.
  logic signed [W+1:0] v, guard_r, duty_r, guard_error, duty_error, guard_half, duty_half;
  assign v           = (W + 2)'(v_i);
  assign guard_r     = (v >>> Guard) + (W + 2)'($signed({1'b0, guard_up}));
  assign duty_r      = (v >>> Duty) + (W + 2)'($signed({1'b0, duty_up}));
  assign guard_error = (guard_r <<< Guard) - v;
  assign duty_error  = (duty_r <<< Duty) - v;
  assign guard_half  = (W + 2)'(1) <<< (Guard - 1);
  assign duty_half   = (W + 2)'(1) <<< (Duty - 1);

  logic guard_near, duty_near, guard_tie, duty_tie, floor;
  assign floor = feltgate_pkg::ROUNDING == 1;
  always_comb begin
    if (floor) begin
      guard_near = negated_i ? guard_error >= 0 && guard_error < 2 * guard_half
                             : guard_error <= 0 && guard_error > -2 * guard_half;
      duty_near  = negated_i ? duty_error >= 0 && duty_error < 2 * duty_half
                             : duty_error <= 0 && duty_error > -2 * duty_half;
    end else begin
      guard_near = guard_error <= guard_half && guard_error >= -guard_half;
      duty_near  = duty_error <= duty_half && duty_error >= -duty_half;
    end
    if (feltgate_pkg::ROUNDING == 0) begin
      guard_tie = negated_i ? guard_error != guard_half : guard_error != -guard_half;
      duty_tie  = negated_i ? duty_error != duty_half : duty_error != -duty_half;
    end else begin
      guard_tie = floor || (guard_error != guard_half && guard_error != -guard_half) || !guard_r[0];
      duty_tie  = floor || (duty_error != duty_half && duty_error != -duty_half) || !duty_r[0];
    end
  end
  always_comb begin
    guard_error_is_half: assert (guard_near);
    duty_error_is_half: assert (duty_near);
    guard_tie_goes_right: assert (guard_tie);
    duty_tie_goes_right: assert (duty_tie);
    goes_up: cover (duty_up && v_i < 0);
    stays: cover (!duty_up && v_i[Duty-1:0] != '0);
    tie: cover (v_i[Duty-1:0] == duty_half[Duty-1:0]);
  end
  logic unused;
  assign unused = clk_i;
endmodule

`default_nettype wire
