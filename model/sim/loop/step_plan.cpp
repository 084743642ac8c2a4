// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lengths of the plant's steps. Documentation: docs/plant.md
#include "sim/loop/step_plan.hpp"

#include "sim/plant/stiffness.hpp"

namespace feltgate {

StepPlan::StepPlan(Clock fine, Clock longest, Clock period)
    : fine_(std::min(fine, period)), period_(period) {
  const Clock steps = (period + longest - 1) / longest;
  for (Clock n = 0; n < steps; ++n) ends_.push_back(fine_ + period * n / steps);
}

StepPlan::StepPlan(const Scenario& s, const plant::Parameters& plant, const DesignInfo& design)
    : StepPlan(s.step_clocks, longest_step_clocks(s, plant, static_cast<double>(design.clock_hz)),
               design.pwm_period) {}

Scenario scene_of(const plant::Parameters& plant, const plant::Hand& hand) {
  Scenario s;
  s.effects = plant.effects;
  s.hand = hand;
  return s;
}

int longest_step_clocks(const Scenario& s, const plant::Parameters& p, double clock_hz) {
  constexpr double calm = 0.1;  // share of the limit; the error is then below that of a count
  constexpr int longest = 250;
  // The bus is advanced with the current of the step before, which gives a first-order error.
  if (s.effects.supply_limit) return s.step_clocks;
  const double radius_m = s.hand.radius_m.value_or(p.lever.radius_m);
  double pole = plant::mechanical_pole_1_s(p, s.effects, {}, radius_m);
  for (const plant::HandPhase& phase : s.hand.phases) {
    pole = std::max(pole, plant::mechanical_pole_1_s(p, s.effects, phase, radius_m));
  }
  for (int clocks = longest; clocks > s.step_clocks; clocks -= 25) {
    const double step_s = clocks / clock_hz;
    if (pole * step_s <= calm * plant::most_pole_steps &&
        plant::outer_pole_1_s(p, s.effects, step_s) * step_s <= calm) {
      return clocks;
    }
  }
  return s.step_clocks;
}

}  // namespace feltgate
