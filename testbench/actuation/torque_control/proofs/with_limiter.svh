// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Ports of both wrappers, torque_control with the limiter that serves it, this tick's back-EMF and window, and
// the clocks in which its outputs are new.

(
    input logic                                            clk_i,
    input logic                                            rst_ni,
    input logic        [                              8:0] start_i,  // where in a tick a reset ends
    input logic                                            armed_i,
    input logic        [                              1:0] mode_i,
    input logic        [                             31:0] param_i,
    input logic signed [     feltgate_pkg::PRODUCT_BITS-1:0] product_i,
    input logic signed [         feltgate_pkg::TORQUE_W-1:0] tau_ref_i,
    input logic signed [  feltgate_pkg::LIMITER_INPUT_W-1:0] other_early_i,  // the scenes'
    input logic signed [  feltgate_pkg::LIMITER_INPUT_W-1:0] other_late_i
);
  localparam int CurrentW = feltgate_pkg::CURRENT_W;
  localparam int VoltageW = feltgate_pkg::VOLTAGE_W;
  localparam int DutyW = feltgate_pkg::DUTY_W;
  localparam int LimiterW = feltgate_pkg::LIMITER_W;
  localparam int EmfW = feltgate_pkg::EMF_W;
  localparam int EmfDrop = feltgate_pkg::VELOCITY_F + feltgate_pkg::P_EMF_CONSTANT_F - feltgate_pkg::VOLTAGE_F;

  `include "wave.svh"
  logic armed_q;
  logic [1:0] mode_q;
  always_ff @(posedge clk_i) begin
    armed_q <= armed_i;
    mode_q  <= mode_i;
  end
  always_comb begin
    assume (tick_q || !rst_ni || (armed_i == armed_q && mode_i == mode_q));
    // A direct voltage is no product of the voltage gain.
    assume (!(wave[feltgate_map_pkg::PRODUCT_AT_VOLTAGE_GAIN] && mode_i == 2'(feltgate_map_pkg::MODE_VOLTAGE)) || product_i == '0);
    assume (phase_q <= 9'(feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT) || (other_early_i == '0 && other_late_i == '0));
  end

  logic signed [feltgate_pkg::LIMITER_INPUT_W-1:0] early_term, late_term;
  logic signed [feltgate_pkg::WITH_ADDEND_W-1:0] limited, addend;
  logic late_up;
  wire signed [feltgate_pkg::WITH_ADDEND_W-1:0] applied = limited;
  logic signed [CurrentW-1:0] current;
  logic signed [VoltageW-1:0] voltage;
  logic signed [DutyW-1:0] duty;
  logic over_limit, region_high, limit_current, limit_voltage, limit_duty;
  wire [feltgate_map_pkg::WAVE_LENGTH-1:0] wave_seen = rst_ni ? wave : '0;  // as the sequencer's reset has it
  torque_control u_dut (
      .*,
      .product_is_emf_constant_i(wave_seen[feltgate_map_pkg::PRODUCT_AT_EMF_CONSTANT]),
      .product_is_observer_gain_i(wave_seen[feltgate_map_pkg::PRODUCT_AT_OBSERVER_GAIN]),
      .at_border_i(wave_seen[feltgate_map_pkg::EVENT_AT_BORDER]),
      .at_region_i(wave_seen[feltgate_map_pkg::EVENT_AT_REGION]),
      .param_is_voltage_setpoint_i(wave_seen[feltgate_map_pkg::PARAM_AT_VOLTAGE_SETPOINT]),
      .product_is_voltage_to_current_i(wave_seen[feltgate_map_pkg::PRODUCT_AT_VOLTAGE_TO_CURRENT]),
      .param_is_voltage_step_i(wave_seen[feltgate_map_pkg::PARAM_AT_VOLTAGE_STEP]),
      .product_is_torque_gain_i(wave_seen[feltgate_map_pkg::PRODUCT_AT_TORQUE_GAIN]),
      .at_direct_voltage_i(wave_seen[feltgate_map_pkg::EVENT_AT_DIRECT_VOLTAGE]),
      .param_is_current_limit_i(wave_seen[feltgate_map_pkg::PARAM_AT_CURRENT_LIMIT]),
      .product_is_dead_voltage_slope_i(wave_seen[feltgate_map_pkg::PRODUCT_AT_DEAD_VOLTAGE_SLOPE]),
      .at_current_i(wave_seen[feltgate_map_pkg::EVENT_AT_CURRENT]),
      .at_hold_size_i(wave_seen[feltgate_map_pkg::EVENT_AT_HOLD_SIZE]),
      .param_is_dead_voltage_i(wave_seen[feltgate_map_pkg::PARAM_AT_DEAD_VOLTAGE]),
      .at_voltage_offset_i(wave_seen[feltgate_map_pkg::EVENT_AT_VOLTAGE_OFFSET]),
      .product_next_voltage_gain_i(wave_seen[feltgate_map_pkg::PRODUCT_AT_VOLTAGE_GAIN-1]),
      .product_is_voltage_gain_i(wave_seen[feltgate_map_pkg::PRODUCT_AT_VOLTAGE_GAIN]),
      .param_is_voltage_window_i(wave_seen[feltgate_map_pkg::PARAM_AT_VOLTAGE_WINDOW]),
      .at_voltage_i(wave_seen[feltgate_map_pkg::EVENT_AT_VOLTAGE]),
      .product_is_duty_gain_i(wave_seen[feltgate_map_pkg::PRODUCT_AT_DUTY_GAIN]),
      .at_duty_i(wave_seen[feltgate_map_pkg::EVENT_AT_DUTY]),
      .early_term_o(early_term),
      .late_term_o(late_term),
      .late_up_o(late_up),
      .addend_o(addend),
      .limited_i(limited),
      .over_limit_i(over_limit),
      .region_high_o(region_high),
      .current_ref_o(current),
      .voltage_o(voltage),
      .duty_o(duty),
      .limit_current_o(limit_current),
      .limit_voltage_o(limit_voltage),
      .limit_duty_o(limit_duty)
  );
  // As the core has it.
  limiter u_limiter (
      .clk_i(clk_i),
      .valid_i(wave[feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT-1] || wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_STEP-1] ||
               wave[feltgate_map_pkg::PARAM_AT_CURRENT_LIMIT-1] || wave[feltgate_map_pkg::PARAM_AT_DEAD_VOLTAGE-1] ||
               wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_WINDOW-1] || wave[feltgate_map_pkg::PARAM_AT_DUTY_LIMIT-1]),
      .torque_i(wave[feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT-1]),
      .voltage_i(wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_WINDOW-1]),
      .duty_i(wave[feltgate_map_pkg::PARAM_AT_DUTY_LIMIT-1]),
      .early_term_i(early_term | other_early_i),
      .early_up_i(1'b0),
      .late_term_i(late_term | other_late_i),
      .late_not_i(1'b0),
      .late_up_i(late_up),
      .param_i(param_i),
      .addend_i(addend),
      .limited_o(limited),
      .over_limit_o(over_limit)
  );
  (* hierconn *) wire signed [feltgate_pkg::VOLTAGE_SUM_W-1:0] \u_dut.voltage_offset_q ;
  (* hierconn *) wire signed [feltgate_pkg::CURRENT_SUM_W-1:0] \u_dut.current_of_tau_hat_q ;
  // What no reset clears is 0 once a wave has passed; the first one after a reset is never an armed one.
  always_comb if (!rst_ni) assume (\u_dut.voltage_offset_q == 0 && \u_dut.current_of_tau_hat_q == 0);
  (* hierconn *) wire signed [EmfW-1:0] \u_dut.emf_q ;
  wire signed [EmfW-1:0] emf = \u_dut.emf_q ;

  // A word as a limit: a negative one, or one that the limiter's or the signal's format does not hold, is 0.
  function automatic logic [LimiterW-1:0] as_limit(input logic [31:0] word, input int bits);
    as_limit = ((word[LimiterW-1:0] >> (bits - 1)) != '0) ? '0 : word[LimiterW-1:0];
  endfunction
  function automatic logic within(input logic signed [39:0] x, input logic [LimiterW-1:0] most);
    within = x <= $signed({1'b0, 39'(most)}) && x >= -$signed({1'b0, 39'(most)});
  endfunction

  // What this tick's back-EMF and window were, as they came by.
  logic [LimiterW-1:0] window_q;
  logic signed [EmfW-1:0] emf_then_q;
  always_ff @(posedge clk_i) begin
    if (wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_WINDOW]) window_q <= as_limit(param_i, VoltageW);
    if (wave[feltgate_map_pkg::PRODUCT_AT_EMF_CONSTANT]) emf_then_q <= EmfW'(product_i >>> EmfDrop);
  end
  // Clocks of this tick since its back-EMF, without a reset.
  logic began_q;
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) began_q <= 1'b0;
    else if (wave[feltgate_map_pkg::PRODUCT_AT_EMF_CONSTANT]) began_q <= 1'b1;
    else if (tick_q) began_q <= 1'b0;
  end
  logic new_current, new_voltage, new_duty, law;
  logic new_current_q, new_voltage_q, new_duty_q, was_q;
  assign new_current = began_q && wave[feltgate_map_pkg::EVENT_AT_CURRENT];
  assign new_voltage = began_q && wave[feltgate_map_pkg::EVENT_AT_VOLTAGE];
  assign new_duty    = began_q && wave[feltgate_map_pkg::EVENT_AT_DUTY];
  assign law = mode_q != 2'(feltgate_map_pkg::MODE_VOLTAGE);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) {new_current_q, new_voltage_q, new_duty_q, was_q} <= '0;
    else begin
      {new_current_q, new_voltage_q, new_duty_q} <= {new_current, new_voltage, new_duty};
      was_q <= 1'b1;
    end
  end

  always_comb begin
    if (past_ok_q && rst_ni && was_q) begin
      inside_emf: assert (!began_q || emf == emf_then_q);
      inside_fixed: assert (\u_dut.voltage_offset_q == 0 || (phase_q > 9'(feltgate_map_pkg::EVENT_AT_DIRECT_VOLTAGE) &&
                            phase_q <= 9'(feltgate_map_pkg::PARAM_AT_VOLTAGE_WINDOW)));
    end
  end
