// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Error budget of a run: the error of each block's quantisation alone, the error of the
// coefficients, and the total error. Documentation: docs/error-bounds.md
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/loop/figures.hpp"
#include "sim/loop/scene_law.hpp"
#include "sim/reference/real_chain.hpp"
#include "studies/bounds/coverage.hpp"

namespace feltgate::bounds {

/// Errors of one row of the budget.
struct BudgetRow {
  std::string name;  ///< a source (source_bounds), or "whole"
  ErrorFigure velocity_rad_s, tau_hat_nm, tau_ref_nm, current_a;
};

/// Several chains with the same samples. A row of a block compares the chain with only this block
/// in fixed point to real arithmetic with the same coefficients. `coefficients` compares the latter
/// to the reference, `gain` the reference to the exact factor, `whole` the fixed-point chain to the
/// reference.
class Budget : public RealChain {
 public:
  /// The chains that a law runs on: with one block in fixed point (velocity_n, dob, scenes,
  /// torque_control), the three in real arithmetic, the core's own. A law is a scene: it is in
  /// fixed point where scenes are.
  static constexpr std::size_t chains = 8;
  static constexpr bool law_in_fixed(std::size_t chain) { return chain == 2 || chain == 7; }
  /// Sets the torque that the law asks of a chain in the following ticks, Nm.
  virtual void program_chain(std::size_t chain, double torque_nm) = 0;
  /// What a chain measured in the last tick.
  virtual LawSample sample(std::size_t chain) const = 0;

  /// Empties the rows, and excludes from them, from the next tick on, the ticks that `coverage`
  /// rules out.
  virtual void cover(const Coverage& coverage) = 0;
  virtual const Coverage& coverage() const = 0;
  /// Ticks that the row `coefficients` leaves out: it alone also those in which a ramp parts its
  /// two chains by more than its bound.
  virtual std::int64_t outside_coefficients() const = 0;
  virtual const std::vector<BudgetRow>& rows() const = 0;
  /// Largest |N-method velocity| so far, before its low-pass, rad/s.
  virtual double largest_velocity_rad_s() const = 0;
};

/// Makes the budget of a design. Throws std::invalid_argument if the design is not built in.
std::unique_ptr<Budget> make_budget(const std::string& design);

/// Registers a further design for make_budget().
using BudgetMaker = std::unique_ptr<Budget> (*)();
void add_budget(const std::string& design, BudgetMaker make);

}  // namespace feltgate::bounds
