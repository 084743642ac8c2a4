// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Room: the scene's torque to four gates. One limiter limits six values of a tick, one after the
// other (docs/blocks/limiter.md). Timing: tau_ref_o is new after EVENT_AT_TAU_REF, duty_o after EVENT_AT_DUTY;
// the bridge takes it at the next start of a PWM period. docs/architecture.md

`default_nettype none

module actuation (
    input  logic                                           clk_i,
    input  logic                                           rst_ni,
    input  logic        [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input  logic        [                             31:0] param_i,
    input  logic                                            armed_i,
    input  logic                                            paused_i,       // a self-test runs: no torque of a scene
    input  logic        [                              1:0] mode_i,         // 0 closed, 1 open loop, 2 voltage
    input  logic        [                              3:0] scene_i,
    input  logic                                            restart_i,      // last clock of a tick: ramp from now on
    input  logic                                            frozen_i,       // the torque may shrink, and rise from below 0 to a positive target
    input  logic                                            derated_i,      // the limit is hold_limit
    input  logic signed [feltgate_pkg::SCENE_TORQUE_W-1:0]  early_term_i,   // torque, one clock before its limit
    input  logic                                            early_up_i,     // with early_term_i: it is rounded up
    input  logic signed [      feltgate_pkg::TORQUE_W-1:0]  late_term_i,    // torque, with its limit
    input  logic                                            late_not_i,     // with late_term_i: the torque is its complement
    input  logic                                            late_up_i,      // + 1
    input  logic signed [  feltgate_pkg::PRODUCT_BITS-1:0]  product_i,
    output logic                                            over_limit_o,   // of the limiter
    output logic signed [ feltgate_pkg::WITH_ADDEND_W-1:0]  applied_o,      // to the multiplier
    output logic                                            region_high_o,  // voltage gain of high torque
    output logic signed [      feltgate_pkg::TORQUE_W-1:0]  tau_ref_o,      // Nm
    output logic signed [     feltgate_pkg::CURRENT_W-1:0]  current_ref_o,  // A
    output logic signed [     feltgate_pkg::VOLTAGE_W-1:0]  voltage_o,      // V
    output logic signed [        feltgate_pkg::DUTY_W-1:0]  duty_o,         // clocks of on-time
    output logic        [feltgate_map_pkg::W_STATUS_LIMITS-1:0] limits_o,   // bit n: limit n acted
    input  logic                                            gates_enable_i,
    input  logic                                            gates_clear_i,  // asynchronous
    input  logic                                            pwm_mode_i,
    input  logic                                            polarity_i,     // of the motor
    output logic                                            gate_a_hi_o,
    output logic                                            gate_a_lo_o,
    output logic                                            gate_b_hi_o,
    output logic                                            gate_b_lo_o,
    output logic                                            period_start_o,
    output logic signed [        feltgate_pkg::DUTY_W-1:0]  duty_active_o   // in force in the bridge
);
  localparam int Wide = feltgate_pkg::LIMITER_INPUT_W;
  localparam int LimitsW = feltgate_map_pkg::W_STATUS_LIMITS;

  logic signed [feltgate_pkg::WITH_ADDEND_W-1:0] limited, addend;
  logic signed [Wide-1:0] control_early, control_late;
  logic late_up, takes_torque, takes_voltage, takes_duty;
  logic limit_torque, limit_ramp, limit_hold, limit_current, limit_voltage, limit_duty;

  // The limiter takes a value one clock before the limit's word is on param_i.
  assign takes_torque  = wave_i[feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT-1];
  assign takes_voltage = wave_i[feltgate_map_pkg::PARAM_AT_VOLTAGE_WINDOW-1];
  assign takes_duty    = wave_i[feltgate_map_pkg::PARAM_AT_DUTY_LIMIT-1];
  limiter u_limiter (
      .clk_i(clk_i),
      .valid_i(takes_torque || wave_i[feltgate_map_pkg::PARAM_AT_VOLTAGE_STEP-1] ||
               wave_i[feltgate_map_pkg::PARAM_AT_CURRENT_LIMIT-1] || wave_i[feltgate_map_pkg::PARAM_AT_DEAD_VOLTAGE-1] ||
               takes_voltage || takes_duty),
      .torque_i(takes_torque), .voltage_i(takes_voltage), .duty_i(takes_duty),
      .early_term_i(control_early | Wide'(early_term_i)), .late_term_i(control_late | Wide'(late_term_i)),
      .early_up_i(early_up_i), .late_not_i(late_not_i), .late_up_i(late_up || late_up_i), .param_i(param_i),
      .addend_i(addend), .limited_o(limited), .over_limit_o(over_limit_o)
  );

  ramp u_ramp (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(armed_i && !paused_i),  // after a self-test the ramp begins as after arming
      .scene_i(scene_i), .restart_i(restart_i),
      .at_ramp_begin_i(wave_i[feltgate_map_pkg::EVENT_AT_RAMP_BEGIN]),
      .at_ramp_excess_i(wave_i[feltgate_map_pkg::EVENT_AT_RAMP_EXCESS]),
      .at_ramp_change_i(wave_i[feltgate_map_pkg::EVENT_AT_RAMP_CHANGE]),
      .at_tau_ref_i(wave_i[feltgate_map_pkg::EVENT_AT_TAU_REF]),
      .param_i(param_i),
      .limited_i(limited[feltgate_pkg::TORQUE_W-1:0]), .over_limit_i(over_limit_o),
      .frozen_i(frozen_i), .derated_i(derated_i),
      .tau_ref_o(tau_ref_o),
      .limit_torque_o(limit_torque), .limit_ramp_o(limit_ramp), .limit_hold_o(limit_hold)
  );

  torque_control u_torque_control (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(armed_i), .mode_i(mode_i),
      .product_is_emf_constant_i(wave_i[feltgate_map_pkg::PRODUCT_AT_EMF_CONSTANT]),
      .product_is_observer_gain_i(wave_i[feltgate_map_pkg::PRODUCT_AT_OBSERVER_GAIN]),
      .at_border_i(wave_i[feltgate_map_pkg::EVENT_AT_BORDER]),
      .at_region_i(wave_i[feltgate_map_pkg::EVENT_AT_REGION]),
      .param_is_voltage_setpoint_i(wave_i[feltgate_map_pkg::PARAM_AT_VOLTAGE_SETPOINT]),
      .product_is_voltage_to_current_i(wave_i[feltgate_map_pkg::PRODUCT_AT_VOLTAGE_TO_CURRENT]),
      .param_is_voltage_step_i(wave_i[feltgate_map_pkg::PARAM_AT_VOLTAGE_STEP]),
      .product_is_torque_gain_i(wave_i[feltgate_map_pkg::PRODUCT_AT_TORQUE_GAIN]),
      .at_direct_voltage_i(wave_i[feltgate_map_pkg::EVENT_AT_DIRECT_VOLTAGE]),
      .param_is_current_limit_i(wave_i[feltgate_map_pkg::PARAM_AT_CURRENT_LIMIT]),
      .product_is_dead_voltage_slope_i(wave_i[feltgate_map_pkg::PRODUCT_AT_DEAD_VOLTAGE_SLOPE]),
      .at_current_i(wave_i[feltgate_map_pkg::EVENT_AT_CURRENT]),
      .at_hold_size_i(wave_i[feltgate_map_pkg::EVENT_AT_HOLD_SIZE]),
      .param_is_dead_voltage_i(wave_i[feltgate_map_pkg::PARAM_AT_DEAD_VOLTAGE]),
      .at_voltage_offset_i(wave_i[feltgate_map_pkg::EVENT_AT_VOLTAGE_OFFSET]),
      .product_next_voltage_gain_i(wave_i[feltgate_map_pkg::PRODUCT_AT_VOLTAGE_GAIN-1]),
      .product_is_voltage_gain_i(wave_i[feltgate_map_pkg::PRODUCT_AT_VOLTAGE_GAIN]),
      .param_is_voltage_window_i(wave_i[feltgate_map_pkg::PARAM_AT_VOLTAGE_WINDOW]),
      .at_voltage_i(wave_i[feltgate_map_pkg::EVENT_AT_VOLTAGE]),
      .product_is_duty_gain_i(wave_i[feltgate_map_pkg::PRODUCT_AT_DUTY_GAIN]),
      .at_duty_i(wave_i[feltgate_map_pkg::EVENT_AT_DUTY]),
      .param_i(param_i), .product_i(product_i),
      .tau_ref_i(tau_ref_o),
      .early_term_o(control_early), .late_term_o(control_late), .late_up_o(late_up),
      .addend_o(addend), .limited_i(limited), .over_limit_i(over_limit_o),
      .region_high_o(region_high_o),
      .current_ref_o(current_ref_o), .voltage_o(voltage_o), .duty_o(duty_o),
      .limit_current_o(limit_current), .limit_voltage_o(limit_voltage), .limit_duty_o(limit_duty)
  );

  pwm #(.Period(feltgate_pkg::PWM_PERIOD), .DeadClocks(feltgate_pkg::DEAD_CLOCKS),
        .ShortestClocks(feltgate_pkg::SHORTEST_CLOCKS)) u_pwm (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .clear_i(gates_clear_i),
      .enable_i(gates_enable_i), .mode_i(pwm_mode_i), .polarity_i(polarity_i),
      .duty_i(duty_o),
      .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
      .period_start_o(period_start_o),
      .duty_active_o(duty_active_o)
  );

  assign applied_o = limited;

  assign limits_o = (LimitsW'(limit_torque) << feltgate_map_pkg::L_TORQUE) |
                    (LimitsW'(limit_ramp) << feltgate_map_pkg::L_RAMP) |
                    (LimitsW'(limit_hold) << feltgate_map_pkg::L_HOLD) |
                    (LimitsW'(limit_current) << feltgate_map_pkg::L_CURRENT) |
                    (LimitsW'(limit_voltage) << feltgate_map_pkg::L_VOLTAGE) |
                    (LimitsW'(limit_duty) << feltgate_map_pkg::L_DUTY);

  logic unused;
  assign unused = ^wave_i;  // a room takes its own clocks of the wave
endmodule

`default_nettype wire
