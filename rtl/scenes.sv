// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The port of the scenes: selects one, limits its torque, and ramps it after arming and after a
// change of scene; between them nothing is slowed. A scene that is not built renders nothing.
// Latency: start in wave clock 1, limit in 25, ramp step in 26, torque reference in 28 and held.
// docs/blocks/scenes.md

`default_nettype none

module scenes #(
    parameter int Mask = feltgate_pkg::SCENE_MASK,  // bit n: scene n is built
    // 1: no ramp on a change of scene, 2: limit on one side only,
    // 3: disarming keeps the torque, 4: ramp never ends, 5: ramp twice as fast downward,
    // 6: a step whatever the distance
    parameter int Defect = 0
) (
    input  logic                                             clk_i,
    input  logic                                             rst_ni,
    input  logic                                             armed_i,
    input  logic        [                               3:0] scene_i,
    input  logic                                             start_i,
    input  logic signed [feltgate_pkg::SCENE_POSITION_W-1:0] position_i,
    input  logic        [                              31:0] param_i,
    input  logic signed [    feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    output logic signed [  feltgate_pkg::SCENE_OFFSET_W-1:0] operand_o,
    output logic                                             square_o,
    output logic signed [        feltgate_pkg::TORQUE_W-1:0] tau_ref_o,
    output logic                                             limit_torque_o,
    output logic                                             limit_ramp_o
);
  localparam int TorqueW = feltgate_pkg::TORQUE_W;
  localparam int RampW = feltgate_pkg::RAMP_W;
  localparam int Fine = feltgate_pkg::RAMP_F - feltgate_pkg::TORQUE_F;

  // The scenes. A torque is 0 unless its scene is selected, so that they may be ored.
  logic signed [feltgate_pkg::SCENE_OFFSET_W-1:0] spring_operand, charge_operand, wall_operand;
  logic signed [TorqueW-1:0] setpoint_tau, membrane_tau, spring_tau, damper_tau, charge_tau,
                             wall_tau;
  logic tension, attract, spring, charge;
  assign tension   = scene_i == feltgate_pkg::SCENE_SPRING_TENSION;
  assign spring    = (Mask[{1'b0, feltgate_pkg::SCENE_SPRING_TENSION}] && tension) ||
                     (Mask[{1'b0, feltgate_pkg::SCENE_SPRING_COMPRESSION}] &&
                      scene_i == feltgate_pkg::SCENE_SPRING_COMPRESSION);
  assign attract   = scene_i == feltgate_pkg::SCENE_CHARGE_ATTRACT;
  assign charge    = (Mask[{1'b0, feltgate_pkg::SCENE_CHARGE_ATTRACT}] && attract) ||
                     (Mask[{1'b0, feltgate_pkg::SCENE_CHARGE_REPEL}] &&
                      scene_i == feltgate_pkg::SCENE_CHARGE_REPEL);
  assign square_o  = charge;
  assign operand_o = charge ? charge_operand : spring_operand;

  if (Mask[{1'b0, feltgate_pkg::SCENE_SETPOINT}]) begin : gen_setpoint
    scene_setpoint u_setpoint (
        .clk_i(clk_i),
        .rst_ni(rst_ni),
        .select_i(scene_i == feltgate_pkg::SCENE_SETPOINT),
        .start_i(start_i),
        .param_i(param_i),
        .tau_o(setpoint_tau)
    );
  end else begin : gen_no_setpoint
    assign setpoint_tau = '0;
  end

  if (Mask[{1'b0, feltgate_pkg::SCENE_MEMBRANE}]) begin : gen_membrane
    scene_membrane u_membrane (
        .clk_i(clk_i),
        .rst_ni(rst_ni),
        .select_i(scene_i == feltgate_pkg::SCENE_MEMBRANE),
        .start_i(start_i),
        .position_i(position_i),
        .param_i(param_i),
        .tau_o(membrane_tau)
    );
  end else begin : gen_no_membrane
    assign membrane_tau = '0;
  end

  if (Mask[{1'b0, feltgate_pkg::SCENE_SPRING_COMPRESSION}] ||
      Mask[{1'b0, feltgate_pkg::SCENE_SPRING_TENSION}]) begin : gen_spring
    scene_spring u_spring (
        .clk_i(clk_i),
        .rst_ni(rst_ni),
        .select_i(spring),
        .tension_i(tension),
        .start_i(start_i),
        .position_i(position_i),
        .param_i(param_i),
        .product_i(product_i),
        .operand_o(spring_operand),
        .tau_o(spring_tau)
    );
  end else begin : gen_no_spring
    assign spring_operand = wall_operand;  // both are reference - position
    assign spring_tau     = '0;
  end

  if (Mask[{1'b0, feltgate_pkg::SCENE_DAMPER}]) begin : gen_damper
    scene_damper u_damper (
        .clk_i(clk_i),
        .rst_ni(rst_ni),
        .select_i(scene_i == feltgate_pkg::SCENE_DAMPER),
        .start_i(start_i),
        .product_i(product_i),
        .tau_o(damper_tau)
    );
  end else begin : gen_no_damper
    assign damper_tau = '0;
  end

  if (Mask[{1'b0, feltgate_pkg::SCENE_CHARGE_ATTRACT}] ||
      Mask[{1'b0, feltgate_pkg::SCENE_CHARGE_REPEL}]) begin : gen_charge
    scene_charge u_charge (
        .clk_i(clk_i),
        .rst_ni(rst_ni),
        .select_i(charge),
        .attract_i(attract),
        .start_i(start_i),
        .position_i(position_i),
        .param_i(param_i),
        .product_i(product_i),
        .operand_o(charge_operand),
        .tau_o(charge_tau)
    );
  end else begin : gen_no_charge
    assign charge_operand = '0;
    assign charge_tau     = '0;
  end

  if (Mask[{1'b0, feltgate_pkg::SCENE_WALL}]) begin : gen_wall
    scene_wall u_wall (
        .clk_i(clk_i),
        .rst_ni(rst_ni),
        .select_i(scene_i == feltgate_pkg::SCENE_WALL),
        .start_i(start_i),
        .position_i(position_i),
        .param_i(param_i),
        .product_i(product_i),
        .operand_o(wall_operand),
        .tau_o(wall_tau)
    );
  end else begin : gen_no_wall
    assign wall_operand = '0;
    assign wall_tau     = '0;
  end

  logic signed [TorqueW-1:0] tau;
  // All but the divider are ready long before clock 25: one level of logic less on its way.
  logic signed [TorqueW-1:0] early_tau_q;
  always_ff @(posedge clk_i) early_tau_q <= setpoint_tau | membrane_tau | spring_tau | damper_tau | wall_tau;
  assign tau = early_tau_q | charge_tau;

  logic [25:0] stage_q;  // stage_q[k]: wave clock k + 2
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) stage_q <= '0;
    else stage_q <= {stage_q[24:0], start_i};
  end

  // Clock 25: the limit. What is kept is the target with its sign turned, as a word and a carry:
  // -L is ~L + 1, tau is -(~tau + 1), so that no clock needs two additions.
  logic signed [TorqueW-1:0] limit, minus_target_q;
  logic signed [  TorqueW:0] upper_gap, lower_gap;
  logic                      above, below, carry_q;
  assign limit     = param_i[TorqueW-1:0];
  assign upper_gap = (TorqueW + 1)'(limit) - (TorqueW + 1)'(tau);
  assign lower_gap = (TorqueW + 1)'(limit) + (TorqueW + 1)'(tau);
  assign above     = upper_gap[TorqueW];
  assign below     = lower_gap[TorqueW] && !above && Defect != 2;
  always_ff @(posedge clk_i) begin
    if (stage_q[23]) begin
      // Disarmed the target is 0; a negative limit counts as 0.
      if ((!armed_i && Defect != 3) || limit[TorqueW-1]) minus_target_q <= '1;
      else minus_target_q <= above ? ~limit : below ? limit : ~tau;
      carry_q <= !armed_i || limit[TorqueW-1] || !below;
    end
  end

  // Clock 26: how far the reference is above the target.
  logic signed [RampW-1:0] ramp_q;
  logic signed [  RampW:0] excess_q;
  logic        [RampW-2:0] step_q;
  always_ff @(posedge clk_i) begin
    excess_q <= {(TorqueW + 1)'($signed(ramp_q[RampW-1:Fine])) + (TorqueW + 1)'(minus_target_q) +
                 (TorqueW + 1)'({1'b0, carry_q}), ramp_q[Fine-1:0]};
    // A negative step counts as 0.
    if (param_i[RampW-1]) step_q <= '0;
    else step_q <= param_i[RampW-2:0];
  end

  // Clock 27: one step towards the target, or all of it. The tick in which the distance is found to
  // be within one step ends the ramp; the reference moves on with the next.
  logic signed [RampW:0] step, change, beyond;
  logic                  ramping_q, stepping, down, reached;
  logic            [3:0] scene_q;
  assign stepping = ramping_q && armed_i;
  assign down     = !excess_q[RampW];
  assign step     = (Defect == 5 && down) ? {1'b0, step_q, 1'b0} : {2'b0, step_q};
  assign change   = stepping ? (step ^ {(RampW + 1) {down}}) : ~excess_q;
  assign beyond   = excess_q + change;
  assign reached  = beyond[RampW] == down && Defect != 6;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      ramp_q         <= '0;
      ramping_q      <= 1'b1;
      scene_q        <= '0;
      limit_torque_o <= 1'b0;
      limit_ramp_o   <= 1'b0;
    end else begin
      if (start_i) scene_q <= scene_i;
      if (start_i && (!armed_i || (scene_i != scene_q && Defect != 1))) ramping_q <= 1'b1;
      else if (stage_q[25] && stepping && reached && Defect != 4) ramping_q <= 1'b0;
      if (stage_q[25] && !(stepping && reached)) begin
        ramp_q <= ramp_q + change[RampW-1:0] + RampW'({1'b0, down || !stepping});
      end
      if (stage_q[23]) limit_torque_o <= armed_i && (above || below);
      if (stage_q[25]) limit_ramp_o <= stepping;
    end
  end
  assign tau_ref_o = ramp_q[RampW-1:Fine];

  // The second line: what no scene uses where few are built.
  logic unused;
  assign unused = ^{param_i[31:RampW], upper_gap[TorqueW-1:0], lower_gap[TorqueW-1:0],
                    position_i, product_i, tension, attract, spring, beyond[RampW-1:0],
                    wall_operand};
endmodule

`default_nettype wire
