// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Designs that are not in rtl/designs but were given to the build of the Python package
// (FELTGATE_EXTRA_DESIGNS). Documentation: docs/python.md
#pragma once

#include "engines/engine.hpp"

namespace feltgate::python {

#define FELTGATE_DESIGN(name) DesignMakers name##_makers();
#include "extra_designs.inc"
#undef FELTGATE_DESIGN

/// Makes them known to make_engine() and make_real_chain(); returns their names.
inline std::vector<std::string> add_extra_designs() {
  std::vector<std::string> names;
#define FELTGATE_DESIGN(name)  \
  add_design(name##_makers()); \
  names.emplace_back(#name);
#include "extra_designs.inc"
#undef FELTGATE_DESIGN
  return names;
}

}  // namespace feltgate::python
