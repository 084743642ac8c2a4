// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reads the [hand] table of a pen. Documentation: docs/pantograph.md
#include <algorithm>
#include <utility>

#include "plant/plant_table.hpp"

namespace feltgate::plant {
namespace {

using Kind = PenPhase::Kind;

PenPhase read_phase(config::TomlReader table, bool last) {
  PenPhase phase;
  phase.kind =
      static_cast<Kind>(table.choice("kind", {"free", "prescribed", "impedance", "force"}));
  double natural_s = 0.0;
  if (phase.kind != Kind::kFree) {
    const std::string unit = phase.kind == Kind::kForce ? "n" : "m";
    const bool steps = phase.kind != Kind::kPrescribed;
    if (!table.has("x") && !table.has("y")) {
      table.fail("kind", "neither \"x\" nor \"y\" is there", "write the motion of one at least");
    }
    if (table.has("x")) phase.x = read_profile(table, "x", unit, steps);
    if (table.has("y")) phase.y = read_profile(table, "y", unit, steps);
    natural_s = std::max(duration_s(phase.x), duration_s(phase.y));
  }
  if (phase.kind == Kind::kImpedance) phase.impedance = read_impedance(table);
  if (table.has("duration_s")) {
    phase.duration_s = table.number("duration_s", config::kPositive);
  } else if (!last) {
    if (natural_s <= 0.0) phase.duration_s = table.number("duration_s", config::kPositive);
    phase.duration_s = natural_s;
  }
  table.finish();
  return phase;
}

}  // namespace

PenHand read_pen_hand(config::TomlReader table) {
  PenHand hand;
  if (table.has("start_m")) {
    const auto start = table.numbers("start_m", {-10.0, 10.0});
    if (start.size() != 2) {
      table.fail("start_m", "\"start_m\" is not two numbers", "write x and y, m");
    }
    hand.start_m = Vec2{start[0], start[1]};
  }
  std::vector<config::TomlReader> phases = table.sections("phase");
  for (std::size_t i = 0; i < phases.size(); ++i) {
    hand.phases.push_back(read_phase(std::move(phases[i]), i + 1 == phases.size()));
  }
  table.finish();
  return hand;
}

}  // namespace feltgate::plant
