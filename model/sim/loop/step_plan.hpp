// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lengths of the plant's steps: while nothing happens, a step lasts from event to event.
// Documentation: docs/plant.md
#pragma once

#include <algorithm>
#include <vector>

#include "../backends/backend.hpp"
#include "../plant/parameters.hpp"
#include "scenario.hpp"

namespace feltgate {

/// The longest step, in clocks, with which every pole of the scene is at most a tenth of its bound;
/// scenario.step_clocks if no longer one is possible.
int longest_step_clocks(const Scenario& scenario, const plant::Parameters& plant, double clock_hz);

/// The part of a scene from which the steps of a plant in a hand follow; the effects are the
/// plant's.
Scenario scene_of(const plant::Parameters& plant, const plant::Hand& hand);

/// Decides where each step ends. It depends only on time and on the scene, never on a back-end, so
/// all back-ends give the same run.
class StepPlan {
 public:
  /// Equal steps of `step` clocks.
  explicit StepPlan(Clock step) : fine_(step) {}
  /// For a duty that holds for `period` clocks from each multiple of `period`: steps end `fine`
  /// clocks after the duty can change; between two such ends they are equal and at most `longest`.
  StepPlan(Clock fine, Clock longest, Clock period);
  /// The same for a scene, on a design.
  StepPlan(const Scenario& scenario, const plant::Parameters& plant, const DesignInfo& design);

  /// From `now` on, for `clocks` clocks, something may happen at any time: use steps of `fine`
  /// clocks.
  void stir(Clock now, Clock clocks) { stirred_until_ = std::max(stirred_until_, now + clocks); }

  /// End of the step that starts at `now`; not after `last`. `corner` is later than `now`: its
  /// effects start at the first multiple of `fine` from there on, and the steps around it are fine
  /// ones.
  Clock end_of_step(Clock now, Clock corner, Clock last) {
    if (ends_.empty()) return std::min(now + fine_, last);
    while (period_begin_ + ends_[next_] <= now) {
      if (++next_ < ends_.size()) continue;
      next_ = 0;
      period_begin_ += period_;
    }
    const Clock end = std::min(period_begin_ + ends_[next_], last);
    const Clock acts = (corner + fine_ - 1) / fine_ * fine_;
    if (now < acts - fine_)
      return std::min(end, now < stirred_until_ ? next_fine(now) : acts - fine_);
    stirred_until_ = std::max(stirred_until_, acts + fine_);
    return std::min(end, next_fine(now));
  }
  /// Start of a period mean of the duty: the plant gets a new duty so many clocks later.
  Clock phase() const { return ends_.empty() ? 0 : fine_; }

 private:
  Clock next_fine(Clock now) const { return (now / fine_ + 1) * fine_; }

  Clock fine_;
  Clock period_ = 0;
  std::vector<Clock> ends_;  ///< ends of the steps in a period; empty: all are `fine_`
  std::size_t next_ = 0;
  Clock period_begin_ = 0;
  Clock stirred_until_ = 0;
};

}  // namespace feltgate
