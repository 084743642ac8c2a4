// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/rates/rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "files/toml/toml_reader.hpp"

namespace feltgate::rates {

namespace {

using Values = BlockLaw::Values;

/// The block's core is known by its slope: slope * core = strength / core^2.
Values charge(const Values& v, const std::string& name, double sign, double count_rad) {
  const double strength = v.at(name + "_strength"), slope = v.at(name + "_core_slope");
  const double core = std::cbrt(strength / slope);
  return {{"centre", v.at(name + "_centre") * count_rad},
          {"core", core * count_rad},
          {"peak", sign * strength / (core * core)}};
}

std::vector<BlockLaw> make() {
  std::vector<BlockLaw> all;
  // A changed set-point acts at once, as a mailbox's word does; a parameter of a law would ramp.
  all.push_back({"setpoint",
                 "",
                 "mailbox setpoint_torque = 0 Nm in -0.5 .. 0.5 Nm max_age 4 s\n"
                 "out torque = setpoint_torque\n",
                 {"setpoint_torque"},
                 [](const Values& v, double) { return v; }});
  all.push_back({"membrane",
                 "membrane",
                 "",
                 {"membrane_lower", "membrane_upper", "membrane_torque"},
                 [](const Values& v, double q) {
                   return Values{{"lower", v.at("membrane_lower") * q},
                                 {"upper", v.at("membrane_upper") * q},
                                 {"strength", v.at("membrane_torque")}};
                 }});
  all.push_back(
      {"spring_compression",
       "",
       "param contact = 0.5 rad in -10 .. 10 rad\n"
       "param stiffness = 1 Nm/rad in 0 .. 10 Nm/rad\n"
       "out torque = if position < contact then stiffness * (contact - position) else 0\n",
       {"compression_contact", "compression_stiffness"},
       [](const Values& v, double q) {
         return Values{{"contact", v.at("compression_contact") * q},
                       {"stiffness", v.at("compression_stiffness") / q}};
       }});
  all.push_back({"spring_tension",
                 "spring",
                 "",
                 {"tension_rest", "tension_stiffness"},
                 [](const Values& v, double q) {
                   return Values{{"rest", v.at("tension_rest") * q},
                                 {"stiffness", v.at("tension_stiffness") / q}};
                 }});
  all.push_back({"damper", "damper", "", {"damper_damping"}, [](const Values& v, double) {
                   return Values{{"damping", v.at("damper_damping")}};
                 }});
  all.push_back({"charge_attract",
                 "charge_far",
                 "",
                 {"attract_centre", "attract_strength", "attract_core", "attract_core_slope"},
                 [](const Values& v, double q) { return charge(v, "attract", 1, q); }});
  all.push_back({"charge_repel",
                 "charge_far",
                 "",
                 {"repel_centre", "repel_strength", "repel_core", "repel_core_slope"},
                 [](const Values& v, double q) { return charge(v, "repel", -1, q); }});
  all.push_back({"wall",
                 "wall",
                 "",
                 {"wall_contact", "wall_stiffness", "wall_damping"},
                 [](const Values& v, double q) {
                   return Values{{"contact", v.at("wall_contact") * q},
                                 {"stiffness", v.at("wall_stiffness") / q},
                                 {"damping", v.at("wall_damping")}};
                 }});
  return all;
}

/// Takes the block's own parameters out of `set` and into `values`; whether there were any.
bool take(std::map<std::string, double>& set, Values& values) {
  bool any = false;
  for (auto& [name, value] : values) {
    const auto it = set.find(name);
    if (it == set.end()) continue;
    value = it->second;
    set.erase(it);
    any = true;
  }
  return any;
}

}  // namespace

const BlockLaw* block_law(const std::string& scene) {
  static const std::vector<BlockLaw> all = make();
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const BlockLaw& l) { return l.scene == scene; });
  return it == all.end() ? nullptr : &*it;
}

void require_one_law(const Scenario& s) {
  constexpr int voltage_mode = 2;
  for (const Event& e : s.events) {
    if ((e.scene && *e.scene != s.scene) || e.mode.value_or(0) == voltage_mode) {
      throw config::ConfigError(fmt::format(
          "{}:{}: the scene changes to another torque law; rates measures one, so give it a file "
          "without this event",
          s.path, e.line));
    }
  }
  if (s.scene == "law" || (block_law(s.scene) != nullptr && s.mode != voltage_mode)) return;
  throw config::ConfigError(
      fmt::format("{}:{}: the scene renders no torque law whose rate could be changed; choose one "
                  "with a scene other than free, in closed_loop or open_loop",
                  s.path, s.scene_line));
}

Scenario as_law(const Scenario& scene, const BlockLaw& law, const DesignInfo& design) {
  Scenario s = scene;
  Values values;
  for (const std::string& name : law.names) values[name] = design.find(name)->si;
  s.scene = "law";
  s.expectations.clear();
  take(s.parameters, values);
  for (const auto& [name, value] : law.parameters(values, design.count_rad)) {
    s.parameters[name] = value;
  }
  for (Event& e : s.events) {
    if (e.scene) e.scene = "law";
    if (!take(e.set, values)) continue;
    for (const auto& [name, value] : law.parameters(values, design.count_rad)) e.set[name] = value;
  }
  return s;
}

}  // namespace feltgate::rates
