// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Torque to current, voltage and duty:
//   I = Jn Kp/Ktn * tau_ref + (1 - Jn Kp)/Ktn * tau_hat    limited; the term of tau_hat only in closed loop
//   V = R * I + Ke * w + dead voltage                      within a window around Ke * w
//   duty = V * period / supply                             limited
// In voltage mode V goes to its set-point by a step a tick, and I = V/R. Disarmed, all are 0.
// valid_o 13 clocks after start_i. docs/blocks/torque_law.md

`default_nettype none

module torque_law (
    input  logic                              clk_i,
    input  logic                              rst_ni,
    input  cfg::params_t                      p,
    input  logic                              armed_i,
    input  logic        [                1:0] mode_i,
    input  logic                              start_i,     // one clock a tick; the next three hold until valid_o
    input  logic signed [  cfg::TORQUE_W-1:0] tau_ref_i,   // Nm
    input  logic signed [  cfg::TORQUE_W-1:0] tau_hat_i,   // Nm, new one clock after start_i at the latest
    input  logic signed [cfg::VELOCITY_W-1:0] velocity_i,  // rad/s
    output logic signed [ cfg::CURRENT_W-1:0] current_o,   // A, held as the next two
    output logic signed [ cfg::VOLTAGE_W-1:0] voltage_o,   // V, saturated
    output logic signed [    cfg::FEED_W-1:0] feed_o,      // V that no current takes: Ke * w + dead voltage
    output logic signed [    cfg::DUTY_W-1:0] duty_o,      // clocks of on-time
    output logic                              limit_current_o,
    output logic                              limit_voltage_o,
    output logic                              limit_duty_o,
    output logic                              valid_o
);
  localparam int W = cfg::LIMITER_INPUT_W;  // of a sum before its limit
  localparam int AppliedW = cfg::WITH_ADDEND_W;
  localparam int OffsetW = cfg::VOLTAGE_W + 2;
  localparam int Speed = cfg::VELOCITY_W > AppliedW ? cfg::VELOCITY_W : AppliedW;
  localparam int Force = cfg::TORQUE_W > cfg::CURRENT_W ? cfg::TORQUE_W : cfg::CURRENT_W;
  localparam int O = Speed > Force ? Speed : Force;  // of the widest operand
  localparam int DutyDrop = cfg::VOLTAGE_F + cfg::P_DUTY_GAIN_F;
  logic closed, direct;
  assign closed = mode_i != 2'(map::MODE_OPEN);
  assign direct = mode_i == 2'(map::MODE_VOLTAGE);

  logic [11:0] at;  // clocks since start_i
  logic signed [W-1:0] current_ref_q;          // the part of tau_ref
  logic signed [cfg::EMF_W-1:0] emf_q;         // Ke * w
  logic signed [OffsetW-1:0] offset_q;  // dead voltage, or in voltage mode the voltage, less Ke * w
  logic signed [AppliedW-1:0] applied_q;       // voltage, not yet saturated
  logic high_q;                                // the region of the high voltage gain

  // One line is one product.
  logic signed [O-1:0] operand_q;
  logic signed [17:0] factor_q;
  logic signed [O+17:0] product_q;
  logic signed [63:0] product;
  always_ff @(posedge clk_i) begin
    if (start_i)    {operand_q, factor_q} <= direct ? {O'(voltage_o), 1'b0, p.voltage_to_current}
                                                    : {O'(tau_ref_i), 1'b0, p.torque_gain};
    else if (at[0]) {operand_q, factor_q} <= {O'(tau_hat_i), p.observer_gain};
    else if (at[1]) {operand_q, factor_q} <= {O'(tau_ref_i), 1'b0, p.dead_voltage_slope};
    else if (at[2]) {operand_q, factor_q} <= {O'(velocity_i), 1'b0, p.emf_constant};
    else if (at[4]) {operand_q, factor_q} <= {O'(current_o), 1'b0, high_q ? p.voltage_gain_high : p.voltage_gain};
    else            {operand_q, factor_q} <= {O'(applied_q), 1'b0, p.duty_gain};
    product_q <= operand_q * factor_q;
  end
  assign product = 64'(product_q);

  // Each branch adds the terms of one sum; the sum is limited in the next clock. A product has the fraction
  // bits of its two factors.
  logic signed [W-1:0] base, term, x_q, limited;
  logic [cfg::LIMITER_W-1:0] limit, limit_q;
  logic up, beyond;
  always_comb begin
    up = 1'b0;
    if (at[2]) begin  // current
      base  = current_ref_q;
      term  = closed && !direct ? W'(fx::scale(product, cfg::CURRENT_F - cfg::TORQUE_F - cfg::P_OBSERVER_GAIN_F)) : '0;
      limit = cfg::LIMITER_W'(p.current_limit);
    end else if (at[3]) begin  // dead voltage; in voltage mode the step
      base  = direct ? W'($signed(p.voltage_setpoint)) : '0;
      term  = direct ? -(W'(voltage_o)) : W'(fx::scale(product, cfg::VOLTAGE_F - cfg::TORQUE_F - cfg::P_DEAD_VOLTAGE_SLOPE_F));
      limit = direct ? cfg::LIMITER_W'(p.voltage_step) : cfg::LIMITER_W'(p.dead_voltage);
    end else if (at[6]) begin  // voltage over Ke * w
      base  = W'(offset_q);
      term  = direct ? '0 : W'(fx::scale(product, cfg::VOLTAGE_F - cfg::CURRENT_F - cfg::P_VOLTAGE_GAIN_F));
      limit = cfg::LIMITER_W'(p.voltage_window);
    end else begin  // duty
      base  = '0;
      term  = W'(fx::scale(product, -DutyDrop));
      up    = fx::rounds_up(product, DutyDrop, term[0]);
      limit = cfg::LIMITER_W'(p.duty_limit);
    end
  end
  always_ff @(posedge clk_i) begin
    x_q     <= base + term + W'($signed({1'b0, up}));
    limit_q <= limit;
  end
  assign beyond  = fx::beyond(64'(x_q), 32'(limit_q));
  assign limited = W'(fx::limited(64'(x_q), 32'(limit_q)));

  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {at, valid_o, current_ref_q, emf_q, offset_q, applied_q, high_q} <= '0;
      {current_o, duty_o, limit_current_o, limit_voltage_o, limit_duty_o} <= '0;
    end else begin
      {valid_o, at} <= {at, start_i};
      if (start_i) high_q           <= fx::beyond(64'(tau_ref_i), 32'(p.region_torque));
      if (at[1])  current_ref_q     <= direct ? W'(fx::scale(product, cfg::CURRENT_F - cfg::VOLTAGE_F - cfg::P_VOLTAGE_TO_CURRENT_F))
                                              : W'(fx::scale(product, cfg::CURRENT_F - cfg::TORQUE_F - cfg::P_TORQUE_GAIN_F));
      if (at[3])  current_o         <= armed_i ? cfg::CURRENT_W'(limited) : '0;
      if (at[3])  limit_current_o   <= armed_i && beyond;
      if (at[4])  emf_q             <= cfg::EMF_W'(fx::scale(product, cfg::VOLTAGE_F - cfg::VELOCITY_F - cfg::P_EMF_CONSTANT_F));
      if (at[4])  offset_q          <= OffsetW'(limited) + (direct ? OffsetW'(voltage_o) : '0);
      if (at[5] && (direct || cfg::EMF_IN_LAW == 0)) offset_q <= offset_q - OffsetW'(emf_q);
      if (at[7])  applied_q         <= armed_i ? AppliedW'(limited) + AppliedW'(emf_q) : '0;
      if (at[7])  limit_voltage_o   <= armed_i && beyond;
      if (at[11]) duty_o            <= cfg::DUTY_W'(limited);
      if (at[11]) limit_duty_o      <= beyond;
    end
  end
  assign feed_o    = cfg::FEED_W'(emf_q) + cfg::FEED_W'(offset_q);
  assign voltage_o = cfg::VOLTAGE_W'(fx::saturate(64'(applied_q), cfg::VOLTAGE_W));
endmodule

`default_nettype wire
