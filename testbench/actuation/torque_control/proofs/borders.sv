// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// torque_control with the limiter that serves it: what is compared with the borders, what is told, the step of
// the set-point, for any products and any words.
`default_nettype none

module borders_proof
`include "with_limiter.svh"

  // Words and products as they came by in this tick.
  logic [LimiterW-1:0] step_q;
  always_ff @(posedge clk_i) begin
    if (wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_STEP]) step_q <= as_limit(param_i, LimiterW);
  end
  // A torque against a border: what was asked a clock ago, and a clock before.
  logic over_q, over_then_q, region_due_q, region_was_q, known_q, applied_now_q, beyond_q;
  logic signed [feltgate_pkg::TORQUE_W-1:0] size_q;
  always_ff @(posedge clk_i) begin
    if (wave[feltgate_map_pkg::EVENT_AT_BORDER] || wave[feltgate_map_pkg::EVENT_AT_HOLD_SIZE]) size_q <= tau_ref_i;
    over_q       <= param_i[LimiterW-1] || !within(40'(size_q), param_i[LimiterW-1:0]);
    over_then_q  <= over_q;
    region_due_q <= wave[feltgate_map_pkg::EVENT_AT_REGION];
    known_q      <= began_q;
    region_was_q <= region_high;
    beyond_q     <= over_limit;
    applied_now_q <= began_q && wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_WINDOW];
  end
  always_comb begin
    if (past_ok_q && rst_ni && was_q) begin
      if (applied_now_q) applied_within_window: assert (!armed_q || within(40'(applied) - 40'(emf_then_q), window_q));
      if (wave[feltgate_map_pkg::EVENT_AT_DIRECT_VOLTAGE] && began_q) begin
        set_point_steps: assert (law || !armed_q || within(40'(applied) - 40'(voltage), step_q));
      end
      if (wave[feltgate_map_pkg::EVENT_AT_HOLD_STRONG] && began_q) hold_border: assert (over_limit == over_q);
      region_in_its_clock: assert (region_due_q ? !known_q || region_high == over_then_q : region_high == region_was_q);
      limits_are_told: assert ((!new_current_q || limit_current == (beyond_q && armed_q)) &&
                               (!new_voltage_q || limit_voltage == (beyond_q && armed_q)) &&
                               (!new_duty_q || limit_duty == beyond_q));
      idle_terms_are_0: assert ((wave[feltgate_map_pkg::PARAM_AT_REGION_TORQUE-1] || wave[feltgate_map_pkg::PARAM_AT_CURRENT_LIMIT-1] ||
                                 wave[feltgate_map_pkg::PARAM_AT_DEAD_VOLTAGE-1] || wave[feltgate_map_pkg::PARAM_AT_HOLD_TORQUE-1] ||
                                 early_term == '0) &&
                                (wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_STEP] || wave[feltgate_map_pkg::PARAM_AT_CURRENT_LIMIT] ||
                                 wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_WINDOW] || wave[feltgate_map_pkg::PARAM_AT_DUTY_LIMIT] ||
                                 late_term == '0));
      limits: cover (new_voltage_q && limit_voltage);
      is_high: cover (region_high && began_q);
    end
  end
endmodule

`default_nettype wire
