// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ramp of the torque reference. tau_ref_o follows the scene's limited torque. After arming, a
// change of scene, a change of derated_i or restart_i it moves by at most one step word per tick
// until it reaches the target; after that it is not slowed. Latency: target on limited_i in the
// clock of the step's word (EVENT_AT_RAMP_EXCESS), tau_ref_o three clocks later, held. docs/blocks/torque_control.md

`default_nettype none

module ramp (
    input  logic                                      clk_i,
    input  logic                                      rst_ni,
    input  logic                                      armed_i,
    input  logic        [                        3:0] scene_i,
    input  logic                                      restart_i,  // last clock of a tick: ramp from now on
    input  logic                                      at_ramp_begin_i,
    input  logic                                      at_ramp_excess_i,
    input  logic                                      at_ramp_change_i,
    input  logic                                      at_tau_ref_i,
    input  logic        [                       31:0] param_i,
    input  logic signed [ feltgate_pkg::TORQUE_W-1:0] limited_i,
    input  logic                                      over_limit_i,
    input  logic                                      frozen_i,   // 1: the torque may only shrink
    input  logic                                      derated_i,  // 1: hold_limit limits too
    output logic signed [ feltgate_pkg::TORQUE_W-1:0] tau_ref_o,       // Nm, motor on lever
    output logic                                      limit_torque_o,  // the torque limit acts
    output logic                                      limit_ramp_o,    // the step acts
    output logic                                      limit_hold_o     // hold_limit acts
);
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int W = feltgate_pkg::RAMP_W;
  localparam int Fine = feltgate_pkg::RAMP_F - feltgate_pkg::TORQUE_F;

  logic signed [W-1:0] ramp_q;
  assign tau_ref_o = ramp_q[W-1:Fine];

  // excess_q: reference minus target. step_q: at least one LSB, also for a word of 0 or a negative
  // word; 0 while frozen.
  logic signed [W:0] excess_q;
  logic      [W-2:0] step_q;
  always_ff @(posedge clk_i) begin
    if (at_ramp_excess_i) begin
      // The long way from all bits of the word ends at one bit.
      if (frozen_i || param_i[W-1]) step_q[W-2:1] <= '0;
      else step_q[W-2:1] <= param_i[W-2:1];
      step_q[0] <= !frozen_i && (param_i[W-1] || param_i[W-2:1] == '0 || param_i[0]);
      excess_q <= {(TorqueW + 1)'(tau_ref_o) - (TorqueW + 1)'(limited_i),
                   ramp_q[Fine-1:0]};
    end
  end

  // The reference moves towards the target by one step, or by the whole distance. A ramp ends in
  // the tick whose distance is within one step; the reference moves on with the next tick. While
  // frozen the step is 0; it applies to a reference that would grow or would change its sign. The choice is made for both directions before the direction is known.
  logic signed [W:0] step, change, overshoot;
  logic signed [W-1:0] change_q;
  logic ramping_q, active, frozen, steps_down_q, steps_up_q, stepping, stepping_q;
  logic down, reached, carry_q, stay_q;
  assign active = ramping_q && armed_i;
  assign frozen = frozen_i && armed_i;
  always_ff @(posedge clk_i) begin
    steps_down_q <= active || (frozen && (ramp_q[W-1] || limited_i[TorqueW-1]));
    steps_up_q   <= active || (frozen && (!ramp_q[W-1] || (!limited_i[TorqueW-1] && limited_i != '0)));
  end
  assign down     = !excess_q[W];
  assign stepping = down ? steps_down_q : steps_up_q;
  assign step     = {2'b0, step_q};
  assign change   = stepping ? (step ^ {(W + 1) {down}}) : ~excess_q;
  assign overshoot = excess_q + change;
  assign reached  = overshoot[W] == down;
  always_ff @(posedge clk_i) begin
    if (at_ramp_change_i) begin
      change_q <= change[W-1:0];
      carry_q  <= down || !stepping;
      stay_q   <= stepping && reached;
      stepping_q <= stepping;
    end
  end

  logic [3:0] scene_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ramp_q       <= '0;
      ramping_q    <= 1'b1;
      scene_q      <= '0;
      limit_torque_o <= 1'b0;
      limit_ramp_o <= 1'b0;
      limit_hold_o <= 1'b0;
    end else begin
      if (at_ramp_excess_i) limit_torque_o <= over_limit_i && armed_i;
      if (at_ramp_begin_i) scene_q <= scene_i;
      if (at_ramp_begin_i) limit_hold_o <= derated_i;
      if (restart_i) ramping_q <= 1'b1;
      else if (at_ramp_begin_i &&
               (!armed_i || scene_i != scene_q || derated_i != limit_hold_o)) ramping_q <= 1'b1;
      else if (at_tau_ref_i && stay_q) ramping_q <= 1'b0;
      if (at_tau_ref_i && !stay_q) ramp_q <= ramp_q + change_q + W'({1'b0, carry_q});
      if (at_tau_ref_i) limit_ramp_o <= stepping_q;
    end
  end

  logic unused;
  assign unused = ^overshoot[W-1:0];
endmodule

`default_nettype wire
