// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What a hand feels of a run: motor torque, position and force as short means, and how
// far two runs are apart in them. Documentation: docs/trim.md
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "loop/loop.hpp"

namespace feltgate::trim {

/// What is simulated of a scene's plant, and in which steps.
struct Model {
  plant::Effects effects;
  bool gates = true;  ///< the four gates; off: the duty in force, as a mean
  int step_clocks = 5;
};

/// A scene simulated with one model.
struct Felt {
  std::vector<double> torque_nm;     ///< Kt*i, on the lever
  std::vector<double> position_rad;  ///< from where the lever starts
  std::vector<double> force_n;       ///< of the hand
  double simulated_s = 0;
  double cpu_s = 0;  ///< of the thread that ran it
  std::size_t states = 0;
  plant::Evaluations evaluations;
  std::vector<std::string> broken;  ///< expectations of the scene that do not hold
};

/// Runs `scene` on the twin of `design` with the effects and steps of `model`. A mean is taken
/// every `window_s`, weighted by a triangle of twice that length, so that what moves a little moves
/// a mean a little. Throws as run_scenario does.
Felt feel(const Scenario& scene, const plant::Parameters& plant, const std::string& design,
          const Model& model, double window_s);

/// Largest and rms difference over the windows, as shares of the reference's largest magnitude and
/// rms. A reference below one count, 1 mNm or 10 mN counts as that much.
struct Loss {
  double peak = 0, rms = 0;
};

struct Difference {
  Loss torque, position, force;
  /// The largest of the six; this is what a tolerance bounds.
  double worst() const;
};

/// `other` against `reference`, two runs of the same length.
Difference compare(const Felt& reference, const Felt& other);

}  // namespace feltgate::trim
