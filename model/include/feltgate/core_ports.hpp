// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The ports of the whole core; the twin and the Verilated RTL share them.
// Documentation: docs/architecture.md
#pragma once

#include <cstdint>

#include "feltgate/encoder_source.hpp"

namespace feltgate {

/// Clock of a tick in which a host's register write is issued: early enough to be committed with
/// this tick.
constexpr int host_write_clock = 5;

/// Inputs of the core in one clock.
struct CoreIn {
  EncoderPins encoder;
  bool encoder_data = false;      ///< of an absolute encoder
  std::uint8_t hall = 0;          ///< Hall lines of the motor; bit n: line n
  std::uint8_t current_data = 0;  ///< of a current loop; bit n: of modulator n
  bool driver_fault = false;      ///< of the bridge's driver, in a design with this pin
  bool arm = false;               ///< the panel's request
  bool stop = false;       ///< the stop input was active since the last clock, however shortly
  bool set_zero = false;   ///< one clock: the position becomes 0 at the end of the tick
  std::uint8_t scene = 0;  ///< the panel's choice
  std::uint16_t reg_addr = 0;
  std::uint32_t reg_wdata = 0;
  bool reg_write = false;  ///< held until a clock in which reg_busy is low
  // The torque that the program of the scene law asks for.
  std::int32_t law_torque = 0;  ///< raw, in the torque format; taken two clocks after the velocity
  bool law_late = false;        ///< no fresh torque: it counts as 0, and the core trips
  bool law_restart = false;     ///< in the last clock of a tick: it may jump in the next
  // State of the other axes of a device with several axes.
  bool axis_fault = false;    ///< another axis has a fault
  bool axis_silent = false;   ///< another axis does not ask to be armed
  bool axis_blocked = false;  ///< another axis must not be armed
  bool axis_testing = false;  ///< another axis runs its self-test: the scene waits
  bool axis_waits = false;    ///< an axis with a lower number runs its self-test: this one's waits
};

/// Every output of the core after one clock. Signals are raw integers in the design's formats.
struct CoreOut {
  std::int64_t velocity = 0;  ///< rad/s
  /// Ticks since reset, modulo 2^32; the word at reg_addr, 3 clocks later.
  std::uint32_t tick_count = 0, reg_rdata = 0;
  /// Count; load [Nm]; torque reference [Nm]; current reference [A]; voltage [V].
  std::int32_t position = 0, tau_hat = 0, tau_ref = 0, current_ref = 0, voltage = 0;
  std::int32_t current = 0;    ///< measured by a current loop, [1,1,17] of full scale
  bool current_clock = false;  ///< to its modulator
  bool heartbeat = false;      ///< to a watchdog outside, in a design with this pin
  std::uint8_t serial = 1;  ///< to an absolute encoder: bit 0 select_n, bit 1 clock, bit 2 command
  /// Clocks of the PWM period: as computed, and as in force.
  std::int16_t duty = 0, duty_active = 0;
  std::uint8_t gates = 0;  ///< bit 0 a_hi, 1 a_lo, 2 b_hi, 3 b_lo; of three phases 4 c_hi, 5 c_lo
  std::uint8_t scene = 0, first_fault = 0;  ///< numbers; first_fault 0: none
  std::uint8_t word_slot = 0;   ///< slot of word_data, the last word stored in the snapshot
  std::uint32_t word_data = 0;  ///< always 0 without read-back
  std::uint16_t limits = 0, faults = 0;  ///< one bit per limit or cause
  bool armed = false, gates_enable = false, snapshot_valid = false, reg_busy = false;
  bool word_valid = false;  ///< word_data is new in this clock

  bool operator==(const CoreOut& o) const {
    return velocity == o.velocity && tick_count == o.tick_count && reg_rdata == o.reg_rdata &&
           position == o.position && tau_hat == o.tau_hat && tau_ref == o.tau_ref &&
           current_ref == o.current_ref && voltage == o.voltage && duty == o.duty &&
           duty_active == o.duty_active && gates == o.gates && scene == o.scene &&
           limits == o.limits && faults == o.faults && first_fault == o.first_fault &&
           armed == o.armed && gates_enable == o.gates_enable &&
           snapshot_valid == o.snapshot_valid && reg_busy == o.reg_busy &&
           word_valid == o.word_valid && word_slot == o.word_slot && word_data == o.word_data &&
           current == o.current && current_clock == o.current_clock && heartbeat == o.heartbeat &&
           serial == o.serial;
  }
};

}  // namespace feltgate
