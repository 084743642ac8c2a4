// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bridge socket: three legs, with two measured phase currents that are controlled in the rotor's frame. In voltage mode
// the drive's duty is the length of the voltage. The observer and the heat take the current along the axis of torque, of
// the last whole window. docs/blocks/three_phase.md

`default_nettype none

module three_phase_current (
    input  logic               clk_i,
    input  logic               rst_ni,
    input  cfg::params_t       p,
    input  cfg::drive_t        drive_i,
    output cfg::bridge_t       bridge_o,
    input  logic signed [31:0] count_i,          // of the encoder
    input  logic        [31:0] offset_i,         // electrical angle at count 0
    input  logic        [ 1:0] current_data_i,   // asynchronous pins of the modulators at phases A and B
    output logic               current_clock_o,  // to them
    input  logic               driver_fault_i,   // asynchronous pin of the bridge's driver
    output logic               gate_a_hi_o,
    output logic               gate_a_lo_o,
    output logic               gate_b_hi_o,
    output logic               gate_b_lo_o,
    output logic               gate_c_hi_o,
    output logic               gate_c_lo_o
);
  localparam logic signed [18:0] PerClock = 19'(((1 << 17) - 1) / cfg::PWM_PERIOD);  // a whole period is below the supply
  logic sensed, measured, missing, open_phase, period_start;
  logic [6:0] why;
  logic [37:0] at_shunt;
  logic signed [18:0] mean_q, reference, resistive, across;
  logic signed [20:0] along;
  logic signed [17:0] feed_forward, length;
  logic [16:0] limit;
  logic [11:0] on_a, on_b, on_c;
  logic signed [cfg::CURRENT_W-1:0] motor_current_q;
  logic signed [cfg::DUTY_W-1:0] duty_active_q;

  current_sensors #(.Sensors(2)) u_current_sensors (
      .clk_i(clk_i), .rst_ni(rst_ni), .drive_i(drive_i), .period_start_i(period_start), .current_data_i(current_data_i),
      .current_clock_o(current_clock_o), .driver_fault_i(driver_fault_i), .missing_i(missing || open_phase),
      .at_shunt_o(at_shunt), .valid_o(sensed), .why_o(why)
  );
  current_command u_current_command (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .drive_i(drive_i), .reference_o(reference), .feed_forward_o(feed_forward),
      .limit_o(limit)
  );
  assign length = 18'(fx::saturate(64'($signed(drive_i.duty)) * 64'(PerClock), 18));
  field_oriented #(.Period(cfg::PWM_PERIOD)) u_field_oriented (
      .clk_i(clk_i), .rst_ni(rst_ni), .armed_i(drive_i.gates_enable), .valid_i(sensed), .direct_i(drive_i.direct),
      .reference_i(reference), .current_a_i(at_shunt[18:0]), .current_b_i(at_shunt[37:19]),
      .emf_i(drive_i.direct ? length : feed_forward), .count_i(count_i), .gain_i(p.commutation_gain),
      .offset_i(offset_i), .polarity_i(drive_i.polarity), .proportional_i(17'(cfg::CURRENT_PROPORTIONAL)),
      .integral_i(17'(cfg::CURRENT_INTEGRAL)), .limit_i(limit), .current_q_o(along), .resistive_o(resistive),
      .across_o(across), .open_o(open_phase), .on_a_o(on_a), .on_b_o(on_b), .on_c_o(on_c), .valid_o(measured)
  );
  current_check u_current_check (
      .clk_i(clk_i), .rst_ni(rst_ni), .armed_i(drive_i.gates_enable && !drive_i.direct), .valid_i(sensed),
      .resistive_i(resistive), .across_i(across), .current_i(along), .resistance_i(17'(cfg::CURRENT_RESISTANCE)),
      .margin_i(17'(cfg::CURRENT_MARGIN)), .missing_o(missing)
  );

  // The current of a tick, in amperes. The duty in force is that of leg A, from half a period on.
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {mean_q, motor_current_q, duty_active_q} <= '0;
    end else begin
      if (measured) mean_q <= 19'(fx::saturate(64'(along), 19));
      if (drive_i.sample)
        motor_current_q <= cfg::CURRENT_W'(fx::saturate(fx::scale(64'(mean_q), cfg::CURRENT_DROP), cfg::CURRENT_W));
      if (!drive_i.gates_enable) duty_active_q <= '0;
      else if (period_start) duty_active_q <= cfg::DUTY_W'(on_a) - cfg::DUTY_W'(cfg::PWM_PERIOD / 2);
    end
  end
  pwm_three_phase #(.Period(cfg::PWM_PERIOD), .DeadClocks(cfg::DEAD_CLOCKS), .ShortestClocks(cfg::SHORTEST_CLOCKS)) u_pwm (
      .clk_i(clk_i), .rst_ni(rst_ni), .clear_i(drive_i.gates_clear), .enable_i(drive_i.gates_enable), .on_a_i(on_a),
      .on_b_i(on_b), .on_c_i(on_c), .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o),
      .gate_b_lo_o(gate_b_lo_o), .gate_c_hi_o(gate_c_hi_o), .gate_c_lo_o(gate_c_lo_o), .period_start_o(period_start)
  );
  assign bridge_o = {1'b1, period_start, duty_active_q, motor_current_q, why};
endmodule

`default_nettype wire
