// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The quantities that a hand feels in a run (motor torque, position, force), as short means, and
// the difference of two runs in them. Documentation: docs/trim.md
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/loop/loop.hpp"

namespace feltgate::trim {

/// The simulated effects of a scene's plant, and the step.
struct Model {
  plant::Effects effects;
  bool gates = true;  ///< true: the four gates switch; false: the mean voltage of the duty
  int step_clocks = 5;
};

/// A scene simulated with one model.
struct Felt {
  std::vector<double> torque_nm;     ///< Kt*i, on the lever
  std::vector<double> position_rad;  ///< from where the lever starts
  std::vector<double> force_n;       ///< of the hand
  double simulated_s = 0;
  double cpu_s = 0;  ///< CPU time of the thread that ran it
  std::size_t states = 0;
  plant::Evaluations evaluations;
  std::vector<std::string> broken;  ///< expectations of the scene that do not hold
};

/// Runs `scene` on the twin of `design` with the effects and step of `model`. It takes a mean every
/// `window_s`, weighted by a triangle of twice that length, so that a small shift in time changes a
/// mean only a little. Throws as run_scenario does.
Felt feel(const Scenario& scene, const plant::Parameters& plant, const std::string& design,
          const Model& model, double window_s);

/// Largest and rms difference over the windows, relative to the reference's largest magnitude and
/// rms. A reference below one count, 1 mNm or 10 mN is replaced by that value.
struct Loss {
  double peak = 0, rms = 0;
};

struct Difference {
  Loss torque, position, force;
  /// The largest of the six losses; a tolerance limits it.
  double worst() const;
};

/// `other` against `reference`, two runs of the same length.
Difference compare(const Felt& reference, const Felt& other);

}  // namespace feltgate::trim
