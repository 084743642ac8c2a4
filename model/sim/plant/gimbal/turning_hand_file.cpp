// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of the [hand] table of a hand that turns a handle. Documentation:
// docs/devices/three-axes.md
#include <fmt/format.h>

#include <utility>
#include <vector>

#include "sim/plant/plant_table.hpp"

namespace feltgate::plant {
namespace {

using Kind = TurnPhase::Kind;

std::vector<double> three(config::TomlReader& table, const std::string& key,
                          const std::string& mend, const config::Range& range) {
  std::vector<double> numbers = table.numbers(key, range);
  if (numbers.size() != 3) table.fail(key, fmt::format("\"{}\" is not three numbers", key), mend);
  return numbers;
}

TurnPhase read_phase(config::TomlReader table, bool last) {
  TurnPhase phase;
  phase.kind = static_cast<Kind>(table.choice("kind", {"free", "spring", "torque"}));
  double natural_s = 0.0;
  if (phase.kind != Kind::kFree) {
    if (table.has("axis")) {
      const std::string mend = "write x, y and z of a direction";
      const auto axis = three(table, "axis", mend, {-1e3, 1e3});
      const Vec3 along{axis[0], axis[1], axis[2]};
      if (!(length(along) > 0.0)) table.fail("axis", "\"axis\" has no direction", mend);
      phase.axis = 1.0 / length(along) * along;
    }
    const bool turns = phase.kind == Kind::kSpring;
    phase.way = read_profile(table, turns ? "turn" : "torque", turns ? "rad" : "nm", !turns);
    natural_s = duration_s(phase.way);
    if (turns) {
      phase.stiffness_nm_rad =
          table.number_or("stiffness_nm_rad", phase.stiffness_nm_rad, config::kPositive);
      phase.damping_nm_s_rad =
          table.number_or("damping_nm_s_rad", phase.damping_nm_s_rad, config::kNotNegative);
    }
  }
  phase.duration_s = read_duration(table, natural_s, last);
  table.finish();
  return phase;
}

}  // namespace

TurningHand read_turning_hand(config::TomlReader table, const AngleStops& stops) {
  TurningHand hand;
  if (table.has("start_deg")) {
    const auto start =
        three(table, "start_deg", "write those of outer, middle and inner joint", {-720.0, 720.0});
    for (std::size_t n = 0; n < 3; ++n) hand.start_rad[n] = start[n] * kRadPerDegree;
    if (hand.start_rad[1] < stops.least_rad || hand.start_rad[1] > stops.most_rad) {
      table.fail("start_deg",
                 fmt::format("the middle joint begins at {:g} degrees, beyond its stops", start[1]),
                 fmt::format("begin from {:g} to {:g}", stops.least_rad / kRadPerDegree,
                             stops.most_rad / kRadPerDegree));
    }
  }
  std::vector<config::TomlReader> phases = table.sections("phase");
  for (std::size_t i = 0; i < phases.size(); ++i) {
    hand.phases.push_back(read_phase(std::move(phases[i]), i + 1 == phases.size()));
  }
  table.finish();
  return hand;
}

}  // namespace feltgate::plant
