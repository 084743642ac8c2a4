// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Registry of the error budgets of the designs that were built in.
// Documentation: docs/error-bounds.md
#include "budget/budget.hpp"

#include <stdexcept>

namespace feltgate::bounds {

#define FELTGATE_DESIGN(name) std::unique_ptr<Budget> make_##name##_budget();
#include "designs.inc"
#undef FELTGATE_DESIGN

std::unique_ptr<Budget> make_budget(const std::string& design) {
#define FELTGATE_DESIGN(name) \
  if (design == #name) return make_##name##_budget();
#include "designs.inc"
#undef FELTGATE_DESIGN
  throw std::invalid_argument("design \"" + design + "\" is not built in; run `feltgate generate`");
}

}  // namespace feltgate::bounds
