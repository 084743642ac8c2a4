// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Numbers of the Haptic Lever and of its motor, for the claims about it. Documentation:
// docs/claims.md
#pragma once

#include <algorithm>

#include "studies/claims/claims.hpp"

namespace feltgate::claims {

// The paper's.
inline constexpr double m1 = 386, tick_s = 1e-6, count_rad = 2 * pi / 4096, cutoff_rad_s = 500;
inline constexpr double ktn = 0.0605, jn = 4.896e-4, kp = 1600, limit_nm = 0.5, source_a = 7;
// Of the motor with the 24 V winding, its wiring and its brushes: vectors/plants/p24.toml.
inline constexpr double kt = 0.0302, ohm = 0.42, brush_v = 0.34, supply_v = 24;
inline constexpr double coulomb_nm = 3.5e-3, inertia_kg_m2 = 1.22e-4;

/// The motor's torque for a voltage at rest.
inline double torque_of(double volt) { return (volt - brush_v) * kt / ohm; }
/// In per cent of what was asked for, with Kv on the current of the reference.
inline double error_pct(double kv, double tau_nm) {
  return 100 * (torque_of(kv * tau_nm / ktn) / tau_nm - 1);
}

/// Mean and rms about it of a signal.
struct Mean {
  double sum = 0, squares = 0;
  std::size_t count = 0;
  void add(double x) { sum += x, squares += x * x, ++count; }
  double mean() const { return count == 0 ? none : sum / static_cast<double>(count); }
  double rms() const {
    if (count == 0) return none;
    return std::sqrt(std::max(0.0, squares / static_cast<double>(count) - mean() * mean()));
  }
};

inline Event set_at(double at_s, const std::string& parameter, double value) {
  Event e;
  e.at_s = at_s;
  e.set = {{parameter, value}};
  return e;
}

std::vector<Source> haptic_lever_torque();

}  // namespace feltgate::claims
