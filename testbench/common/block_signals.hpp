// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Structs of package cfg at a block's ports as the twins have them. docs/testing.md
#pragma once

#include "feltgate/axis/signals.hpp"

namespace feltgate::test {

template <class S>
axis::Tick tick_of(const S& s) {
  return {s.clock, s.sample, s.velocity, s.tau_hat, s.scene, s.tau_ref, s.duty, s.last, s.count};
}
template <class S>
axis::Position position_of(const S& s) {
  return {s.position,       s.count,          static_cast<std::uint16_t>(s.travel),
          s.moved,          s.chatters,       s.illegal,
          s.error,          s.error_count,    s.rejected_count,
          s.index_position, s.polarity_holds, s.trip_channel,
          s.trip_index,     s.trip_flip,      static_cast<unsigned>(s.why)};
}
template <class S>
axis::Bridge bridge_of(const S& s) {
  return {s.measured, s.period_start, s.duty_active, s.current, static_cast<unsigned>(s.why)};
}
template <class S>
axis::Commands commands_of(const S& s) {
  return {s.host, s.host_arm, s.disarm, s.host_stop, s.clear_faults, s.kick, s.mode};
}
template <class S>
axis::Safe safe_of(const S& s) {
  return {s.armed,       s.locks,       s.gates_enable, s.gates_clear, s.clear,
          s.arm_request, s.ready,       s.unkicked,     s.derated,     s.testing,
          s.test_torque, s.test_result, s.faults,       s.first_fault, s.current_estimate};
}
template <class S>
axis::Values values_of(const S& s) {
  return {s.tick,     static_cast<std::int32_t>(s.position),
          s.status,   s.faults,
          s.encoder,  static_cast<std::int32_t>(s.index),
          s.scene,    s.limits,
          s.velocity, s.tau_hat,
          s.tau_ref,  s.current,
          s.voltage,  s.duty};
}

}  // namespace feltgate::test
