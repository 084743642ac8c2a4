// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds jumps in the speed that a scene's hand imposes. No hand can jump, and the lever's inertia
// turns the jump into a blow. Documentation: docs/plant.md
#pragma once

#include <string>
#include <vector>

#include "scenario.hpp"

namespace feltgate {

/// A sentence for each jump of at least `least_jump_rad_s`: "file:line: how large, when"; the first
/// one also says what to do. A jump from or to a speed that only a run shows, as after a phase
/// "free", is not reported. Valid after resolve_effects().
std::vector<std::string> speed_jumps(const Scenario& scenario, const plant::Parameters& plant);
/// The same for a hand given separately, on a lever of this inertia.
std::vector<std::string> speed_jumps(const Scenario& scenario, const plant::Hand& hand,
                                     double inertia_kg_m2);

constexpr double least_jump_rad_s = 1e-3;

}  // namespace feltgate
