// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two causes of fault, a clock after start_i. trip_o: the velocity is above its limit. jump_o: it has
// changed in a tick by more than the low-pass allows, so some hardware is broken. A step of the low-pass,
// a1 * (x - y), is below 2^Weight LSB for every word a1; therefore the bits of the velocity from Weight
// up change by one at most. docs/blocks/safety.md

`default_nettype none

module overspeed (
    input  logic                              clk_i,
    input  logic                              rst_ni,
    input  cfg::params_t                      p,
    input  logic                              start_i,     // velocity_i is new and holds
    input  logic signed [cfg::VELOCITY_W-1:0] velocity_i,  // rad/s
    output logic                              trip_o,      // one clock
    output logic                              jump_o       // one clock
);
  localparam int W = cfg::VELOCITY_W;
  localparam int Weight = W + 17 - cfg::P_VELOCITY_A1_F;
  localparam bit Jumps = Weight >= 0 && Weight <= W - 2;  // else the filter may change by its whole range
  localparam int Drop = Jumps ? Weight : 0;

  logic signed [63:0] moved;
  logic signed [W-1:0] before_q;
  logic too_fast_q, jumped_q, at;
  assign moved = (64'(velocity_i) >>> Drop) - (64'(before_q) >>> Drop);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {before_q, too_fast_q, jumped_q, at} <= '0;
    end else begin
      at <= start_i;
      if (start_i) begin
        before_q   <= velocity_i;
        too_fast_q <= fx::beyond(64'(velocity_i), 32'(p.overspeed));
        jumped_q   <= Jumps && fx::beyond(moved, 32'd1);
      end
    end
  end
  assign trip_o = at && too_fast_q;
  assign jump_o = at && jumped_q;
endmodule

`default_nettype wire
