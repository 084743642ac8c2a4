// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Finds the least model of a scene's plant that a hand could not tell from the full one.
// Documentation: docs/trim.md
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "trim/felt.hpp"

namespace feltgate::trim {

struct Options {
  std::string design = "lever";
  double tolerance = 0.01;  ///< of the full model's peak and of its rms, in (0, 1]
  /// What search and final check take of it, since motions that neither saw may lose more.
  double share = 0.75;
  double window_s = 1e-3;    ///< length of the means that are compared
  int full_step_clocks = 5;  ///< of the full model
  int unseen = 4;            ///< motions of the final check, 1 or more
  std::uint64_t seed = 1;    ///< of these motions
  int threads = 2;
  std::function<void(double done)> progress;  ///< called now and then with 0..1; may be empty
};

/// A part of the model that can be left out: "gates" or the name of an effect.
struct PartReport {
  std::string name;
  Difference alone;  ///< what leaving it out changes where everything else stays (see trim())
  double saves = 0;  ///< share of the CPU time of the model that it was left out of
  /// Worst loss of the set with it left out too, or the sum of all alone if that is more; 0 where
  /// that was not tried.
  double so_far = 0;
  bool dropped = false;
  bool put_back = false;  ///< dropped by the search, back after the final check
};

/// A motion of the final check.
struct UnseenReport {
  std::uint64_t seed = 0;
  double amplitude = 1, speed = 1;
  Difference difference;
  bool searched = false;  ///< an effect was put back because of it, so it is unseen no more
};

struct Report {
  Model full, trimmed;
  std::vector<PartReport> parts;  ///< in the order in which they were tried
  Difference own;                 ///< of the trimmed model on the scene's own motion
  std::vector<UnseenReport> unseen;
  Felt full_run, trimmed_run;  ///< on the scene's own motion
  double step_loss = 0;        ///< worst loss of the set in the coarsest step, on the own motion
  int runs = 0;
  double cpu_s = 0;    ///< of all runs together
  bool holds = false;  ///< the trimmed model is within the tolerance on all motions
  bool smaller() const;
};

/// What the scene's full model is: gates, and every effect that the scene does not switch off; of
/// the two frictions `viscous` only where the scene or plant has it. Reads the scene's file.
Model full_model(Scenario scene, const plant::Parameters& plant, int step_clocks);

/// Parts of `model` that are computed for this scene.
std::vector<std::string> parts_of(const Scenario& scene, const Model& model);
void set_part(Model& model, const std::string& part, bool on);

/// Largest loss of `model` over motions made with these seeds, one report each.
std::vector<UnseenReport> check_unseen(const Scenario& scene, const plant::Parameters& plant,
                                       const Model& full, const Model& model,
                                       const Options& options,
                                       const std::vector<std::uint64_t>& seeds);

/// Greedy removal. First the gates; then every effect alone, out of the model that is left; then,
/// the most time saved per loss first, each is left out for good when the set stays within the
/// share of the tolerance on the scene's own motion; then the coarsest step that does. The set is
/// checked on unseen motions against the same; while that fails, a finer step, an effect or the
/// gates are put back: the first with which it holds, or what mends most. Then the check is
/// repeated on fresh motions. Throws as run_scenario does.
Report trim(const Scenario& scene, const plant::Parameters& plant, const Options& options);

}  // namespace feltgate::trim
