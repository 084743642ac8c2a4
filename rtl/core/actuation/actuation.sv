// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Room: the scene's torque to four gates, or to six of a motor with three phases. One limiter limits six values of a tick, one after the
// other (docs/blocks/torque_control.md). Timing: tau_ref_o is new after EVENT_AT_TAU_REF, duty_o after EVENT_AT_DUTY;
// the bridge takes it at the next start of a PWM period. With the option CURRENT_LOOP a controller of the measured
// current gives the bridge its duty, one in each period (docs/blocks/current.md). With PHASES = 3 the duty is the
// amplitude of three legs' voltages, which turn with the motor (docs/blocks/three_phase.md); with both, two currents are
// measured and controlled in the rotor's frame (docs/blocks/three_phase.md). docs/architecture.md

`default_nettype none

module actuation (
    input  logic                                           clk_i,
    input  logic                                           rst_ni,
    input  logic        [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_i,
    input  logic        [                             31:0] param_i,
    input  logic                                            armed_i,
    input  logic                                            paused_i,       // a self-test runs: no torque of a scene
    input  logic        [   feltgate_map_pkg::W_CONTROL-1:0] control_i,
    input  logic        [                              3:0] scene_i,
    input  logic                                            restart_i,      // last clock of a tick: ramp from now on
    input  logic                                            frozen_i,       // the torque may only shrink
    input  logic                                            derated_i,      // hold_limit limits too
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
    input  logic        [feltgate_pkg::CURRENT_LOOP*(feltgate_pkg::PHASES-2):0] current_data_i,  // of each modulator of a current loop
    input  logic                                            driver_fault_i,    // of the bridge's driver, asynchronous
    output logic                                            current_clock_o,   // to it
    output logic signed [                             18:0] current_o,         // measured, [1,1,17] of full scale; new after EVENT_AT_SAMPLE
    output logic signed [     feltgate_pkg::CURRENT_W-1:0]  motor_current_o,   // ampere: the measured current; without a current loop current_ref_o
    output logic        [feltgate_map_pkg::W_FAULTS_CURRENT+1:0] current_state_o,  // why it is not to be relied on: faults.current, driver, missing
    output logic        [feltgate_map_pkg::W_FAULTS_SEEN-1:0]   trips_o,           // bit n: cause n
    input  logic                                            clear_i,           // of the faults that are kept
    input  logic                                            gates_enable_i,
    input  logic                                            gates_clear_i,  // asynchronous
    output logic                                            gate_a_hi_o,
    output logic                                            gate_a_lo_o,
    output logic                                            gate_b_hi_o,
    output logic                                            gate_b_lo_o,
    input  logic signed [                             31:0] count_i,        // of the encoder, for PHASES = 3
    input  logic        [                             31:0] hall_angle_i,   // with the option HALL in its place
    output logic                                            gate_c_hi_o,    // of PHASES = 3; else 0
    output logic                                            gate_c_lo_o,
    output logic                                            period_start_o,
    output logic signed [        feltgate_pkg::DUTY_W-1:0]  duty_active_o   // in force in the bridge
);
  localparam int Wide = feltgate_pkg::LIMITER_INPUT_W;
  localparam int LimitsW = feltgate_map_pkg::W_STATUS_LIMITS;

  logic polarity;  // of the motor
  logic [feltgate_map_pkg::W_CONTROL_MODE-1:0] mode;
  assign polarity = control_i[feltgate_map_pkg::B_CONTROL_MOTOR_POLARITY];
  assign mode     = control_i[feltgate_map_pkg::B_CONTROL_MODE+:feltgate_map_pkg::W_CONTROL_MODE];

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
      .at_ramp_begin_i(wave_i[feltgate_map_pkg::EVENT_AT_RAMP_BEGIN]), .at_ramp_excess_i(wave_i[feltgate_map_pkg::EVENT_AT_RAMP_EXCESS]),
      .at_ramp_change_i(wave_i[feltgate_map_pkg::EVENT_AT_RAMP_CHANGE]),
      .at_tau_ref_i(wave_i[feltgate_map_pkg::EVENT_AT_TAU_REF]),
      .param_i(param_i),
      .limited_i(limited[feltgate_pkg::TORQUE_W-1:0]), .over_limit_i(over_limit_o),
      .frozen_i(frozen_i), .derated_i(derated_i), .tau_ref_o(tau_ref_o),
      .limit_torque_o(limit_torque), .limit_ramp_o(limit_ramp), .limit_hold_o(limit_hold)
  );

  torque_control u_torque_control (
      .clk_i(clk_i), .rst_ni(rst_ni),
      .armed_i(armed_i), .mode_i(mode),
      .product_is_emf_constant_i(wave_i[feltgate_map_pkg::PRODUCT_AT_EMF_CONSTANT]),
      .product_is_observer_gain_i(wave_i[feltgate_map_pkg::PRODUCT_AT_OBSERVER_GAIN]),
      .at_border_i(wave_i[feltgate_map_pkg::EVENT_AT_BORDER]), .at_region_i(wave_i[feltgate_map_pkg::EVENT_AT_REGION]),
      .param_is_voltage_setpoint_i(wave_i[feltgate_map_pkg::PARAM_AT_VOLTAGE_SETPOINT]),
      .product_is_voltage_to_current_i(wave_i[feltgate_map_pkg::PRODUCT_AT_VOLTAGE_TO_CURRENT]),
      .param_is_voltage_step_i(wave_i[feltgate_map_pkg::PARAM_AT_VOLTAGE_STEP]),
      .product_is_torque_gain_i(wave_i[feltgate_map_pkg::PRODUCT_AT_TORQUE_GAIN]),
      .at_direct_voltage_i(wave_i[feltgate_map_pkg::EVENT_AT_DIRECT_VOLTAGE]),
      .param_is_current_limit_i(wave_i[feltgate_map_pkg::PARAM_AT_CURRENT_LIMIT]),
      .product_is_dead_voltage_slope_i(wave_i[feltgate_map_pkg::PRODUCT_AT_DEAD_VOLTAGE_SLOPE]),
      .at_current_i(wave_i[feltgate_map_pkg::EVENT_AT_CURRENT]), .at_hold_size_i(wave_i[feltgate_map_pkg::EVENT_AT_HOLD_SIZE]),
      .param_is_dead_voltage_i(wave_i[feltgate_map_pkg::PARAM_AT_DEAD_VOLTAGE]),
      .at_voltage_offset_i(wave_i[feltgate_map_pkg::EVENT_AT_VOLTAGE_OFFSET]),
      .product_next_voltage_gain_i(wave_i[feltgate_map_pkg::PRODUCT_AT_VOLTAGE_GAIN-1]),
      .product_is_voltage_gain_i(wave_i[feltgate_map_pkg::PRODUCT_AT_VOLTAGE_GAIN]),
      .param_is_voltage_window_i(wave_i[feltgate_map_pkg::PARAM_AT_VOLTAGE_WINDOW]), .at_voltage_i(wave_i[feltgate_map_pkg::EVENT_AT_VOLTAGE]),
      .product_is_duty_gain_i(wave_i[feltgate_map_pkg::PRODUCT_AT_DUTY_GAIN]),
      .at_duty_i(wave_i[feltgate_map_pkg::EVENT_AT_DUTY]),
      .param_i(param_i), .product_i(product_i),
      .tau_ref_i(tau_ref_o), .early_term_o(control_early), .late_term_o(control_late), .late_up_o(late_up),
      .addend_o(addend), .limited_i(limited), .over_limit_i(over_limit_o),
      .region_high_o(region_high_o), .current_ref_o(current_ref_o), .voltage_o(voltage_o), .duty_o(duty_o),
      .limit_current_o(limit_current), .limit_voltage_o(limit_voltage), .limit_duty_o(limit_duty)
  );

  logic signed [feltgate_pkg::DUTY_W-1:0] bridge_duty;
  logic [31:0] gain_q, offset_q;  // of the angle, with PHASES = 3
  logic signed [31:0] angle_count;
  logic [31:0] angle_offset;
  assign angle_count  = (feltgate_pkg::HALL == 0) ? count_i : '0;
  assign angle_offset = (feltgate_pkg::HALL == 0) ? offset_q : offset_q + hall_angle_i;
  logic [35:0] field_on;           // with a current loop too: the on-times of legs C, B, A
  generate
  if (feltgate_pkg::CURRENT_LOOP == 0) begin : g_voltage_law
    assign bridge_duty     = duty_o;
    assign current_clock_o = 1'b0;
    assign current_o       = '0;
    assign motor_current_o = current_ref_o;
    assign current_state_o = '0;
    assign field_on        = '0;
    logic unused_loop;
    assign unused_loop = ^{current_data_i, driver_fault_i, clear_i, gain_q, angle_offset};
  end else begin : g_current_loop
    current_loop u_current_loop (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .wave_i(wave_i), .param_i(param_i), .product_i(product_i), .limited_i(limited),
        .current_ref_i(current_ref_o), .duty_i(duty_o), .direct_i(mode == 2'(feltgate_map_pkg::MODE_VOLTAGE)),
        .polarity_i(polarity), .gates_enable_i(gates_enable_i), .clear_i(clear_i), .period_start_i(period_start_o),
        .count_i(angle_count), .gain_i(gain_q), .offset_i(angle_offset), .current_data_i(current_data_i), .driver_fault_i(driver_fault_i),
        .current_clock_o(current_clock_o), .current_o(current_o), .motor_current_o(motor_current_o),
        .state_o(current_state_o), .duty_o(bridge_duty), .on_o(field_on)
    );
  end
  endgenerate
  assign trips_o = feltgate_map_pkg::W_FAULTS_SEEN'(gates_enable_i && current_state_o != '0) << feltgate_map_pkg::FAULT_CURRENT;

  generate
  if (feltgate_pkg::PHASES == 2) begin : g_two_legs
    pwm #(.Period(feltgate_pkg::PWM_PERIOD), .DeadClocks(feltgate_pkg::DEAD_CLOCKS),
          .ShortestClocks(feltgate_pkg::SHORTEST_CLOCKS)) u_pwm (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .clear_i(gates_clear_i), .enable_i(gates_enable_i), .mode_i(control_i[feltgate_map_pkg::B_CONTROL_PWM_MODE]), .polarity_i(polarity),
        .duty_i(bridge_duty),
        .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
        .period_start_o(period_start_o), .duty_active_o(duty_active_o)
    );
    assign gate_c_hi_o = 1'b0;
    assign gate_c_lo_o = 1'b0;
    assign {gain_q, offset_q} = '0;
    logic unused_count;
    assign unused_count = ^{angle_count, field_on};
  end else begin : g_three_legs
    logic [11:0] on_a, on_b, on_c;
    logic opens;
    always_ff @(posedge clk_i or negedge rst_ni) begin
      if (!rst_ni) begin
        gain_q   <= '0;
        offset_q <= '0;
      end else begin
        if (wave_i[feltgate_map_pkg::PARAM_AT_COMMUTATION_GAIN]) gain_q <= param_i;
        if (wave_i[feltgate_map_pkg::PARAM_AT_COMMUTATION_OFFSET]) offset_q <= param_i;
      end
    end
    if (feltgate_pkg::CURRENT_LOOP == 0) begin : g_commutation
      // The commutation samples so early that its on-times are new in the clock in which the PWM takes them. The gates open
      // with the first sample of an arming, so no on-times of the last one reach them.
      localparam int Latency = (feltgate_pkg::MODULATION == 0) ? 108 : 85;
      localparam int WaitW = $clog2(feltgate_pkg::PWM_PERIOD);
      logic [WaitW-1:0] wait_q;  // 1: the clock of the sample
      logic signed [feltgate_pkg::DUTY_W-1:0] amplitude_q;  // of the sample
      logic samples, valid, fresh_q;
      assign samples = wait_q == WaitW'(1);
      assign opens   = gates_enable_i && fresh_q;
      always_ff @(posedge clk_i or negedge rst_ni) begin
        if (!rst_ni) begin
          wait_q        <= '0;
          fresh_q       <= 1'b0;
          amplitude_q   <= '0;
          duty_active_o <= '0;
        end else begin
          if (period_start_o) wait_q <= WaitW'(feltgate_pkg::PWM_PERIOD - 1 - Latency);
          else if (wait_q != '0) wait_q <= wait_q - 1'b1;
          fresh_q <= gates_enable_i && (fresh_q || samples);
          if (samples) amplitude_q <= bridge_duty;
          if (!opens) duty_active_o <= '0;
          else if (valid) duty_active_o <= amplitude_q;
        end
      end
      commutation #(.Period(feltgate_pkg::PWM_PERIOD), .Modulation(feltgate_pkg::MODULATION)) u_commutation (
          .clk_i(clk_i), .rst_ni(rst_ni),
          .sample_i(samples), .position_i(angle_count), .gain_i(gain_q), .offset_i(angle_offset), .amplitude_i(bridge_duty),
          .polarity_i(polarity), .on_a_o(on_a), .on_b_o(on_b), .on_c_o(on_c), .valid_o(valid)
      );
      logic unused_field;
      assign unused_field = ^field_on;
    end else begin : g_field
      // Without the enable the on-times are half a period, so no on-times of the last arming reach the gates. The duty in
      // force is that of leg A, from half a period on.
      assign opens = gates_enable_i;
      assign {on_c, on_b, on_a} = field_on;
      always_ff @(posedge clk_i or negedge rst_ni) begin
        if (!rst_ni) duty_active_o <= '0;
        else if (!opens) duty_active_o <= '0;
        else if (period_start_o)
          duty_active_o <= feltgate_pkg::DUTY_W'(on_a) - feltgate_pkg::DUTY_W'(feltgate_pkg::PWM_PERIOD / 2);
      end
      logic unused_duty;
      assign unused_duty = ^bridge_duty;
    end
    pwm_three_phase #(.Period(feltgate_pkg::PWM_PERIOD), .DeadClocks(feltgate_pkg::DEAD_CLOCKS),
                      .ShortestClocks(feltgate_pkg::SHORTEST_CLOCKS)) u_pwm (
        .clk_i(clk_i), .rst_ni(rst_ni),
        .clear_i(gates_clear_i), .enable_i(opens),
        .on_a_i(on_a), .on_b_i(on_b), .on_c_i(on_c),
        .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
        .gate_c_hi_o(gate_c_hi_o), .gate_c_lo_o(gate_c_lo_o), .period_start_o(period_start_o)
    );
  end
  endgenerate

  assign applied_o = limited;

  assign limits_o = (LimitsW'(limit_torque) << feltgate_map_pkg::L_TORQUE) |
                    (LimitsW'(limit_ramp) << feltgate_map_pkg::L_RAMP) |
                    (LimitsW'(limit_hold) << feltgate_map_pkg::L_HOLD) |
                    (LimitsW'(limit_current) << feltgate_map_pkg::L_CURRENT) |
                    (LimitsW'(limit_voltage) << feltgate_map_pkg::L_VOLTAGE) |
                    (LimitsW'(limit_duty) << feltgate_map_pkg::L_DUTY);

  logic unused;
  assign unused = ^{wave_i, control_i, count_i, hall_angle_i};  // a room takes its own clocks of the wave and its own fields of the control word
endmodule

`default_nettype wire
