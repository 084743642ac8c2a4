// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Error bounds of a whole run: the worst over the scenes, modes and parameters that it goes
// through. Documentation: docs/error-bounds.md
#pragma once

#include "bounds/coverage.hpp"
#include "bounds/error_bounds.hpp"
#include "loop/scenario.hpp"
#include "loop/scene_law.hpp"

namespace feltgate {

/// Scenes, modes and parameter values of a run, one after the other.
class RunBounds {
 public:
  /// From the values of the design; |N-method velocity| up to velocity_rad_s, 0: all of the format.
  RunBounds(const design::Elaborated& e, double velocity_rad_s);
  /// The scene law runs this one; none: its torque is without a bound.
  void run_law(const SceneLaw* law);
  /// From now on this scene and mode. Throws std::invalid_argument for a scene not built in.
  void render(const std::string& scene, int mode);
  /// From now on this value. In the middle of a run no bound survives a change of a filter.
  void set(const std::string& parameter, double value, bool in_the_middle);

  const bounds::ErrorBounds& worst() const { return worst_; }
  /// The bounds of each source alone, likewise.
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

/// Smaller than any velocity that is not 0: a region for what must not depend on the motion.
constexpr double hardly_any_rad_s = 1e-9;

/// Of a scene file on a design.
RunBounds scenario_bounds(const design::Elaborated& e, const Scenario& scenario,
                          double velocity_rad_s = 0, const SceneLaw* law = nullptr);

}  // namespace feltgate
