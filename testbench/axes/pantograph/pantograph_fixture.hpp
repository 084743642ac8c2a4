// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Shared by the tests of the pantograph. docs/devices/pantograph.md
#pragma once

#include <cmath>
#include <fstream>
#include <string>

#include "../../sim/plant/plant_fixture.hpp"
#include "sim/plant/pantograph/pantograph.hpp"

namespace feltgate::plant {

inline constexpr double kDegree = 3.14159265358979323846 / 180.0;

inline std::string linkage_file(const std::string& name) {
  return std::string(FELTGATE_SOURCE_DIR) + "/vectors/devices/" + name + ".toml";
}
inline PantographParameters pantograph() {
  return read_pantograph_file(linkage_file("pantograph"));
}

/// Four different links and separate motor axes, so that no terms cancel.
inline LinkageGeometry uneven() { return {0.03, 0.09, 0.12, 0.11, 0.08}; }
inline LinkageBodies uneven_bodies() {
  return {{0.02, 0.04, 1.1e-5},
          {0.015, 0.07, 2.3e-5},
          {0.03, 0.05, 1.7e-5},
          {0.01, 0.03, 0.6e-5},
          0.025,
          {3e-5, 5e-5}};
}
inline constexpr AngleStops kFarStops{-100.0, 100.0, 1.0, 1.0};

/// Mechanics without friction, motor inertia and losses in the stops.
inline LinkageMechanics frictionless(const AngleStops& stops) {
  const PantographParameters p = pantograph();
  return {p.linkage, p.bodies, stops};
}

}  // namespace feltgate::plant
