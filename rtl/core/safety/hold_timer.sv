// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measures how long a torque above hold_torque acts on a lever that stands still (torque_control
// puts tau_ref on the limiter for it). After hold_time derated_o makes hold_limit
// limit the torque too, until the encoder moves or the axis disarms. Once per tick, in EVENT_AT_HOLD.
// Documentation: docs/blocks/supervisor.md
`default_nettype none

module hold_timer (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        armed_i,
    input  logic        at_hold_strong_i,
    input  logic        at_hold_i,
    input  logic [31:0] tick_count_i,
    input  logic [31:0] param_i,
    input  logic        moved_i,       // an encoder edge came in this tick
    input  logic        over_limit_i,  // one clock after the word hold_torque: |tau_ref| is above it
    output logic        derated_o      // hold_limit limits too
);
  localparam int W = feltgate_map_pkg::HOLD_BITS;

  logic [W-1:0] units_q;
  logic strong_q, holds, expired, unit;
  assign unit    = tick_count_i[feltgate_map_pkg::HOLD_UNIT_BITS-1:0] == '0;
  assign holds   = armed_i && !moved_i;
  assign expired = param_i[31] || (param_i[31:W] == '0 && units_q >= param_i[W-1:0]);  // a negative word is 0

  // No reset: until the first wave begins the count is held at 0.
  logic begun_q;
  always_ff @(posedge clk_i) begin
    if (!begun_q || (at_hold_i && (!holds || !strong_q))) units_q <= '0;
    else if (at_hold_i && unit) units_q <= units_q + W'(1);
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      strong_q  <= 1'b0;
      begun_q   <= 1'b0;
      derated_o <= 1'b0;
    end else begin
      if (at_hold_strong_i) begin
        strong_q <= over_limit_i;
        begun_q  <= 1'b1;
      end
      if (at_hold_i) derated_o <= holds && (derated_o || (strong_q && expired));
    end
  end

  logic unused;
  assign unused = ^tick_count_i;  // the block counts units of ticks
endmodule

`default_nettype wire
