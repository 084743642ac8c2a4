// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Gives design_named() the designs that this library was built with. Documentation:
// docs/architecture.md
#include "design/info.hpp"
#include "sim/backends/backend.hpp"

/// scripts/cmake/backends.cmake makes the linker require this symbol, so that this file is linked.
/// It runs before all constructors without a priority, so that a user's global object may name a
/// design.
extern "C" [[gnu::constructor(200)]] void feltgate_shipped_designs();
extern "C" void feltgate_shipped_designs() {
  feltgate::set_design_source({[](const std::string& name) {
                                 return feltgate::design::info_of(
                                     feltgate::design::design_named(name));
                               },
                               feltgate::design::shipped_names});
}
