// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/wave/operand_bus.sv, clock by clock: who holds a clock drives it. It computes
// nothing. Documentation: docs/architecture.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Clocked twin; the widths are those of the numbers that are put in.
class OperandBus {
 public:
  struct In {
    std::uint64_t wave = 0;
    // 0 outside their clocks
    std::int64_t velocity_difference = 0, observer_difference = 0, distance = 0, limited = 0;
    // held
    std::int64_t velocity = 0, tau_hat = 0, tau_ref = 0, current_ref = 0, voltage = 0;
    std::int64_t current_estimate = 0;
  };
  struct Out {
    std::int64_t operand = 0, dob = 0, scene = 0, control = 0, supervisor = 0;
    std::int64_t estimate = 0;
    bool is_signed = false;
    bool square_estimate = false;
  };

  /// The registers have no reset; this clears them.
  void reset() { *this = OperandBus{}; }

  /// What is new in its first clock is only selected here; what is older is copied.
  void clock(const In& in) {
    using W = Map::W;
    const auto ahead_of = [&in](int slot) { return ((in.wave >> (slot - 1)) & 1u) != 0; };
    take_velocity_ = ahead_of(W::emf_over_resistance) || ahead_of(W::inertia_gain) ||
                     ahead_of(W::scene_damping) || ahead_of(W::emf_constant);
    take_tau_hat_ = ahead_of(W::observer_gain);
    take_tau_ref_ = ahead_of(W::torque_gain) || ahead_of(W::dead_voltage_slope);
    current_ = ahead_of(W::torque_constant) ? in.current_ref : 0;
    const bool voltage = ahead_of(W::inverse_resistance) || ahead_of(W::voltage_to_current);
    voltage_ = voltage ? in.voltage : 0;
    square_estimate_ = ahead_of(W::current_square);
    estimate_ = square_estimate_ ? in.current_estimate : 0;
  }

  Out peek(const In& in) const {
    const std::int64_t velocity = take_velocity_ ? in.velocity : 0;
    const std::int64_t tau_hat = take_tau_hat_ ? in.tau_hat : 0;
    const std::int64_t tau_ref = take_tau_ref_ ? in.tau_ref : 0;
    Out out;
    out.dob = in.observer_difference | current_ | velocity;
    out.scene = in.distance | velocity;
    out.control = in.limited | tau_hat | tau_ref | voltage_ | velocity;
    out.supervisor = estimate_ | voltage_ | velocity;
    out.operand = in.velocity_difference | out.dob | out.scene | out.control | out.supervisor;
    out.is_signed = take_tau_hat_;
    out.estimate = estimate_;
    out.square_estimate = square_estimate_;
    return out;
  }

 private:
  bool take_velocity_ = false, take_tau_hat_ = false, take_tau_ref_ = false;
  bool square_estimate_ = false;
  std::int64_t current_ = 0, voltage_ = 0, estimate_ = 0;
};

}  // namespace feltgate
