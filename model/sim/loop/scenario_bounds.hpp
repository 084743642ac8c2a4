// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Error bounds of a whole run: the worst over the scenes, modes and parameters that occur in it.
// Documentation: docs/error-bounds.md
#pragma once

#include <string>

#include "loop.hpp"
#include "replay.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/loop/scene_law.hpp"
#include "studies/bounds/coverage.hpp"
#include "studies/bounds/error_bounds.hpp"

namespace feltgate {

/// The scenes, modes and parameter values of a run, in order.
class RunBounds {
 public:
  /// Starts with the design's values. |N-method velocity| stays below velocity_rad_s; 0: any in
  /// format.
  RunBounds(const design::Elaborated& e, double velocity_rad_s);
  /// The law that the scene law runs on this axis; nullptr: its torque has no bound.
  void run_law(const SceneLaw* law, std::size_t axis);
  /// Scene and mode from now on. Errors: std::invalid_argument for a scene that is not built in.
  void render(const std::string& scene, int mode);
  /// A parameter's value from now on. A change of a filter in the middle of a run voids all bounds.
  void set(const std::string& parameter, double value, bool in_the_middle);

  const bounds::ErrorBounds& worst() const { return worst_; }
  /// The worst bounds of each error source alone.
  const std::vector<bounds::SourceBound>& sources() const { return sources_; }

 private:
  void add();

  const SceneLaw* law_ = nullptr;
  bounds::ChainNumbers numbers_;
  bounds::InputRegion region_;
  bounds::ErrorBounds worst_;
  std::vector<bounds::SourceBound> sources_;
  bool started_ = false, lost_ = false;
};

/// Smaller than any velocity other than 0: a region for results that must not depend on the motion.
constexpr double hardly_any_rad_s = 1e-9;

/// The bounds of a scene file on a design, for one axis.
RunBounds scenario_bounds(const design::Elaborated& e, const Scenario& scenario,
                          double velocity_rad_s = 0, const SceneLaw* law = nullptr,
                          std::size_t axis = 0);

// Runs a scene or a recording and compares its errors with their proven bounds.

namespace design {
struct Elaborated;
}

/// Runs a scene and computes the bounds for its motion. `felt` gets the errors of the core,
/// `broken` each error that exceeds its bound in a tick for which the bound holds. Sets
/// `options.coverage`. `e` is the design `options.design`. Without quad beside the core nothing is
/// compared.
RunResult run_within_bounds(const design::Elaborated& e, const Scenario& scenario,
                            const plant::Parameters& plant, RunOptions options);

/// The same for a recording.
RunResult replay_within_bounds(const design::Elaborated& e, EncoderSource& source,
                               const std::string& subject, ReplayOptions options);

/// Whether this is an engine in fixed point, whose errors have bounds.
bool is_core(const BackendFigures& e);

}  // namespace feltgate
