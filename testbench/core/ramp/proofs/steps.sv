// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How far the torque reference moves in a tick, and within which limit, for any torques, words and
// requests, tick after tick.
`default_nettype none

module steps_proof (
    input logic                                  clk_i,
    input logic                                  rst_ni,
    input cfg::params_t                          p,
    input logic                                  armed_i,
    input logic        [                    3:0] scene_i,
    input logic                                  restart_i,
    input logic                                  frozen_i,
    input logic                                  derated_i,
    input logic                                  testing_i,
    input logic                                  sample_i,
    input logic                                  start_i,
    input logic signed [cfg::SCENE_TORQUE_W-1:0] torque_i
);
  localparam int T = cfg::TORQUE_W;
  localparam int W = cfg::RAMP_W;
  localparam int Fine = cfg::RAMP_F - cfg::TORQUE_F;
  localparam int Wide = cfg::SCENE_TORQUE_W + 1;
  `include "reset.svh"
  logic signed [T-1:0] tau_ref;
  logic limit_torque, limit_ramp, limit_hold, valid;
  ramp u_dut (
      .*,
      .tau_ref_o(tau_ref),
      .limit_torque_o(limit_torque),
      .limit_ramp_o(limit_ramp),
      .limit_hold_o(limit_hold),
      .valid_o(valid)
  );
  (* hierconn *) wire signed [W-1:0] \u_dut.ramp_q ;
  (* hierconn *) wire signed [W:0] \u_dut.excess_q ;
  (* hierconn *) wire signed [T-1:0] \u_dut.target_q ;
  (* hierconn *) wire [T-2:0] \u_dut.limit_q ;
  (* hierconn *) wire [3:0] \u_dut.scene_q ;
  (* hierconn *) wire [1:0] \u_dut.at ;
  (* hierconn *) wire \u_dut.ramping_q ;
  wire signed [W:0] fine = (W + 1)'($signed( \u_dut.ramp_q ));
  wire ramping = \u_dut.ramping_q ;

  // A tick is a sample, then a start; the motor is armed and disarmed between its end and the next sample.
  logic armed_q, sampled_q, after_q, done_q;
  logic [1:0] at_q;
  always_ff @(posedge clk_i) armed_q <= armed_i;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {sampled_q, at_q, done_q, after_q} <= '0;
    else begin
      after_q   <= 1'b1;
      {done_q, at_q} <= {at_q, start_i};
      sampled_q <= sample_i || (sampled_q && !at_q[1]);
    end
  end
  always_comb begin
    assume (!start_i || (sampled_q && at_q == '0));
    assume (!sample_i || !sampled_q);
    assume (!sampled_q || (armed_i == armed_q && !restart_i));
  end

  // The least of all that limit, a clock ago, and the torque within it.
  logic signed [T:0] limit, limit_q, in_force_q;
  logic signed [Wide-1:0] torque, target;
  logic over;
  always_comb begin
    limit = $signed({2'b0, p.torque_limit});
    if (derated_i && $signed({2'b0, p.hold_limit}) < limit) limit = $signed({2'b0, p.hold_limit});
    if (testing_i && $signed({2'b0, p.self_test_torque}) < limit) limit = $signed({2'b0, p.self_test_torque});
  end
  assign torque = Wide'(torque_i);
  assign over   = torque > Wide'(limit_q) || torque < -(Wide'(limit_q));
  assign target = torque > Wide'(limit_q) ? Wide'(limit_q) : torque < -(Wide'(limit_q)) ? -(Wide'(limit_q)) : torque;

  // A tick of the ramp: target and step, what was there before, what there is now.
  logic signed [W:0] target_q, step_q, before_q, moved, left, most;
  logic ramps_q, frozen_q, over_q, started_q, zero_q;
  logic signed [T-1:0] tau_q;
  always_ff @(posedge clk_i) begin
    limit_q   <= limit;
    tau_q     <= tau_ref;
    started_q <= start_i;
    over_q    <= over && armed_i;
    if (start_i) {target_q, in_force_q} <= {(W + 1)'(target) <<< Fine, limit_q};
    if (at_q[1]) begin
      step_q   <= p.ramp_step == '0 ? (W + 1)'(1) : $signed({2'b0, p.ramp_step});
      before_q <= fine;
      ramps_q  <= ramping && armed_i;
      frozen_q <= frozen_i;
    end
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) zero_q <= 1'b0;
    else if (done_q) zero_q <= !armed_q && target_q == '0;  // the last tick was disarmed, and without a torque
  end
  assign moved = fine - before_q;
  assign left  = target_q - fine;
  assign most  = (W + 1)'(in_force_q) <<< Fine;

  // What must make it ramp: disarmed, another scene, another limit, a request.
  logic [3:0] scene_q;
  logic eased_q, must_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {scene_q, eased_q, must_q} <= '0;
    else begin
      if (sample_i) {scene_q, eased_q} <= {scene_i, derated_i};
      must_q <= (sample_i && (!armed_i || scene_i != scene_q || derated_i != eased_q)) || restart_i;
    end
  end

  always_comb begin
    if (rst_ni && past_ok_q && after_q) begin
      moves_in_its_clock: assert (done_q || tau_ref == tau_q);
      valid_in_its_clock: assert (valid == done_q);
      request_ramps: assert (!must_q || ramping);
      shows_the_hold: assert (limit_hold == eased_q);
      shows_the_limit: assert (!started_q || limit_torque == over_q);
      inside_scene: assert ( \u_dut.scene_q == scene_q);
      inside_at: assert ( \u_dut.at == at_q && (at_q == '0 || (sampled_q && at_q != 2'd3)) && (!done_q || at_q == '0));
      target_is_the_least: assert ((T + 1)'($signed({2'b0, \u_dut.limit_q })) == limit_q &&
                                   (at_q == '0 || (W + 1)'($signed( \u_dut.target_q )) <<< Fine == target_q));
      inside_force: assert (at_q == '0 || (in_force_q >= 0 && target_q <= most && target_q >= -most));
      inside_excess: assert (!at_q[1] || (W + 2)'($signed( \u_dut.excess_q )) == (W + 2)'(fine) - (W + 2)'(target_q));
      inside_zero: assert (!zero_q || done_q || (fine == '0 && ramping));
      inside_disarmed: assert (ramping || (sampled_q ? armed_i : !done_q || armed_q));
      if (done_q) begin
        within_the_least_limit: assert (!(before_q <= most && before_q >= -most) || (fine <= most && fine >= -most));
        a_step_at_most: assert (!(ramps_q && armed_q) || (moved <= step_q && moved >= -step_q));
        never_past_the_target: assert (before_q <= target_q ? fine >= before_q && fine <= target_q
                                                            : fine <= before_q && fine >= target_q);
        a_step_or_there: assert (!(ramps_q && armed_q) || frozen_q || !ramping || moved == step_q || moved == -step_q);
        ends_within_a_step: assert (!(ramps_q && armed_q) || ramping || frozen_q || (left <= step_q && left >= -step_q));
        at_once_otherwise: assert (ramps_q || (frozen_q && armed_q) || fine == target_q);
        frozen_falls_only: assert (!(frozen_q && armed_q) ||
                                   (before_q >= 0 ? fine <= before_q && fine >= 0 : fine >= before_q && fine <= 0));
        disarmed_is_the_target: assert (armed_q || fine == target_q);
        shows_the_ramp: assert (limit_ramp ? armed_q && (ramps_q || (frozen_q && fine == before_q))
                                           : !(armed_q && (ramps_q || (frozen_q && fine != target_q))));
        from_zero: assert (!(zero_q && armed_q) || (fine <= step_q && fine >= -step_q));
        rises: cover (ramps_q && armed_q && moved > 0 && ramping);
        follows: cover (!ramps_q && armed_q && fine != before_q);
        tests: cover (limit_torque && in_force_q == $signed({2'b0, p.self_test_torque}) && in_force_q != '0);
      end
    end
  end
endmodule

`default_nettype wire
