// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/registers.toml and rtl/schedule.toml by
// `feltgate generate`: do not edit. Clocks, slots, addresses, bits, numbers of all designs.

`default_nettype none

/* verilator lint_off UNUSEDPARAM */  // a block uses the constants that concern it
package feltgate_map_pkg;
  localparam int WAVE_LENGTH = 50;  // clocks; a tick is at least as long
  localparam int FIRST_WAVE_CLOCK = 2;  // clock of the tick that is wave clock 0
  localparam int MULTIPLIER_LATENCY = 4;  // clocks from the operands to the product
  localparam logic [63:0] SCENE_SLOTS = 64'h000000000000044e;  // bit n: slot n is read from the scene's bank
  // While armed: words of all scenes that are refused or ramp, by address; scenes whose words act at once.
  localparam logic [63:0] REFUSED_WHILE_ARMED = 64'h0004218e78c083b0;
  localparam logic [63:0] RAMPS_WHILE_ARMED = 64'h0100000001000000;
  localparam logic [15:0] INPUT_SCENES = 16'h0004;
  localparam int ERRORS_BORNE = 7;  // encoder errors that are borne, less one every 2^forgive_bits ticks
  localparam int FORGIVE_BITS = 10;  // bits of the ticks after which one encoder error is forgiven
  localparam int RUNAWAY_BITS = 16;  // bits of the longest window of the wrong-polarity check [tick]
  localparam int RUNAWAY_WINDOWS = 2;  // windows on end in which the speed must grow against the commanded current
  localparam int GROWTH_BITS = 5;  // fraction bits of the velocity whose growth is watched
  localparam int KICKLESS_BITS = 24;  // bits of the longest time without a kick [tick]
  localparam int ONE_CHANNEL_EDGES = 16;  // edges of one channel in a row from which it is chatter or a dead channel
  localparam int DEAD_CHANNEL_EDGES = 24;  // as many are a dead channel
  localparam int EDGE_UNIT_BITS = 6;  // bits of the ticks in which the time between edges is counted
  localparam int EDGE_UNITS = 19;  // so many of them without an edge end the row
  localparam int CHATTER_UNIT_BITS = 8;  // bits of the ticks in which the time of chatter is counted
  localparam int CHATTER_UNITS = 20;  // chatter for so many of them is a dead channel
  localparam int INDEX_WIDTH_BITS = 3;  // an index may be less than 2^index_width_bits counts wide
  localparam int HOLD_UNIT_BITS = 10;  // bits of the ticks in which hold_time is counted
  localparam int HOLD_BITS = 13;  // bits of the longest hold_time

  // Wave clocks in which a word, or a square, is on its bus.
  localparam int S_VELOCITY_A1 = 4;
  localparam int S_INVERSE_RESISTANCE = 5;
  localparam int S_EMF_OVER_RESISTANCE = 7;
  localparam int S_TORQUE_CONSTANT = 8;
  localparam int S_INERTIA_GAIN = 9;
  localparam int S_NOMINAL_CURRENT_SQUARED = 17;
  localparam int S_OBSERVER_A1 = 15;
  localparam int S_OVERSPEED = 16;
  localparam int S_I2T_BUDGET = 18;
  localparam int S_POLARITY_SPEED = 19;
  localparam int S_POLARITY_CURRENT = 20;
  localparam int S_POLARITY_TICKS = 21;
  localparam int S_EMF_CONSTANT = 22;
  localparam int S_OBSERVER_GAIN = 23;
  localparam int S_VOLTAGE_SETPOINT = 13;
  localparam int S_TORQUE_LIMIT = 24;
  localparam int S_RAMP_STEP = 25;
  localparam int S_VOLTAGE_TO_CURRENT = 27;
  localparam int S_TORQUE_GAIN = 28;
  localparam int S_DEAD_VOLTAGE_SLOPE = 29;
  localparam int S_REGION_TORQUE = 30;
  localparam int S_HOLD_TORQUE = 31;
  localparam int S_HOLD_TIME = 36;
  localparam int S_HOLD_LIMIT = 56;
  localparam int S_CURRENT_LIMIT = 33;
  localparam int S_VOLTAGE_GAIN = 34;
  localparam int S_VOLTAGE_GAIN_HIGH = 50;
  localparam int S_DEAD_VOLTAGE = 35;
  localparam int S_VOLTAGE_LIMIT = 39;
  localparam int S_DUTY_GAIN = 40;
  localparam int S_DUTY_LIMIT = 45;
  localparam int S_WATCHDOG_TICKS = 46;
  localparam int S_SETPOINT_TORQUE = 10;
  localparam int S_MEMBRANE_LOWER = 1;
  localparam int S_MEMBRANE_UPPER = 2;
  localparam int S_MEMBRANE_TORQUE = 10;
  localparam int S_COMPRESSION_CONTACT = 1;
  localparam int S_COMPRESSION_STIFFNESS = 2;
  localparam int S_TENSION_REST = 1;
  localparam int S_TENSION_STIFFNESS = 2;
  localparam int S_DAMPER_DAMPING = 10;
  localparam int S_ATTRACT_CENTRE = 1;
  localparam int S_ATTRACT_STRENGTH = 2;
  localparam int S_ATTRACT_CORE = 6;
  localparam int S_ATTRACT_CORE_SLOPE = 3;
  localparam int S_REPEL_CENTRE = 1;
  localparam int S_REPEL_STRENGTH = 2;
  localparam int S_REPEL_CORE = 6;
  localparam int S_REPEL_CORE_SLOPE = 3;
  localparam int S_WALL_CONTACT = 1;
  localparam int S_WALL_STIFFNESS = 2;
  localparam int S_WALL_DAMPING = 10;
  localparam int S_SCENE_STIFFNESS = 2;
  localparam int S_CHARGE_SQUARE = 2;
  localparam int S_CHARGE_SLOPE = 3;
  localparam int S_SCENE_DAMPING = 10;
  localparam int S_CURRENT_SQUARE = 13;

  // Wave clocks in which a product is on the product bus.
  localparam int M_VELOCITY_A1 = 8;
  localparam int M_INVERSE_RESISTANCE = 9;
  localparam int M_EMF_OVER_RESISTANCE = 11;
  localparam int M_TORQUE_CONSTANT = 12;
  localparam int M_INERTIA_GAIN = 13;
  localparam int M_OBSERVER_A1 = 19;
  localparam int M_EMF_CONSTANT = 26;
  localparam int M_OBSERVER_GAIN = 27;
  localparam int M_VOLTAGE_TO_CURRENT = 31;
  localparam int M_TORQUE_GAIN = 32;
  localparam int M_DEAD_VOLTAGE_SLOPE = 33;
  localparam int M_VOLTAGE_GAIN = 38;
  localparam int M_DUTY_GAIN = 44;
  localparam int M_COMPRESSION_STIFFNESS = 6;
  localparam int M_TENSION_STIFFNESS = 6;
  localparam int M_DAMPER_DAMPING = 14;
  localparam int M_ATTRACT_CORE_SLOPE = 7;
  localparam int M_REPEL_CORE_SLOPE = 7;
  localparam int M_WALL_STIFFNESS = 6;
  localparam int M_WALL_DAMPING = 14;
  localparam int M_SCENE_STIFFNESS = 6;
  localparam int M_CHARGE_SQUARE = 6;
  localparam int M_CHARGE_SLOPE = 7;
  localparam int M_SCENE_DAMPING = 14;
  localparam int M_CURRENT_SQUARE = 17;

  // Wave clocks of the steps; what a step gives is there a clock later.
  localparam int T_SAMPLE = 0;
  localparam int T_TRAVEL = 1;
  localparam int T_VELOCITY_RAW = 2;
  localparam int T_VELOCITY_DIFFERENCE = 3;
  localparam int T_VELOCITY = 8;
  localparam int T_JUMP = 9;
  localparam int T_DRIVE_TORQUE = 12;
  localparam int T_OBSERVER_INPUT = 13;
  localparam int T_OBSERVER_DIFFERENCE = 14;
  localparam int T_OBSERVER_STATE = 19;
  localparam int T_OBSERVED = 20;
  localparam int T_OBSERVED_ROUNDED = 21;
  localparam int T_TAU_HAT = 22;
  localparam int T_SCENE_DISTANCE = 1;
  localparam int T_SCENE_GAP = 1;
  localparam int T_MEMBRANE_LOWER = 1;
  localparam int T_MEMBRANE_UPPER = 2;
  localparam int T_CHARGE_STRENGTH = 2;
  localparam int T_CHARGE_DIVIDE = 6;
  localparam int T_SPRING_PART = 6;
  localparam int T_CHARGE_PART = 7;
  localparam int T_DAMPER_PART = 14;
  localparam int T_SETPOINT_PART = 10;
  localparam int T_MEMBRANE_SIDE = 3;
  localparam int T_MEMBRANE_TORQUE = 10;
  localparam int T_CHARGE_WIDTH = 4;
  localparam int T_CHARGE_WIDTH_AHEAD = 5;
  localparam int T_CHARGE_QUOTIENT = 8;
  localparam int T_CHARGE_WIDTH_LIMITED = 6;
  localparam int T_CHARGE_CORE = 7;
  localparam int T_CHARGE_CHOSEN = 8;
  localparam int T_SCENE_SUM = 15;
  localparam int T_SCENE_ROUNDED = 22;
  localparam int T_SCENE_AHEAD = 23;
  localparam int T_SCENE_TORQUE = 23;
  localparam int T_TORQUE_LIMITED = 24;
  localparam int T_RAMP_BEGIN = 1;
  localparam int T_RAMP_EXCESS = 25;
  localparam int T_RAMP_CHANGE = 26;
  localparam int T_TAU_REF = 27;
  localparam int T_DIRECT_VOLTAGE = 13;
  localparam int T_SETPOINT_TO_BUS = 26;
  localparam int T_VOLTAGE_TO_BUS = 4;
  localparam int T_CURRENT_TO_BUS = 7;
  localparam int T_VOLTAGE_PART = 26;
  localparam int T_CURRENT_PART = 27;
  localparam int T_BORDER = 28;
  localparam int T_BORDER_AHEAD = 29;
  localparam int T_REGION_LIMITED = 30;
  localparam int T_REGION = 31;
  localparam int T_GAIN_FETCH = 32;
  localparam int T_DIRECT_CURRENT = 31;
  localparam int T_DIRECT_AHEAD = 32;
  localparam int T_CURRENT_SUM = 32;
  localparam int T_CURRENT_LIMITED = 33;
  localparam int T_CURRENT = 34;
  localparam int T_DEAD_SUM = 33;
  localparam int T_DEAD_AHEAD = 34;
  localparam int T_DEAD_VOLTAGE = 35;
  localparam int T_VOLTAGE_OFFSET = 36;
  localparam int T_SET_SUM = 37;
  localparam int T_SET_AHEAD = 38;
  localparam int T_VOLTAGE_SUM = 38;
  localparam int T_VOLTAGE_LIMITED = 39;
  localparam int T_VOLTAGE = 40;
  localparam int T_DUTY_SUM = 44;
  localparam int T_DUTY_LIMITED = 45;
  localparam int T_DUTY = 46;
  localparam int T_ESTIMATE_PART = 9;
  localparam int T_CURRENT_ESTIMATE = 11;
  localparam int T_ESTIMATE_TO_BUS = 12;
  localparam int T_SPEED_SIZE = 15;
  localparam int T_TOO_FAST = 16;
  localparam int T_SPEED = 17;
  localparam int T_COOLED = 17;
  localparam int T_COOLED_AT_LEAST_0 = 18;
  localparam int T_CURRENT_SQUARED = 17;
  localparam int T_TOO_HOT = 18;
  localparam int T_HEAT = 19;
  localparam int T_GROWTH_SIZE = 18;
  localparam int T_GROWTH = 19;
  localparam int T_STRONG_SIZE = 19;
  localparam int T_STRONG = 20;
  localparam int T_RUNAWAY_TICKS = 21;
  localparam int T_POLARITY = 22;
  localparam int T_SILENT = 46;
  localparam int T_WATCHDOG = 47;
  localparam int T_LEVELS = 0;
  localparam int T_CHANNEL = 1;
  localparam int T_HOLD_SIZE = 29;
  localparam int T_HOLD_AHEAD = 30;
  localparam int T_HOLD_LIMITED = 31;
  localparam int T_HOLD_STRONG = 32;
  localparam int T_HOLD = 36;
  localparam int T_POSITION_WORD = 1;
  localparam int T_STATUS_WORD = 0;
  localparam int T_DUTY_WORD = 46;
  localparam int T_SNAPSHOT = 47;

  // Wave clocks in which the snapshot's words are on the operand bus.
  localparam int R_TICK = 6;
  localparam int R_POSITION = 1;
  localparam int R_STATUS = 0;
  localparam int R_FAULTS = 26;
  localparam int R_ENCODER = 14;
  localparam int R_INDEX = 11;
  localparam int R_VELOCITY = 9;
  localparam int R_TAU_HAT = 23;
  localparam int R_TAU_REF = 28;
  localparam int R_CURRENT_REF = 34;
  localparam int R_VOLTAGE = 40;
  localparam int R_DUTY = 46;

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
  localparam int B_FAULTS_SEEN = 0;
  localparam int W_FAULTS_SEEN = 16;
  localparam int B_FAULTS_FIRST = 16;
  localparam int W_FAULTS_FIRST = 5;

  // Bits of the limits.
  localparam int L_TORQUE = 0;  // torque reference at its limit
  localparam int L_RAMP = 1;  // ramping: after arming, a change of scene, or what could have made the torque jump
  localparam int L_CURRENT = 2;  // current reference at its limit
  localparam int L_VOLTAGE = 3;  // voltage at its limit
  localparam int L_DUTY = 4;  // duty at its limit
  localparam int L_VELOCITY = 5;  // the raw velocity saturated its format
  localparam int L_TAU_HAT = 6;  // tau_hat saturated its format
  localparam int L_GATES_CLOSED = 7;  // the gates are off
  localparam int L_HOLD = 8;  // a torque was held for too long: the limit is hold_limit
  localparam int L_CHATTER = 9;  // the count alternates on one edge: the torque reference does not grow

  // Causes of fault: numbers of the first fault, and bits of the faults.
  localparam int FAULT_NONE = 0;
  localparam int FAULT_ENCODER = 1;  // too many illegal transitions
  localparam int FAULT_SPEED = 2;  // |w| above the limit
  localparam int FAULT_POLARITY = 3;  // the speed grows against the commanded current
  localparam int FAULT_I2T = 4;  // estimated current above nominal for too long
  localparam int FAULT_WATCHDOG = 5;  // the host is silent
  localparam int FAULT_STOP = 6;  // external stop
  localparam int FAULT_SELF_TEST = 7;  // the lever answered the pulse of the self-test the wrong way
  localparam int FAULT_CHANNEL = 8;  // one channel of the encoder is dead
  localparam int FAULT_TICK = 9;  // the ticks stand still
  localparam int FAULT_INDEX = 10;  // the count at the index does not fit a revolution
  localparam int FAULT_WORD = 11;  // a parameter or a held control bit has changed by itself
  localparam int FAULT_JUMP = 12;  // the velocity moved by more than its filter can
  localparam int FAULT_ENGINE = 13;  // reserved for programmed forces
  localparam int FAULT_AXIS = 14;  // reserved for further axes
  localparam int FAULT_LINK = 15;  // reserved for the host's link
endpackage
/* verilator lint_on UNUSEDPARAM */

`default_nettype wire
