// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Limits the torque of the scene and ramps it. After arming, a change of scene, of the limit after a
// long hold, or restart_i, tau_ref moves by at most a step a tick until it has reached the scene's
// torque; after that it is not slowed. While frozen_i it may only shrink. valid_o 3 clocks after
// start_i. docs/blocks/ramp.md

`default_nettype none

module ramp (
    input  logic                                  clk_i,
    input  logic                                  rst_ni,
    input  cfg::params_t                          p,
    input  logic                                  armed_i,
    input  logic        [                    3:0] scene_i,
    input  logic                                  restart_i,       // last clock of a tick: ramp from now on
    input  logic                                  frozen_i,
    input  logic                                  derated_i,       // hold_limit limits too
    input  logic                                  testing_i,       // self_test_torque limits too
    input  logic                                  sample_i,        // a tick begins
    input  logic                                  start_i,         // torque_i is new and holds
    input  logic signed [cfg::SCENE_TORQUE_W-1:0] torque_i,        // Nm
    output logic signed [      cfg::TORQUE_W-1:0] tau_ref_o,       // Nm, motor on lever; held
    output logic                                  limit_torque_o,  // the limit acts
    output logic                                  limit_ramp_o,    // the step acts
    output logic                                  limit_hold_o,    // hold_limit holds
    output logic                                  valid_o
);
  localparam int W = cfg::RAMP_W;
  localparam int T = cfg::TORQUE_W;
  localparam int Fine = cfg::RAMP_F - cfg::TORQUE_F;

  // The least of all that limit.
  logic [T-2:0] limit_q, limit;
  always_comb begin
    limit = p.torque_limit;
    if (derated_i && p.hold_limit < limit) limit = p.hold_limit;
    if (testing_i && p.self_test_torque < limit) limit = p.self_test_torque;
  end
  always_ff @(posedge clk_i) limit_q <= limit;

  logic [1:0] at;
  logic signed [T-1:0] target_q;
  logic signed [W-1:0] ramp_q, step;
  logic signed [W:0] excess_q, left;  // of the reference over the target, before and after a step
  logic [3:0] scene_q;
  logic ramping_q, over, down, reached, stepping, frozen;
  assign over      = fx::beyond(64'(torque_i), 32'(limit_q));
  assign tau_ref_o = ramp_q[W-1:Fine];
  assign frozen    = frozen_i && armed_i;
  assign down      = !excess_q[W];
  assign step      = frozen_i ? '0 : p.ramp_step == '0 ? W'(1) : W'(p.ramp_step);  // at least one LSB
  assign left      = down ? excess_q - (W + 1)'(step) : excess_q + (W + 1)'(step);
  assign reached   = left == '0 || left[W] == down;
  // While the torque is frozen, only a step that shrinks the reference and keeps its sign is taken.
  always_comb begin
    if (ramping_q && armed_i) stepping = 1'b1;
    else if (down)            stepping = frozen && (ramp_q[W-1] || target_q[T-1]);
    else                      stepping = frozen && (!ramp_q[W-1] || target_q > 0);
  end

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {at, valid_o, target_q, excess_q, ramp_q, scene_q, limit_torque_o, limit_ramp_o, limit_hold_o} <= '0;
      ramping_q <= 1'b1;
    end else begin
      {valid_o, at} <= {at, start_i};
      if (sample_i) begin
        scene_q      <= scene_i;
        limit_hold_o <= derated_i;
      end
      if (start_i) begin
        target_q       <= T'(fx::limited(64'(torque_i), 32'(limit_q)));
        limit_torque_o <= over && armed_i;
      end
      if (at[0]) excess_q <= (W + 1)'(ramp_q) - ((W + 1)'(target_q) <<< Fine);
      if (at[1]) begin
        limit_ramp_o <= stepping;
        if (!stepping || !reached) ramp_q <= (W'(target_q) <<< Fine) + (stepping ? W'(left) : '0);
      end
      // A ramp ends in the tick in which the target is within a step.
      if (restart_i) ramping_q <= 1'b1;
      else if (sample_i && (!armed_i || scene_i != scene_q || derated_i != limit_hold_o)) ramping_q <= 1'b1;
      else if (at[1] && stepping && reached) ramping_q <= 1'b0;
    end
  end
endmodule

`default_nettype wire
