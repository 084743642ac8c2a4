// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate budget. Documentation: docs/error-bounds.md
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/commands/checks.hpp"
#include "apps/commands/commands.hpp"
#include "files/json_text.hpp"
#include "files/output_file.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/budget/scene_budget.hpp"

namespace feltgate {

namespace {

using bounds::BudgetLine;
using bounds::SceneBudget;
using bounds::SourceBound;
using Json = nlohmann::ordered_json;

struct BudgetArguments {
  std::string scene, design = "lever", plant, json;
  std::uint64_t seed = 1;
  bool quiet = false;
};

/// A column: its heading, its name in JSON, and the member with its value.
struct Column {
  const char* heading;
  const char* name;
  double SourceBound::*value;
};

constexpr Column columns[] = {{"velocity rad/s", "velocity_rad_s", &SourceBound::velocity_rad_s},
                              {"tau_hat Nm", "tau_hat_nm", &SourceBound::tau_hat_nm},
                              {"tau_ref Nm", "tau_ref_nm", &SourceBound::tau_ref_nm},
                              {"current A", "current_a", &SourceBound::current_a}};

std::string text(const SceneBudget& b, const std::string& scene, const std::string& design) {
  std::ostringstream s;
  s << "scene " << scene << ", design " << design << ": largest error, and the proven bound\n\n";
  s << fmt::format("{:<16}", "source");
  for (const Column& c : columns) s << fmt::format(" {:>14} {:>9}", c.heading, "bound");
  s << "\n";
  const auto row = [&](const BudgetLine& l, const char* name) {
    s << fmt::format("{:<16}", name);
    for (const Column& c : columns) {
      s << fmt::format(" {:14.3g} {:9.3g}", l.max.*c.value, l.bound.*c.value);
    }
    s << "\n";
  };
  for (const BudgetLine& l : b.sources) row(l, l.max.name.c_str());
  row(b.sum, "sum");
  row(b.whole, "whole");
  row(b.gain, "2^n (not in it)");
  s << "\n" << b.ticks << " ticks";
  if (b.ticks_out_of_bounds > 0) {
    s << ", of which " << b.ticks_out_of_bounds
      << " in no row: a ramp or saturation and what follows";
  }
  s << fmt::format(
      "\nbounds are for any motion up to this one's {:.4g} rad/s before the low-pass\n",
      b.largest_velocity_rad_s);
  if (!b.holds()) s << "an error exceeds its bound\n";
  return s.str();
}

Json signals(const SourceBound& x) {
  Json j;
  for (const Column& c : columns) {
    const double v = x.*c.value;
    j[c.name] = std::isfinite(v) ? Json(v) : Json(nullptr);
  }
  return j;
}

Json line_json(const BudgetLine& l) {
  return {
      {"max_error", signals(l.max)}, {"rms_error", signals(l.rms)}, {"bound", signals(l.bound)}};
}

std::string json(const SceneBudget& b, const std::string& scene, const std::string& design) {
  Json j{{"schema", "feltgate-budget/1"}, {"version", FELTGATE_VERSION}};
  j["design"] = design;
  j["scene"] = scene;
  j["ticks"] = b.ticks;
  j["ticks_out_of_bounds"] = b.ticks_out_of_bounds;
  j["largest_velocity_rad_s"] = b.largest_velocity_rad_s;
  for (const BudgetLine& l : b.sources) j["sources"][l.max.name] = line_json(l);
  j["sum"] = {{"max_error", signals(b.sum.max)}, {"bound", signals(b.sum.bound)}};
  j["whole"] = line_json(b.whole);
  j["gain"] = line_json(b.gain);
  j["holds"] = b.holds();
  return files::json_text(j);
}

int run(const BudgetArguments& a) {
  Scenario scenario = read_scenario(find_file(a.scene, "vectors/scenes"));
  require_no_law(scenario, "budget");
  if (!a.plant.empty()) scenario.plant = a.plant;
  const std::string plant_path = find_file(scenario.plant, "vectors/plants");
  const plant::Parameters plant = plant::read_plant_file(plant_path);
  resolve_effects(scenario, plant.effects);
  const auto e = elaborate(design::read_design(find_file(a.design, "rtl/designs")),
                           design::read_registers(repository() + "/rtl/registers.toml"));
  resolve_amounts(scenario, design_named(e.design.name));
  files::Outputs outputs;
  outputs.reads(scenario.path);
  outputs.reads(plant_path);
  for (const auto& phase : scenario.hand.phases) outputs.reads(phase.trace.file);
  outputs.reads(find_file(a.design, "rtl/designs"));
  files::OutputFile* file = outputs.open("--json", a.json);
  SceneBudget b;
  {
    Progress progress(scenario.name + " on " + e.design.name, a.quiet);
    b = bounds::scene_budget(e, scenario, plant, a.seed,
                             [&](double done) { progress.update(done); });
  }
  if (file != nullptr) file->write(json(b, scenario.name, e.design.name));
  if (!a.quiet) outputs.say(text(b, scenario.name, e.design.name));
  outputs.commit();
  return b.holds() ? exit_ok : exit_failed;
}

}  // namespace

void add_budget(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<BudgetArguments>();
  CLI::App* sub = app.add_subcommand(
      "budget", "where the error of a scene comes from, block by block, and its proven bound");
  sub->footer(
      "The scene runs once in closed loop on the twin; then chains in which one block alone is in\n"
      "fixed point, the others in 113 bits, see the same counts (docs/error-bounds.md).\n"
      "  feltgate budget spring_compression\n"
      "  feltgate budget membrane --design paper --json budget.json\n"
      "Exit code: 0 every error is within its bound, 1 one is not, 2 unusable input.");
  sub->add_option("scene", a->scene, "name in vectors/scenes, or a path")
      ->required()
      ->type_name("SCENE");
  sub->add_option("--design", a->design, "design point in rtl/designs")
      ->type_name("DESIGN")
      ->capture_default_str();
  sub->add_option("--plant", a->plant, "plant in vectors/plants, or a path; default: the scene's")
      ->type_name("PLANT");
  sub->add_option("--json", a->json, "the same as JSON (docs/json.md)")->type_name("FILE");
  sub->add_option("--seed", a->seed, "of the run")->capture_default_str()->check(checks::seed());
  sub->add_flag("--quiet", a->quiet, "print nothing");
  sub->callback([a, exit_code] {
    a->design = built_design(a->design);
    *exit_code = run(*a);
  });
}

}  // namespace feltgate
