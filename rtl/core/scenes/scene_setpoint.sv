// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene: a constant torque.
// Latency: plus_o one clock after its word, held; 0 while the scene is not selected.
// docs/blocks/scenes.md

`default_nettype none

module scene_setpoint (
    input  logic                                     clk_i,
    input  logic                                     select_i,
    input  logic                                     param_is_setpoint_torque_i,
    input  logic        [                      31:0] param_i,
    output logic signed [feltgate_pkg::TORQUE_W-1:0] plus_o
);
  always_ff @(posedge clk_i) begin
    if (!select_i) plus_o <= '0;
    else if (param_is_setpoint_torque_i) begin
      plus_o <= param_i[feltgate_pkg::TORQUE_W-1:0];
    end
  end

  logic unused;
  assign unused = ^param_i;  // a torque has fewer bits than a word
endmodule

`default_nettype wire
