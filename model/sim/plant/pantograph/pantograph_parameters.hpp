// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Constants of a pantograph in SI units: linkage, joints, stops, and two equal motors.
// Documentation: docs/devices/pantograph.md
#pragma once

#include <string>

#include "../axes_parameters.hpp"
#include "linkage_mechanics.hpp"

namespace feltgate::plant {

/// Constants of a pantograph.
struct PantographParameters : AxesParameters {
  std::string name;
  LinkageGeometry linkage;
  LinkageBodies bodies;  ///< includes joint_inertia_kg_m2
  AngleStops stops;      ///< of theta5 - theta1
  Vec2 start_m;          ///< pen at clock 0, unless the hand gives a start
};

// Reader of vectors/devices/NAME.toml for pantographs.

/// Reads and checks a pantograph; every key is required, unknown keys are errors.
/// Errors: config::ConfigError "file:line: what; mend".
PantographParameters read_pantograph_file(const std::string& path);
/// The same from a text; errors name it `path`.
PantographParameters read_pantograph_text(const std::string& text, const std::string& path);

}  // namespace feltgate::plant
