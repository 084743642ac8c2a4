// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Registers the Verilated cores of the built-in designs.
// Documentation: docs/architecture.md
#include <memory>
#include <stdexcept>
#include <string>

#include "sim/backends/backend.hpp"

namespace feltgate {

#define FELTGATE_DESIGN(name) std::unique_ptr<Backend> make_##name##_rtl(const std::string&);
#include "designs.inc"
#undef FELTGATE_DESIGN

namespace {

std::unique_ptr<Backend> make_rtl(const std::string& design, const std::string& kind) {
#define FELTGATE_DESIGN(name) \
  if (design == #name) return make_##name##_rtl(kind);
#include "designs.inc"
#undef FELTGATE_DESIGN
  throw std::logic_error("no Verilated core of design " + design);  // make_backend() requested it
}

}  // namespace
}  // namespace feltgate

/// scripts/cmake/rtl.cmake makes the linker require this symbol, so that this file is linked.
extern "C" {
extern const bool feltgate_rtl_backends;
const bool feltgate_rtl_backends = [] {
  feltgate::provide_rtl_backends(feltgate::make_rtl);
  return true;
}();
}
