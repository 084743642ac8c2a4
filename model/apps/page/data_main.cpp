// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes the reference data of the page: recorded pins and register writes of scenes, with the hash
// of the native twin over them; and the compiled laws that the page runs without a core.
// Documentation: docs/page.md
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/page/felt_mesh.hpp"
#include "apps/page/image_law.hpp"
#include "apps/page/law_loop.hpp"
#include "apps/page/live_loop.hpp"
#include "apps/page/recorded_inputs.hpp"
#include "law/compile.hpp"
#include "law/read_law.hpp"
#include "sim/axes_loop/axes_scene.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/shape/shape_law.hpp"

namespace {

using namespace feltgate;
using nlohmann::json;

const std::string vectors = FELTGATE_SOURCE_DIR "/vectors/";
const std::string laws = FELTGATE_SOURCE_DIR "/rtl/laws/";

/// Scenes whose inputs are recorded; the long calibrations are left out.
const std::vector<std::string> scenes_of_default = {
    "membrane",       "wall",         "damper",      "spring_compression", "spring_tension",
    "charge_attract", "charge_repel", "torque_step", "hold_and_release"};
const std::vector<std::string> scenes_of_others = {"membrane", "wall"};

json recorded(const std::string& design, const std::string& scene) {
  Scenario scenario = read_scenario(vectors + "scenes/" + scene + ".toml");
  const auto plant = plant::read_plant_file(vectors + "plants/" + scenario.plant + ".toml");
  resolve_effects(scenario, plant.effects);
  RunInputs inputs;
  RunOptions options;
  options.design = design;
  options.engine = "twin";
  options.inputs = &inputs;
  std::unique_ptr<SceneLaw> law;
  if (!scenario.law.empty()) {
    law = make_scene_law(laws + scenario.law + ".law", design_named(design));
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

/// Seven shapes as the study had them, and four squares side by side for training.
const std::vector<std::string> shapes = {"duck",      "bell",     "banana", "fish",
                                         "horseshoe", "mushroom", "square"};
constexpr double training_m = 0.036;
const std::vector<shape::Point> training_centres_m = {
    {-0.032, 0.142}, {0.032, 0.142}, {-0.032, 0.088}, {0.032, 0.088}};
constexpr double corner_m = 2e-3;
constexpr int vertices = 40;

/// The image of a shape's law, and its outline in 10 um.
json hidden(const std::string& name, const shape::Placing& placing) {
  const auto outline = shape::placed(shape::read_svg(vectors + "shapes/" + name + ".svg"), placing);
  const shape::Polygon polygon = shape::sampled(shape::rounded(outline, corner_m), vertices);
  shape::LawRequest request;
  request.summary = name;
  const auto law = law::compile_text(shape::law_text(polygon, request), name + ".law",
                                     law::target_of(design_named("lever")));
  json places = json::array();
  for (const shape::Point& p : polygon.at) {
    places.push_back({std::lround(1e5 * p.x), std::lround(1e5 * p.y)});
  }
  return {{"name", name}, {"image", law::text(law.image)}, {"outline", places}};
}

law::Compiled compiled(const std::string& law, const std::string& design = "lever",
                       double rate_hz = 0) {
  return law::compile(law::read_law(laws + law + ".law", rate_hz),
                      law::target_of(design_named(design)));
}
std::string image_of(const std::string& law, const std::string& design = "lever") {
  return law::text(compiled(law, design).image);
}
/// Where an image keeps a state.
json place_of(const law::Compiled& law, const std::string& state) {
  const page::StateWord word = page::state_word(law, state);
  return {{"address", word.address}, {"scale", word.scale}};
}

/// The law, and the inertia of the lever that each of both is.
json coupled() {
  const auto plant = plant::read_plant_file(vectors + "plants/p24.toml");
  return {{"image", image_of("coupled_levers")}, {"inertia_kg_m2", plant.lever.inertia_kg_m2}};
}

/// The law, the slides and the worlds of a stylus: device and scenes as they are shipped.
json stylus() {
  json worlds = json::array(), slides;
  for (const char* name : {"floor", "sphere", "cube"}) {
    const auto scene = read_axes_scene(
        vectors + "scenes/stylus_" + name + ".toml",
        [](const std::string& device) { return vectors + "devices/" + device + ".toml"; });
    const PlaneHostSettings& w = scene.plane.value();
    worlds.push_back({{"name", name},
                      {"kind", static_cast<int>(w.world)},
                      {"centre", {w.centre_m.x, w.centre_m.y, w.centre_m.z}},
                      {"radius_m", w.radius_m}});
    // A device file gives slides as rotation of a capstan.
    const auto& capstan = std::get<StylusSetup>(scene.device).parameters.lever.lever;
    const double r = capstan.radius_m;
    slides = {{"mass_kg", capstan.inertia_kg_m2 / (r * r)},
              {"friction_ns_m", capstan.viscous_nm_s_rad / (r * r)},
              {"capstan_m", r}};
  }
  return {{"image", image_of("local_space", "stylus_law")},
          {"image_of_edges", image_of("local_edge", "stylus_law")},
          {"slides", slides},
          {"worlds", worlds}};
}

/// The body in space, with where its image keeps the quaternion.
json gimbal() {
  const auto law = compiled("rigid_body", "gimbal_law");
  json body = json::array();
  for (const char* state : {"dw", "dx", "dy", "dz"}) body.push_back(place_of(law, state));
  return {{"image", law::text(law.image)}, {"body", body}};
}

/// The presets of the law `material` are scenes.
json materials() {
  json all = json::array();
  for (const char* name : {"stone", "fabric", "water"}) {
    const auto scenario = read_scenario(vectors + "scenes/material_" + name + ".toml");
    json values = json::object();
    for (const auto& [parameter, value] : scenario.parameters) values[parameter] = value;
    all.push_back({{"name", name}, {"parameters", values}});
  }
  return all;
}

/// The bowed string at its own rate and at that of a usual host, each with where its image keeps
/// what comes to the bridge.
json strings() {
  json all = json::array();
  for (const double rate_hz : {40e3, 1e3}) {
    const auto law = compiled("bowed_string", "lever", rate_hz);
    all.push_back({{"image", law::text(law.image)}, {"heard", place_of(law, "heard")}});
  }
  return all;
}

/// Of the mesh that the page makes itself.
json planes() {
  return {{{"mesh", "knob"}, {"hash", page::hex(stroke_hash(clean(page::knob_mesh())))}}};
}

json hidden_shapes() {
  json all = json::array();
  for (const std::string& name : shapes) all.push_back(hidden(name, {}));
  return all;
}

json training_squares() {
  json all = json::array();
  for (const shape::Point& centre : training_centres_m) {
    shape::Placing placing;
    placing.size_m = training_m;
    placing.centre_m = centre;
    all.push_back(hidden("square", placing));
  }
  return all;
}

}  // namespace

int main(int count, char** argv) {
  if (count < 2) {
    std::fprintf(stderr, "usage: feltgate_page_data DESIGN...\n");
    return 2;
  }
  try {
    json out = {{"recorded", json::array()},
                {"shapes", hidden_shapes()},
                {"training", training_squares()},
                {"drums", image_of("drums")},
                {"material", image_of("material")},
                {"materials", materials()},
                {"coupled", coupled()},
                {"strings", strings()},
                {"stylus", stylus()},
                {"gimbal", gimbal()},
                {"planes", planes()}};
    for (int i = 1; i < count; ++i) {
      const std::string design = argv[i];
      const DesignInfo info = design_named(design);
      if (info.phases == 3) continue;  // the knob's tab compares no bits
      if (info.scene_number("law") >= 0) {
        out["recorded"].push_back(recorded(design, "detent"));
        continue;
      }
      for (const std::string& scene : i == 1 ? scenes_of_default : scenes_of_others) {
        out["recorded"].push_back(recorded(design, scene));
      }
    }
    std::printf("%s\n", out.dump().c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "feltgate: %s\n", error.what());
    return 2;
  }
  return 0;
}
