// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Registry of the error budgets of the designs that were built in.
// Documentation: docs/error-bounds.md
#include "studies/budget/budget.hpp"

#include <map>
#include <stdexcept>

namespace feltgate::bounds {

namespace {

std::map<std::string, BudgetMaker>& further_budgets() {
  static std::map<std::string, BudgetMaker> list;
  return list;
}

}  // namespace

void add_budget(const std::string& design, BudgetMaker make) { further_budgets()[design] = make; }

#define FELTGATE_DESIGN(name) std::unique_ptr<Budget> make_##name##_budget();
#include "designs.inc"
#undef FELTGATE_DESIGN

std::unique_ptr<Budget> make_budget(const std::string& design) {
#define FELTGATE_DESIGN(name) \
  if (design == #name) return make_##name##_budget();
#include "designs.inc"
#undef FELTGATE_DESIGN
  const auto further = further_budgets().find(design);
  if (further != further_budgets().end()) return further->second();
  throw std::invalid_argument("design \"" + design + "\" is not built in; run `feltgate generate`");
}

}  // namespace feltgate::bounds
