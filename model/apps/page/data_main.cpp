// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes the reference data of the page: recorded pins and register writes of scenes, with the hash
// of the native twin over them; the result of a closed loop; and the compiled laws that the page
// runs without a core. Documentation: docs/page.md
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
#include "apps/page/law_loops.hpp"
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

using nlohmann::json;
namespace page = feltgate::page;

const std::string vectors = FELTGATE_SOURCE_DIR "/vectors/";
const std::string laws = FELTGATE_SOURCE_DIR "/rtl/laws/";

/// Scenes whose inputs are recorded; the long calibrations are left out.
const std::vector<std::string> scenes_of_default = {
    "membrane",       "wall",         "damper",      "spring_compression", "spring_tension",
    "charge_attract", "charge_repel", "torque_step", "hold_and_release"};
const std::vector<std::string> scenes_of_others = {"membrane", "wall"};

json recorded(const std::string& design, const std::string& scene) {
  feltgate::Scenario scenario = feltgate::read_scenario(vectors + "scenes/" + scene + ".toml");
  const auto plant =
      feltgate::plant::read_plant_file(vectors + "plants/" + scenario.plant + ".toml");
  feltgate::resolve_effects(scenario, plant.effects);
  page::Recording inputs;
  feltgate::RunOptions options;
  options.design = design;
  options.engine = "twin";
  options.inputs = &inputs;
  const auto absolute = feltgate::design_named(design).absolute;
  if (absolute) {  // such a core goes clock by clock: a part is enough, over the knob's first crest
    scenario.duration_s = std::min(scenario.duration_s, 0.45);
    scenario.expectations.clear();
  }
  page::CountRecorder recorder(absolute ? absolute->bits : 0, &inputs);
  if (absolute) {
    options.plant_step = [&](feltgate::Clock clocks, const feltgate::plant::Observables& o) {
      recorder.turned(o.theta_rad, clocks);
    };
  }
  std::unique_ptr<feltgate::SceneLaw> law;
  if (!scenario.law.empty()) {
    law = feltgate::make_scene_law(laws + scenario.law + ".law", feltgate::design_named(design));
    options.law = law.get();
  }
  run_scenario(scenario, plant, options);
  if (absolute) inputs.edges.clear();  // such a core has no pins for them
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

/// Seven shapes as the study had them, and four squares side by side for training.
const std::vector<std::string> shapes = {"duck",      "bell",     "banana", "fish",
                                         "horseshoe", "mushroom", "square"};
constexpr double training_m = 0.036;
const std::vector<feltgate::shape::Point> training_centres_m = {
    {-0.032, 0.142}, {0.032, 0.142}, {-0.032, 0.088}, {0.032, 0.088}};
constexpr double corner_m = 2e-3;
constexpr int vertices = 40;

/// The image of a shape's law, and its outline in 10 um.
json hidden(const std::string& name, const feltgate::shape::Placing& placing) {
  namespace shape = feltgate::shape;
  const auto outline = shape::placed(shape::read_svg(vectors + "shapes/" + name + ".svg"), placing);
  const shape::Polygon polygon = shape::sampled(shape::rounded(outline, corner_m), vertices);
  shape::LawRequest request;
  request.summary = name;
  const auto law =
      feltgate::law::compile_text(shape::law_text(polygon, request), name + ".law",
                                  feltgate::law::target_of(feltgate::design_named("lever")));
  json places = json::array();
  for (const shape::Point& p : polygon.at) {
    places.push_back({std::lround(1e5 * p.x), std::lround(1e5 * p.y)});
  }
  return {{"name", name}, {"image", feltgate::law::text(law.image)}, {"outline", places}};
}

std::string image_of(const std::string& law) {
  const auto target = feltgate::law::target_of(feltgate::design_named("lever"));
  return feltgate::law::text(feltgate::law::compile_file(laws + law + ".law", target).image);
}

/// The law, and the inertia of the lever that each of both is.
json coupled() {
  const auto plant = feltgate::plant::read_plant_file(vectors + "plants/p24.toml");
  return {{"image", image_of("coupled_levers")}, {"inertia_kg_m2", plant.lever.inertia_kg_m2}};
}

/// The law, the slides and the worlds of a stylus: device and scenes as they are shipped.
json stylus() {
  const auto target = feltgate::law::target_of(page::stylus_design());
  const auto image = [&](const char* law) {
    return feltgate::law::text(feltgate::law::compile_file(laws + law, target).image);
  };
  json worlds = json::array(), slides;
  for (const char* name : {"floor", "sphere", "cube"}) {
    const auto scene = feltgate::read_axes_scene(
        vectors + "scenes/stylus_" + name + ".toml",
        [](const std::string& device) { return vectors + "devices/" + device + ".toml"; });
    const feltgate::PlaneHostSettings& w = scene.plane.value();
    worlds.push_back({{"name", name},
                      {"kind", static_cast<int>(w.world)},
                      {"centre", {w.centre_m.x, w.centre_m.y, w.centre_m.z}},
                      {"radius_m", w.radius_m}});
    const auto& device = std::get<feltgate::StylusSetup>(scene.device);
    const page::StylusSlides s = page::slides_of(device.parameters.lever);
    slides = {
        {"mass_kg", s.mass_kg}, {"friction_ns_m", s.friction_ns_m}, {"capstan_m", s.capstan_m}};
  }
  return {{"image", image("local_space.law")},
          {"image_of_edges", image("local_edge.law")},
          {"slides", slides},
          {"worlds", worlds}};
}

/// The body in space, with where its image keeps the quaternion.
json gimbal() {
  const auto law = feltgate::law::compile_file(laws + "rigid_body.law",
                                               feltgate::law::target_of(page::gimbal_design()));
  json body = json::array();
  for (const char* state : {"dw", "dx", "dy", "dz"}) {
    const page::StateWord word = page::state_word(law, state);
    body.push_back({{"address", word.address}, {"scale", word.scale}});
  }
  return {{"image", feltgate::law::text(law.image)}, {"body", body}};
}

/// The presets of the law `material` are scenes.
json materials() {
  json all = json::array();
  for (const char* name : {"stone", "fabric", "water"}) {
    const auto scenario = feltgate::read_scenario(vectors + "scenes/material_" + name + ".toml");
    json values = json::object();
    for (const auto& [parameter, value] : scenario.parameters) values[parameter] = value;
    all.push_back({{"name", name}, {"parameters", values}});
  }
  return all;
}

/// The bowed string at its own rate and at that of a usual host, each with where its image keeps
/// what comes to the bridge.
json strings() {
  const auto target = feltgate::law::target_of(feltgate::design_named("lever"));
  json all = json::array();
  for (const double rate_hz : {40e3, 1e3}) {
    const auto law =
        feltgate::law::compile(feltgate::law::read_law(laws + "bowed_string.law", rate_hz), target);
    const page::StateWord heard = page::state_word(law, "heard");
    all.push_back({{"rate_hz", rate_hz},
                   {"image", feltgate::law::text(law.image)},
                   {"heard", {{"address", heard.address}, {"scale", heard.scale}}}});
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
  for (const feltgate::shape::Point& centre : training_centres_m) {
    feltgate::shape::Placing placing;
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
    json out = {{"recorded", json::array()},  {"closed", json::array()},
                {"shapes", hidden_shapes()},  {"training", training_squares()},
                {"drums", image_of("drums")}, {"material", image_of("material")},
                {"materials", materials()},   {"coupled", coupled()},
                {"strings", strings()},       {"stylus", stylus()},
                {"gimbal", gimbal()},         {"planes", planes()}};
    for (int i = 1; i < count; ++i) {
      const std::string design = argv[i];
      if (feltgate::design_named(design).phases == 3) {
        out["recorded"].push_back(recorded(design, "knob_detents"));
        continue;
      }
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
