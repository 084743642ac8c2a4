// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of the [hand] table of a pen with two or three axes. Documentation:
// docs/devices/pantograph.md
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sim/plant/plant_table.hpp"

namespace feltgate::plant {
namespace {

using Kind = PenPhase::Kind;

constexpr const char* kAxes[] = {"x", "y", "z"};

/// A phase with one motion per axis, m or N.
template <std::size_t N>
struct Phase {
  Kind kind = Kind::kFree;
  double duration_s = std::numeric_limits<double>::infinity();
  std::array<Profile, N> ways;
  Impedance impedance;
};

template <std::size_t N>
Phase<N> read_phase(config::TomlReader table, bool last) {
  Phase<N> phase;
  phase.kind =
      static_cast<Kind>(table.choice("kind", {"free", "prescribed", "impedance", "force"}));
  double natural_s = 0.0;
  if (phase.kind != Kind::kFree) {
    const std::string unit = phase.kind == Kind::kForce ? "n" : "m";
    const bool steps = phase.kind != Kind::kPrescribed;
    bool any = false;
    for (std::size_t n = 0; n < N; ++n) {
      if (!table.has(kAxes[n])) continue;
      any = true;
      phase.ways[n] = read_profile(table, kAxes[n], unit, steps);
      natural_s = std::max(natural_s, duration_s(phase.ways[n]));
    }
    if (!any) {
      table.fail(
          "kind",
          N == 2 ? "neither \"x\" nor \"y\" is there" : "none of \"x\", \"y\" and \"z\" is there",
          "write the motion of one at least");
    }
  }
  if (phase.kind == Kind::kImpedance) phase.impedance = read_impedance(table);
  phase.duration_s = read_duration(table, natural_s, last);
  table.finish();
  return phase;
}

template <std::size_t N>
struct PhasesOfAxes {
  std::optional<std::array<double, N>> start_m;
  std::vector<Phase<N>> phases;
};

template <std::size_t N>
PhasesOfAxes<N> read_phases(config::TomlReader table) {
  PhasesOfAxes<N> hand;
  if (table.has("start_m")) {
    const auto start = table.numbers("start_m", {-10.0, 10.0});
    if (start.size() != N) {
      table.fail("start_m", fmt::format("\"start_m\" is not {} numbers", N == 2 ? "two" : "three"),
                 N == 2 ? "write x and y, m" : "write x, y and z, m");
    }
    std::copy(start.begin(), start.end(), hand.start_m.emplace().begin());
  }
  std::vector<config::TomlReader> phases = table.sections("phase");
  for (std::size_t i = 0; i < phases.size(); ++i) {
    hand.phases.push_back(read_phase<N>(std::move(phases[i]), i + 1 == phases.size()));
  }
  table.finish();
  return hand;
}

Profile scaled(Profile profile, double by) {
  for (Segment& s : profile) {
    s.to *= by;
    s.amplitude *= by;
  }
  return profile;
}

HandPhase::Kind of_lever(Kind kind) {
  switch (kind) {
    case Kind::kFree:
      return HandPhase::Kind::kFree;
    case Kind::kPrescribed:
      return HandPhase::Kind::kPrescribed;
    case Kind::kImpedance:
      return HandPhase::Kind::kImpedance;
    case Kind::kForce:
      break;
  }
  return HandPhase::Kind::kTorque;
}

}  // namespace

PenHand read_pen_hand(config::TomlReader table) {
  const PhasesOfAxes<2> all = read_phases<2>(std::move(table));
  PenHand hand;
  if (all.start_m) hand.start_m = Vec2{(*all.start_m)[0], (*all.start_m)[1]};
  for (const Phase<2>& p : all.phases) {
    hand.phases.push_back({p.kind, p.duration_s, p.ways[0], p.ways[1], p.impedance});
  }
  return hand;
}

std::array<Hand, 3> read_stylus_hand(config::TomlReader table, double capstan_m) {
  const PhasesOfAxes<3> all = read_phases<3>(std::move(table));
  std::array<Hand, 3> hands;
  for (std::size_t n = 0; n < hands.size(); ++n) {
    if (all.start_m) hands[n].start_rad = (*all.start_m)[n] / capstan_m;
    for (const Phase<3>& p : all.phases) {
      HandPhase& phase = hands[n].phases.emplace_back();
      phase.kind = of_lever(p.kind);
      phase.duration_s = p.duration_s;
      phase.profile = scaled(p.ways[n], p.kind == Kind::kForce ? capstan_m : 1.0 / capstan_m);
      phase.impedance = p.impedance;
    }
  }
  return hands;
}

}  // namespace feltgate::plant
