// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of vectors/devices/NAME.toml for pantographs. Documentation: docs/devices/pantograph.md
#include "sim/plant/pantograph/pantograph_file.hpp"

#include <fmt/format.h>

#include <cmath>

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

}  // namespace feltgate::plant
