// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of gimbal files such as vectors/devices/gimbal.toml. Documentation:
// docs/devices/three-axes.md
#include "sim/plant/gimbal/gimbal_file.hpp"

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

}  // namespace feltgate::plant
