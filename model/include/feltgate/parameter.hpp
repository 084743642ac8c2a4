// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One parameter of a design as the generated headers list it. Documentation: docs/registers.md
#pragma once

#include <cstdint>

#include "feltgate/format.hpp"

namespace feltgate {

/// Name, unit, place and value of a parameter.
struct ParameterInfo {
  const char* name;
  const char* unit;
  int address;       ///< word address in the parameter RAM
  Format format;     ///< format of the word
  double si;         ///< exact value that the design states, in `unit`
  std::int64_t raw;  ///< the same value, quantised
};

}  // namespace feltgate
