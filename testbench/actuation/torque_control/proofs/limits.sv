// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// torque_control with the limiter that serves it: current, voltage and duty against their words, and which
// way they turn, for any products and any words.
`default_nettype none

module limits_proof
`include "with_limiter.svh"

  wire signed [feltgate_pkg::CURRENT_SUM_W-1:0] kept = \u_dut.current_of_tau_hat_q ;
  localparam logic signed [feltgate_pkg::CURRENT_SUM_W-1:0] Kept = feltgate_pkg::CURRENT_SUM_W'(1) <<
      (feltgate_pkg::TORQUE_W + feltgate_pkg::COEFFICIENT_BITS - 1 -
       (feltgate_pkg::TORQUE_F + feltgate_pkg::P_OBSERVER_GAIN_F - feltgate_pkg::CURRENT_F));

  // Words and products as they came by in this tick.
  logic [LimiterW-1:0] current_limit_q, duty_limit_q;
  logic all_down_q, all_up_q, law_product;
  logic fits;
  int operand_bits;
  always_comb begin
    operand_bits = feltgate_pkg::TORQUE_W;
    if (wave[feltgate_map_pkg::PRODUCT_AT_EMF_CONSTANT]) operand_bits = feltgate_pkg::VELOCITY_W;
    if (wave[feltgate_map_pkg::PRODUCT_AT_VOLTAGE_GAIN]) operand_bits = CurrentW;
    if (wave[feltgate_map_pkg::PRODUCT_AT_DUTY_GAIN]) operand_bits = feltgate_pkg::APPLIED_W;
    fits = (product_i < 0 ? ~product_i : product_i) >>> (operand_bits + feltgate_pkg::COEFFICIENT_BITS - 1) == 0;
  end
  assign law_product = wave[feltgate_map_pkg::PRODUCT_AT_OBSERVER_GAIN] || wave[feltgate_map_pkg::PRODUCT_AT_TORQUE_GAIN] ||
                       wave[feltgate_map_pkg::PRODUCT_AT_DEAD_VOLTAGE_SLOPE] || wave[feltgate_map_pkg::PRODUCT_AT_VOLTAGE_GAIN] ||
                       wave[feltgate_map_pkg::PRODUCT_AT_DUTY_GAIN];
  always_ff @(posedge clk_i) begin
    if (wave[feltgate_map_pkg::PARAM_AT_CURRENT_LIMIT]) current_limit_q <= as_limit(param_i, LimiterW);
    if (wave[feltgate_map_pkg::PARAM_AT_DUTY_LIMIT]) duty_limit_q <= as_limit(param_i, DutyW);
    // All products of the law point one way, and are no more than their operands and a word of
    // COEFFICIENT_BITS make; the back-EMF too, or it is 0 where the law does not give it back.
    if (wave[feltgate_map_pkg::PRODUCT_AT_EMF_CONSTANT]) begin
      all_down_q <= fits && ((feltgate_pkg::EMF_IN_LAW != 0) ? product_i <= 0 : product_i == 0);
      all_up_q   <= fits && ((feltgate_pkg::EMF_IN_LAW != 0) ? product_i >= 0 : product_i == 0);
    end else if (law_product) begin
      all_down_q <= all_down_q && fits && product_i <= 0;
      all_up_q   <= all_up_q && fits && product_i >= 0;
    end
  end
  logic signed [CurrentW-1:0] current_was_q;
  logic signed [VoltageW-1:0] voltage_was_q;
  logic signed [DutyW-1:0] duty_was_q;
  logic any_current_q, any_voltage_q, any_duty_q;
  always_ff @(posedge clk_i) begin
    current_was_q <= current;
    voltage_was_q <= voltage;
    duty_was_q    <= duty;
    {any_current_q, any_voltage_q, any_duty_q} <=
        {wave[feltgate_map_pkg::EVENT_AT_CURRENT], wave[feltgate_map_pkg::EVENT_AT_VOLTAGE], wave[feltgate_map_pkg::EVENT_AT_DUTY]};
  end
  localparam logic signed [VoltageW-1:0] Most = {1'b0, {(VoltageW - 1) {1'b1}}};

  logic signed [39:0] between;
  assign between = 40'(voltage) - 40'(emf_then_q);
  always_comb begin
    if (past_ok_q && rst_ni && was_q) begin
      change_in_their_clocks: assert ((any_current_q || current == current_was_q) && (any_voltage_q ||
          voltage == voltage_was_q) &&
                                      (any_duty_q || duty == duty_was_q));
      if (new_current_q) begin
        current_within_limit: assert (within(40'(current), current_limit_q));
        current_turns: assert (!law || !((all_down_q && current > 0) || (all_up_q && current < 0)));
        disarmed_current_is_0: assert (armed_q || current == '0);
        pulls: cover (current < 0 && all_down_q && limit_current);
      end
      if (new_voltage_q) begin
        voltage_within_window: assert (!armed_q || within(between, window_q) ||
                                       (voltage == Most && between < 0) || (voltage == ~Most && between > 0));
        voltage_turns: assert (!law || !((all_down_q && voltage > 0) || (all_up_q && voltage < 0)));
        disarmed_voltage_is_0: assert (armed_q || voltage == '0);
        drives: cover (voltage > 0 && limit_voltage && emf_then_q < 0);
      end
      if (new_duty_q) begin
        duty_within_limit: assert (within(40'(duty), duty_limit_q));
        duty_turns: assert (!((all_down_q && duty > 0) || (all_up_q && duty < 0)));
        turns: cover (duty < 0 && limit_duty);
      end
      inside_down: assert (!began_q || !all_down_q || (emf <= 0 &&
          (phase_q <= 9'(feltgate_map_pkg::PRODUCT_AT_OBSERVER_GAIN) || (kept <= 0 && kept >= -Kept))));
      inside_up: assert (!began_q || !all_up_q || (emf >= 0 &&
          (phase_q <= 9'(feltgate_map_pkg::PRODUCT_AT_OBSERVER_GAIN) || (kept >= 0 && kept < Kept))));
    end
  end
endmodule

`default_nettype wire
