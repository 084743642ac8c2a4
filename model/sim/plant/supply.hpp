// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A source with a current limit and a bus capacitor; a clamp absorbs what the motor returns above
// the nominal voltage. Documentation: docs/plant.md
#pragma once

#include <algorithm>

#include "parameters.hpp"

namespace feltgate::plant {

/// The bus voltage, step by step.
class Supply {
 public:
  explicit Supply(const SupplyParameters& p) : p_(p), bus_v_(p.voltage_v) {}

  /// Advances the bus by dt_s while the bridge draws `bridge_a`; returns the current of the source,
  /// A (negative: absorbed by the clamp).
  double advance(double bridge_a, double dt_s) {
    const double free_v = bus_v_ + (p_.current_limit_a - bridge_a) * dt_s / p_.bus_capacitance_f;
    const double next_v = std::clamp(free_v, 0.0, p_.voltage_v);
    const double source_a = bridge_a + (next_v - bus_v_) * p_.bus_capacitance_f / dt_s;
    bus_v_ = next_v;
    return std::min(source_a, p_.current_limit_a);
  }

  double bus_v() const { return bus_v_; }

 private:
  SupplyParameters p_;
  double bus_v_;
};

}  // namespace feltgate::plant
