// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate rates. Documentation: docs/speed-for-accuracy.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>

#include "apps/commands/commands.hpp"
#include "apps/commands/run_output.hpp"
#include "files/output_file.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/axes_loop/axes_run.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/rates/rates.hpp"

namespace feltgate {

namespace {

struct RatesArguments {
  std::vector<std::string> scenes, beside;
  std::string design, plant, json, picture;
  std::vector<double> rates;
  bool lock_step = false, quiet = false;
};

/// A scene with everything that its measurement needs.
struct Wanted {
  std::string name;
  Scenario scene;  ///< of one lever
  plant::Parameters plant;
  std::optional<AxesScene> device;  ///< or of a device with several axes
  rates::LawSource law;
};

/// The scene's law (its path starts at the scene's folder), or the law for its block.
rates::LawSource law_of(const Scenario& s) {
  if (const rates::BlockLaw* block = rates::block_law(s.scene)) {
    if (block->file.empty()) return {"the law for " + block->scene, block->text};
    return {find_law(block->file), ""};
  }
  if (s.law.empty()) {
    throw std::invalid_argument(fmt::format(
        "{}:{}: scene \"law\" runs a law; name one: law = \"detent\"", s.path, s.scene_line));
  }
  return {law_file(s), ""};
}

/// The design whose engine runs the law.
std::string law_design_of(const Scenario& s, const std::string& asked) {
  return asked.empty() || s.scene != "law" ? rates::law_design : asked;
}

/// A scene that names a device.
Wanted wanted_device(const std::string& path, const RatesArguments& a, files::Outputs& outputs) {
  if (!a.plant.empty() || !a.design.empty() || !a.beside.empty()) {
    refuse_for_device(!a.plant.empty()    ? "--plant"
                      : !a.design.empty() ? "--design"
                                          : "--beside",
                      path);
  }
  Wanted w;
  w.device = device_scene(path);
  const Scenario& s = w.device->scenario;
  w.name = s.name;
  if (s.law.empty()) {
    throw std::invalid_argument(
        fmt::format("{}:{}: a device of several axes needs a law; name one: law = \"pantograph\"",
                    s.path, s.scene_line));
  }
  rates::require_one_law(s);
  w.law = {law_file(s), ""};
  const DesignInfo& design = design_named(own_design(*w.device));
  const auto law = make_axes_law(w.law.path, design, axes_of(*w.device));
  resolve_amounts(w.device->scenario, design, law.get());
  check_asked(s, design, law.get());
  if (w.device->plane) PlaneHost::check(*w.device->plane, path, *law);
  for (const std::string& read : {path, w.device->device_path, w.law.path}) outputs.reads(read);
  return w;
}

Wanted wanted(const std::string& name, const RatesArguments& a, files::Outputs& outputs) {
  const std::string path = find_file(name, "vectors/scenes");
  if (names_device(path)) return wanted_device(path, a, outputs);
  Wanted w;
  w.scene = read_scenario(path);
  w.name = w.scene.name;
  if (!a.plant.empty()) w.scene.plant = a.plant;
  rates::require_one_law(w.scene);
  w.law = law_of(w.scene);
  const std::string block = a.design.empty() ? rates::block_design : a.design;
  const std::string plant_path = find_file(w.scene.plant, "vectors/plants");
  w.plant = plant::read_plant_file(plant_path);
  resolve_effects(w.scene, w.plant.effects);
  if (w.scene.scene != "law") resolve_amounts(w.scene, design_named(block));
  if (has_amounts(w.scene)) {
    const DesignInfo& design = design_named(law_design_of(w.scene, a.design));
    resolve_amounts(w.scene, design, make_scene_law(w.law.path, design).get());
  }
  if (w.scene.scene != "law") check_scenario(w.scene, w.plant, design_named(block));
  outputs.reads(path);
  outputs.reads(plant_path);
  if (w.law.text.empty()) outputs.reads(w.law.path);
  for (const auto& phase : w.scene.hand.phases) outputs.reads(phase.trace.file);
  return w;
}

/// The design with what the scene writes into its registers, such as another cut-off.
design::Elaborated with_registers(design::Elaborated e, const Scenario& scene) {
  for (design::Word& w : e.words) {
    const auto set = scene.parameters.find(w.parameter.name);
    if (set == scene.parameters.end()) continue;
    w.si = set->second;
    w.raw = std::llround(std::ldexp(w.si, w.format.fraction));
  }
  return e;
}

rates::Report measured(const Wanted& w, const rates::Options& options) {
  if (w.device) {
    return rates::measure(*w.device, w.law, elaborated_design(own_design(*w.device)), options);
  }
  const std::string design = law_design_of(w.scene, options.design);
  const auto e = with_registers(elaborated_design(design), w.scene);
  return rates::measure(w.scene, w.law, w.plant, e, options);
}

/// All scenes of vectors/scenes that render a law; the others are reported.
std::vector<Wanted> all_scenes(const RatesArguments& a, files::Outputs& outputs) {
  std::vector<Wanted> all;
  for (const std::string& name : names_in("vectors/scenes")) {
    try {
      all.push_back(wanted(name, a, outputs));
    } catch (const std::exception& error) {
      if (!a.quiet) fmt::print(stderr, "left out: {}\n", error.what());
    }
  }
  return all;
}

/// Exit code 1: bits and linear loop differ by more than 5 % for a swing of enough counts.
int verdict(const rates::Report& r) {
  constexpr double tolerance = 0.05;
  const bool off = std::any_of(r.gains.begin(), r.gains.end(), [](const rates::GainMargin& g) {
    if (std::isnan(g.bits)) return g.disagrees;
    return g.large && !(std::abs(g.bits / g.linear - 1) <= tolerance);
  });
  return off ? exit_failed : exit_ok;
}

int run(const RatesArguments& a) {
  files::Outputs outputs;
  std::vector<Wanted> scenes;
  for (const std::string& name : a.scenes) scenes.push_back(wanted(name, a, outputs));
  const bool all = a.scenes.empty();
  if (all) scenes = all_scenes(a, outputs);
  files::OutputFile* json = outputs.open("--json", a.json);
  files::OutputFile* picture = outputs.open("--output", a.picture);
  if (picture != nullptr) (void)picture->named();  // not stdout: told before the work
  rates::Options options;
  if (!a.rates.empty()) options.rates_hz = a.rates;
  options.lock_step = a.lock_step;
  options.design = a.design;
  for (const std::string& name : a.beside) {
    options.beside.push_back(elaborated_design(name));
    outputs.reads(find_file(name, "rtl/designs"));
  }
  std::vector<rates::Report> reports;
  std::int64_t mismatches = 0;
  for (const Wanted& w : scenes) {
    Progress progress("rates of " + w.name, a.quiet);
    options.progress = [&progress](double done) { progress.update(done); };
    try {
      reports.push_back(measured(w, options));
    } catch (const std::exception& error) {
      if (!all) throw;  // one that was asked for
      if (!a.quiet) fmt::print(stderr, "left out: {}\n", error.what());
      continue;
    }
    progress.finish();
    if (!a.quiet) outputs.say((reports.size() > 1 ? "\n" : "") + report_text(reports.back()));
    for (const rates::RateRow& row : reports.back().rows) {
      mismatches += row.mismatches;
      if (row.mismatches == 0) continue;
      fmt::print(stderr, "{} at {}: RTL and twin differ: {}\n", w.name,
                 rates::rate_text(row.rate_hz), row.first_mismatch);
    }
  }
  const std::string text = rates::reports_json(reports);
  if (json != nullptr) json->write(text);
  if (picture != nullptr) {
    const int status = draw_from_json("rates_picture.py", text, picture->named(), outputs);
    if (status != exit_ok) return status;
  }
  outputs.commit();
  return mismatches == 0 ? exit_ok : exit_failed;
}

}  // namespace

int scene_stability(const std::string& scene, const std::string& json, bool bits) {
  files::Outputs outputs;
  const Wanted w = wanted(scene, {}, outputs);
  files::OutputFile* file = outputs.open("--json", json);
  rates::Options options;
  options.rates_hz.clear();
  options.gains = true;
  options.bits = bits;
  options.whole_torque = true;
  const rates::Report report = measured(w, options);
  if (file != nullptr) file->write(rates::reports_json({report}));
  outputs.say(rates::gains_text(report));
  outputs.commit();
  return verdict(report);
}

void add_rates(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<RatesArguments>();
  CLI::App* sub = app.add_subcommand(
      "rates", "what a slower torque costs: error, stability, clocks and time of a scene by rate");
  sub->footer(
      R"(The scene's torque is renewed only so often and held in between, by the engine in the
core's own bits: a law of the same name stands for the core's block, which is the last
row. Error is against the law in double at the device's true angles and speeds in
every tick; 'counts alone' is what encoder and velocity estimate leave of it at any
rate. Margin: the largest stable stiffness by eigenvalues over the scene's; below 1
the lever, or the device with nobody at it, swings by itself. Of several axes the
swing of the torques in the last quarter and the scene's expectations that are kept
stand beside it. Time: of the twin, against the last row. Without SCENE all of
vectors/scenes, in about ten minutes.
  feltgate rates wall
  feltgate rates detent --rate 200,2000,20000
  feltgate rates coupled_levers                 a device with several axes
  feltgate rates wall -o wall.svg --json wall.json
  feltgate rates -o all.svg                     every scene, one picture
Exit code: 0 measured, 1 RTL and twin differed (--lock-step), 2 unusable input.
docs/speed-for-accuracy.md explains every column.)");
  option(*sub, "scene", a->scenes, "SCENE",
         "scenes: names in vectors/scenes or paths; default: all");
  option(*sub, "--rate", a->rates, "",
         "rates in Hz; default 144,490,1000,10000,40000,100000; the fastest is added",
         checks::number(1, 1e6, "Hz"))
      ->delimiter(',');
  option(*sub, "--plant", a->plant, "PLANT",
         "plant in vectors/plants, or a path; default: the scene's");
  option(*sub, "--design", a->design, "DESIGN",
         "the built design whose block runs, or whose engine of a scene \"law\"; default: "
         "lever and lever_law");
  option(*sub, "--beside", a->beside, "DESIGN,...",
         "other designs, names or files: in the JSON their counts alone, by their velocity "
         "estimate in double, and their margins")
      ->delimiter(',');
  sub->add_flag("--lock-step", a->lock_step,
                "the RTL beside the twin, every output compared: about 20 times slower");
  option(*sub, "-o,--output", a->picture, "FILE",
         "error and margin over the rate as a picture, SVG");
  option(*sub, "--json", a->json, "FILE", "the figures as JSON (docs/json.md)");
  sub->add_flag("--quiet", a->quiet, "print nothing");
  sub->callback([a, exit_code] { *exit_code = run(*a); });
}

}  // namespace feltgate
