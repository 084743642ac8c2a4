// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Bridge socket: two legs, with a loop of the measured current. A PI law gives the voltage of each PWM period; in voltage
// mode the duty is the drive's. The observer and the heat take the current of the last whole window. docs/blocks/current.md

`default_nettype none

module h_bridge_current (
    input  logic         clk_i,
    input  logic         rst_ni,
    input  cfg::params_t p,
    input  logic         current_data_i,   // asynchronous pin of the modulator
    output logic         current_clock_o,  // to it
    input  logic         driver_fault_i,   // asynchronous pin of the bridge's driver
    input  cfg::drive_t  drive_i,
    output cfg::bridge_t bridge_o,
    output logic         gate_a_hi_o,
    output logic         gate_a_lo_o,
    output logic         gate_b_hi_o,
    output logic         gate_b_lo_o
);
  localparam int VoltageF = 17;  // of the supply
  logic controls, measured, missing, period_start;
  logic [6:0] why;
  logic signed [18:0] at_shunt, current, mean_q, reference, resistive;
  logic signed [17:0] feed_forward, voltage;
  logic [16:0] limit;
  logic signed [cfg::CURRENT_W-1:0] motor_current_q;
  logic signed [cfg::DUTY_W-1:0] duty_q, duty_active;
  assign controls = drive_i.gates_enable && !drive_i.direct;

  current_sensors #(.Sensors(1)) u_current_sensors (
      .clk_i(clk_i), .rst_ni(rst_ni), .drive_i(drive_i), .period_start_i(period_start), .current_data_i(current_data_i),
      .current_clock_o(current_clock_o), .driver_fault_i(driver_fault_i), .missing_i(missing), .at_shunt_o(at_shunt),
      .valid_o(measured), .why_o(why)
  );
  assign current = drive_i.polarity ? -at_shunt : at_shunt;  // that which makes tau_ref positive

  current_command u_current_command (
      .clk_i(clk_i), .rst_ni(rst_ni), .p(p), .drive_i(drive_i), .reference_o(reference), .feed_forward_o(feed_forward),
      .limit_o(limit)
  );
  current_control u_current_control (
      .clk_i(clk_i), .rst_ni(rst_ni), .armed_i(controls), .valid_i(measured), .reference_i(reference),
      .current_i(current), .emf_i(feed_forward), .proportional_i(17'(cfg::CURRENT_PROPORTIONAL)),
      .integral_i(17'(cfg::CURRENT_INTEGRAL)), .limit_i(limit), .voltage_o(voltage), .resistive_o(resistive)
  );
  current_check u_current_check (
      .clk_i(clk_i), .rst_ni(rst_ni), .armed_i(controls), .valid_i(measured), .resistive_i(resistive), .across_i(19'd0),
      .current_i(21'(current)), .resistance_i(17'(cfg::CURRENT_RESISTANCE)), .margin_i(17'(cfg::CURRENT_MARGIN)),
      .missing_o(missing)
  );

  // The duty, rounded half up; the current of a tick, in amperes.
  logic signed [63:0] clocks;
  assign clocks = 64'(voltage) * 64'(cfg::PWM_PERIOD);
  always_ff @(posedge clk_i or negedge rst_ni) begin
    if (!rst_ni) begin
      {mean_q, motor_current_q, duty_q} <= '0;
    end else begin
      if (measured) mean_q <= current;
      if (drive_i.sample)
        motor_current_q <= cfg::CURRENT_W'(fx::saturate(fx::scale(64'(mean_q), cfg::CURRENT_DROP), cfg::CURRENT_W));
      duty_q <= cfg::DUTY_W'((clocks + (64'sd1 <<< (VoltageF - 1))) >>> VoltageF);
    end
  end
  pwm #(.Period(cfg::PWM_PERIOD), .DeadClocks(cfg::DEAD_CLOCKS), .ShortestClocks(cfg::SHORTEST_CLOCKS)) u_pwm (
      .clk_i(clk_i), .rst_ni(rst_ni), .clear_i(drive_i.gates_clear), .enable_i(drive_i.gates_enable),
      .mode_i(drive_i.pwm_mode), .polarity_i(drive_i.polarity), .duty_i(drive_i.direct ? drive_i.duty : duty_q),
      .gate_a_hi_o(gate_a_hi_o), .gate_a_lo_o(gate_a_lo_o), .gate_b_hi_o(gate_b_hi_o), .gate_b_lo_o(gate_b_lo_o),
      .period_start_o(period_start), .duty_active_o(duty_active)
  );
  assign bridge_o = {1'b1, period_start, duty_active, motor_current_q, why};
endmodule

`default_nettype wire
