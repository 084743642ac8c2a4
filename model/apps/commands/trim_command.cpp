// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate trim. Documentation: docs/speed-for-accuracy.md
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <memory>
#include <sstream>
#include <thread>

#include "apps/commands/commands.hpp"
#include "apps/commands/run_output.hpp"
#include "feltgate/largest.hpp"
#include "files/output_file.hpp"
#include "files/table.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/rates/rates.hpp"
#include "studies/trim/trim.hpp"

namespace feltgate {

namespace {

using files::Columns;
using files::Json;

struct TrimArguments {
  std::string scene, plant, output, json, tolerance = "1%";
  std::string design;  ///< empty: what the scene runs on
  double window_ms = 1e3 * felt_window_s, duration_s = 0;
  bool quiet = false, full_step = false;
  trim::Options options;
};

/// "1%" or "0.01".
double share_of(const std::string& text) {
  std::size_t end = 0;
  double value = 0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  const std::string unit = text.substr(end);
  if (unit == "%") value /= 100;
  if (end == 0 || !(unit.empty() || unit == "%") || !(value > 0 && value <= 1)) {
    throw std::invalid_argument("--tolerance " + text +
                                " is no share in (0, 1]; write for example 1% or 0.01");
  }
  return value;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[20];
  std::strftime(text, sizeof text, "%Y-%m-%d", std::localtime(&now));
  return text;
}

/// A scene to be trimmed, with what the texts say of it.
struct Trimmed {
  Scenario scene;     ///< of a device: without plant and hand
  std::string plant;  ///< or device
  trim::Subject subject;
};

/// What is off in `model`: what the scene itself leaves out, and what was trimmed.
std::vector<std::string> off(const Trimmed& t, const trim::Model& model) {
  Scenario s = t.scene;
  s.effects = model.effects;
  s.switched = model.gates || s.plant.empty();  // a device has mean voltages at any time
  std::vector<std::string> names = effects_off(s);
  const auto has = [](const std::vector<std::string>& all, const std::string& name) {
    return std::find(all.begin(), all.end(), name) != all.end();
  };
  const std::vector<std::string> left = t.subject.parts(model);
  for (const std::string& part : t.subject.parts(t.subject.full)) {
    if (!has(left, part) && !has(names, part)) names.push_back(part);
  }
  return names;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& w : words) text += (text.empty() ? "" : " ") + w;
  return text.empty() ? "none" : text;
}

double cost(const trim::Felt& felt) { return felt.cpu_s / felt.simulated_s; }

/// Losses in torque, position and force, in the text in percent.
template <class Row>
void add_difference(Columns<Row>& to, const std::string& key, trim::Difference Row::*of) {
  const auto loss = [&](const std::string& name, trim::Loss trim::Difference::*part) {
    to.push_back({key + "/" + name + "/peak", [=](const Row& r) { return (r.*of.*part).peak; },
                  name + " %\npeak", "{:.2f}", 100});
    to.push_back({key + "/" + name + "/rms", [=](const Row& r) { return (r.*of.*part).rms; }, "rms",
                  "{:.2f}", 100});
  };
  loss("torque", &trim::Difference::torque);
  loss("position", &trim::Difference::position);
  loss("force", &trim::Difference::force);
}

std::string part_text(const trim::PartReport& p) {
  if (p.put_back) return "put back by the final check";
  if (p.dropped) return fmt::format("off; all so far {:.2f} %", 100 * p.so_far);
  if (p.so_far > 0) return fmt::format("stays; the set would be {:.2f} % off", 100 * p.so_far);
  return "stays";
}

Columns<trim::PartReport> part_columns() {
  using trim::PartReport;
  Columns<PartReport> all{{"name", &PartReport::name, "<left out\nalone"}};
  add_difference(all, "alone", &PartReport::alone);
  all.push_back({"saves", &PartReport::saves, "saves\nof time", "{:.1f} %", 100});
  all.push_back({"", part_text, "< "});
  all.push_back({"off", &PartReport::dropped});
  all.push_back({"put_back", &PartReport::put_back});
  return all;
}

Columns<trim::UnseenReport> motion_columns() {
  using trim::UnseenReport;
  Columns<UnseenReport> all{
      {"", [](auto& u) { return u.searched ? "searched too" : "unseen"; }, "<motion"},
      {"seed", &UnseenReport::seed, "seed"},
      {"amplitude", &UnseenReport::amplitude, "way", "x{:.2f}"},
      {"speed", &UnseenReport::speed, "speed", "x{:.2f}"},
      {"searched", &UnseenReport::searched}};
  add_difference(all, "difference", &UnseenReport::difference);
  return all;
}

/// The speed of the trimmed model in that of the full one, with the spread of the runs.
std::string speed_text(const trim::Report& r) {
  return fmt::format("{:.3g} times the full model's (median of {} runs, {:.3g} to {:.3g})",
                     r.times_faster(), r.faster.size(), r.faster.front(), r.faster.back());
}

std::string text_of(const trim::Report& r, const Trimmed& t, const TrimArguments& a) {
  std::ostringstream s;
  for (const std::string& b : r.trimmed_run.broken) s << "trimmed, not as expected: " << b << "\n";
  s << "scene " << t.scene.name << ", design " << a.options.design
    << (t.scene.plant.empty() ? ", device " : ", plant ") << t.plant << "\n"
    << fmt::format("tolerance {:.3g} % of peak and of rms, means over {:.3g} ms\n",
                   100 * a.options.tolerance, a.window_ms)
    << "full model: " << joined(t.subject.parts(r.full))
    << fmt::format(", {} clocks a step: {:.3g} s of CPU time per simulated second\n\n",
                   r.full.step_clocks, cost(r.full_run))
    << table(part_columns(), r.parts) << "\neffects off: " << joined(off(t, r.trimmed)) << "\n"
    << fmt::format("step: {} clocks\nown motion: {:.2f} % off at worst; others:\n",
                   r.trimmed.step_clocks, 100 * r.own.worst())
    << table(motion_columns(), r.unseen);
  if (r.full_run.states > 0) {
    s << fmt::format("states of the plant {} -> {}; ", r.full_run.states, r.trimmed_run.states);
  }
  s << fmt::format("CPU per simulated second {:.3g} -> {:.3g} s\nspeed: {}\n", cost(r.full_run),
                   cost(r.trimmed_run), speed_text(r));
  for (const trim::Felt* run : {&r.full_run, &r.trimmed_run}) {
    if (run->fault.empty()) continue;
    s << (run == &r.full_run ? "full model" : "trimmed") << ": a fault opens the gates, "
      << run->fault << "\n";
  }
  if (!r.smaller()) {
    s << (r.out_of_time ? "the search took longer than --search-limit: everything stays on\n"
                        : "nothing can be left out within the tolerance\n");
  }
  s << fmt::format("search: {} runs, {:.3g} s of CPU time\n", r.runs, r.cpu_s);
  return s.str();
}

Json model_json(const Trimmed& t, const trim::Model& model, const trim::Felt& felt) {
  return {{"effects_off", off(t, model)},
          {"step_clocks", model.step_clocks},
          {"plant_states", felt.states},
          {"cpu_s_per_s", cost(felt)}};
}

std::string json_of(const trim::Report& r, const Trimmed& t, const TrimArguments& a) {
  return files::json_text(
      {{"schema", "feltgate-trim/1"},
       {"version", FELTGATE_VERSION},
       {"date", today()},
       {"scene", t.scene.name},
       {"design", a.options.design},
       {"plant", t.plant},
       {"tolerance", a.options.tolerance},
       {"window_s", a.options.window_s},
       {"full", model_json(t, r.full, r.full_run)},
       {"trimmed", model_json(t, r.trimmed, r.trimmed_run)},
       {"faster",
        {{"median", r.times_faster()},
         {"least", r.faster.front()},
         {"most", r.faster.back()},
         {"runs", r.faster.size()}}},
       {"own_motion", object_of(motion_columns(), {0, 1, 1, r.own})["difference"]},
       {"parts", array_of(part_columns(), r.parts)},
       {"unseen", array_of(motion_columns(), r.unseen)},
       {"out_of_time", r.out_of_time},
       {"expectations_broken", r.trimmed_run.broken},
       {"runs", r.runs},
       {"search_cpu_s", r.cpu_s}});
}

std::string comment_of(const trim::Report& r, const Trimmed& t, const TrimArguments& a) {
  std::ostringstream s;
  double worst = r.own.worst();
  for (const trim::UnseenReport& u : r.unseen) worst = larger(worst, u.difference.worst());
  s << "Written on " << today() << " by: feltgate trim " << t.scene.name << " --design "
    << a.options.design << " --tolerance " << a.tolerance << "\n"
    << "effects off: " << joined(off(t, r.trimmed)) << "\n"
    << (a.duration_s > 0 ? fmt::format("On its first {:g} s. ", a.duration_s) : "")
    << fmt::format(
           "Within {:.3g} % of the full model on its own motion and on {} others; speed {}.",
           100 * worst, r.unseen.size(), speed_text(r));
  return s.str();
}

/// Cuts the scene after --duration.
void cut(Scenario& scene, const TrimArguments& a) {
  constexpr double fewest_windows = 10;  // fewer say nothing of a scene
  if (a.duration_s > 0 && a.duration_s < fewest_windows * a.options.window_s) {
    throw std::invalid_argument(fmt::format(
        "--duration {:g}: is shorter than {:g} windows of {:g} ms; give at least {:g} s",
        a.duration_s, fewest_windows, a.window_ms, fewest_windows * a.options.window_s));
  }
  if (a.duration_s > scene.duration_s) {
    throw std::invalid_argument(
        fmt::format("--duration {:g}: the scene is over after {:g} s; give less", a.duration_s,
                    scene.duration_s));
  }
  if (a.duration_s > 0 && a.duration_s < scene.duration_s) {
    scene.duration_s = a.duration_s;
    scene.expectations.clear();
  }
}

/// Makes the law, compiled once; empty for a scene that renders none.
trim::LawMaker law_of(const Scenario& scene, const DesignInfo& design, int axes) {
  if (scene.law.empty()) return {};
  const std::string path = law_file(scene);
  law::Target target = law::target_of(design);
  target.axes = axes;
  law::Compiled compiled = law::compile_file(path, target);
  if (axes == 1) require_one_torque(compiled, path);
  return [compiled = std::move(compiled), path, design, axes] {
    return axes > 1 ? make_axes_law(compiled, path, design, axes)
                    : make_scene_law(compiled, design);
  };
}

Trimmed trimmed_lever(const std::string& path, TrimArguments& a, files::Outputs& outputs) {
  Scenario scene = read_scenario(path);
  if (a.design.empty()) a.options.design = own_design(scene);
  const DesignInfo& design = design_named(a.options.design);
  const trim::LawMaker law = law_of(scene, design, 1);
  const std::unique_ptr<SceneLaw> own = law ? law() : nullptr;
  resolve_amounts(scene, design, own.get());
  choose_plant(scene, design);
  if (!a.plant.empty()) scene.plant = a.plant;
  cut(scene, a);
  const std::string plant_path = find_file(scene.plant, "vectors/plants");
  const plant::Parameters plant = plant::read_plant_file(plant_path);
  outputs.reads(plant_path);
  for (const auto& phase : scene.hand.phases) outputs.reads(phase.trace.file);
  if (law) outputs.reads(law_file(scene));
  const std::string name = scene.plant;
  trim::Subject subject = trim::lever_subject(scene, plant, a.options, law);
  return {std::move(scene), name, std::move(subject)};
}

Trimmed trimmed_device(const std::string& path, TrimArguments& a, files::Outputs& outputs) {
  const char* of_lever = !a.plant.empty() ? "--plant" : a.full_step ? "--full-step" : nullptr;
  if (of_lever != nullptr) refuse_for_device(of_lever, path);
  AxesScene scene = device_scene(path);
  if (a.design.empty()) a.options.design = own_design(scene);
  const DesignInfo& design = design_named(a.options.design);
  if (design.axes != static_cast<int>(axes_of(scene))) {
    throw std::invalid_argument(fmt::format(
        "{}: {} is no design of this device; leave --design out", path, a.options.design));
  }
  const trim::LawMaker law = law_of(scene.scenario, design, axes_of(scene));
  if (!law) throw std::invalid_argument(path + ": a device of several axes needs a law");
  resolve_amounts(scene.scenario, design, law().get());
  cut(scene.scenario, a);
  for (const std::string& read : {scene.device_path, law_file(scene.scenario)}) outputs.reads(read);
  for (const std::string& read : hand_files(scene)) outputs.reads(read);
  return {scene.scenario, device_of(scene), trim::axes_subject(scene, a.options, law)};
}

int run_trim(TrimArguments& a) {
  a.options.tolerance = share_of(a.tolerance);
  a.options.window_s = 1e-3 * a.window_ms;
  const std::string path = find_file(a.scene, "vectors/scenes");
  files::Outputs outputs;
  outputs.reads(path);
  const Trimmed t =
      names_device(path) ? trimmed_device(path, a, outputs) : trimmed_lever(path, a, outputs);
  outputs.reads(find_file(a.options.design, "rtl/designs"));
  files::OutputFile* output = outputs.open("--output", a.output);
  files::OutputFile* json = outputs.open("--json", a.json);
  Progress progress("trim " + t.scene.name + " on " + a.options.design, a.quiet);
  a.options.progress = [&progress](double done) { progress.update(done); };
  const trim::Report report = trim::trim(t.subject, a.options);
  progress.finish();

  if (json != nullptr) json->write(json_of(report, t, a));
  if (!a.quiet) outputs.say(text_of(report, t, a));
  const bool found = report.holds && report.smaller() && report.trimmed_run.broken.empty();
  if (output != nullptr) {
    if (found) {
      output->write(trim::scene_text(t.scene, report.trimmed, comment_of(report, t, a)));
    } else {
      output->discard();
      if (!a.quiet) {
        outputs.say(fmt::format("{} is not written: {}\n", a.output,
                                report.trimmed_run.broken.empty()
                                    ? "nothing can be left out"
                                    : "an expectation of the scene is broken"));
      }
    }
  }
  outputs.commit();
  return found ? exit_ok : exit_failed;
}

}  // namespace

void add_trim(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<TrimArguments>();
  a->options.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  CLI::App* sub = app.add_subcommand(
      "trim", "which effects of the plant a scene needs: the least model within a tolerance");
  sub->footer(
      R"(SCENE is a name in vectors/scenes or the path of a scene file. The full model has every effect and
switching gates. Torque, position and force at the hand, as means over 1 ms, are kept within the
tolerance on the scene's own motion and on others (docs/speed-for-accuracy.md).
  feltgate trim membrane                           one percent
  feltgate trim coupled_levers                     a device: its effects alone
  feltgate trim damper --tolerance 5% -o fast.toml && feltgate run fast.toml
Exit code: 0 a smaller model was found, 1 nothing can be left out or an expectation is broken,
2 unusable input.)");
  option(*sub, "scene", a->scene, "SCENE", "scene")->required();
  defaulted(*sub, "--tolerance", a->tolerance, "SHARE",
            "share of the full model's peak and of its rms");
  option(*sub, "--design", a->design, "DESIGN", design_help);
  option(*sub, "--plant", a->plant, "PLANT",
         "plant in vectors/plants, or a path; default: the scene's");
  option(*sub, "-o,--output", a->output, "FILE", "the trimmed scene as a file for feltgate run");
  option(*sub, "--json", a->json, "FILE", "the figures as JSON");
  option(*sub, "--duration", a->duration_s, "SECONDS", "of the scene; default: its own",
         checks::seconds());
  defaulted(*sub, "--window", a->window_ms, "", "length of the means, ms",
            checks::number(0.01, 1000, "ms"));
  defaulted(*sub, "--full-step", a->options.full_step_clocks, "", "step of the full model, clocks",
            checks::whole(1, 5));
  defaulted(*sub, "--unseen", a->options.unseen, "", "motions of the final check",
            checks::whole(1, 100));
  defaulted(*sub, "--seed", a->options.seed, "", "of these motions", checks::seed());
  defaulted(*sub, "--jobs", a->options.threads, "", "runs at a time", checks::whole(1, 64));
  option(*sub, "--search-limit", a->options.longest_s, "SECONDS",
         "ends the search: everything stays on; default: no end", checks::seconds());
  sub->add_flag("--quiet", a->quiet, "print nothing");
  sub->callback([a, sub, exit_code] {
    a->full_step = sub->count("--full-step") > 0;
    if (!a->design.empty()) a->options.design = built_design(a->design);
    *exit_code = run_trim(*a);
  });
}

}  // namespace feltgate
