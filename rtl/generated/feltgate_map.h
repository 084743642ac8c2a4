// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/registers.toml by
// `feltgate generate`: do not edit.
// The register map of all designs for C99 and C++: addresses, fields, numbers.
#ifndef FELTGATE_MAP_H
#define FELTGATE_MAP_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Addresses count words of 32 bits; on a bus that counts bytes: */
#define FELTGATE_BYTES(address) (4u * (address))
/* A field of a word, and a value at the place of a field:
   FELTGATE_GET(FELTGATE_STATUS_MODE, word), FELTGATE_PUT(FELTGATE_CONTROL_SCENE, 3) */
#define FELTGATE_GET(field, word) (((uint32_t)(word) & field##_MASK) >> field##_BIT)
#define FELTGATE_PUT(field, value) (((uint32_t)(value) << field##_BIT) & field##_MASK)

/* The word nearest to value * scale, halves away from 0; beyond low and high the nearer of them;
   0 for what is no number. */
static inline uint32_t feltgate_word(double value, double scale, double low, double high) {
  const double scaled = value * scale;
  double rest;
  int64_t whole;
  if (!(scaled == scaled)) return 0;
  if (scaled >= high) return (uint32_t)(int64_t)high;
  if (scaled <= low) return (uint32_t)(int64_t)low;
  whole = (int64_t)scaled;
  rest = scaled - (double)whole;
  if (rest >= 0.5) ++whole;
  if (rest <= -0.5) --whole;
  return (uint32_t)whole;
}

/* What the low bits of a word say; bits above them are ignored, as in the core. */
static inline double feltgate_value(uint32_t word, int bits, int has_sign, double scale) {
  const uint32_t top = 1u << (bits - 1);
  const uint32_t low = bits < 32 ? word & ((top << 1) - 1u) : word;
  if (!has_sign || !(low & top)) return (double)low / scale;
  return ((double)low - 2.0 * (double)top) / scale;
}

#ifdef __cplusplus
}
#endif

/* Words by their address. */

#define FELTGATE_VELOCITY_A1 0x004u  /* low-pass coefficient of the velocity estimator, 1-exp(-cutoff*T) [1] */

#define FELTGATE_INVERSE_RESISTANCE 0x005u  /* 1/R of the estimated motor current (V - Ke*w)/R [1/ohm] */

#define FELTGATE_EMF_OVER_RESISTANCE 0x007u  /* Ke/R of the estimated motor current [A s/rad] */

#define FELTGATE_TORQUE_CONSTANT 0x008u  /* nominal torque constant Ktn of the observer [Nm/A] */

#define FELTGATE_INERTIA_GAIN 0x009u  /* g*Jn: observer cut-off times nominal inertia [Nm s/rad] */

#define FELTGATE_OBSERVER_A1 0x00fu  /* low-pass coefficient of the disturbance observer, 1-exp(-g*T) [1] */

#define FELTGATE_OVERSPEED 0x010u  /* fault above this speed [rad/s] */

#define FELTGATE_NOMINAL_CURRENT_SQUARED 0x011u  /* square of the current that the motor can carry without limit in time [A^2] */

#define FELTGATE_I2T_BUDGET 0x012u  /* trip level of the integral of I^2 - Inom^2 over ticks [A^2 tick] */

#define FELTGATE_POLARITY_SPEED 0x013u  /* wrong-polarity check: what the speed against the commanded current gains in a window [rad/s] */

#define FELTGATE_POLARITY_CURRENT 0x014u  /* wrong-polarity check: current reference above which a direction is meant [A] */

#define FELTGATE_POLARITY_TICKS 0x015u  /* wrong-polarity check: length of a window [tick] */

#define FELTGATE_EMF_CONSTANT 0x016u  /* Ke of the motor: back-EMF of the voltage law, and middle of the window [V s/rad] */

#define FELTGATE_OBSERVER_GAIN 0x017u  /* (1-Jn*Kp)/Ktn: gain of tau_hat in the current reference [A/Nm] */

#define FELTGATE_TORQUE_LIMIT 0x018u  /* largest torque reference [Nm] */

#define FELTGATE_RAMP_STEP 0x019u  /* torque change per tick while ramping [Nm/tick] */

#define FELTGATE_VOLTAGE_TO_CURRENT 0x01bu  /* direct voltage mode: current reference per volt, shown to the observer [1/ohm] */

#define FELTGATE_TORQUE_GAIN 0x01cu  /* Jn*Kp/Ktn: gain of tau_ref in the current reference [A/Nm] */

#define FELTGATE_DEAD_VOLTAGE_SLOPE 0x01du  /* slope of the dead-voltage law around zero torque [V/Nm] */

#define FELTGATE_REGION_TORQUE 0x01eu  /* border between the two regions of the voltage gain; at the border the low one holds [Nm] */

#define FELTGATE_VOLTAGE_SETPOINT 0x01fu  /* direct voltage mode: the voltage that it ramps to [V] */

#define FELTGATE_VOLTAGE_STEP 0x020u  /* direct voltage mode: voltage change per tick [V/tick] */

#define FELTGATE_CURRENT_LIMIT 0x021u  /* largest current reference [A] */

#define FELTGATE_VOLTAGE_GAIN 0x022u  /* Kv of the low-torque region times 1 ohm, or the resistance [ohm] */

#define FELTGATE_DEAD_VOLTAGE 0x023u  /* dead voltage of brushes and bridge [V] */

#define FELTGATE_HOLD_TORQUE 0x024u  /* a torque reference above it without a count may be held for hold_time only [Nm] */

#define FELTGATE_SELF_TEST_QUIET 0x025u  /* self-test: so long no count before the pulse; above 255 it counts as 255 [128 ticks] */

#define FELTGATE_SELF_TEST_PULSE 0x026u  /* self-test: length of the pulse, and of its opposite; above 255 it counts as 255, 0 is no test [128 ticks] */

#define FELTGATE_VOLTAGE_WINDOW 0x027u  /* how far the voltage may be from the back-EMF: R*Imax + dead voltage, at most the supply [V] */

#define FELTGATE_DUTY_GAIN 0x028u  /* PWM clocks per volt: period over supply voltage [clock/V] */

#define FELTGATE_SELF_TEST_ARMS 0x029u  /* self-test: bit 0: the scene begins though the lever is held, bit 1: though it moves; else a fault [1] */

#define FELTGATE_HOLD_TIME 0x02bu  /* for how long; from 8192 on without end [1024 ticks] */

#define FELTGATE_DUTY_LIMIT 0x02du  /* largest on-time in a PWM period [clock] */

#define FELTGATE_WATCHDOG_TICKS 0x02eu  /* host watchdog: longest time between two kicks; asleep until the first [tick] */

#define FELTGATE_VOLTAGE_GAIN_HIGH 0x032u  /* Kv of the high-torque region times 1 ohm, or the resistance [ohm] */

#define FELTGATE_SELF_TEST_TORQUE 0x033u  /* torque of the self-test's pulse, if it is less than the limits in force [Nm] */

#define FELTGATE_HOLD_LIMIT 0x038u  /* torque limit after that, until a count comes, if it is less than torque_limit [Nm] */

#define FELTGATE_SETPOINT_TORQUE 0x04au  /* constant torque [Nm] */

#define FELTGATE_MEMBRANE_LOWER 0x061u  /* lower face of the membrane [count] */

#define FELTGATE_MEMBRANE_UPPER 0x062u  /* upper face of the membrane [count] */

#define FELTGATE_MEMBRANE_TORQUE 0x06au  /* torque inside, against the side of entry [Nm] */

#define FELTGATE_COMPRESSION_CONTACT 0x081u  /* where the lever meets the spring; it pushes back below [count] */

#define FELTGATE_COMPRESSION_STIFFNESS 0x082u  /* stiffness [Nm/count] */

#define FELTGATE_TENSION_REST 0x0a1u  /* rest position of the spring [count] */

#define FELTGATE_TENSION_STIFFNESS 0x0a2u  /* stiffness [Nm/count] */

#define FELTGATE_DAMPER_DAMPING 0x0cau  /* damping [Nm s/rad] */

#define FELTGATE_ATTRACT_CENTRE 0x0e1u  /* position of the fixed charge (its fraction bits are ignored) [count] */

#define FELTGATE_ATTRACT_STRENGTH 0x0e2u  /* r*k_c: torque times distance squared [Nm count^2] */

#define FELTGATE_ATTRACT_CORE_SLOPE 0x0e3u  /* slope of the linear core [Nm/count] */

#define FELTGATE_ATTRACT_CORE 0x0e6u  /* last whole count of the linear core: up to it the torque is slope times distance; 0 is the raw law [count] */

#define FELTGATE_REPEL_CENTRE 0x101u  /* position of the fixed charge (its fraction bits are ignored) [count] */

#define FELTGATE_REPEL_STRENGTH 0x102u  /* r*k_c: torque times distance squared [Nm count^2] */

#define FELTGATE_REPEL_CORE_SLOPE 0x103u  /* slope of the linear core [Nm/count] */

#define FELTGATE_REPEL_CORE 0x106u  /* last whole count of the linear core: up to it the torque is slope times distance; 0 is the raw law [count] */

#define FELTGATE_WALL_CONTACT 0x121u  /* face of the wall; free below, wall above [count] */

#define FELTGATE_WALL_STIFFNESS 0x122u  /* stiffness [Nm/count] */

#define FELTGATE_WALL_DAMPING 0x12au  /* damping inside the wall [Nm s/rad] */

#define FELTGATE_CONTROL 0x200u  /* what the core does */
#define FELTGATE_CONTROL_HOST_BIT 0  /* 1: arm and scene come from this word, 0: from the pins */
#define FELTGATE_CONTROL_HOST_MASK 0x00000001u
#define FELTGATE_CONTROL_ARM_BIT 1  /* request to arm (when host is 1) */
#define FELTGATE_CONTROL_ARM_MASK 0x00000002u
#define FELTGATE_CONTROL_SCENE_BIT 2  /* scene number (when host is 1) */
#define FELTGATE_CONTROL_SCENE_MASK 0x0000003cu
#define FELTGATE_CONTROL_MODE_BIT 6  /* 0 closed loop, 1 open loop, 2 direct voltage; this and what follows hold while armed */
#define FELTGATE_CONTROL_MODE_MASK 0x000000c0u
#define FELTGATE_CONTROL_MOTOR_POLARITY_BIT 8  /* 1: the motor's leads are swapped */
#define FELTGATE_CONTROL_MOTOR_POLARITY_MASK 0x00000100u
#define FELTGATE_CONTROL_ENCODER_POLARITY_BIT 9  /* 1: the encoder's channels are swapped; of an absolute encoder it also holds from the first reading on */
#define FELTGATE_CONTROL_ENCODER_POLARITY_MASK 0x00000200u
#define FELTGATE_CONTROL_PWM_MODE_BIT 10  /* 0 sign-magnitude, 1 locked antiphase */
#define FELTGATE_CONTROL_PWM_MODE_MASK 0x00000400u
#define FELTGATE_CONTROL_FILTER_BIT 11  /* encoder glitch filter in samples, 0 is off */
#define FELTGATE_CONTROL_FILTER_MASK 0x00007800u

#define FELTGATE_COMMAND 0x201u  /* each bit written 1 acts once */
#define FELTGATE_COMMAND_SET_ZERO_BIT 0  /* position := 0 */
#define FELTGATE_COMMAND_SET_ZERO_MASK 0x00000001u
#define FELTGATE_COMMAND_CLEAR_FAULTS_BIT 1  /* forget the latched faults and encoder errors; only while arming is not requested */
#define FELTGATE_COMMAND_CLEAR_FAULTS_MASK 0x00000002u
#define FELTGATE_COMMAND_KICK_BIT 2  /* feed the host watchdog, and wake it the first time */
#define FELTGATE_COMMAND_KICK_MASK 0x00000004u
#define FELTGATE_COMMAND_FREEZE_BIT 3  /* hold the snapshot that is read back */
#define FELTGATE_COMMAND_FREEZE_MASK 0x00000008u
#define FELTGATE_COMMAND_THAW_BIT 4  /* let the snapshot follow again */
#define FELTGATE_COMMAND_THAW_MASK 0x00000010u
#define FELTGATE_COMMAND_STOP_BIT 5  /* the fault stop, at once, also while another write waits */
#define FELTGATE_COMMAND_STOP_MASK 0x00000020u

#define FELTGATE_STATUS 0x300u  /* what the core does and what holds it back */
#define FELTGATE_STATUS_LIMITS_BIT 0  /* what holds the torque back, by its bit */
#define FELTGATE_STATUS_LIMITS_MASK 0x00000fffu
#define FELTGATE_STATUS_SCENE_BIT 20  /* scene number */
#define FELTGATE_STATUS_SCENE_MASK 0x00f00000u
#define FELTGATE_STATUS_ARMED_BIT 24  /* armed */
#define FELTGATE_STATUS_ARMED_MASK 0x01000000u
#define FELTGATE_STATUS_MODE_BIT 25  /* 0 closed loop, 1 open loop, 2 direct voltage */
#define FELTGATE_STATUS_MODE_MASK 0x06000000u
#define FELTGATE_STATUS_ENCODER_ERROR_BIT 27  /* an illegal transition was seen */
#define FELTGATE_STATUS_ENCODER_ERROR_MASK 0x08000000u
#define FELTGATE_STATUS_REFUSED_BIT 28  /* the last parameter written was refused, for the motor was armed */
#define FELTGATE_STATUS_REFUSED_MASK 0x10000000u
#define FELTGATE_STATUS_UNKICKED_BIT 29  /* arming waits for the first kick of the watchdog */
#define FELTGATE_STATUS_UNKICKED_MASK 0x20000000u
#define FELTGATE_STATUS_SELF_TEST_BIT 16  /* self-test: 0 none or not over, 1 right, 2 held, 3 moving */
#define FELTGATE_STATUS_SELF_TEST_MASK 0x00030000u
#define FELTGATE_STATUS_TESTING_BIT 18  /* the scene waits for the self-test */
#define FELTGATE_STATUS_TESTING_MASK 0x00040000u
#define FELTGATE_STATUS_DRIVER_FAULT_BIT 19  /* of a current loop, else 0: the bridge's driver tells of a fault, or did so with the gates enabled */
#define FELTGATE_STATUS_DRIVER_FAULT_MASK 0x00080000u
#define FELTGATE_STATUS_SATURATED_BIT 31  /* the last parameter written did not fit its format and became the nearest value that does */
#define FELTGATE_STATUS_SATURATED_MASK 0x80000000u
#define FELTGATE_STATUS_CURRENT_MISSING_BIT 30  /* of a current loop, else 0: the measured current was not what the voltage makes, or a phase was open */
#define FELTGATE_STATUS_CURRENT_MISSING_MASK 0x40000000u

#define FELTGATE_POSITION 0x301u  /* position [count] [count] */

#define FELTGATE_TICK 0x306u  /* tick counter, wraps at 2^32 */

#define FELTGATE_VELOCITY 0x309u  /* velocity in its signal format [rad/s] */

#define FELTGATE_INDEX 0x30bu  /* position latched at the last index edge [count] [count] */

#define FELTGATE_ENCODER 0x30eu  /* encoder error count [15:0], rejected pulses [31:16] */

#define FELTGATE_TAU_HAT 0x317u  /* observed torque; void while the limits voltage or duty act, see there [Nm] */

#define FELTGATE_FAULTS 0x31au  /* what closed the gates */
#define FELTGATE_FAULTS_SEEN_BIT 0  /* faults that were seen, by their bit */
#define FELTGATE_FAULTS_SEEN_MASK 0x0000ffffu
#define FELTGATE_FAULTS_FIRST_BIT 16  /* number of the first of them, 0 none */
#define FELTGATE_FAULTS_FIRST_MASK 0x001f0000u
#define FELTGATE_FAULTS_CURRENT_BIT 21  /* of a current loop, else 0: bit 0 over-current, 1 stuck, 2 saturated, 3 offset, 4 not calibrated */
#define FELTGATE_FAULTS_CURRENT_MASK 0x03e00000u
#define FELTGATE_FAULTS_ABSOLUTE_BIT 26  /* of an absolute encoder, else 0: bit 0 missing, 1 check, 2 sensor, 3 jump, 4 frozen, 5 starts: no reading yet, and none was wrong; of Hall lines 0 all alike, 1 apart, 3 a sector passed over, 5 no sector yet */
#define FELTGATE_FAULTS_ABSOLUTE_MASK 0xfc000000u

#define FELTGATE_TAU_REF 0x31cu  /* torque reference [Nm] */

#define FELTGATE_CURRENT_REF 0x322u  /* current reference, saturated [A] */

#define FELTGATE_VOLTAGE 0x328u  /* voltage, saturated [V] */

#define FELTGATE_DUTY 0x32eu  /* duty [clock] [clock] */

/* What only the host's link has, no bus: docs/link.md. */

#define FELTGATE_LINK_IDENTITY 0x1000u  /* the number 0x46454c54, "FELT" */

#define FELTGATE_LINK_VERSION 0x1001u  /* of the link: major in bits 31 to 16, minor below */

#define FELTGATE_LINK_DESIGN_CRC 0x1002u  /* CRC-32 of the design; equal to that of the host's copy */

#define FELTGATE_LINK_CLOCK_HZ 0x1003u  /* clock of the core [Hz] */

#define FELTGATE_LINK_CLOCKS_PER_TICK 0x1004u  /* clocks of a tick */

#define FELTGATE_LINK_FEATURES 0x1005u  /* what there is */
#define FELTGATE_LINK_FEATURES_SIMULATED_BIT 0  /* no board: a simulation */
#define FELTGATE_LINK_FEATURES_SIMULATED_MASK 0x00000001u
#define FELTGATE_LINK_FEATURES_CAPTURE_BIT 1  /* capture is built */
#define FELTGATE_LINK_FEATURES_CAPTURE_MASK 0x00000002u
#define FELTGATE_LINK_FEATURES_STREAM_BIT 2  /* the stream is built */
#define FELTGATE_LINK_FEATURES_STREAM_MASK 0x00000004u
#define FELTGATE_LINK_FEATURES_ENGINE_BIT 3  /* there is an engine for laws; its words begin at the constant engine */
#define FELTGATE_LINK_FEATURES_ENGINE_MASK 0x00000008u
#define FELTGATE_LINK_FEATURES_ROWS_LOG2_BIT 8  /* log2 of the rows of the capture memory */
#define FELTGATE_LINK_FEATURES_ROWS_LOG2_MASK 0x0000ff00u
#define FELTGATE_LINK_FEATURES_COLUMNS_BIT 16  /* words of a row */
#define FELTGATE_LINK_FEATURES_COLUMNS_MASK 0x00ff0000u

#define FELTGATE_LINK_FRAMES_GOOD 0x1006u  /* requests that were taken */

#define FELTGATE_LINK_FRAMES_BAD 0x1007u  /* frames that were not */

#define FELTGATE_LINK_LAST_WRITE_SEQUENCE 0x1008u  /* sequence of the last write that was taken; 0x100: none since the reset */

#define FELTGATE_LINK_BOARD 0x1009u  /* 0 other, 1 DE0-Nano, 2 ULX3S, 3 Tang Nano 9K */

#define FELTGATE_LINK_INPUTS 0x100au  /* the board's inputs, its page says which */

#define FELTGATE_LINK_STREAM_WORDS 0x1010u  /* mask of the words that are streamed: bit k is the k-th word of the snapshot in the order of its slots */

#define FELTGATE_LINK_STREAM_PERIOD 0x1011u  /* ticks from one frame to the next, 0: off */

#define FELTGATE_LINK_STREAM_DROPPED 0x1012u  /* frames for which the wire was not free */

#define FELTGATE_LINK_CAPTURE_CONTROL 0x1020u  /* what a write asks of the capture */
#define FELTGATE_LINK_CAPTURE_CONTROL_START_BIT 0  /* begins to fill the rows before the trigger */
#define FELTGATE_LINK_CAPTURE_CONTROL_START_MASK 0x00000001u
#define FELTGATE_LINK_CAPTURE_CONTROL_ABORT_BIT 1  /* ends it */
#define FELTGATE_LINK_CAPTURE_CONTROL_ABORT_MASK 0x00000002u
#define FELTGATE_LINK_CAPTURE_CONTROL_TRIGGER_BIT 2  /* triggers now */
#define FELTGATE_LINK_CAPTURE_CONTROL_TRIGGER_MASK 0x00000004u

#define FELTGATE_LINK_CAPTURE_STATE 0x1021u  /* 0 idle, 1 fills the rows before the trigger, 2 waits, 3 fills the rest, 4 done */

#define FELTGATE_LINK_CAPTURE_WORDS 0x1022u  /* mask of the words of a row, at most 8; of more the lowest 8 */

#define FELTGATE_LINK_CAPTURE_PRE 0x1023u  /* rows before the trigger */

#define FELTGATE_LINK_CAPTURE_PERIOD 0x1024u  /* ticks from one row to the next, 1: every tick */

#define FELTGATE_LINK_TRIGGER_WORD 0x1025u  /* which word triggers, as the number of its bit in the mask */

#define FELTGATE_LINK_TRIGGER_MODE 0x1026u  /* 0 only by hand, 1 rises to the level or above, signed, 2 falls below it, 3 a bit of the level becomes 1, 4 a law tells the event of that number; without an engine 0 to 3 only */

#define FELTGATE_LINK_TRIGGER_LEVEL 0x1027u  /* the level, the mask of bits, or the number of the event; for any event the constant any_event */

#define FELTGATE_LINK_CAPTURE_FIRST 0x1028u  /* row of the oldest tick */

#define FELTGATE_LINK_CAPTURE_ROWS 0x1029u  /* rows that hold a tick */

/* X(name, NAME) for each parameter that all designs have. */
#define FELTGATE_PARAMETERS(X) \
  X(velocity_a1, VELOCITY_A1) \
  X(inverse_resistance, INVERSE_RESISTANCE) \
  X(emf_over_resistance, EMF_OVER_RESISTANCE) \
  X(torque_constant, TORQUE_CONSTANT) \
  X(inertia_gain, INERTIA_GAIN) \
  X(observer_a1, OBSERVER_A1) \
  X(overspeed, OVERSPEED) \
  X(nominal_current_squared, NOMINAL_CURRENT_SQUARED) \
  X(i2t_budget, I2T_BUDGET) \
  X(polarity_speed, POLARITY_SPEED) \
  X(polarity_current, POLARITY_CURRENT) \
  X(polarity_ticks, POLARITY_TICKS) \
  X(emf_constant, EMF_CONSTANT) \
  X(observer_gain, OBSERVER_GAIN) \
  X(torque_limit, TORQUE_LIMIT) \
  X(ramp_step, RAMP_STEP) \
  X(voltage_to_current, VOLTAGE_TO_CURRENT) \
  X(torque_gain, TORQUE_GAIN) \
  X(dead_voltage_slope, DEAD_VOLTAGE_SLOPE) \
  X(region_torque, REGION_TORQUE) \
  X(voltage_setpoint, VOLTAGE_SETPOINT) \
  X(voltage_step, VOLTAGE_STEP) \
  X(current_limit, CURRENT_LIMIT) \
  X(voltage_gain, VOLTAGE_GAIN) \
  X(dead_voltage, DEAD_VOLTAGE) \
  X(hold_torque, HOLD_TORQUE) \
  X(self_test_quiet, SELF_TEST_QUIET) \
  X(self_test_pulse, SELF_TEST_PULSE) \
  X(voltage_window, VOLTAGE_WINDOW) \
  X(duty_gain, DUTY_GAIN) \
  X(self_test_arms, SELF_TEST_ARMS) \
  X(hold_time, HOLD_TIME) \
  X(duty_limit, DUTY_LIMIT) \
  X(watchdog_ticks, WATCHDOG_TICKS) \
  X(voltage_gain_high, VOLTAGE_GAIN_HIGH) \
  X(self_test_torque, SELF_TEST_TORQUE) \
  X(hold_limit, HOLD_LIMIT) \
  X(setpoint_torque, SETPOINT_TORQUE) \
  X(membrane_lower, MEMBRANE_LOWER) \
  X(membrane_upper, MEMBRANE_UPPER) \
  X(membrane_torque, MEMBRANE_TORQUE) \
  X(compression_contact, COMPRESSION_CONTACT) \
  X(compression_stiffness, COMPRESSION_STIFFNESS) \
  X(tension_rest, TENSION_REST) \
  X(tension_stiffness, TENSION_STIFFNESS) \
  X(damper_damping, DAMPER_DAMPING) \
  X(attract_centre, ATTRACT_CENTRE) \
  X(attract_strength, ATTRACT_STRENGTH) \
  X(attract_core_slope, ATTRACT_CORE_SLOPE) \
  X(attract_core, ATTRACT_CORE) \
  X(repel_centre, REPEL_CENTRE) \
  X(repel_strength, REPEL_STRENGTH) \
  X(repel_core_slope, REPEL_CORE_SLOPE) \
  X(repel_core, REPEL_CORE) \
  X(wall_contact, WALL_CONTACT) \
  X(wall_stiffness, WALL_STIFFNESS) \
  X(wall_damping, WALL_DAMPING)

/* Scenes. */
#define FELTGATE_SCENE_FREE 0u
#define FELTGATE_SCENE_SETPOINT 2u
#define FELTGATE_SCENE_MEMBRANE 3u
#define FELTGATE_SCENE_SPRING_COMPRESSION 4u
#define FELTGATE_SCENE_SPRING_TENSION 5u
#define FELTGATE_SCENE_DAMPER 6u
#define FELTGATE_SCENE_CHARGE_ATTRACT 7u
#define FELTGATE_SCENE_CHARGE_REPEL 8u
#define FELTGATE_SCENE_WALL 9u
#define FELTGATE_SCENE_LAW 10u

/* Bits of FELTGATE_STATUS_LIMITS. */
#define FELTGATE_LIMIT_TORQUE (1u << 0)  /* torque reference at its limit */
#define FELTGATE_LIMIT_RAMP (1u << 1)  /* ramping: after arming, a change of scene, or what could have made the torque jump */
#define FELTGATE_LIMIT_CURRENT (1u << 2)  /* current reference at its limit */
#define FELTGATE_LIMIT_VOLTAGE (1u << 3)  /* voltage at the end of the window around the back-EMF; without a current loop tau_hat is void, for the motor gives less than it counts on */
#define FELTGATE_LIMIT_DUTY (1u << 4)  /* duty at its limit; without a current loop tau_hat is void, as above */
#define FELTGATE_LIMIT_VELOCITY (1u << 5)  /* the raw velocity saturated its format */
#define FELTGATE_LIMIT_TAU_HAT (1u << 6)  /* tau_hat saturated its format */
#define FELTGATE_LIMIT_GATES_CLOSED (1u << 7)  /* the gates are off */
#define FELTGATE_LIMIT_HOLD (1u << 8)  /* a torque was held for too long: the limit is hold_limit, or torque_limit if that is less */
#define FELTGATE_LIMIT_CHATTER (1u << 9)  /* the count alternates on one edge: the torque reference does not grow */

/* Numbers in FELTGATE_FAULTS_FIRST; fault n is also bit n of FELTGATE_FAULTS_SEEN. */
#define FELTGATE_FAULT_ENCODER 1u  /* too many illegal transitions; of an absolute encoder or Hall lines what faults.absolute says */
#define FELTGATE_FAULT_SPEED 2u  /* |w| above the limit */
#define FELTGATE_FAULT_POLARITY 3u  /* the speed grows against the commanded current */
#define FELTGATE_FAULT_I2T 4u  /* estimated current above nominal for too long */
#define FELTGATE_FAULT_WATCHDOG 5u  /* the host is silent */
#define FELTGATE_FAULT_STOP 6u  /* external stop */
#define FELTGATE_FAULT_SELF_TEST 7u  /* the lever answered the pulse of the self-test the wrong way, or was held or moved where the design does not arm then */
#define FELTGATE_FAULT_CHANNEL 8u  /* one channel of the encoder is dead */
#define FELTGATE_FAULT_TICK 9u  /* the ticks stand still */
#define FELTGATE_FAULT_INDEX 10u  /* the count at the index does not fit a revolution */
#define FELTGATE_FAULT_WORD 11u  /* a parameter, a held control bit or the position has changed by itself */
#define FELTGATE_FAULT_JUMP 12u  /* the velocity moved by more than its filter can */
#define FELTGATE_FAULT_ENGINE 13u  /* the engine is late: no fresh torque within its time, in the scene law */
#define FELTGATE_FAULT_AXIS 14u  /* another axis has a fault */
#define FELTGATE_FAULT_CURRENT 15u  /* of a current loop: over-current, the driver's own fault, or the sensor fails; faults.current, status.driver_fault and status.current_missing say which */

/* Numbers that fields and words refer to. */
#define FELTGATE_MODE_OPEN 1  /* control.mode: open loop */
#define FELTGATE_MODE_VOLTAGE 2  /* control.mode: direct voltage */
#define FELTGATE_ERRORS_BORNE 7  /* encoder errors that are borne, less one every 2^forgive_bits ticks */
#define FELTGATE_FORGIVE_BITS 10  /* bits of the ticks after which one encoder error is forgiven */
#define FELTGATE_RUNAWAY_BITS 16  /* bits of the longest window of the wrong-polarity check [tick] */
#define FELTGATE_RUNAWAY_WINDOWS 2  /* windows on end in which the speed must grow against the commanded current */
#define FELTGATE_GROWTH_BITS 5  /* fraction bits of the velocity whose growth is watched */
#define FELTGATE_SELF_TEST_UNIT_BITS 7  /* bits of the ticks in a unit of the self-test's times */
#define FELTGATE_SELF_TEST_COUNT_BITS 8  /* bits of these times */
#define FELTGATE_SELF_TEST_PATIENCE_BITS 17  /* bits of the ticks of which the second multiple ends the self-test's wait */
#define FELTGATE_SELF_TEST_COUNTS 2  /* counts that are an answer to the self-test */
#define FELTGATE_SELF_TEST_RIGHT 1  /* what status.self_test says: the lever answered the right way */
#define FELTGATE_SELF_TEST_HELD 2  /* it did not answer */
#define FELTGATE_SELF_TEST_MOVING 3  /* it was not still for long enough to be asked */
#define FELTGATE_SELF_TEST_HELD_BIT 0  /* of self_test_arms: the scene begins though the lever is held */
#define FELTGATE_SELF_TEST_MOVING_BIT 1  /* of self_test_arms: the scene begins though the lever moves */
#define FELTGATE_KICKLESS_BITS 24  /* bits of the longest time without a kick [tick] */
#define FELTGATE_ARM_WAIT_MS 20  /* for so long a request to arm may wait until the gates open [ms]; then it is refused */
#define FELTGATE_ABSOLUTE_JUMP_BIT 3  /* of faults.absolute: the angle has jumped */
#define FELTGATE_ONE_CHANNEL_EDGES 16  /* edges of one channel in a row from which it is chatter or a dead channel */
#define FELTGATE_DEAD_CHANNEL_EDGES 24  /* as many are a dead channel */
#define FELTGATE_EDGE_UNITS 19  /* so many times 2^EDGE_UNIT_BITS ticks (of the design) without an edge end the row */
#define FELTGATE_CHATTER_UNITS 20  /* chatter for so many times 4 * 2^EDGE_UNIT_BITS ticks is a dead channel */
#define FELTGATE_INDEX_WIDTH_BITS 3  /* an index may be less than 2^index_width_bits counts wide */
#define FELTGATE_HOLD_UNIT_BITS 10  /* bits of the ticks in which hold_time is counted */
#define FELTGATE_HOLD_BITS 13  /* bits of the longest hold_time */

/* Of the link's format. */
#define FELTGATE_LINK_FORMAT_IDENTITY 1178946644  /* what the word identity says */
#define FELTGATE_LINK_FORMAT_VERSION 65536  /* what the word version says */
#define FELTGATE_LINK_FORMAT_BAUD 1000000  /* bits per second where nothing else is said */
#define FELTGATE_LINK_FORMAT_FRAME_END 192  /* byte before and after a frame */
#define FELTGATE_LINK_FORMAT_FRAME_ESCAPE 219  /* byte that changes the next one's meaning */
#define FELTGATE_LINK_FORMAT_ESCAPED_END 220  /* after the escape: frame_end */
#define FELTGATE_LINK_FORMAT_ESCAPED_ESCAPE 221  /* after the escape: frame_escape */
#define FELTGATE_LINK_FORMAT_KIND_READ 1  /* first byte of a request to read */
#define FELTGATE_LINK_FORMAT_KIND_WRITE 2  /* first byte of a request to write */
#define FELTGATE_LINK_FORMAT_KIND_STREAM 64  /* first byte of a frame that nobody asked for */
#define FELTGATE_LINK_FORMAT_KIND_REPLY 128  /* set in the first byte of a reply */
#define FELTGATE_LINK_FORMAT_REQUEST_BYTES 12  /* bytes of every request, its CRC among them */
#define FELTGATE_LINK_FORMAT_READ_WORDS 64  /* most words of one read */
#define FELTGATE_LINK_FORMAT_MAP_BITS 14  /* bits of an address; a request beyond is bad. One more where features.engine is set */
#define FELTGATE_LINK_FORMAT_NO_SEQUENCE 256  /* last_write_sequence before the first write */
#define FELTGATE_LINK_FORMAT_WORDS 4096  /* first address of the link's words; below are the core's */
#define FELTGATE_LINK_FORMAT_MEMORY 8192  /* first address of the capture memory: 8 words of a row, then the next row */
#define FELTGATE_LINK_FORMAT_ROWS_LOG2 10  /* log2 of the rows of the capture memory */
#define FELTGATE_LINK_FORMAT_COLUMNS 8  /* words of a row */
#define FELTGATE_LINK_FORMAT_TRIGGER_MODE_BITS 3  /* bits of trigger_mode */
#define FELTGATE_LINK_FORMAT_TRIGGER_RISES 1  /* trigger_mode: the word rises to the level or above, signed */
#define FELTGATE_LINK_FORMAT_TRIGGER_FALLS 2  /* trigger_mode: the word falls below the level */
#define FELTGATE_LINK_FORMAT_TRIGGER_BIT 3  /* trigger_mode: a bit of the level becomes 1 */
#define FELTGATE_LINK_FORMAT_TRIGGER_EVENT 4  /* trigger_mode: an event of a law; a bit of its own, which stays 0 without an engine */
#define FELTGATE_LINK_FORMAT_ANY_EVENT 512  /* set in trigger_level: an event of any number; the bits below it are the number */
#define FELTGATE_LINK_FORMAT_ENGINE 16384  /* first address of the engine's words, where features.engine is set */

#endif
