// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The extension module feltgate._designs, which _core loads. Documentation: docs/python.md
#include <pybind11/pybind11.h>

#include <vector>

#include "sim/backends/backend.hpp"

namespace feltgate::python {

#define FELTGATE_DESIGN(name) DesignMakers name##_makers();
#include "extra_designs.inc"
#undef FELTGATE_DESIGN

PYBIND11_MODULE(_designs, m) {
  static const std::vector<DesignMakers> all{
#define FELTGATE_DESIGN(name) name##_makers(),
#include "extra_designs.inc"
#undef FELTGATE_DESIGN
  };
  m.attr("makers") = pybind11::capsule(&all);
}

}  // namespace feltgate::python
