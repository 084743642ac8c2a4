// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the page compares itself with: recorded pins and register writes of scenes with the hash of
// the native twin over them, and a closed loop as it went here. Documentation: docs/page.md
#include <cstdio>
#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "law_loop/scene_law.hpp"
#include "loop/scenario.hpp"
#include "page/live_loop.hpp"
#include "page/recorded_inputs.hpp"
#include "plant/plant_file.hpp"

namespace {

using nlohmann::json;
namespace page = feltgate::page;

const std::string vectors = FELTGATE_SOURCE_DIR "/vectors/";
const std::string laws = FELTGATE_SOURCE_DIR "/rtl/laws/";

/// Scenes whose inputs are recorded. The calibrations are as long as they are dull.
const std::vector<std::string> scenes_of_default = {
    "membrane",       "wall",         "damper",      "spring_compression", "spring_tension",
    "charge_attract", "charge_repel", "torque_step", "hold_and_release"};
const std::vector<std::string> scenes_of_others = {"membrane", "wall"};

json recorded(const std::string& design, const std::string& scene) {
  feltgate::Scenario scenario = feltgate::read_scenario(vectors + "scenes/" + scene + ".toml");
  const auto plant =
      feltgate::plant::read_plant_file(vectors + "plants/" + scenario.plant + ".toml");
  feltgate::resolve_effects(scenario, plant.effects);
  feltgate::RunInputs inputs;
  feltgate::RunOptions options;
  options.design = design;
  options.engine = "twin";
  options.inputs = &inputs;
  std::unique_ptr<feltgate::SceneLaw> law;
  if (!scenario.law.empty()) {
    law = feltgate::make_scene_law(laws + scenario.law + ".law", feltgate::design_named(design));
    options.law = law.get();
  }
  run_scenario(scenario, plant, options);
  const std::string text = page::text_of(inputs);
  return {{"design", design},
          {"scene", scene},
          {"seconds", scenario.duration_s},
          {"inputs", text},
          {"hash", page::hex(page::hash_of(design, page::inputs_from_text(text)))}};
}

json closed_loop(const std::string& design) {
  json rows = json::array();
  for (const page::ScriptRow& row :
       page::follow_script(design, feltgate::plant::read_plant_file(vectors + "plants/p24.toml"))) {
    rows.push_back({row.theta_rad, row.torque_nm});
  }
  return {{"design", design}, {"scene", "wall"}, {"rows", rows}};
}

}  // namespace

int main(int count, char** argv) {
  if (count < 2) {
    std::fprintf(stderr, "usage: feltgate_page_data DESIGN...\n");
    return 2;
  }
  try {
    json out = {{"recorded", json::array()}, {"closed", json::array()}};
    for (int i = 1; i < count; ++i) {
      const std::string design = argv[i];
      if (feltgate::design_named(design).scene_number("law") >= 0) {
        out["recorded"].push_back(recorded(design, "detent"));
        continue;
      }
      for (const std::string& scene : i == 1 ? scenes_of_default : scenes_of_others) {
        out["recorded"].push_back(recorded(design, scene));
      }
      out["closed"].push_back(closed_loop(design));
    }
    std::printf("%s\n", out.dump().c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "feltgate: %s\n", error.what());
    return 2;
  }
  return 0;
}
