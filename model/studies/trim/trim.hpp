// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds the smallest model of a scene's plant that a hand cannot distinguish from the full one.
// Documentation: docs/speed-for-accuracy.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "studies/trim/subject.hpp"

namespace feltgate::trim {

/// A removable part of the model: "gates" or the name of an effect.
struct PartReport {
  std::string name;
  Difference alone;  ///< difference when only this part is removed (see trim())
  double saves = 0;  ///< saved share of the CPU time of the model with the part
  /// Worst loss of the set after this removal, or the sum of all single losses if larger; 0 if not
  /// tried.
  double so_far = 0;
  bool dropped = false;
  bool put_back = false;  ///< removed by the search, restored by the final check
};

/// A motion of the final check.
struct UnseenReport {
  std::uint64_t seed = 0;
  double amplitude = 1, speed = 1;
  Difference difference;
  bool searched =
      false;  ///< an effect was restored because of it, so it no longer counts as unseen
};

struct Report {
  Model full, trimmed;
  std::vector<PartReport> parts;  ///< in the order in which they were tried
  Difference own;                 ///< of the trimmed model on the scene's own motion
  std::vector<UnseenReport> unseen;
  Felt full_run, trimmed_run;  ///< on the scene's own motion; cpu_s is the median of timed_runs
  /// CPU time of the full model over that of the trimmed one, one run after the other; ascending.
  std::vector<double> faster;
  double step_loss = 0;  ///< worst loss of the set in the coarsest step, on the own motion
  int runs = 0;
  double cpu_s = 0;          ///< of all runs together
  bool out_of_time = false;  ///< longest_s was over: nothing is left out
  bool holds = false;        ///< the trimmed model is within the tolerance on all motions
  bool smaller() const;      ///< something is left out, or the step is coarser
  /// The median of `faster`.
  double times_faster() const { return faster[faster.size() / 2]; }
};

/// Greedy removal. First the gates; then every effect alone, out of the model that is left; then,
/// the least loss first, each is left out for good when the set stays within the share of the
/// tolerance on the scene's own motion; then the coarsest step that does. The set is
/// checked on unseen motions against the same; while that fails, a finer step, an effect or the
/// gates are put back: the first with which it holds, or what mends most. Then the check is
/// repeated on fresh motions. Throws as run_scenario does.
Report trim(const Subject& subject, const Options& options);

/// Text of the scene file `scene.path` with bridge, step and effects of `model`, and the plant that
/// scene.plant names; of a device with the effects alone. The rest of the text is unchanged, but
/// recordings and laws in the original's folder get their full path. `comment` comes first, with #
/// before each line.
std::string scene_text(const Scenario& scene, const Model& model, const std::string& comment);

}  // namespace feltgate::trim
