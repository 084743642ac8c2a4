// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/designs/lever.toml and rtl/registers.toml by
// `feltgate generate`: do not edit.
#pragma once

#include <cstdint>
#include <string_view>

#include "feltgate/chain_formats.hpp"
#include "feltgate/fixed.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/parameter.hpp"

namespace feltgate {

/// feed-forward torque with the true motor's constants; the default.
struct Lever {
  static constexpr const char* name = "lever";
  static constexpr std::int64_t clock_hz = 50000000;
  static constexpr std::int64_t tick_hz = 1000000;
  static constexpr double count_rad = 0.0015339807878856412;
  static constexpr double velocity_gain_rad_s = 0.0;
  static constexpr double supply_v = 24.0;
  static constexpr int clocks_per_tick = 50;  // clocks
  static constexpr int m1 = 767;  // ticks between the two positions of the velocity estimator
  static constexpr int velocity_shift = 1;  // raw velocity = 2^n * counts
  static constexpr int velocity_gain = 0;  // mantissa of the gain that stands for 2^n; 0: none
  static constexpr int velocity_gain_f = 17;  // its fraction bits
  static constexpr int index_counts = 4096;  // counts from index to index; 0: not checked
  static constexpr int pwm_period = 1000;  // clocks
  static constexpr int dead_clocks = 25;  // clocks
  static constexpr int shortest_clocks = 10;  // clocks, of a pulse at a gate
  static constexpr int scene_mask = 1021;  // bit n: scene n is built
  static constexpr int control_reset = 0;  // control word after reset
  static constexpr int scene_guard_bits = 2;  // bits that a scene's terms keep below a torque step
  static constexpr int require_watchdog = 0;  // 1: arming waits for the first kick
  static constexpr int emf_in_law = 1;  // 1: the voltage law gives back the back-EMF
  static constexpr int i2t_start = 1460000000;  // I2t sum after power-up: half the budget, for nobody knows how hot the motor is
  static constexpr int axes = 1;  // motors with an encoder each
  static constexpr int engine = 0;  // 1: programs give the torque of the scene law
  static constexpr int engine_max_age = 0;  // ticks without a fresh torque that are borne
  static constexpr int mt_counts = 0;  // velocity by M/T of an encoder with so many counts in a turn; 0: by the N-method
  static constexpr int mt_window = 0;  // clocks: of a shorter span twice the cycles
  static constexpr int mt_doublings = 0;  // the span has at most 2^n cycles
  static constexpr int edge_unit_bits = 6;  // bits of the ticks in which the time between edges is counted
  static constexpr int fast_edges = 0;  // 1: at the fastest motion several counts come in a tick
  static constexpr int self_test_drop = 0;  // the self-test takes 2^n counts for one
  static constexpr int current_loop = 0;  // 1: a measured current is controlled
  static constexpr int current_drop = 0;  // fraction bits of the current reference below an LSB of the measured current
  static constexpr int current_proportional = 0;  // [0,4,13], supply per full scale
  static constexpr int current_integral = 0;  // [0,0,17]
  static constexpr int current_resistance = 0;  // [0,4,13], supply per full scale
  static constexpr int current_margin = 0;  // [0,0,17] of the supply: half of the largest current's
  static constexpr int current_overcurrent = 0;  // [0,0,8] of full scale
  static constexpr int current_strobe = 0;  // clock of the PWM period in which a window begins
  static constexpr int feed_gain = 0;  // mantissa: parts of the supply per LSB of the voltage
  static constexpr int feed_drop = 0;  // its fraction bits
  static constexpr int driver_fault = 0;  // 1: the driver tells of its faults
  static constexpr int heartbeat = 0;  // ticks between changes of the pin for a watchdog outside, a power of two; 0: no pin
  static constexpr int absolute_encoder = 0;  // 1: the position is of an absolute encoder
  static constexpr int absolute_framing = 0;  // 0 SPI with parity, 1 SSI with CRC-6
  static constexpr int absolute_bits = 0;  // of a turn
  static constexpr int absolute_half_clocks = 0;  // clocks: half a serial clock
  static constexpr int absolute_gap_clocks = 0;  // clocks before the serial clock and between readings
  static constexpr int absolute_period = 0;  // ticks from reading to reading
  static constexpr int absolute_jump_step = 0;  // counts of the fastest motion in a reading
  static constexpr int absolute_diagnosis = 0;  // SPI: address of the diagnosis
  static constexpr int hall = 0;  // 1: Hall lines give the electrical angle at power-up
  static constexpr int phases = 2;  // legs of the bridge: 2 of one motor current, 3 of three
  static constexpr Round rounding = Round::half_up;  // where the chain rounds
  static constexpr std::uint32_t design_crc = 0xf6bf6134;  // by which a host knows the design

  /// Formats of the parameters.
  struct P {
    static constexpr Format velocity_a1{0, -10, 27};
    static constexpr Format inverse_resistance{0, 2, 15};
    static constexpr Format emf_over_resistance{0, -3, 20};
    static constexpr Format torque_constant{0, -5, 22};
    static constexpr Format inertia_gain{0, -4, 21};
    static constexpr Format nominal_current_squared{0, 30, 2};
    static constexpr Format observer_a1{0, -10, 27};
    static constexpr Format overspeed{1, 10, 21};
    static constexpr Format i2t_budget{0, 30, 2};
    static constexpr Format polarity_speed{1, 10, 21};
    static constexpr Format polarity_current{1, 5, 16};
    static constexpr Format polarity_ticks{0, 31, 0};
    static constexpr Format emf_constant{0, -5, 22};
    static constexpr Format observer_gain{1, 0, 17};
    static constexpr Format voltage_setpoint{1, 5, 14};
    static constexpr Format voltage_step{1, 5, 14};
    static constexpr Format torque_limit{1, 4, 16};
    static constexpr Format ramp_step{1, 4, 24};
    static constexpr Format voltage_to_current{0, 2, 15};
    static constexpr Format torque_gain{0, 6, 11};
    static constexpr Format dead_voltage_slope{0, 7, 10};
    static constexpr Format region_torque{1, 4, 16};
    static constexpr Format hold_torque{1, 4, 16};
    static constexpr Format hold_time{0, 31, 0};
    static constexpr Format hold_limit{1, 4, 16};
    static constexpr Format current_limit{1, 5, 16};
    static constexpr Format voltage_gain{0, -1, 18};
    static constexpr Format voltage_gain_high{0, -1, 18};
    static constexpr Format dead_voltage{1, 5, 14};
    static constexpr Format voltage_window{1, 5, 14};
    static constexpr Format duty_gain{0, 6, 11};
    static constexpr Format duty_limit{0, 12, 0};
    static constexpr Format watchdog_ticks{0, 31, 0};
    static constexpr Format self_test_torque{1, 4, 16};
    static constexpr Format self_test_quiet{0, 31, 0};
    static constexpr Format self_test_pulse{0, 31, 0};
    static constexpr Format self_test_arms{0, 31, 0};
    static constexpr Format setpoint_torque{1, 4, 16};
    static constexpr Format membrane_lower{1, 17, 8};
    static constexpr Format membrane_upper{1, 17, 8};
    static constexpr Format membrane_torque{1, 4, 16};
    static constexpr Format compression_contact{1, 17, 8};
    static constexpr Format compression_stiffness{0, -9, 26};
    static constexpr Format tension_rest{1, 17, 8};
    static constexpr Format tension_stiffness{0, -9, 26};
    static constexpr Format damper_damping{0, -5, 22};
    static constexpr Format attract_centre{1, 17, 8};
    static constexpr Format attract_strength{0, 16, 16};
    static constexpr Format attract_core{0, 18, 0};
    static constexpr Format attract_core_slope{0, -8, 25};
    static constexpr Format repel_centre{1, 17, 8};
    static constexpr Format repel_strength{0, 16, 16};
    static constexpr Format repel_core{0, 18, 0};
    static constexpr Format repel_core_slope{0, -8, 25};
    static constexpr Format wall_contact{1, 17, 8};
    static constexpr Format wall_stiffness{0, -3, 20};
    static constexpr Format wall_damping{0, -3, 20};
  };

  // Equal in all designs.
  using A = Map::A;
  using S = Map::S;
  using C = Map::C;
  static constexpr int scene_number(std::string_view scene) {
    return Map::scene_number(scene);
  }
  static constexpr const auto& scene_names = Map::scene_names;

  static constexpr BaseFormats base{
      {1, 10, 21}, {1, 4, 16}, {1, 5, 16}, {1, 5, 14},
      30, velocity_shift, velocity_gain != 0, {0, 0, 17},
      P::velocity_a1, P::torque_constant, P::inertia_gain, P::observer_a1,
      P::torque_gain, P::observer_gain, P::voltage_gain, P::emf_constant,
      P::dead_voltage_slope, P::voltage_to_current, P::duty_gain,
      P::inverse_resistance, P::emf_over_resistance, P::compression_stiffness,
      P::tension_stiffness, P::attract_core_slope, P::repel_core_slope, P::wall_stiffness,
      P::damper_damping, P::wall_damping};
  static constexpr Formats f = derive(base);

  /// Parameters: name, unit, address, format, exact value, integer, format of its
  /// register.
  static constexpr ParameterInfo parameters[] = {
      {"velocity_a1", "1", A::velocity_a1, P::velocity_a1,
       0.00049987502083072939, 67092, {0, -10, 27}},
      {"inverse_resistance", "1/ohm", A::inverse_resistance, P::inverse_resistance,
       2.3809523809523809, 78019, {0, 2, 15}},
      {"emf_over_resistance", "A s/rad", A::emf_over_resistance, P::emf_over_resistance,
       0.071904761904761916, 75398, {0, -3, 20}},
      {"torque_constant", "Nm/A", A::torque_constant, P::torque_constant,
       0.030200000000000001, 126668, {0, -5, 22}},
      {"inertia_gain", "Nm s/rad", A::inertia_gain, P::inertia_gain,
       0.060999999999999999, 127926, {0, -4, 21}},
      {"nominal_current_squared", "A^2", A::nominal_current_squared, P::nominal_current_squared,
       33.292899999999996, 133, {0, 29, 2}},
      {"observer_a1", "1", A::observer_a1, P::observer_a1,
       0.00049987502083072939, 67092, {0, -10, 27}},
      {"overspeed", "rad/s", A::overspeed, P::overspeed,
       613.60000000000002, 1286812467, {0, 10, 21}},
      {"i2t_budget", "A^2 tick", A::i2t_budget, P::i2t_budget,
       730000000.0, 2920000000, {0, 30, 2}},
      {"polarity_speed", "rad/s", A::polarity_speed, P::polarity_speed,
       6.0, 12582912, {0, 10, 21}},
      {"polarity_current", "A", A::polarity_current, P::polarity_current,
       6.0, 393216, {0, 5, 16}},
      {"polarity_ticks", "tick", A::polarity_ticks, P::polarity_ticks,
       4000.0, 4000, {0, 16, 0}},
      {"emf_constant", "V s/rad", A::emf_constant, P::emf_constant,
       0.030200000000000001, 126668, {0, -5, 22}},
      {"observer_gain", "A/Nm", A::observer_gain, P::observer_gain,
       0.0, 0, {1, 0, 17}},
      {"voltage_setpoint", "V", A::voltage_setpoint, P::voltage_setpoint,
       0.0, 0, {1, 5, 14}},
      {"voltage_step", "V/tick", A::voltage_step, P::voltage_step,
       0.00238037109375, 39, {0, 5, 14}},
      {"torque_limit", "Nm", A::torque_limit, P::torque_limit,
       0.5, 32768, {0, 4, 16}},
      {"ramp_step", "Nm/tick", A::ramp_step, P::ramp_step,
       5.0000000000000004e-06, 84, {0, 4, 24}},
      {"voltage_to_current", "1/ohm", A::voltage_to_current, P::voltage_to_current,
       2.3809523809523809, 78019, {0, 2, 15}},
      {"torque_gain", "A/Nm", A::torque_gain, P::torque_gain,
       33.11258278145695, 67815, {0, 6, 11}},
      {"dead_voltage_slope", "V/Nm", A::dead_voltage_slope, P::dead_voltage_slope,
       97.5, 99840, {0, 7, 10}},
      {"region_torque", "Nm", A::region_torque, P::region_torque,
       0.5, 32768, {0, 4, 16}},
      {"hold_torque", "Nm", A::hold_torque, P::hold_torque,
       0.25, 16384, {0, 4, 16}},
      {"hold_time", "1024 ticks", A::hold_time, P::hold_time,
       4883.0, 4883, {0, 14, 0}},
      {"hold_limit", "Nm", A::hold_limit, P::hold_limit,
       0.125, 8192, {0, 4, 16}},
      {"current_limit", "A", A::current_limit, P::current_limit,
       16.600000000000001, 1087898, {0, 5, 16}},
      {"voltage_gain", "ohm", A::voltage_gain, P::voltage_gain,
       0.41999999999999998, 110100, {0, -1, 18}},
      {"voltage_gain_high", "ohm", A::voltage_gain_high, P::voltage_gain_high,
       0.41999999999999998, 110100, {0, -1, 18}},
      {"dead_voltage", "V", A::dead_voltage, P::dead_voltage,
       0.97500000000000009, 15974, {0, 5, 14}},
      {"voltage_window", "V", A::voltage_window, P::voltage_window,
       8.1150000000000002, 132956, {0, 5, 14}},
      {"duty_gain", "clock/V", A::duty_gain, P::duty_gain,
       41.666666666666664, 85333, {0, 6, 11}},
      {"duty_limit", "clock", A::duty_limit, P::duty_limit,
       965.0, 965, {0, 12, 0}},
      {"watchdog_ticks", "tick", A::watchdog_ticks, P::watchdog_ticks,
       100000.0, 100000, {0, 24, 0}},
      {"self_test_torque", "Nm", A::self_test_torque, P::self_test_torque,
       0.050000000000000003, 3277, {0, 4, 16}},
      {"self_test_quiet", "128 ticks", A::self_test_quiet, P::self_test_quiet,
       157.0, 157, {0, 8, 0}},
      {"self_test_pulse", "128 ticks", A::self_test_pulse, P::self_test_pulse,
       39.0, 39, {0, 8, 0}},
      {"self_test_arms", "1", A::self_test_arms, P::self_test_arms,
       3.0, 3, {0, 2, 0}},
      {"setpoint_torque", "Nm", A::setpoint_torque, P::setpoint_torque,
       0.0, 0, {1, 4, 16}},
      {"membrane_lower", "count", A::membrane_lower, P::membrane_lower,
       325.94932345220167, 83443, {1, 17, 8}},
      {"membrane_upper", "count", A::membrane_upper, P::membrane_upper,
       456.3290528330823, 116820, {1, 17, 8}},
      {"membrane_torque", "Nm", A::membrane_torque, P::membrane_torque,
       0.5, 32768, {0, 4, 16}},
      {"compression_contact", "count", A::compression_contact, P::compression_contact,
       325.94932345220167, 83443, {1, 17, 8}},
      {"compression_stiffness", "Nm/count", A::compression_stiffness, P::compression_stiffness,
       0.0015339807878856412, 102944, {0, -9, 26}},
      {"tension_rest", "count", A::tension_rest, P::tension_rest,
       0.0, 0, {1, 17, 8}},
      {"tension_stiffness", "Nm/count", A::tension_stiffness, P::tension_stiffness,
       0.00076699039394282058, 51472, {0, -9, 26}},
      {"damper_damping", "Nm s/rad", A::damper_damping, P::damper_damping,
       0.029999999999999999, 125829, {0, -5, 22}},
      {"attract_centre", "count", A::attract_centre, P::attract_centre,
       0.0, 0, {1, 17, 8}},
      {"attract_strength", "Nm count^2", A::attract_strength, P::attract_strength,
       8499.4369167158384, 557019098, {0, 16, 16}},
      {"attract_core", "count", A::attract_core, P::attract_core,
       130.0, 130, {0, 18, 0}},
      {"attract_core_slope", "Nm/count", A::attract_core_slope, P::attract_core_slope,
       0.0038349519697141021, 128680, {0, -8, 25}},
      {"repel_centre", "count", A::repel_centre, P::repel_centre,
       0.0, 0, {1, 17, 8}},
      {"repel_strength", "Nm count^2", A::repel_strength, P::repel_strength,
       8499.4369167158384, 557019098, {0, 16, 16}},
      {"repel_core", "count", A::repel_core, P::repel_core,
       130.0, 130, {0, 18, 0}},
      {"repel_core_slope", "Nm/count", A::repel_core_slope, P::repel_core_slope,
       0.0038349519697141021, 128680, {0, -8, 25}},
      {"wall_contact", "count", A::wall_contact, P::wall_contact,
       325.94932345220167, 83443, {1, 17, 8}},
      {"wall_stiffness", "Nm/count", A::wall_stiffness, P::wall_stiffness,
       0.0061359231515425647, 6434, {0, -3, 20}},
      {"wall_damping", "Nm s/rad", A::wall_damping, P::wall_damping,
       0.0050000000000000001, 5243, {0, -3, 20}},
  };

  /// The constants of the package cfg.
  static constexpr NamedConstant constants[] = {
      {"CLOCK_HZ", 50000000},
      {"CLOCKS_PER_TICK", 50},
      {"M1", 767},
      {"VELOCITY_SHIFT", 1},
      {"VELOCITY_GAIN", 0},
      {"VELOCITY_GAIN_F", 17},
      {"INDEX_COUNTS", 4096},
      {"PWM_PERIOD", 1000},
      {"DEAD_CLOCKS", 25},
      {"SHORTEST_CLOCKS", 10},
      {"SCENE_MASK", 1021},
      {"CONTROL_RESET", 0},
      {"SCENE_GUARD_BITS", 2},
      {"REQUIRE_WATCHDOG", 0},
      {"EMF_IN_LAW", 1},
      {"I2T_START", 1460000000},
      {"AXES", 1},
      {"ENGINE", 0},
      {"ENGINE_MAX_AGE", 0},
      {"MT_COUNTS", 0},
      {"MT_WINDOW", 0},
      {"MT_DOUBLINGS", 0},
      {"EDGE_UNIT_BITS", 6},
      {"FAST_EDGES", 0},
      {"SELF_TEST_DROP", 0},
      {"CURRENT_LOOP", 0},
      {"CURRENT_DROP", 0},
      {"CURRENT_PROPORTIONAL", 0},
      {"CURRENT_INTEGRAL", 0},
      {"CURRENT_RESISTANCE", 0},
      {"CURRENT_MARGIN", 0},
      {"CURRENT_OVERCURRENT", 0},
      {"CURRENT_STROBE", 0},
      {"FEED_GAIN", 0},
      {"FEED_DROP", 0},
      {"DRIVER_FAULT", 0},
      {"HEARTBEAT", 0},
      {"ABSOLUTE_ENCODER", 0},
      {"ABSOLUTE_FRAMING", 0},
      {"ABSOLUTE_BITS", 0},
      {"ABSOLUTE_HALF_CLOCKS", 0},
      {"ABSOLUTE_GAP_CLOCKS", 0},
      {"ABSOLUTE_PERIOD", 0},
      {"ABSOLUTE_JUMP_STEP", 0},
      {"ABSOLUTE_DIAGNOSIS", 0},
      {"HALL", 0},
      {"PHASES", 2},
      {"ROUNDING", 0},
      {"DESIGN_CRC", 4139737396},
      {"TICK_W", 6},
      {"FEED_W", 23},
      {"POSITION_W", 32},
      {"POSITION_F", 0},
      {"SCENE_POSITION_W", 18},
      {"SCENE_POSITION_F", 0},
      {"SCENE_OFFSET_W", 26},
      {"SCENE_OFFSET_F", 8},
      {"SCENE_DISTANCE_W", 27},
      {"SCENE_DISTANCE_F", 8},
      {"SCENE_PART_W", 29},
      {"SCENE_PART_F", 18},
      {"SCENE_TORQUE_W", 29},
      {"SCENE_TORQUE_F", 16},
      {"TRAVEL_DIFFERENCE_W", 16},
      {"TRAVEL_DIFFERENCE_F", 0},
      {"VELOCITY_RAW_W", 16},
      {"VELOCITY_RAW_F", -1},
      {"VELOCITY_W", 32},
      {"VELOCITY_F", 21},
      {"VELOCITY_DIFFERENCE_W", 33},
      {"VELOCITY_DIFFERENCE_F", 21},
      {"INERTIA_TORQUE_W", 37},
      {"INERTIA_TORQUE_F", 30},
      {"DRIVE_TORQUE_W", 31},
      {"DRIVE_TORQUE_F", 30},
      {"OBSERVER_W", 38},
      {"OBSERVER_F", 30},
      {"OBSERVER_DIFFERENCE_W", 35},
      {"OBSERVER_DIFFERENCE_F", 26},
      {"OBSERVED_W", 39},
      {"OBSERVED_F", 30},
      {"TORQUE_W", 21},
      {"TORQUE_F", 16},
      {"RAMP_W", 29},
      {"RAMP_F", 24},
      {"CURRENT_W", 22},
      {"CURRENT_F", 16},
      {"CURRENT_PART_W", 27},
      {"CURRENT_PART_F", 16},
      {"CURRENT_SUM_W", 28},
      {"CURRENT_SUM_F", 16},
      {"VOLTAGE_W", 20},
      {"VOLTAGE_F", 14},
      {"VOLTAGE_PART_W", 26},
      {"VOLTAGE_PART_F", 14},
      {"VOLTAGE_SUM_W", 28},
      {"VOLTAGE_SUM_F", 14},
      {"EMF_W", 20},
      {"EMF_F", 14},
      {"APPLIED_W", 21},
      {"APPLIED_F", 14},
      {"DUTY_W", 13},
      {"DUTY_F", 0},
      {"DUTY_SUM_W", 14},
      {"DUTY_SUM_F", 0},
      {"LIMITER_W", 22},
      {"LIMITER_F", 0},
      {"WITH_ADDEND_W", 23},
      {"WITH_ADDEND_F", 0},
      {"LIMITER_INPUT_W", 29},
      {"LIMITER_INPUT_F", 0},
      {"CURRENT_ESTIMATE_PART_W", 16},
      {"CURRENT_ESTIMATE_PART_F", 8},
      {"CURRENT_ESTIMATE_W", 17},
      {"CURRENT_ESTIMATE_F", 8},
      {"CURRENT_SQUARED_W", 19},
      {"CURRENT_SQUARED_F", 2},
      {"I2T_W", 32},
      {"I2T_F", 2},
      {"CHARGE_W", 32},
      {"CHARGE_F", 16},
      {"P_VELOCITY_A1_F", 27},
      {"P_INVERSE_RESISTANCE_F", 15},
      {"P_EMF_OVER_RESISTANCE_F", 20},
      {"P_TORQUE_CONSTANT_F", 22},
      {"P_INERTIA_GAIN_F", 21},
      {"P_OBSERVER_A1_F", 27},
      {"P_EMF_CONSTANT_F", 22},
      {"P_OBSERVER_GAIN_F", 17},
      {"P_VOLTAGE_TO_CURRENT_F", 15},
      {"P_TORQUE_GAIN_F", 11},
      {"P_DEAD_VOLTAGE_SLOPE_F", 10},
      {"P_VOLTAGE_GAIN_F", 18},
      {"P_VOLTAGE_GAIN_HIGH_F", 18},
      {"P_DUTY_GAIN_F", 11},
      {"P_COMPRESSION_STIFFNESS_F", 26},
      {"P_TENSION_STIFFNESS_F", 26},
      {"P_DAMPER_DAMPING_F", 22},
      {"P_ATTRACT_CORE_SLOPE_F", 25},
      {"P_REPEL_CORE_SLOPE_F", 25},
      {"P_WALL_STIFFNESS_F", 20},
      {"P_WALL_DAMPING_F", 20},
  };
};

}  // namespace feltgate
