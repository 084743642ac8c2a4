// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How far the torque reference moves in a tick, for any targets, words and requests, tick after tick.
`default_nettype none

module steps_proof (
    input logic                                      clk_i,
    input logic                                      rst_ni,
    input logic        [                        8:0] start_i,  // where in a tick a reset ends
    input logic                                      armed_i,
    input logic        [                        3:0] scene_i,
    input logic                                      restart_i,
    input logic        [                       31:0] param_i,
    input logic signed [feltgate_pkg::TORQUE_W-1:0]  limited_i,
    input logic                                      over_limit_i,
    input logic                                      frozen_i,
    input logic                                      derated_i
);
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int W = feltgate_pkg::RAMP_W;
  localparam int Fine = feltgate_pkg::RAMP_F - feltgate_pkg::TORQUE_F;
  localparam int Begin = feltgate_map_pkg::EVENT_AT_RAMP_BEGIN;
  localparam int Excess = feltgate_map_pkg::EVENT_AT_RAMP_EXCESS;
  localparam int Result = feltgate_map_pkg::EVENT_AT_TAU_REF;

  `include "wave.svh"

  // What holds for a whole tick changes after its end, or early in the wave, and not in the ramp's clocks.
  logic armed_q, frozen_q;
  always_ff @(posedge clk_i) begin
    armed_q  <= armed_i;
    frozen_q <= frozen_i;
  end
  always_comb begin
    assume (tick_q || !rst_ni || armed_i == armed_q);
    assume (phase_q <= 9'(Begin) || frozen_i == frozen_q);
    assume (tick || !restart_i);
    // The limiter's result of a torque has the torque's format.
  end

  logic signed [TorqueW-1:0] tau_ref;
  logic limit_torque, limit_ramp, limit_hold;
  ramp u_dut (
      .*,
      .at_ramp_begin_i(wave[feltgate_map_pkg::EVENT_AT_RAMP_BEGIN]),
      .at_ramp_excess_i(wave[feltgate_map_pkg::EVENT_AT_RAMP_EXCESS]),
      .at_ramp_change_i(wave[feltgate_map_pkg::EVENT_AT_RAMP_CHANGE]),
      .at_tau_ref_i(wave[feltgate_map_pkg::EVENT_AT_TAU_REF]),
      .tau_ref_o(tau_ref),
      .limit_torque_o(limit_torque),
      .limit_ramp_o(limit_ramp),
      .limit_hold_o(limit_hold)
  );
  (* hierconn *) wire signed [W-1:0] \u_dut.ramp_q ;
  wire signed [W:0] fine = (W + 1)'($signed(\u_dut.ramp_q ));
  (* hierconn *) wire \u_dut.ramping_q ;
  (* hierconn *) wire [3:0] \u_dut.scene_q ;
  wire ramping = \u_dut.ramping_q ;

  // A tick of the ramp: target and step as they come by, what was there before.
  logic signed [W:0] target_q, step_q, before_q, moved, left;
  logic began_q, ramps_q, done_q, limited_q, after_q, torque_due_q, zero_q;
  logic signed [TorqueW-1:0] tau_q;
  logic signed [W:0] step_word;
  assign step_word = (param_i[W-1] || param_i[W-2:0] == '0) ? (W + 1)'(1) : $signed({2'b0, param_i[W-2:0]});
  always_ff @(posedge clk_i) begin
    if (wave[Excess]) begin
      target_q <= $signed({limited_i[TorqueW-1], limited_i[TorqueW-1:0], {Fine{1'b0}}});
      step_q   <= step_word;
      before_q <= fine;
      ramps_q  <= ramping && armed_i;
    end
    done_q <= began_q && wave[Result];
    limited_q    <= wave[Excess];
    torque_due_q <= over_limit_i && armed_i;
    tau_q  <= tau_ref;
  end
  // A tick counts from its begin, without a reset.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) began_q <= 1'b0;
    else if (wave[Begin]) began_q <= 1'b1;
  end
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      after_q <= 1'b0;
      zero_q  <= 1'b0;
    end else begin
      after_q <= 1'b1;
      if (done_q) zero_q <= !armed_q && target_q == '0;  // the last tick was disarmed, and without a torque
    end
  end
  assign moved = fine - before_q;
  assign left  = target_q - fine;

  // What must make it ramp: disarmed, another scene, another limit, a request.
  logic [3:0] scene_q;
  logic eased_q, must_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      scene_q   <= '0;
      eased_q   <= 1'b0;
      must_q    <= 1'b0;
    end else begin
      if (wave[Begin]) begin
        scene_q <= scene_i;
        eased_q <= derated_i;
      end
      must_q <= (wave[Begin] && (!armed_i || scene_i != scene_q || derated_i != eased_q)) || restart_i;
    end
  end

  always_comb begin
    if (rst_ni && past_ok_q && after_q) begin
      moves_in_its_clock: assert (done_q || !began_q || tau_ref == tau_q);
      inside_scene: assert (\u_dut.scene_q == scene_q);
      shows_the_hold: assert (limit_hold == eased_q);
      request_ramps: assert (!must_q || ramping);
      inside_zero: assert (!zero_q || done_q || (began_q && fine == '0 && ramping));
      inside_disarmed: assert (!began_q || armed_i || phase_q <= 9'(Begin) || ramping ||
                               phase_q > 9'(Clocks - 1 - feltgate_map_pkg::FIRST_WAVE_CLOCK));
      shows_the_limit: assert (!limited_q || limit_torque == torque_due_q);
      if (done_q) begin
        a_step_at_most: assert (!(ramps_q && armed_q) || (moved <= step_q && moved >= -step_q));
        never_past_the_target: assert ((before_q <= target_q) ? (fine >= before_q && fine <= target_q)
                                                             : (fine <= before_q && fine >= target_q));
        a_step_or_there: assert (!(ramps_q && armed_q) || frozen_q || !ramping || moved == step_q ||
                                 moved == -step_q);
        ends_within_a_step: assert (!ramps_q || !armed_q || ramping || frozen_q || (left <= step_q && left >= -step_q));
        at_once_otherwise: assert (ramps_q || (frozen_q && armed_q) || fine == target_q);
        frozen_falls_only: assert (!(frozen_q && armed_q) ||
                                   ((before_q >= 0) ? (fine <= before_q && fine >= 0) : (fine >= before_q && fine <= 0)));
        disarmed_is_the_target: assert (armed_q || fine == target_q);
        shows_the_ramp: assert (limit_ramp ? armed_q && (ramps_q || (frozen_q && fine == before_q))
                                           : !(armed_q && (ramps_q || (frozen_q && fine != target_q))));
        inside_from_zero: assert (!(zero_q && armed_q) || (fine <= step_q && fine >= -step_q));
        rises: cover (ramps_q && armed_q && moved > 0 && ramping);
        follows: cover (!ramps_q && armed_q && fine != before_q);
      end
    end
  end
endmodule

`default_nettype wire
