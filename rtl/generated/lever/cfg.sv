// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/designs/lever.toml and rtl/registers.toml by
// `feltgate generate`: do not edit. Formats [S,I,F], constants,
// words and structs of the design.

`default_nettype none

/* verilator lint_off UNUSEDPARAM */  // a block uses the constants that concern it
package cfg;
  // Of a signal: width (W) and fraction bits (F); of a coefficient (P): fraction bits.
  localparam int CLOCK_HZ = 50000000;  // Hz
  localparam int CLOCKS_PER_TICK = 50;  // clocks
  localparam int M1 = 767;  // ticks between the two positions of the velocity estimator
  localparam int VELOCITY_SHIFT = 1;  // raw velocity = 2^n * counts
  localparam int VELOCITY_GAIN = 0;  // mantissa of the gain that stands for 2^n; 0: none
  localparam int VELOCITY_GAIN_F = 17;  // its fraction bits
  localparam int INDEX_COUNTS = 4096;  // counts from index to index; 0: not checked
  localparam int PWM_PERIOD = 1000;  // clocks
  localparam int DEAD_CLOCKS = 25;  // clocks
  localparam int SHORTEST_CLOCKS = 10;  // clocks, of a pulse at a gate
  localparam logic [15:0] SCENE_MASK = 16'h03fd;  // bit n: scene n is built
  localparam logic [14:0] CONTROL_RESET = 15'h0000;  // control word after reset
  localparam int SCENE_GUARD_BITS = 2;  // bits that a scene's terms keep below a torque step
  localparam int REQUIRE_WATCHDOG = 0;  // 1: arming waits for the first kick
  localparam int EMF_IN_LAW = 1;  // 1: the voltage law gives back the back-EMF
  localparam int I2T_START = 1460000000;  // I2t sum after power-up: half the budget, for nobody knows how hot the motor is
  localparam int AXES = 1;  // motors with an encoder each
  localparam int ENGINE = 0;  // 1: programs give the torque of the scene law
  localparam int ENGINE_MAX_AGE = 0;  // ticks without a fresh torque that are borne
  localparam int MT_COUNTS = 0;  // velocity by M/T of an encoder with so many counts in a turn; 0: by the N-method
  localparam int MT_WINDOW = 0;  // clocks: of a shorter span twice the cycles
  localparam int MT_DOUBLINGS = 0;  // the span has at most 2^n cycles
  localparam int EDGE_UNIT_BITS = 6;  // bits of the ticks in which the time between edges is counted
  localparam int FAST_EDGES = 0;  // 1: at the fastest motion several counts come in a tick
  localparam int SELF_TEST_DROP = 0;  // the self-test takes 2^n counts for one
  localparam int CURRENT_LOOP = 0;  // 1: a measured current is controlled
  localparam int CURRENT_DROP = 0;  // fraction bits of the current reference below an LSB of the measured current
  localparam int CURRENT_PROPORTIONAL = 0;  // [0,4,13], supply per full scale
  localparam int CURRENT_INTEGRAL = 0;  // [0,0,17]
  localparam int CURRENT_RESISTANCE = 0;  // [0,4,13], supply per full scale
  localparam int CURRENT_MARGIN = 0;  // [0,0,17] of the supply: half of the largest current's
  localparam int CURRENT_OVERCURRENT = 0;  // [0,0,8] of full scale
  localparam int CURRENT_STROBE = 0;  // clock of the PWM period in which a window begins
  localparam int FEED_GAIN = 0;  // mantissa: parts of the supply per LSB of the voltage
  localparam int FEED_DROP = 0;  // its fraction bits
  localparam int DRIVER_FAULT = 0;  // 1: the driver tells of its faults
  localparam int HEARTBEAT = 0;  // ticks between changes of the pin for a watchdog outside, a power of two; 0: no pin
  localparam int ABSOLUTE_ENCODER = 0;  // 1: the position is of an absolute encoder
  localparam int ABSOLUTE_FRAMING = 0;  // 0 SPI with parity, 1 SSI with CRC-6
  localparam int ABSOLUTE_BITS = 0;  // of a turn
  localparam int ABSOLUTE_HALF_CLOCKS = 0;  // clocks: half a serial clock
  localparam int ABSOLUTE_GAP_CLOCKS = 0;  // clocks before the serial clock and between readings
  localparam int ABSOLUTE_PERIOD = 0;  // ticks from reading to reading
  localparam int ABSOLUTE_JUMP_STEP = 0;  // counts of the fastest motion in a reading
  localparam int ABSOLUTE_DIAGNOSIS = 0;  // SPI: address of the diagnosis
  localparam int HALL = 0;  // 1: Hall lines give the electrical angle at power-up
  localparam int PHASES = 2;  // legs of the bridge: 2 of one motor current, 3 of three
  localparam int ROUNDING = 0;  // where the chain rounds: 0 half up, 1 floor, 2 convergent
  localparam logic [31:0] DESIGN_CRC = 32'hf6bf6134;  // by which a host knows the design
  localparam int TICK_W = 6;  // bits of a clock's number in the tick
  localparam int FEED_W = 23;  // bits of the voltage that no current takes
  localparam int POSITION_W = 32;  // [1,31,0]
  localparam int POSITION_F = 0;
  localparam int SCENE_POSITION_W = 18;  // [1,17,0]
  localparam int SCENE_POSITION_F = 0;
  localparam int SCENE_OFFSET_W = 26;  // [1,17,8]
  localparam int SCENE_OFFSET_F = 8;
  localparam int SCENE_DISTANCE_W = 27;  // [1,18,8]
  localparam int SCENE_DISTANCE_F = 8;
  localparam int SCENE_PART_W = 29;  // [1,10,18]
  localparam int SCENE_PART_F = 18;
  localparam int SCENE_TORQUE_W = 29;  // [1,12,16]
  localparam int SCENE_TORQUE_F = 16;
  localparam int TRAVEL_DIFFERENCE_W = 16;  // [1,15,0]
  localparam int TRAVEL_DIFFERENCE_F = 0;
  localparam int VELOCITY_RAW_W = 16;  // [1,16,-1]
  localparam int VELOCITY_RAW_F = -1;
  localparam int VELOCITY_W = 32;  // [1,10,21]
  localparam int VELOCITY_F = 21;
  localparam int VELOCITY_DIFFERENCE_W = 33;  // [1,11,21]
  localparam int VELOCITY_DIFFERENCE_F = 21;
  localparam int INERTIA_TORQUE_W = 37;  // [1,6,30]
  localparam int INERTIA_TORQUE_F = 30;
  localparam int DRIVE_TORQUE_W = 31;  // [1,0,30]
  localparam int DRIVE_TORQUE_F = 30;
  localparam int OBSERVER_W = 38;  // [1,7,30]
  localparam int OBSERVER_F = 30;
  localparam int OBSERVER_DIFFERENCE_W = 35;  // [1,8,26]
  localparam int OBSERVER_DIFFERENCE_F = 26;
  localparam int OBSERVED_W = 39;  // [1,8,30]
  localparam int OBSERVED_F = 30;
  localparam int TORQUE_W = 21;  // [1,4,16]
  localparam int TORQUE_F = 16;
  localparam int RAMP_W = 29;  // [1,4,24]
  localparam int RAMP_F = 24;
  localparam int CURRENT_W = 22;  // [1,5,16]
  localparam int CURRENT_F = 16;
  localparam int CURRENT_PART_W = 27;  // [1,10,16]
  localparam int CURRENT_PART_F = 16;
  localparam int CURRENT_SUM_W = 28;  // [1,11,16]
  localparam int CURRENT_SUM_F = 16;
  localparam int VOLTAGE_W = 20;  // [1,5,14]
  localparam int VOLTAGE_F = 14;
  localparam int VOLTAGE_PART_W = 26;  // [1,11,14]
  localparam int VOLTAGE_PART_F = 14;
  localparam int VOLTAGE_SUM_W = 28;  // [1,13,14]
  localparam int VOLTAGE_SUM_F = 14;
  localparam int EMF_W = 20;  // [1,5,14]
  localparam int EMF_F = 14;
  localparam int APPLIED_W = 21;  // [1,6,14]
  localparam int APPLIED_F = 14;
  localparam int DUTY_W = 13;  // [1,12,0]
  localparam int DUTY_F = 0;
  localparam int DUTY_SUM_W = 14;  // [1,13,0]
  localparam int DUTY_SUM_F = 0;
  localparam int LIMITER_W = 22;  // [1,21,0]
  localparam int LIMITER_F = 0;
  localparam int WITH_ADDEND_W = 23;  // [1,22,0]
  localparam int WITH_ADDEND_F = 0;
  localparam int LIMITER_INPUT_W = 29;  // [1,28,0]
  localparam int LIMITER_INPUT_F = 0;
  localparam int CURRENT_ESTIMATE_PART_W = 16;  // [1,7,8]
  localparam int CURRENT_ESTIMATE_PART_F = 8;
  localparam int CURRENT_ESTIMATE_W = 17;  // [1,8,8]
  localparam int CURRENT_ESTIMATE_F = 8;
  localparam int CURRENT_SQUARED_W = 19;  // [0,17,2]
  localparam int CURRENT_SQUARED_F = 2;
  localparam int I2T_W = 32;  // [0,30,2]
  localparam int I2T_F = 2;
  localparam int CHARGE_W = 32;  // [0,16,16]
  localparam int CHARGE_F = 16;
  localparam int P_VELOCITY_A1_F = 27;
  localparam int P_INVERSE_RESISTANCE_F = 15;
  localparam int P_EMF_OVER_RESISTANCE_F = 20;
  localparam int P_TORQUE_CONSTANT_F = 22;
  localparam int P_INERTIA_GAIN_F = 21;
  localparam int P_OBSERVER_A1_F = 27;
  localparam int P_EMF_CONSTANT_F = 22;
  localparam int P_OBSERVER_GAIN_F = 17;
  localparam int P_VOLTAGE_TO_CURRENT_F = 15;
  localparam int P_TORQUE_GAIN_F = 11;
  localparam int P_DEAD_VOLTAGE_SLOPE_F = 10;
  localparam int P_VOLTAGE_GAIN_F = 18;
  localparam int P_VOLTAGE_GAIN_HIGH_F = 18;
  localparam int P_DUTY_GAIN_F = 11;
  localparam int P_COMPRESSION_STIFFNESS_F = 26;
  localparam int P_TENSION_STIFFNESS_F = 26;
  localparam int P_DAMPER_DAMPING_F = 22;
  localparam int P_ATTRACT_CORE_SLOPE_F = 25;
  localparam int P_REPEL_CORE_SLOPE_F = 25;
  localparam int P_WALL_STIFFNESS_F = 20;
  localparam int P_WALL_DAMPING_F = 20;

  // Parameter RAM after reset: the design's values, quantised.
  function automatic logic [31:0] parameter_reset(input logic [8:0] address);
    case (address)
      9'd4: parameter_reset = 32'd67092;  // velocity_a1
      9'd5: parameter_reset = 32'd78019;  // inverse_resistance
      9'd7: parameter_reset = 32'd75398;  // emf_over_resistance
      9'd8: parameter_reset = 32'd126668;  // torque_constant
      9'd9: parameter_reset = 32'd127926;  // inertia_gain
      9'd17: parameter_reset = 32'd133;  // nominal_current_squared
      9'd15: parameter_reset = 32'd67092;  // observer_a1
      9'd16: parameter_reset = 32'd1286812467;  // overspeed
      9'd18: parameter_reset = 32'd2920000000;  // i2t_budget
      9'd19: parameter_reset = 32'd12582912;  // polarity_speed
      9'd20: parameter_reset = 32'd393216;  // polarity_current
      9'd21: parameter_reset = 32'd4000;  // polarity_ticks
      9'd22: parameter_reset = 32'd126668;  // emf_constant
      9'd23: parameter_reset = 32'd0;  // observer_gain
      9'd31: parameter_reset = 32'd0;  // voltage_setpoint
      9'd32: parameter_reset = 32'd39;  // voltage_step
      9'd24: parameter_reset = 32'd32768;  // torque_limit
      9'd25: parameter_reset = 32'd84;  // ramp_step
      9'd27: parameter_reset = 32'd78019;  // voltage_to_current
      9'd28: parameter_reset = 32'd67815;  // torque_gain
      9'd29: parameter_reset = 32'd99840;  // dead_voltage_slope
      9'd30: parameter_reset = 32'd32768;  // region_torque
      9'd36: parameter_reset = 32'd16384;  // hold_torque
      9'd43: parameter_reset = 32'd4883;  // hold_time
      9'd56: parameter_reset = 32'd8192;  // hold_limit
      9'd33: parameter_reset = 32'd1087898;  // current_limit
      9'd34: parameter_reset = 32'd110100;  // voltage_gain
      9'd50: parameter_reset = 32'd110100;  // voltage_gain_high
      9'd35: parameter_reset = 32'd15974;  // dead_voltage
      9'd39: parameter_reset = 32'd132956;  // voltage_window
      9'd40: parameter_reset = 32'd85333;  // duty_gain
      9'd45: parameter_reset = 32'd965;  // duty_limit
      9'd46: parameter_reset = 32'd100000;  // watchdog_ticks
      9'd51: parameter_reset = 32'd3277;  // self_test_torque
      9'd37: parameter_reset = 32'd157;  // self_test_quiet
      9'd38: parameter_reset = 32'd39;  // self_test_pulse
      9'd41: parameter_reset = 32'd3;  // self_test_arms
      9'd74: parameter_reset = 32'd0;  // setpoint_torque
      9'd97: parameter_reset = 32'd83443;  // membrane_lower
      9'd98: parameter_reset = 32'd116820;  // membrane_upper
      9'd106: parameter_reset = 32'd32768;  // membrane_torque
      9'd129: parameter_reset = 32'd83443;  // compression_contact
      9'd130: parameter_reset = 32'd102944;  // compression_stiffness
      9'd161: parameter_reset = 32'd0;  // tension_rest
      9'd162: parameter_reset = 32'd51472;  // tension_stiffness
      9'd202: parameter_reset = 32'd125829;  // damper_damping
      9'd225: parameter_reset = 32'd0;  // attract_centre
      9'd226: parameter_reset = 32'd557019098;  // attract_strength
      9'd230: parameter_reset = 32'd130;  // attract_core
      9'd227: parameter_reset = 32'd128680;  // attract_core_slope
      9'd257: parameter_reset = 32'd0;  // repel_centre
      9'd258: parameter_reset = 32'd557019098;  // repel_strength
      9'd262: parameter_reset = 32'd130;  // repel_core
      9'd259: parameter_reset = 32'd128680;  // repel_core_slope
      9'd289: parameter_reset = 32'd83443;  // wall_contact
      9'd290: parameter_reset = 32'd6434;  // wall_stiffness
      9'd298: parameter_reset = 32'd5243;  // wall_damping
      default: parameter_reset = 32'd0;
    endcase
  endfunction

  // Whether a parameter has a sign, and the bits above its format.
  function automatic logic [32:0] parameter_above(input logic [8:0] address);
    case (address)
      9'd4: parameter_above = {1'd0, 32'hfffe0000};  // velocity_a1
      9'd5: parameter_above = {1'd0, 32'hfffe0000};  // inverse_resistance
      9'd7: parameter_above = {1'd0, 32'hfffe0000};  // emf_over_resistance
      9'd8: parameter_above = {1'd0, 32'hfffe0000};  // torque_constant
      9'd9: parameter_above = {1'd0, 32'hfffe0000};  // inertia_gain
      9'd17: parameter_above = {1'd0, 32'h80000000};  // nominal_current_squared
      9'd15: parameter_above = {1'd0, 32'hfffe0000};  // observer_a1
      9'd16: parameter_above = {1'd0, 32'h80000000};  // overspeed
      9'd19: parameter_above = {1'd0, 32'h80000000};  // polarity_speed
      9'd20: parameter_above = {1'd0, 32'hffe00000};  // polarity_current
      9'd21: parameter_above = {1'd0, 32'hffff0000};  // polarity_ticks
      9'd22: parameter_above = {1'd0, 32'hfffe0000};  // emf_constant
      9'd23: parameter_above = {1'd1, 32'hfffe0000};  // observer_gain
      9'd31: parameter_above = {1'd1, 32'hfff80000};  // voltage_setpoint
      9'd32: parameter_above = {1'd0, 32'hfff80000};  // voltage_step
      9'd24: parameter_above = {1'd0, 32'hfff00000};  // torque_limit
      9'd25: parameter_above = {1'd0, 32'hf0000000};  // ramp_step
      9'd27: parameter_above = {1'd0, 32'hfffe0000};  // voltage_to_current
      9'd28: parameter_above = {1'd0, 32'hfffe0000};  // torque_gain
      9'd29: parameter_above = {1'd0, 32'hfffe0000};  // dead_voltage_slope
      9'd30: parameter_above = {1'd0, 32'hfff00000};  // region_torque
      9'd36: parameter_above = {1'd0, 32'hfff00000};  // hold_torque
      9'd43: parameter_above = {1'd0, 32'hffffc000};  // hold_time
      9'd56: parameter_above = {1'd0, 32'hfff00000};  // hold_limit
      9'd33: parameter_above = {1'd0, 32'hffe00000};  // current_limit
      9'd34: parameter_above = {1'd0, 32'hfffe0000};  // voltage_gain
      9'd50: parameter_above = {1'd0, 32'hfffe0000};  // voltage_gain_high
      9'd35: parameter_above = {1'd0, 32'hfff80000};  // dead_voltage
      9'd39: parameter_above = {1'd0, 32'hfff80000};  // voltage_window
      9'd40: parameter_above = {1'd0, 32'hfffe0000};  // duty_gain
      9'd45: parameter_above = {1'd0, 32'hfffff000};  // duty_limit
      9'd46: parameter_above = {1'd0, 32'hff000000};  // watchdog_ticks
      9'd51: parameter_above = {1'd0, 32'hfff00000};  // self_test_torque
      9'd37: parameter_above = {1'd0, 32'hffffff00};  // self_test_quiet
      9'd38: parameter_above = {1'd0, 32'hffffff00};  // self_test_pulse
      9'd41: parameter_above = {1'd0, 32'hfffffffc};  // self_test_arms
      9'd74: parameter_above = {1'd1, 32'hfff00000};  // setpoint_torque
      9'd97: parameter_above = {1'd1, 32'hfe000000};  // membrane_lower
      9'd98: parameter_above = {1'd1, 32'hfe000000};  // membrane_upper
      9'd106: parameter_above = {1'd0, 32'hfff00000};  // membrane_torque
      9'd129: parameter_above = {1'd1, 32'hfe000000};  // compression_contact
      9'd130: parameter_above = {1'd0, 32'hfffe0000};  // compression_stiffness
      9'd161: parameter_above = {1'd1, 32'hfe000000};  // tension_rest
      9'd162: parameter_above = {1'd0, 32'hfffe0000};  // tension_stiffness
      9'd202: parameter_above = {1'd0, 32'hfffe0000};  // damper_damping
      9'd225: parameter_above = {1'd1, 32'hfe000000};  // attract_centre
      9'd230: parameter_above = {1'd0, 32'hfffc0000};  // attract_core
      9'd227: parameter_above = {1'd0, 32'hfffe0000};  // attract_core_slope
      9'd257: parameter_above = {1'd1, 32'hfe000000};  // repel_centre
      9'd262: parameter_above = {1'd0, 32'hfffc0000};  // repel_core
      9'd259: parameter_above = {1'd0, 32'hfffe0000};  // repel_core_slope
      9'd289: parameter_above = {1'd1, 32'hfe000000};  // wall_contact
      9'd290: parameter_above = {1'd0, 32'hfffe0000};  // wall_stiffness
      9'd298: parameter_above = {1'd0, 32'hfffe0000};  // wall_damping
      default: parameter_above = 33'd0;
    endcase
  endfunction

  // The words as the blocks take them. Of each register of params_t, from the first on: its
  // lowest bit, its bits, the address of its word.
  localparam int WORDS = 42;
  localparam logic [671:0] WORD_LOW = {16'd0, 16'd21, 16'd39, 16'd56, 16'd88, 16'd114, 16'd116, 16'd124, 16'd132, 16'd152, 16'd176, 16'd188, 16'd205, 16'd224, 16'd243, 16'd260, 16'd277, 16'd298, 16'd318, 16'd332, 16'd352, 16'd372, 16'd389, 16'd406, 16'd423, 16'd451, 16'd471, 16'd490, 16'd510, 16'd528, 16'd545, 16'd561, 16'd582, 16'd613, 16'd645, 16'd676, 16'd693, 16'd724, 16'd741, 16'd758, 16'd775, 16'd792};
  localparam logic [671:0] WORD_BITS = {16'd21, 16'd18, 16'd17, 16'd32, 16'd26, 16'd2, 16'd8, 16'd8, 16'd20, 16'd24, 16'd12, 16'd17, 16'd19, 16'd19, 16'd17, 16'd17, 16'd21, 16'd20, 16'd14, 16'd20, 16'd20, 16'd17, 16'd17, 16'd17, 16'd28, 16'd20, 16'd19, 16'd20, 16'd18, 16'd17, 16'd16, 16'd21, 16'd31, 16'd32, 16'd31, 16'd17, 16'd31, 16'd17, 16'd17, 16'd17, 16'd17, 16'd17};
  localparam logic [671:0] WORD_ADDRESS = {16'd490, 16'd486, 16'd483, 16'd482, 16'd481, 16'd41, 16'd38, 16'd37, 16'd51, 16'd46, 16'd45, 16'd40, 16'd39, 16'd35, 16'd50, 16'd34, 16'd33, 16'd56, 16'd43, 16'd36, 16'd30, 16'd29, 16'd28, 16'd27, 16'd25, 16'd24, 16'd32, 16'd31, 16'd23, 16'd22, 16'd21, 16'd20, 16'd19, 16'd18, 16'd16, 16'd15, 16'd17, 16'd9, 16'd8, 16'd7, 16'd5, 16'd4};
  localparam int PARAMS_W = 809;
  localparam logic [808:0] PARAMS_RESET = {17'd67092, 17'd78019, 17'd75398, 17'd126668, 17'd127926, 31'd133, 17'd67092, 31'd1286812467, 32'd2920000000, 31'd12582912, 21'd393216, 16'd4000, 17'd126668, 18'd0, 20'd0, 19'd39, 20'd32768, 28'd84, 17'd78019, 17'd67815, 17'd99840, 20'd32768, 20'd16384, 14'd4883, 20'd8192, 21'd1087898, 17'd110100, 17'd110100, 19'd15974, 19'd132956, 17'd85333, 12'd965, 24'd100000, 20'd3277, 8'd157, 8'd39, 2'd3, 26'd0, 32'd0, 17'd0, 18'd0, 21'd0};
  typedef struct packed {
    logic [16:0] velocity_a1;
    logic [16:0] inverse_resistance;
    logic [16:0] emf_over_resistance;
    logic [16:0] torque_constant;
    logic [16:0] inertia_gain;
    logic [30:0] nominal_current_squared;
    logic [16:0] observer_a1;
    logic [30:0] overspeed;
    logic [31:0] i2t_budget;
    logic [30:0] polarity_speed;
    logic [20:0] polarity_current;
    logic [15:0] polarity_ticks;
    logic [16:0] emf_constant;
    logic signed [17:0] observer_gain;
    logic signed [19:0] voltage_setpoint;
    logic [18:0] voltage_step;
    logic [19:0] torque_limit;
    logic [27:0] ramp_step;
    logic [16:0] voltage_to_current;
    logic [16:0] torque_gain;
    logic [16:0] dead_voltage_slope;
    logic [19:0] region_torque;
    logic [19:0] hold_torque;
    logic [13:0] hold_time;
    logic [19:0] hold_limit;
    logic [20:0] current_limit;
    logic [16:0] voltage_gain;
    logic [16:0] voltage_gain_high;
    logic [18:0] dead_voltage;
    logic [18:0] voltage_window;
    logic [16:0] duty_gain;
    logic [11:0] duty_limit;
    logic [23:0] watchdog_ticks;
    logic [19:0] self_test_torque;
    logic [7:0] self_test_quiet;
    logic [7:0] self_test_pulse;
    logic [1:0] self_test_arms;
    logic signed [25:0] scene_1;
    logic [31:0] scene_2;
    logic [16:0] scene_3;
    logic [17:0] scene_6;
    logic signed [20:0] scene_10;
  } params_t;

  // The tick, and the clocks in which its results are new.
  typedef struct packed {
    logic [5:0] clock;  // of the tick, from 0 on
    logic sample;  // the position is sampled
    logic velocity;  // is new, as the next four
    logic tau_hat;
    logic scene;  // its torque
    logic tau_ref;
    logic duty;
    logic last;  // the last clock of the tick
    logic [31:0] count;  // ticks since the reset
  } tick_t;

  // To the encoder's socket.
  typedef struct packed {
    logic sample;  // the position is sampled
    logic [31:0] tick_count;
    logic [3:0] filter;  // samples of the glitch filter
    logic polarity;  // the channels are swapped
    logic set_zero;  // the position becomes 0
    logic clear;  // the errors are forgotten
    logic gates_enable;
  } encoder_t;

  // From the encoder's socket.
  typedef struct packed {
    logic signed [31:0] position;  // counts since the zero
    logic signed [31:0] count;  // counts, which no zero changes
    logic signed [15:0] travel;  // low bits of the counts since the reset
    logic moved;  // an edge came since the tick before
    logic chatters;  // the torque must not grow
    logic illegal;  // both channels changed in one clock
    logic error;  // that was seen since the last clear
    logic [15:0] error_count;
    logic [15:0] rejected_count;  // pulses that the filter took away
    logic signed [31:0] index_position;  // counts, at the last index
    logic polarity_holds;  // the channels cannot be swapped now
    logic trip_channel;  // a channel is dead
    logic trip_index;  // an index came at a wrong count
    logic trip_flip;  // a bit has changed by itself
    logic [5:0] why;  // faults.absolute
  } position_t;

  // To the bridge's socket.
  typedef struct packed {
    logic gates_enable;
    logic gates_clear;  // asynchronous: every gate off at once
    logic clear;  // faults and errors are forgotten
    logic pwm_mode;  // locked antiphase
    logic polarity;  // the motor's leads are swapped
    logic direct;  // direct voltage: no current is controlled
    logic sample;  // the position is sampled
    logic valid;  // the duty is new, with current and feed
    logic signed [21:0] current;  // A, asked for
    logic signed [22:0] feed;  // V, of the back-EMF and the dead time
    logic signed [12:0] duty;  // clocks
  } drive_t;

  // From the bridge's socket.
  typedef struct packed {
    logic measured;  // there is a measured current
    logic period_start;  // a PWM period begins
    logic signed [12:0] duty_active;  // of this period
    logic signed [21:0] current;  // A, measured
    logic [6:0] why;  // faults.current, status.driver_fault, status.current_missing
  } bridge_t;

  // Of the panel: a rising arm requests to arm.
  typedef struct packed {
    logic arm;
    logic stop;
    logic set_zero;
    logic [3:0] scene;
  } panel_t;

  // The program of the scene law.
  typedef struct packed {
    logic signed [20:0] torque;  // Nm
    logic late;  // no fresh torque within its time
    logic restart;  // with the last clock of a tick: the torque ramps
  } law_t;

  // The other axes.
  typedef struct packed {
    logic fault;  // one has a fault
    logic silent;  // one does not request to arm: a request waits
    logic blocked;  // one is not ready: a request is refused
    logic testing;  // one runs its self-test
    logic waits;  // one of a lower number tests first
  } peers_t;

  // Of host and panel.
  typedef struct packed {
    logic host;  // 1: the host has control, 0: the panel
    logic host_arm;  // the host's request, a level
    logic panel_arm;  // the panel's
    logic disarm;  // requests do not count in this tick
    logic stop;  // of the panel
    logic host_stop;
    logic clear_faults;
    logic kick;  // of the watchdog
    logic [1:0] mode;
  } commands_t;

  // State of the safety.
  typedef struct packed {
    logic armed;
    logic locks;  // with the last clock of a tick: armed from the next clock on, unless a cause comes
    logic gates_enable;  // falls at once at a fault
    logic gates_clear;  // asynchronous: every gate off at once
    logic clear;  // faults and errors are forgotten
    logic arm_request;  // counts, and no sensor starts
    logic ready;  // this axis can be armed
    logic unkicked;  // arming waits for the watchdog's first kick
    logic derated;  // hold_limit limits the torque
    logic testing;  // the self-test runs
    logic signed [28:0] test_torque;  // Nm, of the self-test
    logic [1:0] test_result;  // status.self_test
    logic [15:0] faults;  // by number of the cause
    logic [4:0] first_fault;  // number of the cause, 0: none
    logic signed [16:0] current_estimate;  // A
  } safety_t;

  // What the host reads of a tick.
  typedef struct packed {
    logic [31:0] tick;
    logic signed [31:0] position;  // counts
    logic [31:0] status;
    logic [31:0] faults;
    logic [31:0] encoder;  // rejected and illegal counts
    logic signed [31:0] index;  // counts
    logic [3:0] scene;
    logic [11:0] limits;
    logic signed [31:0] velocity;  // rad/s
    logic signed [20:0] tau_hat;  // Nm
    logic signed [20:0] tau_ref;  // Nm
    logic signed [21:0] current;  // A
    logic signed [19:0] voltage;  // V
    logic signed [12:0] duty;  // clocks
  } snapshot_t;

  // A word of the snapshot on its way into memory.
  typedef struct packed {
    logic valid;
    logic [5:0] place;  // map::S_...
    logic [31:0] data;
  } word_t;

  // The control word.
  typedef struct packed {
    logic [3:0] filter;  // encoder glitch filter in samples, 0 is off
    logic pwm_mode;  // 0 sign-magnitude, 1 locked antiphase
    logic encoder_polarity;  // 1: the encoder's channels are swapped; of an absolute encoder it also holds from the first reading on
    logic motor_polarity;  // 1: the motor's leads are swapped
    logic [1:0] mode;  // 0 closed loop, 1 open loop, 2 direct voltage; this and what follows hold while armed
    logic [3:0] scene;  // scene number (when host is 1)
    logic arm;  // request to arm (when host is 1)
    logic host;  // 1: arm and scene come from this word, 0: from the pins
  } control_t;
endpackage
/* verilator lint_on UNUSEDPARAM */

`default_nettype wire
