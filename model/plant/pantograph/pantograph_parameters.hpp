// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Constants of a pantograph: linkage, joints, stops and two motors alike, in SI units.
// Documentation: docs/pantograph.md
#pragma once

#include <string>

#include "../axes_parameters.hpp"
#include "linkage_mechanics.hpp"

namespace feltgate::plant {

struct PantographParameters : AxesParameters {
  std::string name;
  LinkageGeometry linkage;
  LinkageBodies bodies;  ///< joint_inertia_kg_m2 included
  AngleStops stops;      ///< of theta5 - theta1
  Vec2 start_m;          ///< of the pen at clock 0, unless a hand says otherwise
};

}  // namespace feltgate::plant
