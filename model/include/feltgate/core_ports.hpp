// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The ports of the whole core, as the twin and the Verilated RTL show them alike.
// Documentation: docs/blocks/feltgate_core.md
#pragma once

#include <cstdint>

#include "feltgate/encoder_source.hpp"

namespace feltgate {

/// Clock of a tick in which a host's register write is issued: early, so that it is committed with
/// this tick.
constexpr int host_write_clock = 5;

/// Inputs of the core in one clock.
struct CoreIn {
  EncoderPins encoder;
  bool arm = false;
  bool stop = false;  ///< the stop was seen since the last clock, however shortly
  bool set_zero = false;
  std::uint8_t scene = 0;
  std::uint16_t reg_addr = 0;
  std::uint32_t reg_wdata = 0;
  bool reg_write = false;
  // Of the scene law: what a program asks for.
  std::int32_t law_torque = 0;  ///< raw, in the format of the torque; sampled at Step::law_torque
  bool law_late = false;        ///< there is no fresh one: it counts as 0, and trips
  bool law_restart = false;     ///< in the last clock of a tick: it may jump with the next
  // Of several axes: what the others say.
  bool axis_fault = false;    ///< one has a fault
  bool axis_silent = false;   ///< one does not ask to be armed
  bool axis_blocked = false;  ///< one must not be armed
  bool axis_testing = false;  ///< one tests itself: the scene waits
  bool axis_waits = false;    ///< one before this one does: its own test waits
};

/// Every output of the core after one clock.
struct CoreOut {
  std::int64_t velocity = 0;
  std::uint32_t tick_count = 0, reg_rdata = 0;
  std::int32_t position = 0, tau_hat = 0, tau_ref = 0, current_ref = 0, voltage = 0;
  std::int16_t duty = 0, duty_active = 0;
  std::uint8_t gates = 0;  ///< a_hi, a_lo, b_hi, b_lo from bit 0
  std::uint8_t scene = 0, first_fault = 0;
  std::uint8_t word_slot = 0;   ///< of word_data, the last word that went into the snapshot
  std::uint32_t word_data = 0;  ///< no words without read-back
  std::uint16_t limits = 0, faults = 0;
  bool armed = false, gates_enable = false, snapshot_valid = false, reg_busy = false;
  bool word_valid = false;  ///< it is new in this clock

  bool operator==(const CoreOut& o) const {
    return velocity == o.velocity && tick_count == o.tick_count && reg_rdata == o.reg_rdata &&
           position == o.position && tau_hat == o.tau_hat && tau_ref == o.tau_ref &&
           current_ref == o.current_ref && voltage == o.voltage && duty == o.duty &&
           duty_active == o.duty_active && gates == o.gates && scene == o.scene &&
           limits == o.limits && faults == o.faults && first_fault == o.first_fault &&
           armed == o.armed && gates_enable == o.gates_enable &&
           snapshot_valid == o.snapshot_valid && reg_busy == o.reg_busy &&
           word_valid == o.word_valid && word_slot == o.word_slot && word_data == o.word_data;
  }
};

}  // namespace feltgate
