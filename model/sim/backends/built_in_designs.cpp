// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Registers the designs of rtl/designs that are not presets; a program that links feltgate_backends
// has them. Documentation: docs/architecture.md
#include "sim/backends/backend.hpp"

namespace feltgate {

#define FELTGATE_DESIGN(name) DesignMakers name##_makers();
#include "designs.inc"
#undef FELTGATE_DESIGN

}  // namespace feltgate

/// scripts/cmake/backends.cmake makes the linker require this symbol, so that this file is linked.
/// It runs before all constructors without a priority, so that a user's global object may name a
/// design.
extern "C" [[gnu::constructor(200)]] void feltgate_built_in_designs();
extern "C" void feltgate_built_in_designs() {
#define FELTGATE_DESIGN(name) feltgate::add_design(feltgate::name##_makers());
#include "designs.inc"
#undef FELTGATE_DESIGN
}
