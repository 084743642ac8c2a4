// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The error budget of a scene, of one axis or several: all its chains run beside the twin in closed
// loop, on the twin's counts. Documentation: docs/error-bounds.md
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "design/design.hpp"
#include "sim/axes_loop/axes_scene.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/loop/scene_law.hpp"
#include "sim/loop/session.hpp"
#include "studies/budget/budget.hpp"

namespace feltgate::bounds {

/// One row of the table: largest error, rms error, and proven bound (infinity: none).
struct BudgetLine {
  SourceBound max, rms, bound;
  bool holds() const;
};

struct SceneBudget {
  /// velocity_n, dob, scenes (law: of a scene with a law), torque_control, coefficients
  std::vector<BudgetLine> sources;
  BudgetLine sum;    ///< of the largest errors above, and of their bounds; no rms
  BudgetLine whole;  ///< core against reference, with the theorem's bound
  BudgetLine gain;   ///< 2^n against the exact factor; not in the whole
  std::int64_t ticks = 0;
  std::int64_t ticks_out_of_bounds = 0;        ///< in no row: ramps, saturation and what follows
  std::int64_t ticks_out_of_coefficients = 0;  ///< not in the row `coefficients`
  double largest_velocity_rad_s = 0;           ///< before the low-pass: the bounds' region
  std::int64_t ticks_apart = 0;  ///< of all axes: the core's own chain was not the core; an error

  /// Whether no measured error exceeds its bound.
  bool within_bounds() const;
  bool holds() const { return ticks_apart == 0 && within_bounds(); }
};

struct BudgetOptions {
  SceneLaw* law = nullptr;
  std::uint64_t seed = 1;
  std::function<void(double done)> progress;  ///< called occasionally with 0..1; may be empty
};

/// The chains of all axes beside a run, each with the law on its own measurements.
class BudgetRun : public Passenger {
 public:
  /// All must outlive this; law: nullptr for a scene without one. Throws std::invalid_argument for
  /// a scene or parameter that the design does not have.
  BudgetRun(const design::Elaborated& e, const Scenario& scenario, SceneLaw* law, std::size_t axes);
  void begin() override;
  void set_parameter(std::size_t axis, int address, double value) override;
  void tick(const Snapshot* axes, const ChainIn* in) override;
  /// The budget of an axis since begin().
  SceneBudget budget(std::size_t axis) const;

 private:
  /// The law in the numbers of these chains, on the measurements of the first.
  struct Rider {
    std::unique_ptr<LawRider> law;
    std::vector<std::size_t> chains;
  };

  const design::Elaborated& e_;
  const Scenario& scenario_;
  const SceneLaw* law_;
  int law_scene_;
  std::vector<Coverage> coverage_;
  std::vector<std::unique_ptr<Budget>> axes_;
  std::vector<Rider> riders_;
  bool entered_ = false;
  std::int64_t changes_ = 1;  ///< parameter sets that the riders know; loading is the first
  std::int64_t apart_ = 0;
};

/// Computes the budget. Throws std::invalid_argument for a scene or parameter that the design does
/// not have.
SceneBudget scene_budget(const design::Elaborated& e, const Scenario& scenario,
                         const plant::Parameters& plant, const BudgetOptions& options);
/// The same for each axis of a device, with the law of the scene. Errors: those of run_axes().
std::vector<SceneBudget> scene_budgets(const design::Elaborated& e, const AxesScene& scene,
                                       const BudgetOptions& options);

}  // namespace feltgate::bounds
