// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Generated from rtl/registers.toml by
// `feltgate generate`: do not edit. What holds the torque back and what closes the
// gates, by bit and by name.
#pragma once

#include <array>
#include <cstdint>

namespace feltgate {

/// Bits of Snapshot::limits: which limit holds the torque now.
namespace limit {
constexpr unsigned torque = 1;  ///< torque reference at its limit
constexpr unsigned ramp = 2;  ///< ramping: after arming, a change of scene, or what could have made the torque jump
constexpr unsigned current = 4;  ///< current reference at its limit
constexpr unsigned voltage = 8;  ///< voltage at the end of the window around the back-EMF; without a current loop tau_hat is void, for the motor gives less than it counts on
constexpr unsigned duty = 16;  ///< duty at its limit; without a current loop tau_hat is void, as above
constexpr unsigned velocity = 32;  ///< the raw velocity saturated its format
constexpr unsigned tau_hat = 64;  ///< tau_hat saturated its format
constexpr unsigned gates_closed = 128;  ///< the gates are off
constexpr unsigned hold = 256;  ///< a torque was held for too long: the limit is hold_limit, or torque_limit if that is less
constexpr unsigned chatter = 512;  ///< the count alternates on one edge: the torque reference does not grow
/// By the number of the bit.
inline constexpr std::array<const char*, 10> names{
    "torque",
    "ramp",
    "current",
    "voltage",
    "duty",
    "velocity",
    "tau_hat",
    "gates_closed",
    "hold",
    "chatter"};
}  // namespace limit

/// Numbers of the causes, as in first_fault and as bits of faults.
enum class Fault : std::uint8_t {
  none = 0,
  encoder = 1,  ///< too many illegal transitions; of an absolute encoder or Hall lines what faults.absolute says
  speed = 2,  ///< |w| above the limit
  polarity = 3,  ///< the speed grows against the commanded current
  i2t = 4,  ///< estimated current above nominal for too long
  watchdog = 5,  ///< the host is silent
  stop = 6,  ///< external stop
  self_test = 7,  ///< the lever answered the pulse of the self-test the wrong way, or was held or moved where the design does not arm then
  channel = 8,  ///< one channel of the encoder is dead
  tick = 9,  ///< the ticks stand still
  index = 10,  ///< the count at the index does not fit a revolution
  word = 11,  ///< a parameter, a held control bit or the position has changed by itself
  jump = 12,  ///< the velocity moved by more than its filter can
  engine = 13,  ///< the engine is late: no fresh torque within its time, in the scene law
  axis = 14,  ///< another axis has a fault
  current = 15,  ///< of a current loop: over-current, the driver's own fault, or the sensor fails; faults.current, status.driver_fault and status.current_missing say which
};
/// Its bit of faults.
constexpr std::uint16_t fault_bit(Fault cause) {
  return static_cast<std::uint16_t>(1U << static_cast<unsigned>(cause));
}
/// By the number of the cause.
inline constexpr std::array<const char*, 16> fault_names{
    "none",
    "encoder",
    "speed",
    "polarity",
    "i2t",
    "watchdog",
    "stop",
    "self_test",
    "channel",
    "tick",
    "index",
    "word",
    "jump",
    "engine",
    "axis",
    "current"};

}  // namespace feltgate
