// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Where the hand of a scene imposes a speed that jumps: no hand does, and the lever's inertia makes
// a blow of it. Documentation: docs/plant.md
#pragma once

#include <string>
#include <vector>

#include "scenario.hpp"

namespace feltgate {

/// A sentence for each jump from `least_jump_rad_s` on, "file:line: how large, when", the first
/// with what to do. A jump from or to a speed that only a run shows, as after a phase "free", is
/// not told. Valid after resolve_effects().
std::vector<std::string> speed_jumps(const Scenario& scenario, const plant::Parameters& plant);
/// The same of a hand that stands elsewhere than in the scenario, on a lever of this inertia.
std::vector<std::string> speed_jumps(const Scenario& scenario, const plant::Hand& hand,
                                     double inertia_kg_m2);

constexpr double least_jump_rad_s = 1e-3;

}  // namespace feltgate
