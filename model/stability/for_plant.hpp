// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A design and a plant: where their constants differ, and the design that has the plant's.
// Documentation: docs/designs.md
#pragma once

#include <string>
#include <vector>

#include "design/design.hpp"
#include "plant/parameters.hpp"

namespace feltgate::stability {

/// A constant that design and plant both have.
struct Constant {
  std::string name, unit;
  std::string key;  ///< "section.key" of the design file
  double of_design = 0, of_plant = 0;
  /// The plant's against the design's, 0.1: a tenth more. Infinite where the design has 0.
  double excess() const;
};

/// Constants further apart than this are told.
constexpr double noticeable = 0.01;

/// Those of `plant` that the voltage law, the observer or the encoder of `d` counts on and that
/// differ noticeably; an effect that is off in `effects` does not count.
std::vector<Constant> differing_constants(const design::Design& d, const plant::Parameters& plant,
                                          const plant::Effects& effects);

/// A design for a plant, not written yet.
struct PlantDesign {
  std::string text;  ///< of the file
  design::Elaborated design;
  std::vector<Constant> changed;   ///< of_design: of the base
  std::vector<std::string> notes;  ///< what a plant file does not say and a user should look at
};

/// The design file `base` with the constants of `plant` and what follows from them: current limit,
/// velocity factor, over-speed, wall. It will be called `path`; `plant_name` is how the user named
/// the plant. Throws config::ConfigError where no working design comes of it: a base with another
/// voltage law than motor_model, a value out of range, an unstable loop.
PlantDesign design_for_plant(const std::string& base, const plant::Parameters& plant,
                             const std::string& plant_name, const std::string& path,
                             const design::RegisterMap& registers);

}  // namespace feltgate::stability
