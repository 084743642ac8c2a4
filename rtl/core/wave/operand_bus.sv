// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The operand bus to the multiplier. In each wave clock at most one source drives it, all others
// are 0, so an OR combines them. A value that is held longer is gated, or enters through a copy that
// is 0 outside its clocks. Combinational from its inputs and copies. docs/architecture.md

`default_nettype none

module operand_bus (
    input  logic                                                  clk_i,
    input  logic                                                  param_next_inverse_resistance_i,
    input  logic                                                  param_next_emf_over_resistance_i,
    input  logic                                                  param_next_torque_constant_i,
    input  logic                                                  param_next_inertia_gain_i,
    input  logic                                                  param_next_damper_damping_i,
    input  logic                                                  param_next_current_square_i,
    input  logic                                                  param_next_emf_constant_i,
    input  logic                                                  param_next_observer_gain_i,
    input  logic                                                  param_next_voltage_to_current_i,
    input  logic                                                  param_next_torque_gain_i,
    input  logic                                                  param_next_dead_voltage_slope_i,
    // These are 0 outside their clocks.
    input  logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] velocity_difference_i,
    input  logic signed [feltgate_pkg::OBSERVER_DIFFERENCE_W-1:0] observer_difference_i,
    input  logic signed [    feltgate_pkg::SCENE_DISTANCE_W-1:0]  distance_i,
    input  logic signed [        feltgate_pkg::WITH_ADDEND_W-1:0] limited_i,
    // These are held.
    input  logic signed [           feltgate_pkg::VELOCITY_W-1:0] velocity_i,
    input  logic signed [             feltgate_pkg::TORQUE_W-1:0] tau_hat_i,
    input  logic signed [             feltgate_pkg::TORQUE_W-1:0] tau_ref_i,
    input  logic signed [            feltgate_pkg::CURRENT_W-1:0] current_ref_i,
    input  logic signed [            feltgate_pkg::VOLTAGE_W-1:0] voltage_i,
    input  logic signed [   feltgate_pkg::CURRENT_ESTIMATE_W-1:0] current_estimate_i,
    // The core's operand, and each block's part of it.
    output logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] operand_o,
    output logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] dob_o,
    output logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] scene_o,
    output logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] control_o,
    output logic signed [    feltgate_pkg::MULTIPLIER_A_BITS-1:0] supervisor_o,
    output logic                                                  signed_o,  // param is signed
    output logic signed [   feltgate_pkg::CURRENT_ESTIMATE_W-1:0] estimate_o,  // to be squared
    output logic                                                  square_estimate_o
);
  localparam int W = feltgate_pkg::MULTIPLIER_A_BITS;

  logic signed [           feltgate_pkg::VELOCITY_W-1:0] velocity;
  logic signed [             feltgate_pkg::TORQUE_W-1:0] tau_hat, tau_ref;
  logic signed [            feltgate_pkg::CURRENT_W-1:0] current_q;
  logic signed [            feltgate_pkg::VOLTAGE_W-1:0] voltage_q;
  logic signed [   feltgate_pkg::CURRENT_ESTIMATE_W-1:0] estimate_q;
  logic take_velocity_q, take_tau_hat_q, take_tau_ref_q, square_estimate_q;
  // A value that is new in its first bus clock is gated by a select made one clock ahead. The other
  // values are copied one clock ahead.
  always_ff @(posedge clk_i) begin
    take_velocity_q <= param_next_emf_over_resistance_i ||
                       param_next_inertia_gain_i ||
                       param_next_damper_damping_i ||
                       param_next_emf_constant_i;
    take_tau_hat_q  <= param_next_observer_gain_i;
    take_tau_ref_q  <= param_next_torque_gain_i ||
                       param_next_dead_voltage_slope_i;
    if (!param_next_torque_constant_i) current_q <= '0;
    else current_q <= current_ref_i;
    if (!(param_next_inverse_resistance_i ||
          param_next_voltage_to_current_i)) voltage_q <= '0;
    else voltage_q <= voltage_i;
    square_estimate_q <= param_next_current_square_i;
    if (!param_next_current_square_i) estimate_q <= '0;
    else estimate_q <= current_estimate_i;
  end
  assign velocity  = take_velocity_q ? velocity_i : '0;
  assign tau_hat   = take_tau_hat_q ? tau_hat_i : '0;
  assign tau_ref   = take_tau_ref_q ? tau_ref_i : '0;
  assign signed_o  = take_tau_hat_q;
  assign square_estimate_o = square_estimate_q;
  assign dob_o        = W'(observer_difference_i) | W'(current_q) | W'(velocity);
  assign scene_o      = W'(distance_i) | W'(velocity);
  assign control_o    = W'(limited_i) | W'(tau_hat) | W'(tau_ref) | W'(voltage_q) | W'(velocity);
  assign supervisor_o = W'(estimate_q) | W'(voltage_q) | W'(velocity);
  // Sources that fit 32 bits are ORed at that width, which makes a simulation faster. The limiter's
  // result arrives late in the clock, so it is ORed last.
  logic signed [31:0] narrow;
  assign narrow       = (32'(velocity) | 32'(voltage_q) | 32'(estimate_q)) | (32'(tau_hat) | 32'(tau_ref)) |
                        (32'(distance_i) | 32'(current_q));
  assign operand_o    = (W'(velocity_difference_i) | W'(observer_difference_i) | W'(narrow)) | W'(limited_i);
  assign estimate_o   = estimate_q;
endmodule

`default_nettype wire
