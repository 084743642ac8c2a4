// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scene: a constant torque, the word of slot 10.
// Latency: start in wave clock 1, torque in 12 and held; 0 while the scene is not selected.
// docs/blocks/scene_setpoint.md

`default_nettype none

module scene_setpoint #(
    parameter int Defect = 0  // 1: torque stays when the scene is left, 2: word of the slot before
) (
    input  logic                                     clk_i,
    input  logic                                     rst_ni,
    input  logic                                     select_i,
    input  logic                                     start_i,
    input  logic        [                      31:0] param_i,
    output logic signed [feltgate_pkg::TORQUE_W-1:0] tau_o
);
  localparam int TorqueW = feltgate_pkg::TORQUE_W;

  logic [9:0] stage_q;  // stage_q[k]: wave clock k + 2
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) stage_q <= '0;
    else stage_q <= {stage_q[8:0], start_i};
  end

  logic signed [TorqueW-1:0] word_q;
  always_ff @(posedge clk_i) begin
    if (!select_i && Defect != 1) word_q <= '0;
    else word_q <= param_i[TorqueW-1:0];
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) tau_o <= '0;
    else if ((Defect == 2) ? stage_q[8] : stage_q[9]) tau_o <= word_q;
  end

  logic unused;
  assign unused = &{param_i[31:TorqueW], stage_q[9:8]};
endmodule

`default_nettype wire
