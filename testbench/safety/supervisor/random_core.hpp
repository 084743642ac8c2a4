// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Random scenarios with stops and encoder errors at any clock. Documentation:
// docs/blocks/supervisor.md
#pragma once

#include "../../wave/sequencer/sequencer_twin.hpp"
#include "random_scenario.hpp"

namespace feltgate::test {

/// RandomScenario with stops and encoder errors at any clock.
class RandomCore {
 public:
  /// `near`: many limits are equal or close to the signals that they are compared with.
  RandomCore(std::uint64_t seed, ResetPlan plan, bool near = false)
      : random_(seed), scenarios_(seed, near), clock_(seed, plan), bus_(seed) {}

  Twin::In operator()(std::int64_t, const Twin::Out& out) {
    const auto& now = clock_.next();
    if (now.tick || first_) {
      next_ = scenarios_.next();
      storm_ = random_.one_in(300) ? 40 : 0;
      hurry_ = random_.one_in(100);
    }
    // The request, the commands and the words change at the end of a tick, like the registers.
    if (now.slot_fetch == 0) s_ = next_;
    first_ = false;
    s_.stop = random_.one_in(6000) || (s_.stop && !random_.one_in(100));
    s_.encoder_error = random_.one_in(3000) || (storm_ > 0 && random_.coin());
    if (storm_ > 0) --storm_;
    s_.period_start = random_.one_in(hurry_ ? 30 : 3000);
    // Faults from other blocks, and the command stop.
    s_.trips = 0;
    if (random_.one_in(3000)) {
      s_.trips = static_cast<std::uint16_t>(1U << (7 + random_.below(9)));
    }
    return bus_.clock(now, s_, out.current_estimate);
  }

 private:
  Random random_;
  RandomScenario scenarios_;
  RunningClock<Design::clocks_per_tick> clock_;
  Bus bus_;
  Scenario s_;
  Scenario next_;
  bool first_ = true;
  int storm_ = 0;
  bool hurry_ = false;  ///< PWM periods are shorter than a tick
};

}  // namespace feltgate::test
