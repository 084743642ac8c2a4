// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of scene files. Documentation: docs/scenes.md
#include "sim/loop/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "feltgate/design_info.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/backends/absolute_sensor.hpp"
#include "sim/plant/plant_table.hpp"

namespace feltgate {

namespace {

const std::vector<std::string> kModes{"closed_loop", "open_loop", "voltage"};
const std::vector<std::string> kPhases{"a", "b", "c"};

/// Reads numbers into `values`, and texts such as "4 Nm/deg" into `amounts`.
void read_values(const toml::table& table, config::TomlReader reader,
                 std::map<std::string, double>* values,
                 std::map<std::string, std::string>* amounts) {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (node.is_string()) {
      (*amounts)[name] = reader.text(name);
    } else {
      (*values)[name] = reader.number(name, config::kAnyNumber);
    }
  }
}

Event read_event(config::TomlReader r, const toml::table& table, double duration_s) {
  Event e;
  e.line = r.line("at_s");
  e.at_s = r.number("at_s", config::kNotNegative);
  if (e.at_s >= duration_s) {
    r.fail(
        "at_s",
        fmt::format("the event at {} s comes when the scene of {} s is over", e.at_s, duration_s),
        "move the event, or raise duration_s");
  }
  if (r.has("scene")) e.scene = r.text("scene");
  if (r.has("mode")) e.mode = static_cast<int>(r.choice("mode", kModes));
  if (r.has("arm")) e.arm = r.flag("arm");
  if (r.has("stop")) e.stop = r.flag("stop");
  if (r.has("encoder")) {
    const std::vector<std::string> names(AbsoluteSensor::defects.begin(),
                                         AbsoluteSensor::defects.end());
    e.encoder = names[r.choice("encoder", names)];
  }
  if (r.has("open_phase")) e.open_phase = static_cast<int>(r.choice("open_phase", kPhases));
  if (r.has("set")) {
    read_values(*table["set"].as_table(), r.section("set"), &e.set, &e.amounts);
  }
  if (r.has("step_nm")) e.step_nm = r.number("step_nm", config::kAnyNumber);
  if (!e.scene && !e.mode && !e.arm && !e.stop && e.encoder.empty() && !e.open_phase &&
      !e.step_nm && e.set.empty() && e.amounts.empty()) {
    r.fail("at_s", "the event does nothing",
           "give it set, scene, mode, arm, stop, encoder, open_phase or step_nm");
  }
  r.finish();
  return e;
}

TrackerSettings read_tracker(config::TomlReader r) {
  TrackerSettings t;
  t.line = r.line("mailbox");
  t.mailbox = r.text("mailbox");
  if (r.has("encoder_mailbox")) t.encoder_mailbox = r.text("encoder_mailbox");
  if (r.has("of")) t.of_encoder = r.choice("of", {"lever", "encoder"}) == 1;
  t.rate_hz = r.number("rate_hz", {0.1, 10e3});
  t.noise_rad = r.number_or("noise_rad", t.noise_rad, {0, 1});
  t.resolution_rad = r.number_or("resolution_rad", t.resolution_rad, {0, 1});
  t.alpha = r.number_or("alpha", t.alpha, {1e-3, 1});
  t.latency_s = r.number_or("latency_s", t.latency_s, {0, 1});
  if (r.has("seed")) t.seed = static_cast<std::uint64_t>(r.integer("seed", 0, 1'000'000'000));
  r.finish();
  return t;
}

/// The flags that the table sets: those that come out equal whatever base they override.
std::vector<EffectSetting> read_effects_set(const config::TomlReader& table) {
  plant::Effects all, none;
  for (const plant::EffectName& e : plant::effect_names) {
    all.*e.flag = true;
    none.*e.flag = false;
  }
  all = plant::read_effects(table, all);
  none = plant::read_effects(table, none);
  std::vector<EffectSetting> set;
  for (const plant::EffectName& e : plant::effect_names) {
    if (all.*e.flag == none.*e.flag) set.push_back({e.flag, all.*e.flag});
  }
  return set;
}

Expectation read_expectation(config::TomlReader r, const toml::table& table) {
  Expectation x;
  x.figure = r.text("figure");
  x.line = static_cast<int>(table.source().begin.line);
  if (r.has("design")) x.design = r.text("design");
  x.low = r.number_or("low", x.low, config::kAnyNumber);
  x.high = r.number_or("high", x.high, config::kAnyNumber);
  if (!r.has("low") && !r.has("high")) {
    r.fail("figure", "an expectation needs a bound", "give low, high or both");
  }
  if (x.low > x.high) r.fail("low", "no value is above low and below high", "exchange them");
  r.finish();
  return x;
}

/// Reads what all scenes have; `own` reads the device-specific part.
Scenario read(const toml::table& root, const std::string& path,
              const std::function<void(config::TomlReader& file, Scenario& s)>& own) {
  config::TomlReader top(root, path, "the scene");
  Scenario s;
  s.path = path;
  s.name = std::filesystem::path(path).stem().string();
  s.title = top.text("title");
  s.about = top.paragraph("about");
  s.duration_s = top.number("duration_s", {1e-5, 1e5});
  own(top, s);
  {
    config::TomlReader core = top.section("core");
    s.scene = core.text("scene");
    s.scene_line = core.line("scene");
    if (core.has("law")) {
      s.law = core.text("law");
      s.law_line = core.line("law");
    }
    if (core.has("mode")) s.mode = static_cast<int>(core.choice("mode", kModes));
    s.arm_s = core.number_or("arm_s", 0.0, config::kNotNegative);
    core.finish();
  }
  if (top.has("parameters")) {
    const config::TomlReader reader = top.section("parameters");
    read_values(*root["parameters"].as_table(), reader, &s.parameters, &s.amounts);
    for (const auto& [name, value] : s.parameters) s.parameter_lines[name] = reader.line(name);
    for (const auto& [name, text] : s.amounts) s.parameter_lines[name] = reader.line(name);
  }
  const auto events = top.sections("event");
  for (std::size_t i = 0; i < events.size(); ++i) {
    s.events.push_back(
        read_event(events[i], *root["event"].as_array()->get(i)->as_table(), s.duration_s));
  }
  std::stable_sort(s.events.begin(), s.events.end(),
                   [](const Event& a, const Event& b) { return a.at_s < b.at_s; });
  if (top.has("feed")) {
    config::TomlReader feed = top.section("feed");
    s.feed_line = feed.line("rate_hz");
    s.feed_hz = feed.number("rate_hz", {0.1, 10e3});
    feed.finish();
  }
  if (top.has("tracker")) s.tracker = read_tracker(top.section("tracker"));
  if (top.has("rest")) {
    config::TomlReader rest = top.section("rest");
    s.rest_line = rest.line("from_s");
    s.rest_from_s = rest.number("from_s", {0, s.duration_s});
    rest.finish();
  }
  if (top.has("drag")) {
    config::TomlReader drag = top.section("drag");
    s.drag_line = drag.line("from_s");
    s.drag_from_s = drag.number("from_s", {0, s.duration_s});
    drag.finish();
  }
  if (top.has("effects")) s.effects_set = read_effects_set(top.section("effects"));
  const auto expectations = top.sections("expect");
  for (std::size_t i = 0; i < expectations.size(); ++i) {
    s.expectations.push_back(
        read_expectation(expectations[i], *root["expect"].as_array()->get(i)->as_table()));
  }
  top.finish();
  return s;
}

}  // namespace

Scenario read_scenario(const std::string& path) {
  const toml::table root = config::parse_toml_file(path);
  return read(root, path, [](config::TomlReader& top, Scenario& s) {
    if (top.has("device")) {
      top.fail("device", "a device of several axes",
               "take a scene of one lever, or `feltgate run`");
    }
    if (top.has("design")) s.design = top.text("design");
    s.plant_given = top.has("plant");
    s.plant = s.plant_given ? top.text("plant") : "p24";
    s.step_given = top.has("step_clocks");
    if (s.step_given) s.step_clocks = static_cast<int>(top.integer("step_clocks", 1, 250));
    if (top.has("bridge")) s.switched = top.choice("bridge", {"averaged", "switched"}) == 1;
    if (top.has("hand")) s.hand = plant::read_hand(top.section("hand"));
  });
}

Scenario read_device_scene(const std::string& path,
                           const std::function<void(config::TomlReader& file)>& device) {
  const toml::table root = config::parse_toml_file(path);
  return read(root, path, [&](config::TomlReader& top, Scenario& s) {
    device(top);
    s.plant.clear();
  });
}

bool names_device(const std::string& path) {
  return config::parse_toml_file(path).contains("device");
}

std::vector<std::string> effects_off(const Scenario& scenario) {
  const auto& phases = scenario.hand.phases;
  const bool mass = std::any_of(phases.begin(), phases.end(), [](const plant::HandPhase& p) {
    return p.kind == plant::HandPhase::Kind::kImpedance;
  });
  std::vector<std::string> off;
  if (!scenario.switched) off.emplace_back("gates");
  for (const plant::EffectName& e : plant::effect_names) {
    if (e.flag == &plant::Effects::hand_dynamics && !mass) continue;
    if (!(scenario.effects.*e.flag)) off.emplace_back(e.name);
  }
  return off;
}

std::set<std::string> scenes_used(const Scenario& scenario) {
  std::set<std::string> used{scenario.scene};
  for (const Event& e : scenario.events) {
    if (e.scene) used.insert(*e.scene);
  }
  return used;
}

std::string own_design(const Scenario& scenario) {
  if (!scenario.design.empty()) return scenario.design;
  return scenario.law.empty() ? "lever" : "lever_law";
}

std::string default_plant(const DesignInfo& design) {
  if (design.hall) return "hall_motor";
  return design.phases == 3 ? "gimbal_motor" : "p24";
}

void choose_plant(Scenario& scenario, const DesignInfo& design) {
  if (!scenario.plant_given) scenario.plant = default_plant(design);
}

void resolve_effects(Scenario& scenario, const plant::Effects& of_plant) {
  scenario.effects = of_plant;
  for (const auto& [flag, on] : scenario.effects_set) scenario.effects.*flag = on;
}

}  // namespace feltgate
