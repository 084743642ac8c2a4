// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The sequencer's outputs for the stimulus of a block that hangs on the wave: it restarts with each
// reset that LockStep<> makes, which it foresees from the same seed. Documentation: docs/testing.md
#pragma once

#include "lock_step.hpp"
#include "sequencer_twin.hpp"

namespace feltgate::test {

template <int ClocksPerTick>
class RunningClock {
 public:
  /// Seed and plan of the run.
  RunningClock(std::uint64_t seed, ResetPlan plan) : resets_(seed ^ 0x7265736574U), plan_(plan) {}

  /// To be called first in every clock of the stimulus, the ones in reset included.
  const typename Sequencer<ClocksPerTick>::Out& next() {
    if (!in_reset_) sequencer_.clock({});
    if (left_ > 0) {
      --left_;
    } else if (plan_.mean_distance != 0 && resets_.one_in(plan_.mean_distance)) {
      left_ = 1 + resets_.below(8);
    }
    in_reset_ = left_ > 0;
    if (in_reset_) sequencer_.reset();
    return sequencer_.out();
  }
  /// Whether the block is held in reset in this clock.
  bool in_reset() const { return in_reset_; }

 private:
  Sequencer<ClocksPerTick> sequencer_;
  Random resets_;
  ResetPlan plan_;
  std::int64_t left_ = 4;  // as LockStep<>: three clocks of reset at the start
  bool in_reset_ = true;
};

}  // namespace feltgate::test
