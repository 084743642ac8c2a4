// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Error budget of a run: the error that each block's quantisation makes alone, that of the
// coefficients, and the whole. Documentation: docs/error-bounds.md
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bounds/coverage.hpp"
#include "loop/figures.hpp"
#include "reference/real_chain.hpp"

namespace feltgate::bounds {

/// Errors of one row of the budget.
struct BudgetRow {
  std::string name;  ///< a source (source_bounds), or "whole"
  ErrorFigure velocity_rad_s, tau_hat_nm, tau_ref_nm, current_a;
};

/// Several chains that see the same samples. Rows compare blocks in fixed point, one at a time,
/// with real arithmetic and the same coefficients; `coefficients` that with the reference; `gain`
/// the reference with the exact factor; `whole` the fixed-point chain with the reference.
class Budget : public RealChain {
 public:
  /// Ticks that the coverage rules out count in no row, from the next tick on.
  virtual void cover(const Coverage& coverage) = 0;
  virtual const Coverage& coverage() const = 0;
  virtual const std::vector<BudgetRow>& rows() const = 0;
  /// Largest |N-method velocity| before its low-pass so far, rad/s.
  virtual double largest_velocity_rad_s() const = 0;
};

/// Throws std::invalid_argument for a design that is not built in.
std::unique_ptr<Budget> make_budget(const std::string& design);

/// A design that is not among those: make_budget() knows it from now on.
using BudgetMaker = std::unique_ptr<Budget> (*)();
void add_budget(const std::string& design, BudgetMaker make);

}  // namespace feltgate::bounds
