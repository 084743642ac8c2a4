// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How long the steps of the plant are: from event to event while nothing happens.
// Documentation: docs/plant.md
#pragma once

#include <algorithm>
#include <vector>

#include "../engines/engine.hpp"
#include "../plant/parameters.hpp"
#include "scenario.hpp"

namespace feltgate {

/// The longest step, in clocks, that keeps every pole of the scene a tenth of the way to its bound;
/// scenario.step_clocks where none above it does.
int longest_step_clocks(const Scenario& scenario, const plant::Parameters& plant, double clock_hz);

/// Says where each step ends. Only time and what the scene says decide, never an engine: all
/// engines give the same run.
class StepPlan {
 public:
  /// Each step is `step` clocks long.
  explicit StepPlan(Clock step) : fine_(step) {}
  /// A duty that holds for `period` clocks from a multiple of it on: the steps end `fine` clocks
  /// after it can be new, and between two of these they are equal, at most `longest`.
  StepPlan(Clock fine, Clock longest, Clock period);

  /// From `now` on for `clocks` something may happen at any time: steps of `fine` clocks.
  void stir(Clock now, Clock clocks) { stirred_until_ = std::max(stirred_until_, now + clocks); }

  /// End of the step from `now` on, not after `last`. `corner`, later than `now`: what it causes
  /// acts from the first multiple of `fine` on, and the steps before and after that are fine ones.
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
  /// The mean over a period of the duty begins here: the plant feels a duty so much later.
  Clock phase() const { return ends_.empty() ? 0 : fine_; }

 private:
  Clock next_fine(Clock now) const { return (now / fine_ + 1) * fine_; }

  Clock fine_;
  Clock period_ = 0;
  std::vector<Clock> ends_;  ///< of the steps of a period; empty: all are `fine_`
  std::size_t next_ = 0;
  Clock period_begin_ = 0;
  Clock stirred_until_ = 0;
};

}  // namespace feltgate
