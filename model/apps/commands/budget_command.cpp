// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate budget. Documentation: docs/error-bounds.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "apps/commands/checks.hpp"
#include "apps/commands/commands.hpp"
#include "apps/commands/run_output.hpp"
#include "files/json_text.hpp"
#include "files/output_file.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/law_loop/scene_law.hpp"
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
  std::string scene, plant, json;
  std::string design;  ///< empty: what the scene runs on
  std::uint64_t seed = 1;
  bool quiet = false;
};

/// A column: its heading, its name in JSON, and the member with its value.
struct Column {
  const char* heading;
  const char* name;
  double SourceBound::*value;
};

/// A scene of one axis or several, its law if it has one, and how its budgets are computed.
struct Subject {
  Scenario scene;
  std::string design;
  std::unique_ptr<SceneLaw> law;
  std::function<std::vector<SceneBudget>(const bounds::BudgetOptions&)> budgets;
};

Subject lever_subject(const std::string& path, const BudgetArguments& a, files::Outputs& outputs) {
  Subject s{read_scenario(path), a.design, nullptr, {}};
  if (s.design.empty()) s.design = own_design(s.scene);
  if (!s.scene.law.empty()) {
    s.law = make_scene_law(law_file(s.scene), design_named(s.design));
    outputs.reads(law_file(s.scene));
  }
  choose_plant(s.scene, design_named(s.design));
  if (!a.plant.empty()) s.scene.plant = a.plant;
  const std::string plant_path = find_file(s.scene.plant, "vectors/plants");
  const plant::Parameters plant = plant::read_plant_file(plant_path);
  resolve_effects(s.scene, plant.effects);
  resolve_amounts(s.scene, design_named(s.design), s.law.get());
  outputs.reads(plant_path);
  for (const auto& phase : s.scene.hand.phases) outputs.reads(phase.trace.file);
  s.budgets = [scene = s.scene, plant, e = elaborated_design(s.design)](const auto& options) {
    return std::vector<SceneBudget>{scene_budget(e, scene, plant, options)};
  };
  return s;
}

Subject device_subject(const std::string& path, const BudgetArguments& a, files::Outputs& outputs) {
  if (!a.plant.empty()) {
    throw std::invalid_argument(fmt::format(
        "--plant is for scenes of one lever, and {} names a device; leave it out", path));
  }
  AxesScene scene = read_axes_scene(
      path, [](const std::string& name) { return find_file(name, "vectors/devices"); });
  Subject s{scene.scenario, a.design, nullptr, {}};
  if (s.design.empty()) s.design = own_design(scene);
  const AxesDesignMakers* made = find_axes_design(s.design);
  if (made == nullptr) {
    throw std::invalid_argument(
        fmt::format("{}: {} is no design of a device in this program; leave --design out, and "
                    "start ./feltgate budget, which builds a program that has it",
                    path, s.design));
  }
  if (s.scene.law.empty()) {
    throw std::invalid_argument(path + ": a device of several axes needs a law");
  }
  const DesignInfo design = made->info();
  s.law = make_axes_law(law_file(s.scene), design, axes_of(scene));
  resolve_amounts(scene.scenario, design, s.law.get());
  check_asked(scene.scenario, design, s.law.get());
  if (scene.plane) PlaneHost::check(*scene.plane, path, *s.law);
  for (const std::string& read : {scene.device_path, law_file(s.scene)}) outputs.reads(read);
  for (const std::string& read : hand_files(scene)) outputs.reads(read);
  s.budgets = [scene, e = elaborated_design(s.design)](const auto& options) {
    return scene_budgets(e, scene, options);
  };
  return s;
}

constexpr Column columns[] = {{"velocity rad/s", "velocity_rad_s", &SourceBound::velocity_rad_s},
                              {"tau_hat Nm", "tau_hat_nm", &SourceBound::tau_hat_nm},
                              {"tau_ref Nm", "tau_ref_nm", &SourceBound::tau_ref_nm},
                              {"current A", "current_a", &SourceBound::current_a}};

std::string table(const SceneBudget& b) {
  std::ostringstream s;
  s << fmt::format("{:<16}", "source");
  for (const Column& c : columns) s << fmt::format(" {:>14} {:>9}", c.heading, "bound");
  s << "\n";
  const auto row = [&](const BudgetLine& l, const char* name) {
    s << fmt::format("{:<16}", name);
    for (const Column& c : columns) {
      const double bound = l.bound.*c.value;
      s << fmt::format(" {:14.3g} {:>9}", l.max.*c.value,
                       std::isfinite(bound) ? fmt::format("{:.3g}", bound) : "-");
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
  if (b.ticks_out_of_coefficients > b.ticks_out_of_bounds) {
    s << "; the row coefficients leaves out " << b.ticks_out_of_coefficients
      << ", for the steps of a ramp add up the error of their word";
  }
  s << fmt::format(
      "\nbounds are for any motion up to this one's {:.4g} rad/s before the low-pass\n",
      b.largest_velocity_rad_s);
  return s.str();
}

std::string text(const std::vector<SceneBudget>& axes, const std::string& scene,
                 const std::string& design) {
  std::ostringstream s;
  s << "scene " << scene << ", design " << design
    << ": largest error, and the proven bound (-: none)\n";
  for (std::size_t n = 0; n < axes.size(); ++n) {
    if (axes.size() > 1) s << "\naxis " << n;
    s << "\n" << table(axes[n]);
    if (!axes[n].within_bounds()) s << "an error exceeds its bound\n";
  }
  if (axes.front().ticks_apart > 0) {
    s << axes.front().ticks_apart << " ticks in which the chain in fixed point is not the core\n";
  }
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

/// Adds what a budget says of one axis.
void add_axis(Json& j, const SceneBudget& b) {
  j["ticks"] = b.ticks;
  j["ticks_out_of_bounds"] = b.ticks_out_of_bounds;
  j["ticks_out_of_coefficients"] = b.ticks_out_of_coefficients;
  j["largest_velocity_rad_s"] = b.largest_velocity_rad_s;
  for (const BudgetLine& l : b.sources) j["sources"][l.max.name] = line_json(l);
  j["sum"] = {{"max_error", signals(b.sum.max)}, {"bound", signals(b.sum.bound)}};
  j["whole"] = line_json(b.whole);
  j["gain"] = line_json(b.gain);
  j["holds"] = b.holds();
}

std::string json(const std::vector<SceneBudget>& axes, const Subject& s) {
  const bool several = axes.size() > 1;
  Json j{{"schema", several ? "feltgate-axes-budget/1" : "feltgate-budget/1"},
         {"version", FELTGATE_VERSION}};
  j["design"] = s.design;
  j["scene"] = s.scene.name;
  if (s.law) j["law"] = s.law->name();
  if (!several) add_axis(j, axes.front());
  for (std::size_t n = 0; several && n < axes.size(); ++n) {
    j["axes"].push_back(Json::object());
    add_axis(j["axes"].back(), axes[n]);
  }
  return files::json_text(j);
}

int run(const BudgetArguments& a) {
  const std::string path = find_file(a.scene, "vectors/scenes");
  files::Outputs outputs;
  outputs.reads(path);
  Subject s =
      names_device(path) ? device_subject(path, a, outputs) : lever_subject(path, a, outputs);
  outputs.reads(find_file(s.design, "rtl/designs"));
  files::OutputFile* file = outputs.open("--json", a.json);
  std::vector<SceneBudget> axes;
  {
    Progress progress(s.scene.name + " on " + s.design, a.quiet);
    bounds::BudgetOptions options{s.law.get(), a.seed, [&](double done) { progress.update(done); }};
    axes = s.budgets(options);
  }
  if (file != nullptr) file->write(json(axes, s));
  if (!a.quiet) outputs.say(text(axes, s.scene.name, s.design));
  outputs.commit();
  const bool hold = std::all_of(axes.begin(), axes.end(), [](const auto& b) { return b.holds(); });
  return hold ? exit_ok : exit_failed;
}

}  // namespace

void add_budget(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<BudgetArguments>();
  CLI::App* sub = app.add_subcommand(
      "budget", "where the error of a scene comes from, block by block, and its proven bound");
  sub->footer(
      "The scene runs once in closed loop on the twin; beside it chains in which one block alone\n"
      "is in fixed point, the others in 113 bits, get the same counts. A law runs on what each of\n"
      "them measures, and has a row in place of the scenes; a device of several axes has a table\n"
      "for each axis (docs/error-bounds.md).\n"
      "  feltgate budget spring_compression\n"
      "  feltgate budget membrane --design paper --json budget.json\n"
      "  feltgate budget detent                a law, on lever_law\n"
      "  feltgate budget coupled_levers        a device, on its own design\n"
      "Exit code: 0 every error is within its bound, 1 one is not, 2 unusable input.");
  sub->add_option("scene", a->scene, "name in vectors/scenes, or a path")
      ->required()
      ->type_name("SCENE");
  sub->add_option("--design", a->design, design_help)->type_name("DESIGN");
  sub->add_option("--plant", a->plant, "plant in vectors/plants, or a path; default: the scene's")
      ->type_name("PLANT");
  sub->add_option("--json", a->json, "the same as JSON (docs/json.md)")->type_name("FILE");
  sub->add_option("--seed", a->seed, "of the run")->capture_default_str()->check(checks::seed());
  sub->add_flag("--quiet", a->quiet, "print nothing");
  sub->callback([a, exit_code] {
    if (!a->design.empty()) a->design = built_design(a->design);
    *exit_code = run(*a);
  });
}

}  // namespace feltgate
