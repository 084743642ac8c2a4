// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Reader of scenes of devices with several axes. Documentation: docs/scenes.md
#include "sim/axes_loop/axes_scene.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <type_traits>
#include <utility>

#include "files/toml/toml_reader.hpp"
#include "sim/loop/speed_jumps.hpp"
#include "sim/plant/gimbal/gimbal.hpp"
#include "sim/plant/pantograph/pantograph.hpp"
#include "sim/plant/plant_file.hpp"
#include "sim/plant/plant_table.hpp"

namespace feltgate {

namespace {

void take_lever(plant::LeverSetParameters& p) {
  p.encoder = p.lever.encoder;
  p.effects = p.lever.effects;
}

/// The kind of device that a file describes; each kind has a table that the others lack.
DeviceSetup setup_of(const std::string& path, config::TomlReader& top) {
  toml::table file = config::parse_toml_file(path);
  if (file.contains("linkage")) {
    PantographSetup s{plant::read_pantograph_file(path), {}};
    if (top.has("hand")) s.hand = plant::read_pen_hand(top.section("hand"));
    return s;
  }
  if (file.contains("levers")) {
    TwoLeversSetup s;
    config::TomlReader device(file, path, "the file");
    s.parameters.name = device.text("name");
    config::TomlReader levers = device.section("levers");
    const auto folder = std::filesystem::path(path).parent_path();
    s.parameters.lever = plant::read_plant_file((folder / levers.text("plant")).string());
    levers.finish();
    device.finish();
    take_lever(s.parameters);
    if (top.has("hand")) s.hand[0] = plant::read_hand(top.section("hand"));
    if (top.has("met")) s.hand[1] = plant::read_hand(top.section("met"));
    return s;
  }
  if (file.contains("slides")) {
    config::TomlReader device(file, path, "the file");
    config::TomlReader slides = device.section("slides");
    slides.integer("count", 3, 3);
    slides.finish();
    // The remaining tables describe one slide.
    file.erase("slides");
    StylusSetup s;
    s.parameters.lever = plant::read_plant(file, path);
    s.parameters.name = s.parameters.lever.name;
    take_lever(s.parameters);
    if (top.has("hand")) {
      s.hand = plant::read_stylus_hand(top.section("hand"), s.parameters.lever.lever.radius_m);
    }
    return s;
  }
  if (file.contains("bodies")) {
    GimbalSetup s{plant::read_gimbal_file(path), {}};
    if (top.has("hand")) s.hand = plant::read_turning_hand(top.section("hand"), s.parameters.stops);
    return s;
  }
  throw config::ConfigError(path +
                            ":1: no device that `feltgate run` knows; it takes one with the table "
                            "[linkage], a pantograph, [levers], [slides], a stylus, or [bodies], a "
                            "gimbal");
}

}  // namespace

AxesScene read_axes_scene(const std::string& path,
                          const std::function<std::string(const std::string&)>& find) {
  AxesScene scene;
  scene.scenario = read_device_scene(path, [&](config::TomlReader& top) {
    scene.device_path = find(top.text("device"));
    scene.device = setup_of(scene.device_path, top);
    if (!top.has("plane")) return;
    if (std::holds_alternative<TwoLeversSetup>(scene.device) ||
        std::holds_alternative<GimbalSetup>(scene.device)) {
      top.fail("plane", "a plane without a pen",
               "take device = \"pantograph\" or \"stylus\", or leave it out");
    }
    scene.plane = read_plane_host(top.section("plane"), axes_of(scene));
  });
  for (const Event& e : scene.scenario.events) {
    if (!e.step_nm && !e.open_phase) continue;
    throw config::ConfigError(fmt::format("{}:{}: {} is for scenes of one lever; leave it out",
                                          path, e.line, e.step_nm ? "step_nm" : "open_phase"));
  }
  const Scenario& s = scene.scenario;
  const int line = s.tracker ? s.tracker->line : s.rest_line > 0 ? s.rest_line : s.drag_line;
  if (line > 0) {
    throw config::ConfigError(fmt::format(
        "{}:{}: [tracker], [rest] and [drag] are for scenes of one lever; leave them out", path,
        line));
  }
  std::visit([&](const auto& setup) { resolve_effects(scene.scenario, setup.parameters.effects); },
             scene.device);
  return scene;
}

int axes_of(const AxesScene& scene) {
  return std::visit(
      [](const auto& setup) {
        return static_cast<int>(std::decay_t<decltype(setup)>::Plant::axes);
      },
      scene.device);
}

const std::string& device_of(const AxesScene& scene) {
  return std::visit([](const auto& setup) -> const std::string& { return setup.parameters.name; },
                    scene.device);
}

std::string own_design(const AxesScene& scene) { return device_of(scene) + "_law"; }

std::vector<std::string> hand_files(const AxesScene& scene) {
  std::vector<std::string> files;
  const auto add = [&files](const auto& hands) {
    for (const plant::Hand& hand : hands) {
      for (const plant::HandPhase& phase : hand.phases) {
        if (!phase.trace.file.empty()) files.push_back(phase.trace.file);
      }
    }
  };
  if (const auto* levers = std::get_if<TwoLeversSetup>(&scene.device)) add(levers->hand);
  if (const auto* stylus = std::get_if<StylusSetup>(&scene.device)) add(stylus->hand);
  return files;
}

std::vector<std::string> speed_jumps(const AxesScene& scene) {
  std::vector<std::string> all;
  const auto* levers = std::get_if<TwoLeversSetup>(&scene.device);
  if (levers == nullptr) return all;
  for (const plant::Hand& hand : levers->hand) {
    const double inertia_kg_m2 = levers->parameters.lever.lever.inertia_kg_m2;
    for (std::string& jump : speed_jumps(scene.scenario, hand, inertia_kg_m2)) {
      all.push_back(std::move(jump));
    }
  }
  return all;
}

}  // namespace feltgate
