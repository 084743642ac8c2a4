// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Makes a design with the constants of a plant.
// Documentation: docs/designs.md
#pragma once

#include <string>
#include <vector>

#include "design/design.hpp"
#include "sim/plant/parameters.hpp"
#include "studies/stability/constants.hpp"

namespace feltgate::stability {

/// A design for a plant, not written yet.
struct PlantDesign {
  std::string text;  ///< of the file
  design::Elaborated design;
  std::vector<Constant> changed;   ///< of_design: of the base
  std::vector<std::string> notes;  ///< values that the plant file lacks and the user should check
};

/// The design file `base` with the constants of `plant` and what follows from them: current limit,
/// velocity factor, over-speed, wall. It will be called `path`; `plant_name` is how the user named
/// the plant. Throws config::ConfigError where no working design comes of it: a base with another
/// voltage law than motor_model, a value out of range, an unstable loop.
PlantDesign design_for_plant(const std::string& base, const plant::Parameters& plant,
                             const std::string& plant_name, const std::string& path,
                             const design::RegisterMap& registers);

}  // namespace feltgate::stability
