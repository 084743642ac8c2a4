// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Which number is on the bus in which clock of the wave: that of the schedule, whole, and no other.
`default_nettype none

module operands_proof (
    input logic                                                  clk_i,
    input logic        [                                    8:0] start_i,
    input logic signed [feltgate_pkg::VELOCITY_DIFFERENCE_W-1:0] velocity_difference_i,
    input logic signed [feltgate_pkg::OBSERVER_DIFFERENCE_W-1:0] observer_difference_i,
    input logic signed [     feltgate_pkg::SCENE_DISTANCE_W-1:0] distance_i,
    input logic signed [        feltgate_pkg::WITH_ADDEND_W-1:0] limited_i,
    input logic signed [           feltgate_pkg::VELOCITY_W-1:0] velocity_i,
    input logic signed [             feltgate_pkg::TORQUE_W-1:0] tau_hat_i,
    input logic signed [             feltgate_pkg::TORQUE_W-1:0] tau_ref_i,
    input logic signed [            feltgate_pkg::CURRENT_W-1:0] current_ref_i,
    input logic signed [            feltgate_pkg::VOLTAGE_W-1:0] voltage_i,
    input logic signed [   feltgate_pkg::CURRENT_ESTIMATE_W-1:0] current_estimate_i
);
  localparam int W = feltgate_pkg::MULTIPLIER_A_BITS;
  localparam int Clocks = feltgate_pkg::CLOCKS_PER_TICK;

  logic [1:0] clocks_q;
  logic [8:0] phase_q;
  logic [feltgate_map_pkg::WAVE_LENGTH-1:0] wave;
  initial clocks_q = 2'd0;
  always_ff @(posedge clk_i) begin
    if (clocks_q != 2'd3) clocks_q <= clocks_q + 2'd1;
    phase_q <= phase_q == 9'(Clocks - 1) ? 9'd0 : phase_q + 9'd1;
  end
  assign wave = (phase_q < 9'(feltgate_map_pkg::WAVE_LENGTH)) ? feltgate_map_pkg::WAVE_LENGTH'(1) << phase_q : '0;

  logic of_velocity, of_voltage, of_tau_ref, of_distance, of_limited;
  assign of_velocity = wave[feltgate_map_pkg::PARAM_AT_EMF_OVER_RESISTANCE] || wave[feltgate_map_pkg::PARAM_AT_INERTIA_GAIN] ||
                       wave[feltgate_map_pkg::PARAM_AT_DAMPER_DAMPING] || wave[feltgate_map_pkg::PARAM_AT_EMF_CONSTANT];
  assign of_voltage  = wave[feltgate_map_pkg::PARAM_AT_INVERSE_RESISTANCE] || wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_TO_CURRENT];
  assign of_tau_ref  = wave[feltgate_map_pkg::PARAM_AT_TORQUE_GAIN] || wave[feltgate_map_pkg::PARAM_AT_DEAD_VOLTAGE_SLOPE];
  assign of_distance = wave[feltgate_map_pkg::PARAM_AT_SCENE_STIFFNESS] || wave[feltgate_map_pkg::PARAM_AT_CHARGE_SLOPE];
  assign of_limited  = phase_q > 9'(feltgate_map_pkg::PARAM_AT_TORQUE_LIMIT) && !of_voltage && !of_tau_ref;
  always_comb begin
    assume (phase_q < 9'(Clocks));
    // Who is 0 outside its clocks by itself.
    assume (wave[feltgate_map_pkg::PARAM_AT_VELOCITY_A1] || velocity_difference_i == '0);
    assume (wave[feltgate_map_pkg::PARAM_AT_OBSERVER_A1] || observer_difference_i == '0);
    assume (of_distance || distance_i == '0);
    assume (of_limited || limited_i == '0);
  end

  logic signed [W-1:0] operand, dob, scene, control, supervisor;
  logic signed_word, square;
  logic signed [feltgate_pkg::CURRENT_ESTIMATE_W-1:0] estimate;
  operand_bus u_dut (
      .*,
      .param_next_inverse_resistance_i(wave[feltgate_map_pkg::PARAM_AT_INVERSE_RESISTANCE-1]),
      .param_next_emf_over_resistance_i(wave[feltgate_map_pkg::PARAM_AT_EMF_OVER_RESISTANCE-1]),
      .param_next_torque_constant_i(wave[feltgate_map_pkg::PARAM_AT_TORQUE_CONSTANT-1]),
      .param_next_inertia_gain_i(wave[feltgate_map_pkg::PARAM_AT_INERTIA_GAIN-1]),
      .param_next_damper_damping_i(wave[feltgate_map_pkg::PARAM_AT_DAMPER_DAMPING-1]),
      .param_next_current_square_i(wave[feltgate_map_pkg::PARAM_AT_CURRENT_SQUARE-1]),
      .param_next_emf_constant_i(wave[feltgate_map_pkg::PARAM_AT_EMF_CONSTANT-1]),
      .param_next_observer_gain_i(wave[feltgate_map_pkg::PARAM_AT_OBSERVER_GAIN-1]),
      .param_next_voltage_to_current_i(wave[feltgate_map_pkg::PARAM_AT_VOLTAGE_TO_CURRENT-1]),
      .param_next_torque_gain_i(wave[feltgate_map_pkg::PARAM_AT_TORQUE_GAIN-1]),
      .param_next_dead_voltage_slope_i(wave[feltgate_map_pkg::PARAM_AT_DEAD_VOLTAGE_SLOPE-1]),
      .operand_o(operand),
      .dob_o(dob),
      .scene_o(scene),
      .control_o(control),
      .supervisor_o(supervisor),
      .signed_o(signed_word),
      .estimate_o(estimate),
      .square_estimate_o(square)
  );

  // Copied a clock before.
  logic signed [feltgate_pkg::CURRENT_W-1:0] current_q;
  logic signed [feltgate_pkg::VOLTAGE_W-1:0] voltage_q;
  logic signed [feltgate_pkg::CURRENT_ESTIMATE_W-1:0] estimate_q;
  always_ff @(posedge clk_i) begin
    current_q  <= current_ref_i;
    voltage_q  <= voltage_i;
    estimate_q <= current_estimate_i;
  end
  logic signed [W-1:0] wanted;
  always_comb begin
    if (wave[feltgate_map_pkg::PARAM_AT_VELOCITY_A1]) wanted = W'(velocity_difference_i);
    else if (wave[feltgate_map_pkg::PARAM_AT_OBSERVER_A1]) wanted = W'(observer_difference_i);
    else if (of_distance) wanted = W'(distance_i);
    else if (of_velocity) wanted = W'(velocity_i);
    else if (wave[feltgate_map_pkg::PARAM_AT_TORQUE_CONSTANT]) wanted = W'(current_q);
    else if (wave[feltgate_map_pkg::PARAM_AT_CURRENT_SQUARE]) wanted = W'(estimate_q);
    else if (wave[feltgate_map_pkg::PARAM_AT_OBSERVER_GAIN]) wanted = W'(tau_hat_i);
    else if (of_voltage) wanted = W'(voltage_q);
    else if (of_tau_ref) wanted = W'(tau_ref_i);
    else wanted = W'(limited_i);
  end

  always_comb begin
    if (clocks_q >= 2'd2) begin
      operand_is_the_schedules: assert (operand == wanted);
      parts_are_the_operand: assert (!(of_velocity && dob != wanted) && !(of_velocity && scene != wanted) &&
          !(of_velocity && control != wanted) && !(of_velocity && supervisor != wanted) &&
          (!wave[feltgate_map_pkg::PARAM_AT_OBSERVER_A1] || dob == wanted) &&
              (!wave[feltgate_map_pkg::PARAM_AT_TORQUE_CONSTANT] || dob == wanted) &&
          (!of_distance || scene == wanted) && (!of_tau_ref || control == wanted) &&
          (!wave[feltgate_map_pkg::PARAM_AT_OBSERVER_GAIN] || control == wanted) && (!of_voltage || (control == wanted &&
              supervisor == wanted)) &&
          (!(of_limited && limited_i != '0) || control == wanted) && (!wave[feltgate_map_pkg::PARAM_AT_CURRENT_SQUARE] ||
              supervisor == wanted));
      one_word_has_a_sign: assert (signed_word == wave[feltgate_map_pkg::PARAM_AT_OBSERVER_GAIN]);
      squared_in_its_clock: assert (square == wave[feltgate_map_pkg::PARAM_AT_CURRENT_SQUARE] &&
          estimate == (square ? estimate_q : '0));
      negative: cover (of_tau_ref && operand < 0);
    end
  end
endmodule

`default_nettype wire
