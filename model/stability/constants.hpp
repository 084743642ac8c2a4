// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Where the constants of a design and of a plant differ. Documentation: docs/designs.md
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

/// All that design and plant both have; dead voltage and bridge only where they act.
std::vector<Constant> shared_constants(const design::Design& d, const plant::Parameters& plant,
                                       const plant::Effects& effects);

/// Constants further apart than this are told.
constexpr double noticeable = 0.01;

/// Those of `plant` that the voltage law, the observer or the encoder of `d` counts on and that
/// differ noticeably; an effect that is off in `effects` does not count.
std::vector<Constant> differing_constants(const design::Design& d, const plant::Parameters& plant,
                                          const plant::Effects& effects);

}  // namespace feltgate::stability
