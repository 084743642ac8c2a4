// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/registers.toml by
// `feltgate generate`: do not edit. Addresses, bits, numbers of all designs.

`default_nettype none

/* verilator lint_off UNUSEDPARAM */  // a block uses the constants that concern it
package map;
  // While armed: words of all scenes that are refused or ramp, by address; scenes whose words act at once.
  localparam logic [63:0] REFUSED_WHILE_ARMED = 64'h000c23ef78c083b0;
  localparam logic [63:0] RAMPS_WHILE_ARMED = 64'h0100000001000000;
  localparam logic [15:0] INPUT_SCENES = 16'h0004;
  localparam int MODE_OPEN = 1;  // control.mode: open loop
  localparam int MODE_VOLTAGE = 2;  // control.mode: direct voltage
  localparam int ERRORS_BORNE = 7;  // encoder errors that are borne, less one every 2^forgive_bits ticks
  localparam int FORGIVE_BITS = 10;  // bits of the ticks after which one encoder error is forgiven
  localparam int RUNAWAY_BITS = 16;  // bits of the longest window of the wrong-polarity check [tick]
  localparam int RUNAWAY_WINDOWS = 2;  // windows on end in which the speed must grow against the commanded current
  localparam int GROWTH_BITS = 5;  // fraction bits of the velocity whose growth is watched
  localparam int SELF_TEST_UNIT_BITS = 7;  // bits of the ticks in a unit of the self-test's times
  localparam int SELF_TEST_COUNT_BITS = 8;  // bits of these times
  localparam int SELF_TEST_PATIENCE_BITS = 17;  // bits of the ticks of which the second multiple ends the self-test's wait
  localparam int SELF_TEST_COUNTS = 2;  // counts that are an answer to the self-test
  localparam int SELF_TEST_RIGHT = 1;  // what status.self_test says: the lever answered the right way
  localparam int SELF_TEST_HELD = 2;  // it did not answer
  localparam int SELF_TEST_MOVING = 3;  // it was not still for long enough to be asked
  localparam int SELF_TEST_HELD_BIT = 0;  // of self_test_arms: the scene begins though the lever is held
  localparam int SELF_TEST_MOVING_BIT = 1;  // of self_test_arms: the scene begins though the lever moves
  localparam int KICKLESS_BITS = 24;  // bits of the longest time without a kick [tick]
  localparam int ARM_WAIT_MS = 20;  // for so long a request to arm may wait until the gates open [ms]; then it is refused
  localparam int ABSOLUTE_JUMP_BIT = 3;  // of faults.absolute: the angle has jumped
  localparam int ONE_CHANNEL_EDGES = 16;  // edges of one channel in a row from which it is chatter or a dead channel
  localparam int DEAD_CHANNEL_EDGES = 24;  // as many are a dead channel
  localparam int EDGE_UNITS = 19;  // so many times 2^EDGE_UNIT_BITS ticks (of the design) without an edge end the row
  localparam int CHATTER_UNITS = 20;  // chatter for so many times 4 * 2^EDGE_UNIT_BITS ticks is a dead channel
  localparam int INDEX_WIDTH_BITS = 3;  // an index may be less than 2^index_width_bits counts wide
  localparam int HOLD_UNIT_BITS = 10;  // bits of the ticks in which hold_time is counted
  localparam int HOLD_BITS = 13;  // bits of the longest hold_time

  // Places of the snapshot's words, from A_SNAPSHOT on.
  localparam logic [5:0] S_TICK = 6'd6;
  localparam logic [5:0] S_POSITION = 6'd1;
  localparam logic [5:0] S_STATUS = 6'd0;
  localparam logic [5:0] S_FAULTS = 6'd26;
  localparam logic [5:0] S_ENCODER = 6'd14;
  localparam logic [5:0] S_INDEX = 6'd11;
  localparam logic [5:0] S_VELOCITY = 6'd9;
  localparam logic [5:0] S_TAU_HAT = 6'd23;
  localparam logic [5:0] S_TAU_REF = 6'd28;
  localparam logic [5:0] S_CURRENT_REF = 6'd34;
  localparam logic [5:0] S_VOLTAGE = 6'd40;
  localparam logic [5:0] S_DUTY = 6'd46;

  // Addresses of the parameters.
  localparam logic [11:0] A_VELOCITY_A1 = 12'h004;
  localparam logic [11:0] A_INVERSE_RESISTANCE = 12'h005;
  localparam logic [11:0] A_EMF_OVER_RESISTANCE = 12'h007;
  localparam logic [11:0] A_TORQUE_CONSTANT = 12'h008;
  localparam logic [11:0] A_INERTIA_GAIN = 12'h009;
  localparam logic [11:0] A_NOMINAL_CURRENT_SQUARED = 12'h011;
  localparam logic [11:0] A_OBSERVER_A1 = 12'h00f;
  localparam logic [11:0] A_OVERSPEED = 12'h010;
  localparam logic [11:0] A_I2T_BUDGET = 12'h012;
  localparam logic [11:0] A_POLARITY_SPEED = 12'h013;
  localparam logic [11:0] A_POLARITY_CURRENT = 12'h014;
  localparam logic [11:0] A_POLARITY_TICKS = 12'h015;
  localparam logic [11:0] A_EMF_CONSTANT = 12'h016;
  localparam logic [11:0] A_OBSERVER_GAIN = 12'h017;
  localparam logic [11:0] A_VOLTAGE_SETPOINT = 12'h01f;
  localparam logic [11:0] A_VOLTAGE_STEP = 12'h020;
  localparam logic [11:0] A_TORQUE_LIMIT = 12'h018;
  localparam logic [11:0] A_RAMP_STEP = 12'h019;
  localparam logic [11:0] A_VOLTAGE_TO_CURRENT = 12'h01b;
  localparam logic [11:0] A_TORQUE_GAIN = 12'h01c;
  localparam logic [11:0] A_DEAD_VOLTAGE_SLOPE = 12'h01d;
  localparam logic [11:0] A_REGION_TORQUE = 12'h01e;
  localparam logic [11:0] A_HOLD_TORQUE = 12'h024;
  localparam logic [11:0] A_HOLD_TIME = 12'h02b;
  localparam logic [11:0] A_HOLD_LIMIT = 12'h038;
  localparam logic [11:0] A_CURRENT_LIMIT = 12'h021;
  localparam logic [11:0] A_VOLTAGE_GAIN = 12'h022;
  localparam logic [11:0] A_VOLTAGE_GAIN_HIGH = 12'h032;
  localparam logic [11:0] A_DEAD_VOLTAGE = 12'h023;
  localparam logic [11:0] A_VOLTAGE_WINDOW = 12'h027;
  localparam logic [11:0] A_DUTY_GAIN = 12'h028;
  localparam logic [11:0] A_DUTY_LIMIT = 12'h02d;
  localparam logic [11:0] A_WATCHDOG_TICKS = 12'h02e;
  localparam logic [11:0] A_SELF_TEST_TORQUE = 12'h033;
  localparam logic [11:0] A_SELF_TEST_QUIET = 12'h025;
  localparam logic [11:0] A_SELF_TEST_PULSE = 12'h026;
  localparam logic [11:0] A_SELF_TEST_ARMS = 12'h029;
  localparam logic [11:0] A_COMMUTATION_GAIN = 12'h01a;
  localparam logic [11:0] A_COMMUTATION_OFFSET = 12'h00d;
  localparam logic [11:0] A_SETPOINT_TORQUE = 12'h04a;
  localparam logic [11:0] A_MEMBRANE_LOWER = 12'h061;
  localparam logic [11:0] A_MEMBRANE_UPPER = 12'h062;
  localparam logic [11:0] A_MEMBRANE_TORQUE = 12'h06a;
  localparam logic [11:0] A_COMPRESSION_CONTACT = 12'h081;
  localparam logic [11:0] A_COMPRESSION_STIFFNESS = 12'h082;
  localparam logic [11:0] A_TENSION_REST = 12'h0a1;
  localparam logic [11:0] A_TENSION_STIFFNESS = 12'h0a2;
  localparam logic [11:0] A_DAMPER_DAMPING = 12'h0ca;
  localparam logic [11:0] A_ATTRACT_CENTRE = 12'h0e1;
  localparam logic [11:0] A_ATTRACT_STRENGTH = 12'h0e2;
  localparam logic [11:0] A_ATTRACT_CORE = 12'h0e6;
  localparam logic [11:0] A_ATTRACT_CORE_SLOPE = 12'h0e3;
  localparam logic [11:0] A_REPEL_CENTRE = 12'h101;
  localparam logic [11:0] A_REPEL_STRENGTH = 12'h102;
  localparam logic [11:0] A_REPEL_CORE = 12'h106;
  localparam logic [11:0] A_REPEL_CORE_SLOPE = 12'h103;
  localparam logic [11:0] A_WALL_CONTACT = 12'h121;
  localparam logic [11:0] A_WALL_STIFFNESS = 12'h122;
  localparam logic [11:0] A_WALL_DAMPING = 12'h12a;

  // Scene numbers.
  localparam logic [3:0] SCENE_FREE = 4'd0;
  localparam logic [3:0] SCENE_SETPOINT = 4'd2;
  localparam logic [3:0] SCENE_MEMBRANE = 4'd3;
  localparam logic [3:0] SCENE_SPRING_COMPRESSION = 4'd4;
  localparam logic [3:0] SCENE_SPRING_TENSION = 4'd5;
  localparam logic [3:0] SCENE_DAMPER = 4'd6;
  localparam logic [3:0] SCENE_CHARGE_ATTRACT = 4'd7;
  localparam logic [3:0] SCENE_CHARGE_REPEL = 4'd8;
  localparam logic [3:0] SCENE_WALL = 4'd9;
  localparam logic [3:0] SCENE_LAW = 4'd10;

  // Addresses of the control words and of the snapshot's first; bits (B) and widths (W) of the
  // words' fields.
  localparam logic [11:0] A_SNAPSHOT = 12'h300;
  localparam logic [11:0] A_CONTROL = 12'h200;
  localparam int W_CONTROL = 15;
  localparam int B_CONTROL_HOST = 0;
  localparam int B_CONTROL_ARM = 1;
  localparam int B_CONTROL_SCENE = 2;
  localparam int W_CONTROL_SCENE = 4;
  localparam int B_CONTROL_MODE = 6;
  localparam int W_CONTROL_MODE = 2;
  localparam int B_CONTROL_MOTOR_POLARITY = 8;
  localparam int B_CONTROL_ENCODER_POLARITY = 9;
  localparam int B_CONTROL_PWM_MODE = 10;
  localparam int B_CONTROL_FILTER = 11;
  localparam int W_CONTROL_FILTER = 4;
  localparam logic [11:0] A_COMMAND = 12'h201;
  localparam int W_COMMAND = 6;
  localparam int B_COMMAND_SET_ZERO = 0;
  localparam int B_COMMAND_CLEAR_FAULTS = 1;
  localparam int B_COMMAND_KICK = 2;
  localparam int B_COMMAND_FREEZE = 3;
  localparam int B_COMMAND_THAW = 4;
  localparam int B_COMMAND_STOP = 5;
  localparam int B_STATUS_LIMITS = 0;
  localparam int W_STATUS_LIMITS = 12;
  localparam int B_STATUS_SCENE = 20;
  localparam int W_STATUS_SCENE = 4;
  localparam int B_STATUS_ARMED = 24;
  localparam int B_STATUS_MODE = 25;
  localparam int W_STATUS_MODE = 2;
  localparam int B_STATUS_ENCODER_ERROR = 27;
  localparam int B_STATUS_REFUSED = 28;
  localparam int B_STATUS_UNKICKED = 29;
  localparam int B_STATUS_SELF_TEST = 16;
  localparam int W_STATUS_SELF_TEST = 2;
  localparam int B_STATUS_TESTING = 18;
  localparam int B_STATUS_DRIVER_FAULT = 19;
  localparam int B_STATUS_SATURATED = 31;
  localparam int B_STATUS_CURRENT_MISSING = 30;
  localparam int B_FAULTS_SEEN = 0;
  localparam int W_FAULTS_SEEN = 16;
  localparam int B_FAULTS_FIRST = 16;
  localparam int W_FAULTS_FIRST = 5;
  localparam int B_FAULTS_CURRENT = 21;
  localparam int W_FAULTS_CURRENT = 5;
  localparam int B_FAULTS_ABSOLUTE = 26;
  localparam int W_FAULTS_ABSOLUTE = 6;

  // Bits of the limits.
  localparam int L_TORQUE = 0;  // torque reference at its limit
  localparam int L_RAMP = 1;  // ramping: after arming, a change of scene, or what could have made the torque jump
  localparam int L_CURRENT = 2;  // current reference at its limit
  localparam int L_VOLTAGE = 3;  // voltage at the end of the window around the back-EMF; without a current loop tau_hat is void, for the motor gives less than it counts on
  localparam int L_DUTY = 4;  // duty at its limit; without a current loop tau_hat is void, as above
  localparam int L_VELOCITY = 5;  // the raw velocity saturated its format
  localparam int L_TAU_HAT = 6;  // tau_hat saturated its format
  localparam int L_GATES_CLOSED = 7;  // the gates are off
  localparam int L_HOLD = 8;  // a torque was held for too long: the limit is hold_limit, or torque_limit if that is less
  localparam int L_CHATTER = 9;  // the count alternates on one edge: the torque reference does not grow

  // Causes of fault: numbers of the first fault, and bits of the faults.
  localparam int FAULT_NONE = 0;
  localparam int FAULT_ENCODER = 1;  // too many illegal transitions; of an absolute encoder or Hall lines what faults.absolute says
  localparam int FAULT_SPEED = 2;  // |w| above the limit
  localparam int FAULT_POLARITY = 3;  // the speed grows against the commanded current
  localparam int FAULT_I2T = 4;  // estimated current above nominal for too long
  localparam int FAULT_WATCHDOG = 5;  // the host is silent
  localparam int FAULT_STOP = 6;  // external stop
  localparam int FAULT_SELF_TEST = 7;  // the lever answered the pulse of the self-test the wrong way, or was held or moved where the design does not arm then
  localparam int FAULT_CHANNEL = 8;  // one channel of the encoder is dead
  localparam int FAULT_TICK = 9;  // the ticks stand still
  localparam int FAULT_INDEX = 10;  // the count at the index does not fit a revolution
  localparam int FAULT_WORD = 11;  // a parameter, a held control bit or the position has changed by itself
  localparam int FAULT_JUMP = 12;  // the velocity moved by more than its filter can
  localparam int FAULT_ENGINE = 13;  // the engine is late: no fresh torque within its time, in the scene law
  localparam int FAULT_AXIS = 14;  // another axis has a fault
  localparam int FAULT_CURRENT = 15;  // of a current loop: over-current, the driver's own fault, or the sensor fails; faults.current, status.driver_fault and status.current_missing say which
endpackage
/* verilator lint_on UNUSEDPARAM */

`default_nettype wire
