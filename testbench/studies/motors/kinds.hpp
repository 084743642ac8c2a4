// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Kinds of motor and encoder for which a design is made: 48 to 1 000 000 counts in a turn, 3 to
// 60 V, 0.5 to 50 A. Values are typical of their class and no data sheet's.
#pragma once

#include <array>
#include <optional>

#include "sim/plant/parameters.hpp"

namespace feltgate::test {

struct Kind {
  const char* name;  ///< of the design, too
  const char* base;
  double supply_v, nominal_a;
  /// Of three phases: those of a phase, the back-EMF's peak.
  double torque_constant, resistance_ohm, inductance_h, dead_v;
  double inertia_kg_m2, friction_nm;
  int lines;
  int pole_pairs;  ///< 0: brushes
};

inline constexpr std::array<Kind, 13> kinds{{
    {"coin_64", "lever", 3, 0.5, 0.0022, 1.4, 0.3e-3, 0.05, 1.5e-6, 0.15e-3, 16, 0},
    {"hobby_48", "lever", 12, 0.6, 0.0116, 2.1, 1.4e-3, 0.4, 2.1e-5, 0.6e-3, 12, 0},
    {"geared_480", "lever", 12, 0.6, 0.116, 2.1, 1.4e-3, 0.4, 1.5e-4, 6e-3, 120, 0},
    {"printer_400", "lever", 12, 0.9, 0.025, 3.0, 2.0e-3, 0.4, 4e-5, 1.5e-3, 100, 0},
    {"maxon_25", "lever", 24, 1.22, 0.0234, 2.32, 0.238e-3, 0.3, 2.1e-5, 1e-3, 500, 0},
    {"maxon_40", "lever", 24, 5.77, 0.0302, 0.42, 82.3e-6, 0.34, 1.22e-4, 3.5e-3, 1024, 0},
    {"maxon_40_48v", "lever", 48, 3.1, 0.0603, 1.25, 0.33e-3, 0.34, 1.22e-4, 3.5e-3, 2048, 0},
    {"wheel_hub", "lever", 24, 10, 0.45, 0.22, 0.4e-3, 0, 0.012, 0.05, 2048, 0},
    {"wheel_48v", "lever", 48, 8, 0.7, 0.6, 3e-3, 0, 0.008, 0.05, 2500, 0},
    {"traction_60v", "lever", 60, 50, 0.09, 0.05, 0.1e-3, 0, 2e-3, 0.02, 4096, 0},
    {"fine_1e6", "lever", 24, 5.77, 0.0302, 0.42, 82.3e-6, 0.34, 1.22e-4, 3.5e-3, 250'000, 0},
    {"absolute_24v", "lever_absolute", 24, 3.2, 0.0525, 1.1, 0.3e-3, 0.3, 1.5e-4, 3e-3, 4096, 0},
    {"gimbal_12v", "gimbal_motor", 12, 0.9, 0.05, 4.5, 1.5e-3, 0, 3e-5, 0.6e-3, 16384, 7},
}};

inline plant::Parameters plant_of(const Kind& k) {
  plant::Parameters p;
  p.name = k.name;
  if (k.pole_pairs > 0) {
    plant::PhaseParameters phases;
    phases.resistance_ohm = k.resistance_ohm;
    phases.inductance_h = k.inductance_h;
    phases.pole_pairs = k.pole_pairs;
    phases.back_emf_v_s_rad = k.torque_constant;
    p.phases = phases;
    p.motor = phases.as_brushed();
  } else {
    p.motor = {k.torque_constant, k.torque_constant, k.resistance_ohm, k.inductance_h, k.dead_v};
  }
  p.lever = {k.inertia_kg_m2, 0, 0.1};
  p.lugre = {10'000 * k.friction_nm, 5 * k.friction_nm,   1e-6,
             k.friction_nm,          1.3 * k.friction_nm, 0.5};
  p.supply = {k.supply_v, 100, 1e-3, 0.7};
  p.encoder.lines = k.lines;
  p.effects.dead_voltage = k.dead_v > 0;
  return p;
}

}  // namespace feltgate::test
