// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Checks that the plant's step is short enough for a scene. Derivation: docs/plant.md
#include <fmt/format.h>

#include <cmath>

#include "files/toml/toml_reader.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/plant/stiffness.hpp"

namespace feltgate {

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
