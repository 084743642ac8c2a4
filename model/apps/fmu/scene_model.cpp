// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A scene as a model for co-simulation. Documentation: docs/other-tools.md
#include "apps/fmu/scene_model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "sim/backends/fnv1a.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate::fmu {

namespace {

namespace fs = std::filesystem;

constexpr double longest_s = 1e5;  ///< as in a scene file

/// Units by their exponents of SI, for a tool that checks or converts them.
constexpr const char* unit_definitions =
    R"(  <UnitDefinitions>
    <Unit name="s"><BaseUnit s="1"/></Unit>
    <Unit name="rad"><BaseUnit rad="1"/></Unit>
    <Unit name="rad/s"><BaseUnit rad="1" s="-1"/></Unit>
    <Unit name="Nm"><BaseUnit kg="1" m="2" s="-2"/></Unit>
    <Unit name="A"><BaseUnit A="1"/></Unit>
    <Unit name="V"><BaseUnit kg="1" m="2" s="-3" A="-1"/></Unit>
  </UnitDefinitions>
)";

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || fs::is_directory(path)) {
    throw std::invalid_argument(path + ": there is no such file; name one that can be read");
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Errors: as Scene.
Scenario scenario_of(const std::string& path, const DesignInfo& design) {
  (void)read_text(path);
  if (names_device(path)) {
    throw std::invalid_argument(path + " names a device of several axes; choose one of one lever");
  }
  Scenario s = read_scenario(path);
  if (scenes_used(s).count("law") != 0) {
    throw std::invalid_argument(path + " runs a law of its own, for which design " + design.name +
                                " has no engine; choose a scene without law");
  }
  for (const plant::HandPhase& phase : s.hand.phases) {
    if (phase.kind != plant::HandPhase::Kind::kTrace || phase.trace.file.empty()) continue;
    throw std::invalid_argument(
        fmt::format("{}:{}: the hand reads {}, which no FMU contains; give "
                    "it a motion",
                    path, phase.line, phase.trace.file));
  }
  choose_plant(s, design);
  return s;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c == '\n' ? ' ' : c;
    }
  }
  return out;
}

std::string element(const Variable& v, std::size_t reference) {
  std::string type = "Float64", role;
  switch (v.kind) {
    case Variable::Kind::time:
      role = R"(causality="independent" variability="continuous")";
      break;
    case Variable::Kind::own_hand:
      type = "Boolean";
      role = R"(causality="parameter" variability="fixed" start="false")";
      break;
    case Variable::Kind::torque:
      role = R"(causality="input" variability="continuous" start="0")";
      break;
    case Variable::Kind::output:
      if (v.column.value.is_bits()) type = "Int32";
      role = fmt::format(R"(causality="output" variability="{}" initial="calculated")",
                         v.column.value.is_bits() ? "discrete" : "continuous");
      break;
  }
  const std::string unit = v.column.unit.empty() ? "" : fmt::format(R"( unit="{}")", v.column.unit);
  return fmt::format(R"(    <{} name="{}" valueReference="{}" {}{} description="{}"/>)"
                     "\n",
                     type, v.column.name, reference, role, unit, escaped(v.column.meaning));
}

}  // namespace

const std::vector<Variable>& variables() {
  static const std::vector<Variable> all = [] {
    const ColumnValue none(&Row::time_s);
    std::vector<Variable> list{
        {Variable::Kind::time, {"time", "s", "time of the importer", 0, none}},
        {Variable::Kind::own_hand,
         {"own_hand", "", "true: push_nm acts on the lever instead of the scene's hand", 0, none}},
        {Variable::Kind::torque,
         {"push_nm", "Nm", "with own_hand: torque on the lever during the step", 0, none}}};
    for (const Column& c : row_columns(true, {})) {
      list.push_back({Variable::Kind::output, c});
    }
    return list;
  }();
  return all;
}

Scene::Scene(const std::string& scene_path, const std::string& plant_path,
             const std::string& design_name)
    : scenario(scenario_of(scene_path, design_named(design_name))), design(design_name) {
  const DesignInfo& info = design_named(design);
  Fnv1a sum;
  for (const std::string& text : {read_text(scene_path), read_text(plant_path)}) {
    for (const char c : text) sum.add_at_once(static_cast<unsigned char>(c));
    sum.add(static_cast<std::int64_t>(text.size()));
  }
  token = fmt::format("{{feltgate-{:08x}-{:016x}}}", info.design_crc, sum.value());
  plant = plant::read_plant_file(plant_path);
  resolve_effects(scenario, plant.effects);
  resolve_amounts(scenario, info);
  scenario = as_run(scenario, info);
  check_scenario(scenario, plant, info);
}

std::string plant_of_scene(const std::string& scene_path, const std::string& plants,
                           const std::string& design) {
  const std::string name = scenario_of(scene_path, design_named(design)).plant;
  const bool is_path = name.find('/') != std::string::npos || fs::path(name).extension() == ".toml";
  return is_path ? name : plants + "/" + name + ".toml";
}

std::string model_description(const Scene& scene, const std::string& identifier) {
  const Scenario& s = scene.scenario;
  std::string text = fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="{0} of feltgate {1}" description="{2}"
    instantiationToken="{3}" generationTool="feltgate product fmu" license="Apache-2.0">
  <CoSimulation modelIdentifier="{4}" canHandleVariableCommunicationStepSize="true"/>
{5}  <DefaultExperiment startTime="0" stopTime="{6}" stepSize="0.001"/>
  <ModelVariables>
)",
      escaped(s.name), scene.design, escaped(s.title), scene.token, identifier, unit_definitions,
      s.duration_s);
  const auto& all = variables();
  for (std::size_t i = 0; i < all.size(); ++i) text += element(all[i], i);
  text += "  </ModelVariables>\n  <ModelStructure>\n";
  for (const char* what : {"Output", "InitialUnknown"}) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].kind == Variable::Kind::output) {
        text += fmt::format("    <{} valueReference=\"{}\"/>\n", what, i);
      }
    }
  }
  return text + "  </ModelStructure>\n</fmiModelDescription>\n";
}

SceneModel::SceneModel(const Scene& scene)
    : scenario_(scene.scenario), plant_(scene.plant), design_(design_named(scene.design)) {
  scenario_.duration_s = longest_s;
  scenario_.expectations.clear();
  row_.theta_rad = scenario_.hand.initial_rad();
  options_.design = scene.design;
  options_.engine = "twin";
  options_.row = [this](const Row& r) { later_.push_back(r); };
}

void SceneModel::start() {
  if (own_hand_) {
    scenario_.hand.start_rad = scenario_.hand.initial_rad();
    scenario_.hand.phases.clear();
  }
  run_ = stepped_run(scenario_, plant_, options_);
}

void SceneModel::run_to(double time_s) {
  if (!(time_s >= time_s_ && time_s <= longest_s)) {
    throw std::runtime_error(
        fmt::format("the model is at {} s and goes on to {:g} s at most; {} s "
                    "is not between them",
                    time_s_, longest_s, time_s));
  }
  if (!run_) start();
  if (own_hand_ && torque_nm_ != acting_nm_) {
    plant::Segment step;
    step.kind = plant::Segment::Kind::kStep;
    step.duration_s = longest_s;
    step.to = acting_nm_ = torque_nm_;
    plant::HandPhase push;
    push.kind = plant::HandPhase::Kind::kTorque;
    push.profile = {step};
    run_->take(push);
  }
  time_s_ = time_s;
  const Clock now = std::llround(time_s * static_cast<double>(design_.clock_hz));
  run_->run_to(now);
  const std::int64_t over = now / design_.clocks_per_tick;
  for (; ticks_shown_ < over && !later_.empty(); ++ticks_shown_) {
    row_ = later_.front();
    later_.pop_front();
  }
}

}  // namespace feltgate::fmu
