// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of scenes: each one entered, saturated, left; a tie of each rounded term.
// docs/testing.md
`default_nettype none

module scenes_cover #(
  parameter int Mask  = 0,
  parameter int Guard = 2,
  parameter int PartW = 24,
  parameter int TorqueW = 21,
  parameter int SceneTorqueW = 24
) (
  input logic clk_i,
  input logic rst_ni,
  input logic armed_i,
  input logic rounds,
  input logic [3:0] scene_i,
  input logic signed [PartW:0] sum_q,
  input logic signed [SceneTorqueW-1:0] rounded_q,
  input logic signed [TorqueW-1:0] word_q,
  input logic signed [TorqueW-1:0] late_term_o
);
  logic [3:0] before_q;
  logic       known_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      before_q <= '0;
      known_q  <= 1'b0;
    end else if (rounds) begin
      before_q <= scene_i;
      known_q  <= 1'b1;
    end
  end

  logic tie, wide;
  assign tie  = sum_q[Guard-1:0] == {1'b1, {(Guard - 1) {1'b0}}};
  assign wide = rounded_q[SceneTorqueW-1:TorqueW-1] != {(SceneTorqueW - TorqueW + 1) {rounded_q[SceneTorqueW-1]}};
  for (genvar n = 2; n < 10; n++) begin : g_scene
    localparam bit Built = Mask[n];
    localparam bit Rounds = n != int'(feltgate_map_pkg::SCENE_SETPOINT) && n != int'(feltgate_map_pkg::SCENE_MEMBRANE);
    logic here, enters, leaves;
    assign here   = armed_i && scene_i == 4'(n);
    assign enters = rounds && known_q && here && before_q != 4'(n);
    assign leaves = rounds && known_q && armed_i && scene_i != 4'(n) && before_q == 4'(n);
    if (Built) begin : g_built
      entered: cover property (@(posedge clk_i) disable iff (!rst_ni) enters);
      left:    cover property (@(posedge clk_i) disable iff (!rst_ni) leaves);
      acts:    cover property (@(posedge clk_i) disable iff (!rst_ni) here && (rounded_q != 0 || word_q != 0 || late_term_o != 0));
      if (Rounds) begin : g_rounds
        tie_even: cover property (@(posedge clk_i) disable iff (!rst_ni) rounds && here && tie && !sum_q[Guard]);
        tie_odd:  cover property (@(posedge clk_i) disable iff (!rst_ni) rounds && here && tie && sum_q[Guard]);
        beyond_any_torque: cover property (@(posedge clk_i) disable iff (!rst_ni) here && wide && word_q == 0);
      end
    end
  end
endmodule

bind scenes scenes_cover #(.Mask(Mask), .Guard(Guard), .PartW(PartW), .TorqueW(TorqueW),
                           .SceneTorqueW(feltgate_pkg::SCENE_TORQUE_W)) u_cover (.rounds(wave_i[AtRounded]), .*);

`default_nettype wire
