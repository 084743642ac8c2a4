// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What goes from block to block: the structs of package cfg. A bit of a packed struct is a bool
// here, a vector an integer. docs/architecture.md
#pragma once

#include <cstdint>

#include "feltgate/core_ports.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate::axis {

struct Tick {
  int clock = 0;        ///< of the tick, from 0
  bool sample = false;  ///< the position is sampled
  bool velocity = false, tau_hat = false, scene = false, tau_ref = false,
       duty = false;  ///< is new
  bool last = false;  ///< clock of a tick
  std::uint32_t count = 0;
};

/// To the encoder.
struct Encoder {
  bool sample = false;
  std::uint32_t tick_count = 0;
  int filter = 0;
  bool polarity = false, set_zero = false, clear = false, gates_enable = false;
};

/// From the encoder.
struct Position {
  std::int32_t position = 0;
  std::int32_t count = 0;  ///< whatever the zero
  std::uint16_t travel = 0;
  bool moved = false, chatters = false, illegal = false, error = false;
  std::uint16_t error_count = 0, rejected_count = 0;
  std::int32_t index_position = 0;
  bool polarity_holds = false;
  bool trip_channel = false, trip_index = false, trip_flip = false;
  unsigned why = 0;  ///< the top bit: no first reading yet
};

/// To the bridge.
struct Drive {
  bool gates_enable = false, gates_clear = false, clear = false, pwm_mode = false, polarity = false;
  bool direct = false;                 ///< voltage mode: no current is controlled
  bool sample = false, valid = false;  ///< the position is sampled; current, feed, duty are new
  std::int32_t current = 0;
  std::int32_t feed = 0;  ///< V, fed forward to a current's controller
  std::int16_t duty = 0;
};

/// From the bridge.
struct Bridge {
  bool measured = false, period_start = false;
  std::int16_t duty_active = 0;
  std::int32_t current = 0;
  unsigned why = 0;  ///< bit 4: no offset yet
};

/// What a motor with three phases takes of its encoder, beside the words of commutation.
struct Rotor {
  std::int32_t count = 0;   ///< times the gain an electrical angle
  std::uint32_t angle = 0;  ///< one that is known, 2^-32 electrical turn
};

/// All inputs of a chip: pins, of which each top has some, panel, register port, program, other
/// axes.
using Pins = CoreIn;

/// The control word.
struct Control {
  using C = Map::C;
  std::uint32_t word = 0;
  bool bit(int n) const { return (word >> n & 1) != 0; }
  bool host() const { return bit(C::control_host); }
  bool arm() const { return bit(C::control_arm); }
  int scene() const { return static_cast<int>(word >> C::control_scene & 15); }
  int mode() const { return static_cast<int>(word >> C::control_mode & 3); }
  bool motor_polarity() const { return bit(C::control_motor_polarity); }
  bool encoder_polarity() const { return bit(C::control_encoder_polarity); }
  bool pwm_mode() const { return bit(C::control_pwm_mode); }
  int filter() const { return static_cast<int>(word >> C::control_filter & 15); }
};

/// Of the host, to safety.
struct Commands {
  bool host = false, host_arm = false, disarm = false, host_stop = false, clear_faults = false,
       kick = false;
  int mode = 0;
};

/// From safety.
struct Safe {
  bool armed = false, locks = false, gates_enable = false, gates_clear = false, clear = false,
       arm_request = false, ready = false, unkicked = false, derated = false, testing = false;
  std::int64_t test_torque = 0;
  int test_result = 0;
  std::uint16_t faults = 0;
  int first_fault = 0;
  std::int64_t current_estimate = 0;
};

/// All values of a tick.
struct Values {
  std::uint32_t tick = 0;
  std::int32_t position = 0;
  std::uint32_t status = 0, faults = 0, encoder = 0;
  std::int32_t index = 0;
  int scene = 0;
  std::uint32_t limits = 0;
  std::int64_t velocity = 0, tau_hat = 0, tau_ref = 0, current = 0, voltage = 0, duty = 0;
};

/// A word of the snapshot, as a stream has it.
struct SnapshotWord {
  bool valid = false;
  int place = 0;
  std::uint32_t data = 0;
};

}  // namespace feltgate::axis
