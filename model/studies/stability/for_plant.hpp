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

/// The design file `base` with the constants of `plant` and what follows from them and from the
/// current in A that the motor carries without limit in time: formats, limits, the words of the
/// protections, scenes that fit. It will be called `path`; `plant_name` is how the user named the
/// plant. Throws config::ConfigError or std::invalid_argument where no working design comes of it:
/// a base with another voltage law than motor_model, a motor that cannot move its lever, a value
/// out of range, an unstable loop.
PlantDesign design_for_plant(const std::string& base, const plant::Parameters& plant,
                             double nominal_current_a, const std::string& plant_name,
                             const std::string& path, const design::RegisterMap& registers);

}  // namespace feltgate::stability
