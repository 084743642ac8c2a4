// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of vectors/devices/NAME.toml for pantographs. Documentation: docs/devices/pantograph.md
#include "sim/plant/pantograph/pantograph.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sim/plant/plant_table.hpp"

namespace feltgate::plant {
namespace {

LinkageGeometry read_linkage(config::TomlReader table) {
  LinkageGeometry g;
  g.base_m = table.number("base_m", config::kNotNegative);
  g.crank_1_m = table.number("crank_1_m", config::kPositive);
  g.rod_1_m = table.number("rod_1_m", config::kPositive);
  g.rod_5_m = table.number("rod_5_m", config::kPositive);
  g.crank_5_m = table.number("crank_5_m", config::kPositive);
  table.finish();
  return g;
}

LinkBody read_body(config::TomlReader table) {
  LinkBody b;
  b.mass_kg = table.number("mass_kg", config::kNotNegative);
  b.centre_m = table.number("centre_m", {-10.0, 10.0});
  b.inertia_kg_m2 = table.number("inertia_kg_m2", config::kNotNegative);
  table.finish();
  return b;
}

// Whether the rods can span the distance of the elbows, for both motors at one point: it follows
// from a1, a4 and the angle between the cranks. With a base between the motors only a run shows it.
bool closes(const LinkageGeometry& g, double between_rad) {
  if (g.base_m > 0.0) return true;
  const double apart = length(
      Vec2{g.crank_5_m * std::cos(between_rad) - g.crank_1_m, g.crank_5_m * std::sin(between_rad)});
  return apart < g.rod_1_m + g.rod_5_m && apart > std::abs(g.rod_1_m - g.rod_5_m);
}

AngleStops read_stops(config::TomlReader table, const LinkageGeometry& geometry) {
  AngleStops s;
  s.least_rad = kRadPerDegree * table.number("least_deg", {0.0, 180.0});
  s.most_rad = kRadPerDegree * table.number("most_deg", {0.0, 180.0});
  s.stiffness_nm_rad = table.number("stiffness_nm_rad", config::kPositive);
  s.restitution = table.number("restitution", {0.1, 1.0});
  if (s.most_rad <= s.least_rad) {
    table.fail("most_deg", "\"most_deg\" is not above \"least_deg\"",
               "leave the cranks a way: raise it");
  }
  for (const char* key : {"least_deg", "most_deg"}) {
    const double at_rad = key[0] == 'l' ? s.least_rad : s.most_rad;
    if (at_rad > 0.0 && closes(geometry, at_rad)) continue;
    table.fail(key, fmt::format("the rods do not meet at {:g} degrees", at_rad / kRadPerDegree),
               "stop the cranks before the linkage is straight, or make the rods longer");
  }
  table.finish();
  return s;
}

Vec2 read_start(config::TomlReader& table, const PantographParameters& p) {
  const auto at = table.numbers("start_m", {-10.0, 10.0});
  if (at.size() != 2) table.fail("start_m", "\"start_m\" is not two numbers", "write x and y, m");
  const Vec2 start{at[0], at[1]};
  const auto theta = Linkage(p.linkage).inverse(start);
  if (!theta) {
    table.fail("start_m", "the pen cannot be there", "choose a place within the links' reach");
  }
  const double between = (*theta)[1] - (*theta)[0];
  if (between < p.stops.least_rad || between > p.stops.most_rad) {
    table.fail("start_m",
               fmt::format("the cranks are {:.4g} degrees apart there, beyond a stop",
                           between / kRadPerDegree),
               "choose a place between the stops");
  }
  return start;
}

PantographParameters read_table(const toml::table& root, const std::string& file) {
  config::TomlReader reader(root, file, "the file");
  PantographParameters p;
  p.name = reader.text("name");
  p.linkage = read_linkage(reader.section("linkage"));
  p.bodies.crank_1 = read_body(reader.section("crank_1"));
  p.bodies.rod_1 = read_body(reader.section("rod_1"));
  p.bodies.rod_5 = read_body(reader.section("rod_5"));
  p.bodies.crank_5 = read_body(reader.section("crank_5"));
  p.stops = read_stops(reader.section("stops"), p.linkage);
  config::TomlReader pen = reader.section("pen");
  p.bodies.pen_kg = pen.number("mass_kg", config::kNotNegative);
  p.start_m = read_start(pen, p);
  pen.finish();
  read_axes(reader, p);
  p.bodies.joint_inertia_kg_m2 = {p.joint.inertia_kg_m2(), p.joint.inertia_kg_m2()};
  reader.finish();
  return p;
}

}  // namespace

PantographParameters read_pantograph_file(const std::string& path) {
  return read_table(config::parse_toml_file(path), path);
}

PantographParameters read_pantograph_text(const std::string& text, const std::string& path) {
  return read_table(config::parse_toml_text(text, path), path);
}

// Reader of the [hand] table of a pen with two or three axes.

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
