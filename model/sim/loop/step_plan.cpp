// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Lengths of the plant's steps. Documentation: docs/plant.md
#include "sim/loop/step_plan.hpp"

#include <cmath>

#include <fmt/format.h>

#include "files/toml/toml_reader.hpp"
#include "sim/loop/scenario_check.hpp"
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

// Checks that the plant's step is short enough for a scene. Derivation: docs/plant.md

namespace {

using plant::HandPhase;

/// Advice where a pole is too fast.
std::string mend(const Scenario& s, double pole_1_s, double most, double clock_hz,
                 const std::string& softer) {
  const double clocks = std::floor(most / pole_1_s * clock_hz);
  if (!(clocks >= 1)) return softer;
  return fmt::format("{}, or set step_clocks = {} (it is {})", softer, clocks, s.step_clocks);
}

/// The keys that make a phase stiff.
std::string softer(HandPhase::Kind kind) {
  switch (kind) {
    case HandPhase::Kind::kCord:
      return "lower damping_nm_s_rad or stiffness_nm_rad of the cord";
    case HandPhase::Kind::kImpedance:
      return "raise mass_kg, or lower damping and stiffness of hand and grip";
    default:
      return "raise inertia_kg_m2, or lower the viscous friction";
  }
}

}  // namespace

void check_step(const Scenario& s, const plant::Parameters& p, double clock_hz) {
  const double step_s = s.step_clocks / clock_hz;
  const auto refuse = [&](const std::string& place, const std::string& what, double pole_1_s,
                          double most, const std::string& change) {
    throw config::ConfigError(fmt::format(
        "{}{}, {:.3g} 1/s, times the plant's step of {:.3g} s is {:.3g} and must stay below {}; {}",
        place.empty() ? "" : place + ": ", what, pole_1_s, step_s, pole_1_s * step_s, most,
        mend(s, pole_1_s, most, clock_hz, change)));
  };
  const double radius_m = s.hand.radius_m.value_or(p.lever.radius_m);
  const double outer = plant::outer_pole_1_s(p, s.effects, step_s);
  if (!(outer * step_s <= 1.0)) {
    refuse(p.place, "the fastest pole of bristles and back-EMF", outer, 1.0,
           "raise inertia_kg_m2, or lower the friction's stiffness and damping");
  }
  const auto check = [&](const HandPhase& phase, const std::string& place) {
    const double pole = plant::mechanical_pole_1_s(p, s.effects, phase, radius_m);
    if (pole * step_s <= plant::most_pole_steps) return;
    refuse(place, "the fastest mechanical pole", pole, plant::most_pole_steps, softer(phase.kind));
  };
  check(HandPhase{}, p.place);
  for (const HandPhase& phase : s.hand.phases) {
    check(phase, s.path.empty() ? "" : fmt::format("{}:{}", s.path, phase.line));
  }
}

}  // namespace feltgate
