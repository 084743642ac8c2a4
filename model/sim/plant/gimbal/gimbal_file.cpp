// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of gimbal files such as vectors/devices/gimbal.toml. Documentation:
// docs/devices/three-axes.md
#include "sim/plant/gimbal/gimbal.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sim/plant/plant_table.hpp"

namespace feltgate::plant {
namespace {

// Principal moments of a body; for a real body none exceeds the sum of the others.
Vec3 read_inertia(config::TomlReader& table, const std::string& key) {
  const auto i = table.numbers(key, config::kPositive);
  if (i.size() != 3) table.fail(key, "\"" + key + "\" is not three numbers", "write x, y and z");
  if (i[0] > i[1] + i[2] || i[1] > i[0] + i[2] || i[2] > i[0] + i[1]) {
    table.fail(key, "one moment of \"" + key + "\" is more than the sum of the others",
               "no body is like that; correct it");
  }
  return {i[0], i[1], i[2]};
}

AngleStops read_stops(config::TomlReader table) {
  AngleStops s;
  s.least_rad = kRadPerDegree * table.number("least_deg", {-89.0, 89.0});
  s.most_rad = kRadPerDegree * table.number("most_deg", {-89.0, 89.0});
  s.stiffness_nm_rad = table.number("stiffness_nm_rad", config::kPositive);
  s.restitution = table.number("restitution", {0.1, 1.0});
  if (s.most_rad <= s.least_rad) {
    table.fail("most_deg", "\"most_deg\" is not above \"least_deg\"",
               "leave the middle joint a way: raise it");
  }
  table.finish();
  return s;
}

GimbalParameters read_table(const toml::table& root, const std::string& file) {
  config::TomlReader reader(root, file, "the file");
  GimbalParameters p;
  p.name = reader.text("name");
  config::TomlReader bodies = reader.section("bodies");
  p.bodies.outer = read_inertia(bodies, "outer_kg_m2");
  p.bodies.inner = read_inertia(bodies, "inner_kg_m2");
  p.bodies.handle = read_inertia(bodies, "handle_kg_m2");
  bodies.finish();
  p.stops = read_stops(reader.section("stops"));
  read_axes(reader, p);
  const double joint = p.joint.inertia_kg_m2();
  p.bodies.joint_inertia_kg_m2 = {joint, joint, joint};
  reader.finish();
  return p;
}

}  // namespace

GimbalParameters read_gimbal_file(const std::string& path) {
  return read_table(config::parse_toml_file(path), path);
}

GimbalParameters read_gimbal_text(const std::string& text, const std::string& path) {
  return read_table(config::parse_toml_text(text, path), path);
}

// Reader of the [hand] table of a hand that turns a handle.

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
