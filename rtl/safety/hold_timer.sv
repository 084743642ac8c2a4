// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measures for how long a torque above hold_torque acts on a lever that stands still. After hold_time
// derated_o makes hold_limit limit the torque too, until the encoder moves or the axis disarms. New
// two clocks after start_i. docs/blocks/safety.md

`default_nettype none

module hold_timer (
    input  logic                            clk_i,
    input  logic                            rst_ni,
    input  cfg::params_t                    p,
    input  logic                            armed_i,
    input  logic        [             31:0] tick_count_i,
    input  logic                            start_i,    // tau_ref_i is new; all inputs hold for two clocks
    input  logic signed [cfg::TORQUE_W-1:0] tau_ref_i,  // Nm
    input  logic                            moved_i,    // an edge came since the tick before
    output logic                            derated_o
);
  localparam int W = map::HOLD_BITS;
  logic [W-1:0] units_q;  // of 2^HOLD_UNIT_BITS ticks
  logic strong_q, holds, at;
  assign holds = armed_i && !moved_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {units_q, strong_q, derated_o, at} <= '0;
    end else begin
      at <= start_i;
      if (start_i) strong_q <= fx::beyond(64'(tau_ref_i), 32'(p.hold_torque));
      if (at) begin
        if (!holds || !strong_q) units_q <= '0;
        else if (tick_count_i[map::HOLD_UNIT_BITS-1:0] == '0) units_q <= units_q + 1'b1;
        derated_o <= holds && (derated_o || (strong_q && {1'b0, units_q} >= p.hold_time));
      end
    end
  end
endmodule

`default_nettype wire
