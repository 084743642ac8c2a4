// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measures how long a torque above hold_torque acts on a lever that stands still. After hold_time
// the torque limit is hold_limit until the encoder moves or the axis disarms. Evaluated once per
// tick, in EVENT_AT_HOLD.
// Documentation: docs/blocks/hold_timer.md
`default_nettype none

module hold_timer (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        armed_i,
    /* verilator lint_off UNUSEDSIGNAL */  // the block takes its own clocks and bits
    input  logic [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input  logic [31:0] tick_count_i,
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic [31:0] param_i,
    input  logic        moved_i,       // an encoder edge came in this tick
    input  logic        over_limit_i,  // one clock after the word hold_torque: |tau_ref| is above it
    output logic        derated_o      // the torque limit is hold_limit
);
  localparam int W = feltgate_map_pkg::HOLD_BITS;
  localparam int Hold = feltgate_map_pkg::EVENT_AT_HOLD;  // hold_time is on the bus

  logic [W-1:0] units_q;
  logic strong_q, holds, expired, unit;
  assign unit    = tick_count_i[feltgate_map_pkg::HOLD_UNIT_BITS-1:0] == '0;
  assign holds   = armed_i && !moved_i;
  assign expired = param_i[31] || (param_i[31:W] == '0 && units_q >= param_i[W-1:0]);  // a negative word is 0

  always_ff @(posedge clk_i) begin
    if (wave_i[feltgate_map_pkg::EVENT_AT_HOLD_STRONG]) strong_q <= over_limit_i;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      units_q <= '0;
      derated_o <= 1'b0;
    end else if (wave_i[Hold]) begin
      derated_o <= holds && (derated_o || (strong_q && expired));
      if (!holds || !strong_q) units_q <= '0;
      else if (unit) units_q <= units_q + W'(1);
    end
  end
endmodule

`default_nettype wire
