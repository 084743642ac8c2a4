// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate run. Documentation: docs/scenes.md, docs/json.md
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include "apps/commands/commands.hpp"
#include "apps/commands/run_output.hpp"
#include "files/output_file.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/scenario_bounds.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/loop/speed_jumps.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_laws(const std::string& at) {
  throw std::invalid_argument(
      at +
      "this program runs scenes of the core alone; ./feltgate run builds the one that runs laws");
}

}  // namespace

void apply_settings(const std::vector<std::string>& set, const DesignInfo& design,
                    const SceneLaw* law, Scenario& scenario) {
  std::set<std::string> given;
  for (const std::string& item : set) {
    const auto at = item.find('=');
    if (at == std::string::npos || at == 0) {
      throw std::invalid_argument("--set " + item +
                                  " is not NAME=VALUE; write for example --set voltage_gain=1");
    }
    const std::string name = item.substr(0, at);
    if (!given.insert(name).second) {
      throw std::invalid_argument("--set " + item + ": " + name +
                                  " is given twice; leave one of them out");
    }
    try {
      // For an unknown name, check_asked() lists the known ones.
      scenario.parameters[name] = parameter_in(name, item.substr(at + 1), design, law).value_or(0);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("--set {}: {}", item, error.what()));
    }
    scenario.parameter_lines.erase(name);  // an error in it is none of the file
  }
}

void refuse_for_device(const std::string& option, const std::string& scene) {
  throw std::invalid_argument(fmt::format(
      "{} is for scenes of one lever, and {} names a device; leave it out", option, scene));
}

namespace {

/// In mismatch/ in the build folder, or in the current folder.
std::string waveform_path(const SessionResult& r) {
  const char* build = std::getenv("FELTGATE_BUILD");
  const fs::path folder = build != nullptr ? fs::path(build) / "mismatch" : fs::path("mismatch");
  fs::create_directories(folder);
  return (folder / (r.subject + "." + r.design + ".fst")).string();
}

}  // namespace

void show_mismatch(const SessionResult& r, BackendOptions options,
                   const std::function<void(const BackendOptions& again)>& run) {
  if (r.mismatches == 0) return;
  constexpr Clock before = 200, after = 20;
  files::OutputFile waveform("waveform", waveform_path(r));
  options.fst = waveform.named();
  options.fst_from = r.first_mismatch_clock - before;
  options.fst_to = r.first_mismatch_clock + after;
  run(options);
  waveform.commit();
  fmt::print(stderr,
             "first mismatch: {}\nwaveform: gtkwave {} {}/scripts/gtkwave/feltgate_core.gtkw\n",
             r.first_mismatch, waveform.path(), repository());
}

Scenario cut_after(Scenario scenario, const SessionResult& r, Clock clocks) {
  scenario.duration_s =
      std::max(1e-5, r.simulated_s * static_cast<double>(clocks) / static_cast<double>(r.clocks));
  scenario.expectations.clear();
  return scenario;
}

LawScenes& law_scenes() {
  static LawScenes all;
  return all;
}

std::string law_file(const Scenario& s) {
  const bool path = s.law.find('/') != std::string::npos || fs::path(s.law).extension() == ".law";
  if (path) return (fs::path(s.path).parent_path() / s.law).string();
  try {
    return find_law(s.law);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}:{}: {}", s.path, s.law_line, error.what()));
  }
}

namespace {

/// The law of the scene; nullptr if it has none.
std::unique_ptr<SceneLaw> law_of(const Scenario& s, const DesignInfo& design) {
  const bool renders = scenes_used(s).count("law") != 0;
  if (s.law.empty() && !renders) return nullptr;
  const std::string at = fmt::format("{}:{}: ", s.path, s.law.empty() ? s.scene_line : s.law_line);
  if (s.law.empty()) {
    throw std::invalid_argument(at + "scene \"law\" runs a law; name one: law = \"detent\"");
  }
  if (!renders) {
    throw std::invalid_argument(at + "no scene renders the law; write scene = \"law\"");
  }
  if (design.scene_number("law") < 0) {
    throw std::invalid_argument(fmt::format(
        "{}design {} has no engine for a law; use --design lever_law", at, design.name));
  }
  if (law_scenes().law == nullptr) refuse_laws(at);
  return law_scenes().law(law_file(s), design);
}

/// A row for each run of the law.
void write_states(files::OutputFile& to, const SceneLaw& law, RunOptions& options) {
  to.write(fmt::format("time_s,{}\n", fmt::join(law.states(), ",")));
  options.law_states = [&to](double at_s, const std::vector<double>& states) {
    to.write(fmt::format("{:.9g},{:.9g}\n", at_s, fmt::join(states, ",")));
  };
}

/// The design of --design, else that for which the scene is made.
std::string design_of(const RunArguments& a, const Scenario& s) {
  return built_design(!a.design.empty() ? a.design : own_design(s));
}

/// What a reader of the scene may expect otherwise.
std::vector<std::string> scene_notes(const Scenario& s, double count_rad) {
  std::vector<std::string> notes;
  std::set<std::string> laws = scenes_used(s);
  for (const char* anywhere : {"free", "setpoint", "damper"}) laws.erase(anywhere);
  const double start_rad = s.hand.initial_rad();
  if (!laws.empty() && std::abs(start_rad) >= count_rad) {
    notes.push_back(fmt::format(
        "the core counts from the angle where the lever starts, {:g} rad: what {} puts at an angle "
        "is met that much further",
        start_rad, *laws.begin()));
  }
  double stopped_s = -1;
  for (const Event& e : s.events) {
    if (e.stop.value_or(false) && stopped_s < 0) stopped_s = e.at_s;
    if (!e.arm.value_or(false) || stopped_s < 0) continue;
    notes.push_back(fmt::format(
        "arm = true at {:g} s does nothing: the stop of {:g} s is a latched fault, and a scene "
        "cannot clear one",
        e.at_s, stopped_s));
  }
  double asked_s = s.arm_s;  // -1: the request is low
  for (const Event& e : s.events) {
    if (!e.arm) continue;
    if (*e.arm && asked_s >= 0 && asked_s < e.at_s && stopped_s < 0) {
      notes.push_back(
          fmt::format("arm = true at {:g} s is no new request, that of {:g} s still stands; an "
                      "event with arm = false before it ends that one",
                      e.at_s, asked_s));
    }
    asked_s = *e.arm ? e.at_s : -1;
  }
  return notes;
}

int run(RunArguments a) {
  if (a.columns && a.scene.empty()) {
    fmt::print("{}", columns_markdown());
    return exit_ok;
  }
  if (a.scene.empty()) throw std::invalid_argument("run: SCENE is missing; feltgate run --help");
  const std::string scene_path = find_file(a.scene, "vectors/scenes");
  if (names_device(scene_path)) {
    for (const auto& [option, value] : {std::pair{"--plant", a.plant},
                                        {"--report", a.report},
                                        {"--record", a.record},
                                        {"--events", a.events},
                                        {"--states", a.states}}) {
      if (!value.empty()) refuse_for_device(option, a.scene);
    }
    if (a.torque_scale > 0) {
      throw std::invalid_argument("--torque-scale is for scenes of one lever; leave it out");
    }
    if (law_scenes().axes == nullptr) refuse_laws(scene_path + ": ");
    if (!a.design.empty()) a.design = built_design(a.design);
    return law_scenes().axes(scene_path, a);
  }
  if (a.columns) {
    fmt::print("{}", columns_markdown());
    return exit_ok;
  }
  Scenario scenario = read_scenario(scene_path);
  a.design = design_of(a, scenario);
  const DesignInfo& design = design_named(a.design);
  choose_plant(scenario, design);
  if (!a.plant.empty()) scenario.plant = a.plant;
  const std::string plant_path = find_file(scenario.plant, "vectors/plants");
  const plant::Parameters plant = plant::read_plant_file(plant_path);
  resolve_effects(scenario, plant.effects);
  const std::unique_ptr<SceneLaw> law = law_of(scenario, design);
  if (a.torque_scale > 0) {
    scale_torques(scenario, a.torque_scale, elaborated_design(own_design(scenario)), design);
  }
  resolve_amounts(scenario, design, law.get());
  apply_settings(a.set, design, law.get(), scenario);
  check_scenario(scenario, plant, design, law.get());

  if (a.every > 0 && a.csv.empty() && a.report.empty()) {
    throw std::invalid_argument("--every thins out the rows of --csv; add --csv FILE");
  }
  RunOptions options;
  options.design = a.design;
  options.engine = a.engine;
  options.seed = a.seed;
  options.law = law.get();
  // Outputs are opened before the run: an unwritable name must not waste the run.
  files::Outputs outputs;
  outputs.reads(scene_path);
  outputs.reads(plant_path);
  for (const auto& phase : scenario.hand.phases) outputs.reads(phase.trace.file);
  if (law) outputs.reads(law_file(scenario));
  outputs.reads(find_file(a.design, "rtl/designs"));
  outputs.folder("--report", a.report, "report.html");
  files::OutputFile* json = outputs.open("--json", a.json);
  files::OutputFile* csv = outputs.open("--csv", a.csv);
  files::OutputFile* fst = outputs.open("--fst", a.fst);
  files::OutputFile* record = outputs.open("--record", a.record);
  files::OutputFile* events = outputs.open("--events", a.events);
  files::OutputFile* states = outputs.open("--states", a.states);
  if (law == nullptr && (events != nullptr || states != nullptr)) {
    throw std::invalid_argument(fmt::format(
        "{}:{}: {}, and the scene runs none; name one: law = \"drums\"", scene_path,
        scenario.scene_line,
        events != nullptr ? "--events writes what a law tells" : "--states writes those of a law"));
  }
  if (states != nullptr) write_states(*states, *law, options);
  if (fst != nullptr) options.fst = fst->named();
  if (record != nullptr) options.record = record->handle();
  const design::Elaborated elaborated = elaborated_design(a.design);
  const std::vector<Column> columns = row_columns(true, choose_backends(a.engine).names());
  std::vector<CsvWriter> writers;
  if (csv != nullptr) writers.emplace_back(csv->handle(), columns);
  const auto of_report = [&](const std::string& path) {
    if (std::filesystem::exists(path)) {
      throw std::invalid_argument(
          fmt::format("--report {}: {} is there already and would be replaced; give another folder",
                      a.report, path));
    }
    return outputs.open("--report", path);
  };
  // The report reads files, so outputs to stdout or a device are also written to a file for it.
  std::string json_path = a.json, csv_path = a.csv;
  if (!a.report.empty()) {
    const std::string begin = a.report + "/" + scenario.name;
    if (json == nullptr || json->in_place()) json_path = begin + ".json";
    if (csv == nullptr || csv->in_place()) {
      csv_path = begin + ".csv";
      writers.emplace_back(of_report(csv_path)->handle(), columns);
    }
  }
  files::OutputFile* report_json = json_path == a.json ? nullptr : of_report(json_path);
  if (!writers.empty()) {
    const auto ticks = static_cast<std::int64_t>(scenario.duration_s *
                                                 static_cast<double>(elaborated.design.tick_hz));
    options.row_every = a.every > 0 ? a.every : sane_every(ticks);
    if (!a.quiet) fmt::print(stderr, "{}\n", writers[0].forecast(ticks, options.row_every));
    options.row = [&writers](const Row& r) {
      for (CsvWriter& writer : writers) writer.add(r);
    };
  }
  Progress progress(scenario.name + " on " + a.design, a.quiet);
  options.progress = [&progress](double done) { progress.update(done); };
  const RunResult result = run_within_bounds(elaborated, scenario, plant, options);
  const Scenario as = as_run(scenario, design);
  RunLabels labels{"scene", plant.name, "", as.step_clocks, effects_off(as)};
  labels.differing = stability::differing_constants(elaborated.design, plant, scenario.effects);
  labels.plant_as_named = scenario.plant;
  labels.speed_jumps = speed_jumps(scenario, plant);
  const auto arms = [](const Event& e) { return e.arm.value_or(false); };
  if (scenario.arm_s >= scenario.duration_s &&
      std::none_of(scenario.events.begin(), scenario.events.end(), arms)) {
    labels.never_armed_s = scenario.arm_s;
  }
  if (elaborated.design.absolute) {
    labels.encoder =
        fmt::format("absolute, {} bits, a reading every {} ticks", elaborated.design.absolute_bits,
                    elaborated.design.absolute_period_ticks());
  }
  labels.notes = scene_notes(scenario, elaborated.design.count_rad());
  if (a.torque_scale > 0) {
    labels.notes.push_back(fmt::format("torques are {:g} of those of design {}", a.torque_scale,
                                       own_design(scenario)));
  }
  for (files::OutputFile* file : {json, report_json}) {
    if (file != nullptr) file->write(run_json(result, labels));
  }
  if (events != nullptr) events->write(event_lines(result.events, law->period_s()));
  if (!a.quiet) {
    outputs.say(run_text(result, labels));
  }
  outputs.commit();
  const bool ok = result.as_expected();
  if (!a.report.empty()) {
    const int status =
        run_script("report.py", {"--", a.report, json_path, csv_path}, outputs.text());
    if (status != 0) return status < exit_signal ? exit_unusable : status;
  }
  if (a.quiet) {
    for (const std::string& line : result.broken) std::fprintf(stderr, "%s\n", line.c_str());
  }
  show_mismatch(result, options, [&](const BackendOptions& same) {
    const std::unique_ptr<SceneLaw> from_start = law_of(scenario, design);
    RunOptions again;
    static_cast<BackendOptions&>(again) = same;
    again.law = from_start.get();
    run_scenario(cut_after(scenario, result, same.fst_to + 1), plant, again);
  });
  return ok ? exit_ok : exit_failed;
}

}  // namespace

void add_run(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<RunArguments>();
  CLI::App* sub =
      app.add_subcommand("run", "one scene in closed loop: core, motor, lever and hand");
  sub->footer(R"(SCENE is a name in vectors/scenes or the path of a scene file (docs/scenes.md).
  feltgate run membrane                      RTL and twin in lock-step, float, double, quad
  feltgate run torque_step --design paper --report out
  feltgate run damper --engine twin,double,float --csv damper.csv    fixed beside float
  feltgate run detent                        a scene with a law of its own (docs/laws.md)
Exit code: 0 no mismatch, every expectation of the scene holds and every error is within its
proven bound (a torque without one: within 10 % of the largest asked), 1 otherwise, 2
unusable input.)");
  option(*sub, "scene", a->scene, "SCENE", "scene");
  option(*sub, "--design", a->design, "DESIGN",
         "design point in rtl/designs; default: the scene's, else lever");
  option(*sub, "--plant", a->plant, "PLANT",
         "plant in vectors/plants, or a path; default: the scene's");
  option(*sub, "--torque-scale", a->torque_scale, "FACTOR",
         "of a scene made for another design: multiply its torques by this (docs/scenes.md)",
         checks::number(1e-3, 1e3, ""));
  defaulted(*sub, "--engine", a->engine, "ENGINES", backend_help);
  option(*sub, "--set", a->set, "NAME=VALUE",
         "parameter to set before arming, in its unit or with one: wall_stiffness=0.1Nm/deg; may "
         "be repeated");
  defaulted(*sub, "--seed", a->seed, "", "of the RTL's state before reset", checks::seed());
  option(*sub, "--report", a->report, "DIR",
         "folder for an HTML report with pictures, JSON and CSV");
  option(*sub, "--json", a->json, "FILE", "figures as JSON (docs/json.md)");
  option(*sub, "--csv", a->csv, "FILE",
         "a row per tick, the columns of every back-end (docs/json.md)");
  option(*sub, "--every", a->every, "TICKS", every_help, checks::whole(1, 1'000'000'000));
  sub->add_flag("--columns", a->columns,
                "print the CSV columns of SCENE, of one lever without, and end");
  option(*sub, "--fst", a->fst, "FILE",
         "waveform of every clock of the RTL (large: short scenes only)");
  option(*sub, "--record", a->record, "FILE",
         "the encoder's edges as a vector file (docs/traces.md)");
  option(*sub, "--events", a->events, "FILE",
         "events of the scene's law as lines for Pure Data (docs/devices/strings-and-drums.md)");
  option(*sub, "--states", a->states, "FILE",
         "states of the scene's law after each of its runs, CSV, SI (docs/laws.md)");
  sub->add_flag("--quiet", a->quiet, "print only what went wrong");
  sub->callback([a, exit_code] { *exit_code = run(*a); });
}

}  // namespace feltgate
