// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds constants that differ between a design and a plant. Documentation: docs/designs.md
#pragma once

#include <string>
#include <vector>

#include "design/design.hpp"
#include "sim/plant/parameters.hpp"

namespace feltgate::stability {

/// A constant that design and plant both have.
struct Constant {
  std::string name, unit;
  std::string key;  ///< "section.key" of the design file
  double of_design = 0, of_plant = 0;
  /// Relative excess of the plant's value over the design's (0.1: a tenth more). Infinite if the
  /// design has 0.
  double excess() const;
};

/// All constants that design and plant share; dead voltage and bridge only if they act.
std::vector<Constant> shared_constants(const design::Design& d, const plant::Parameters& plant,
                                       const plant::Effects& effects);

/// Relative difference above which a constant is reported.
constexpr double noticeable = 0.01;

/// The constants of `plant` on which voltage law, observer or encoder of `d` depend and that differ
/// noticeably; effects that are off in `effects` are ignored.
std::vector<Constant> differing_constants(const design::Design& d, const plant::Parameters& plant,
                                          const plant::Effects& effects);

}  // namespace feltgate::stability
