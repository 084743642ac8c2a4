// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Cover points of ramp: what begins one, where it ends, what stays frozen.
// docs/testing.md
`default_nettype none

module ramp_cover #(
  parameter int W = 24
) (
  input logic clk_i,
  input logic rst_ni,
  input logic armed_i,
  input logic restart_i,
  input logic frozen_i,
  input logic derated_i,
  input logic limit_hold_o,
  input logic limit_torque_o,
  input logic begins,
  input logic moves,
  input logic changes,
  input logic [3:0] scene_i,
  input logic [3:0] scene_q,
  input logic ramping_q,
  input logic stepping_q,
  input logic stay_q,
  input logic down,
  input logic stepping,
  input logic frozen,
  input logic [W-2:0] step_q,
  input logic signed [W-1:0] change_q,
  input logic signed [W-1:0] ramp_q
);
  logic signed [W-1:0] next;
  assign next = ramp_q + change_q;

  begins_by_arming:  cover property (@(posedge clk_i) disable iff (!rst_ni) begins && !armed_i);
  begins_by_scene:   cover property (@(posedge clk_i) disable iff (!rst_ni) begins && armed_i && scene_i != scene_q && !ramping_q);
  begins_by_ease:    cover property (@(posedge clk_i) disable iff (!rst_ni) begins && armed_i && derated_i && !limit_hold_o);
  begins_by_relief:  cover property (@(posedge clk_i) disable iff (!rst_ni) begins && armed_i && !derated_i && limit_hold_o);
  begins_by_restart: cover property (@(posedge clk_i) disable iff (!rst_ni) restart_i && armed_i && !ramping_q);
  steps_up:          cover property (@(posedge clk_i) disable iff (!rst_ni) moves && stepping_q && !stay_q && !down);
  steps_down:        cover property (@(posedge clk_i) disable iff (!rst_ni) moves && stepping_q && !stay_q && down);
  ends_up:           cover property (@(posedge clk_i) disable iff (!rst_ni) moves && ramping_q && stay_q && !down);
  ends_down:         cover property (@(posedge clk_i) disable iff (!rst_ni) moves && ramping_q && stay_q && down);
  at_once_up:        cover property (@(posedge clk_i) disable iff (!rst_ni) moves && !stepping_q && !down);
  at_once_down:      cover property (@(posedge clk_i) disable iff (!rst_ni) moves && !stepping_q && down);
  step_0:            cover property (@(posedge clk_i) disable iff (!rst_ni) moves && stepping_q && step_q == '0 && !frozen_i);
  frozen_growth:     cover property (@(posedge clk_i) disable iff (!rst_ni) changes && frozen && !ramping_q && stepping);
  frozen_fall:       cover property (@(posedge clk_i) disable iff (!rst_ni) changes && frozen && !ramping_q && !stepping);
  frozen_sign:       cover property (@(posedge clk_i) disable iff (!rst_ni) changes && frozen && !ramping_q && stepping && down && ramp_q > 0);
  through_0:         cover property (@(posedge clk_i) disable iff (!rst_ni)
                                     moves && !stepping_q && next[W-1] != ramp_q[W-1] && ramp_q != 0 && next != 0);
  at_torque_limit:   cover property (@(posedge clk_i) disable iff (!rst_ni) limit_torque_o && ramping_q);
endmodule

bind ramp ramp_cover #(.W(W)) u_cover (
  .begins(at_ramp_begin_i), .moves(at_tau_ref_i),
  .changes(at_ramp_change_i), .*);

`default_nettype wire
