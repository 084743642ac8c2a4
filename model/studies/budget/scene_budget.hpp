// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The error budget of a scene: its motion is recorded once in closed loop, then replayed open loop
// through all chains of the budget. Documentation: docs/error-bounds.md
#pragma once

#include <functional>
#include <vector>

#include "sim/loop/loop.hpp"
#include "sim/loop/scenario_bounds.hpp"
#include "studies/budget/budget.hpp"

namespace feltgate::bounds {

/// One row of the table: largest error, rms error, and proven bound (infinity: none).
struct BudgetLine {
  SourceBound max, rms, bound;
  bool holds() const;
};

struct SceneBudget {
  std::vector<BudgetLine> sources;  ///< velocity_n, dob, scenes, torque_control, coefficients
  BudgetLine sum;                   ///< of the largest errors above, and of their bounds; no rms
  BudgetLine whole;                 ///< core against reference, with the theorem's bound
  BudgetLine gain;                  ///< 2^n against the exact factor; not in the whole
  std::int64_t ticks = 0;
  std::int64_t ticks_out_of_bounds = 0;  ///< in no row: ramps, saturation and what follows
  double largest_velocity_rad_s = 0;     ///< before the low-pass: the bounds' region

  /// Whether no measured error exceeds its bound.
  bool holds() const;
};

/// Computes the budget. Throws std::invalid_argument for a scene or parameter that the design does
/// not have. `progress` is called occasionally with 0..1; it may be empty.
SceneBudget scene_budget(const design::Elaborated& e, const Scenario& scenario,
                         const plant::Parameters& plant, std::uint64_t seed,
                         const std::function<void(double)>& progress);

}  // namespace feltgate::bounds
