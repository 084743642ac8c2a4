// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Elaboration-time checks of a design's package: what the core requires of it. A check that fails
// instantiates a missing module whose name states the rule. Verilator, Icarus, Yosys, slang and
// Quartus all accept this form. The blocks check their own parameters in the same way. No logic, no
// ports. docs/designs.md

`default_nettype none

module feltgate_checks;
  localparam int A = feltgate_pkg::MULTIPLIER_A_BITS;

  generate
  if (!(feltgate_map_pkg::MULTIPLIER_LATENCY == 4 && feltgate_map_pkg::FIRST_WAVE_CLOCK == 2))
  begin : g_check_map
    the_map_must_have_the_latencies_of_this_RTL missing ();
  end
  if (!(A == 35 && feltgate_pkg::MULTIPLIER_B_BITS == 18 && feltgate_pkg::PRODUCT_BITS == 53))
  begin : g_check_multiplier
    the_multiplier_must_be_35_by_18_bits missing ();
  end
  if (!(feltgate_pkg::COEFFICIENT_BITS >= 2 && feltgate_pkg::COEFFICIENT_BITS <= 17))
  begin : g_check_coefficients
    COEFFICIENT_BITS_must_fit_the_multiplier missing ();
  end
  if (!(feltgate_pkg::ROUNDING >= 0 && feltgate_pkg::ROUNDING <= 2)) begin : g_check_rounding
    ROUNDING_must_be_0_1_or_2 missing ();
  end

  if (!(feltgate_pkg::PHASES == 2 ||
        (feltgate_pkg::PHASES == 3 &&
         (feltgate_pkg::MODULATION == 1 || (feltgate_pkg::MODULATION == 0 && feltgate_pkg::CURRENT_LOOP == 0)) &&
         feltgate_pkg::PWM_PERIOD >=
         ((feltgate_pkg::CURRENT_LOOP != 0) ? 772 : (feltgate_pkg::MODULATION == 0) ? 110 : 87)))) begin : g_check_phases
    PHASES_must_be_2_or_3_with_a_PWM_PERIOD_that_is_long_enough_and_sines_without_a_CURRENT_LOOP missing ();
  end

  // Parameters and snapshot are words of 32 bits.
  if (!(feltgate_pkg::POSITION_W == 32 && feltgate_pkg::CHARGE_W == 32 &&
        feltgate_pkg::VELOCITY_W <= 32 && feltgate_pkg::RAMP_W <= 32 &&
        feltgate_pkg::CURRENT_W <= 32 && feltgate_pkg::SCENE_OFFSET_W <= 31 &&
        feltgate_pkg::I2T_W <= 32 && feltgate_pkg::CURRENT_SQUARED_W <= 32))
  begin : g_check_words
    a_signal_must_fit_its_word_of_32_bits missing ();
  end

  // Position and velocity.
  if (!(feltgate_pkg::TRAVEL_BITS == 16 &&
        feltgate_pkg::TRAVEL_DIFFERENCE_W == feltgate_pkg::TRAVEL_BITS)) begin : g_check_travel
    TRAVEL_BITS_must_be_the_16_of_the_decoder missing ();
  end
  if (!(feltgate_pkg::VELOCITY_DIFFERENCE_W <= A && feltgate_pkg::OBSERVER_DIFFERENCE_W <= A))
  begin : g_check_differences
    a_filters_difference_must_fit_the_multiplier missing ();
  end
  if (!(feltgate_pkg::SCENE_POSITION_W == 18 && feltgate_pkg::SCENE_OFFSET_F >= 1 &&
        feltgate_pkg::SCENE_OFFSET_W ==
        feltgate_pkg::SCENE_POSITION_W + feltgate_pkg::SCENE_OFFSET_F)) begin : g_check_scene
    SCENE_OFFSET_must_be_SCENE_POSITION_with_a_fraction missing ();
  end

  // Torque, current, voltage, duty.
  if (!(feltgate_pkg::RAMP_F > feltgate_pkg::TORQUE_F &&
        feltgate_pkg::RAMP_W - feltgate_pkg::RAMP_F ==
        feltgate_pkg::TORQUE_W - feltgate_pkg::TORQUE_F)) begin : g_check_ramp
    RAMP_must_be_TORQUE_with_more_fraction missing ();
  end
  if (!(feltgate_pkg::OBSERVER_F > feltgate_pkg::TORQUE_F)) begin : g_check_observer
    OBSERVER_F_must_be_above_TORQUE_F missing ();
  end
  if (!(feltgate_pkg::DUTY_W == 13 && feltgate_pkg::DUTY_F == 0)) begin : g_check_duty
    DUTY_must_be_the_13_bits_of_the_bridge missing ();
  end
  if (!(feltgate_pkg::TORQUE_W <= feltgate_pkg::LIMITER_W &&
        feltgate_pkg::CURRENT_W <= feltgate_pkg::LIMITER_W &&
        feltgate_pkg::VOLTAGE_W <= feltgate_pkg::LIMITER_W &&
        feltgate_pkg::DUTY_W <= feltgate_pkg::LIMITER_W)) begin : g_check_limiter
    LIMITER_W_must_hold_torque_current_voltage_and_duty missing ();
  end
  if (!(feltgate_pkg::WITH_ADDEND_W <= 32 && feltgate_pkg::SCENE_DISTANCE_W <= 32))
  begin : g_check_operands
    every_operand_but_a_difference_must_fit_32_bits missing ();
  end
  if (!(feltgate_pkg::CURRENT_ESTIMATE_W <= 18 &&
        feltgate_pkg::CURRENT_ESTIMATE_W == feltgate_pkg::CURRENT_ESTIMATE_PART_W + 1 &&
        feltgate_pkg::CURRENT_ESTIMATE_F == feltgate_pkg::CURRENT_ESTIMATE_PART_F))
  begin : g_check_estimate
    CURRENT_ESTIMATE_must_fit_the_multiplier missing ();
  end

  // A product has at least as many fraction bits as its result, and one more if it is rounded.
  if (!(feltgate_pkg::CURRENT_F + feltgate_pkg::P_TORQUE_CONSTANT_F >= feltgate_pkg::OBSERVER_F &&
        feltgate_pkg::VELOCITY_F + feltgate_pkg::P_INERTIA_GAIN_F >= feltgate_pkg::OBSERVER_F &&
        feltgate_pkg::OBSERVER_DIFFERENCE_F + feltgate_pkg::P_OBSERVER_A1_F >
        feltgate_pkg::OBSERVER_F &&
        feltgate_pkg::VELOCITY_DIFFERENCE_F + feltgate_pkg::P_VELOCITY_A1_F >
        feltgate_pkg::VELOCITY_F)) begin : g_check_filter_products
    a_filters_product_must_have_the_bits_that_are_dropped missing ();
  end
  if (!(feltgate_pkg::TORQUE_F + feltgate_pkg::P_TORQUE_GAIN_F >= feltgate_pkg::CURRENT_F &&
        feltgate_pkg::TORQUE_F + feltgate_pkg::P_OBSERVER_GAIN_F >= feltgate_pkg::CURRENT_F &&
        feltgate_pkg::VOLTAGE_F + feltgate_pkg::P_VOLTAGE_TO_CURRENT_F >= feltgate_pkg::CURRENT_F &&
        feltgate_pkg::VELOCITY_F + feltgate_pkg::P_EMF_CONSTANT_F >= feltgate_pkg::VOLTAGE_F &&
        feltgate_pkg::TORQUE_F + feltgate_pkg::P_DEAD_VOLTAGE_SLOPE_F >= feltgate_pkg::VOLTAGE_F &&
        feltgate_pkg::CURRENT_F + feltgate_pkg::P_VOLTAGE_GAIN_F >= feltgate_pkg::VOLTAGE_F &&
        feltgate_pkg::P_VOLTAGE_GAIN_HIGH_F == feltgate_pkg::P_VOLTAGE_GAIN_F &&
        feltgate_pkg::VOLTAGE_F + feltgate_pkg::P_DUTY_GAIN_F >= 1)) begin : g_check_control_products
    a_product_of_torque_control_must_have_the_bits_that_are_dropped missing ();
  end
  if (!(feltgate_pkg::P_TENSION_STIFFNESS_F == feltgate_pkg::P_COMPRESSION_STIFFNESS_F))
  begin : g_check_springs
    both_springs_must_have_one_format missing ();
  end
  if (!(feltgate_pkg::SCENE_GUARD_BITS >= 1 &&
        feltgate_pkg::SCENE_PART_F == feltgate_pkg::TORQUE_F + feltgate_pkg::SCENE_GUARD_BITS &&
        feltgate_pkg::SCENE_TORQUE_W >= feltgate_pkg::SCENE_POSITION_W + 1 &&
        feltgate_pkg::LIMITER_INPUT_W >= feltgate_pkg::SCENE_TORQUE_W &&
        feltgate_pkg::LIMITER_INPUT_W > feltgate_pkg::LIMITER_W)) begin : g_check_scene_torque
    a_scenes_torque_must_hold_its_terms_and_fit_the_limiter missing ();
  end
  endgenerate
endmodule

`default_nettype wire
