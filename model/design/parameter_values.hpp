// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the value of every parameter from a design. Documentation: docs/designs.md
#pragma once

#include <map>
#include <string>

#include "design/design.hpp"

namespace feltgate::design {

/// A parameter's value in its unit and the key of the design file that decides it.
struct Value {
  double si;
  const char* key;
};

/// The values by the parameters' names in the register map.
std::map<std::string, Value> parameter_values(const Design& d);

}  // namespace feltgate::design
