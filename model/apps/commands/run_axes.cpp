// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate run of a scene whose device has several axes. Documentation: docs/devices.md
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "apps/commands/commands.hpp"
#include "apps/commands/run_output.hpp"
#include "files/output_file.hpp"
#include "files/table.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "sim/loop/scenario_check.hpp"

namespace feltgate {

using files::Cells;
using files::Columns;
using files::Json;
using files::when;

namespace {

bool bounded(const AxesResult& r) {
  return std::any_of(r.axes.begin(), r.axes.end(),
                     [](const AxisFigures& a) { return std::isfinite(a.bound_nm); });
}

Columns<AxisFigures> columns_of(const AxesResult& r) {
  using Axis = const AxisFigures&;
  const bool compared = !r.reference.empty();
  return {{"", [&r](Axis a) { return &a - r.axes.data(); }, "axis"},
          {"asked_peak_nm", [](Axis a) { return a.torque.asked.value; }, "asked Nm", "{:.4g}"},
          {"commanded_peak_nm", [](Axis a) { return a.torque.commanded.value; }},
          {"motor_peak_nm", [](Axis a) { return a.torque.motor.value; }, "motor Nm", "{:.4g}"},
          {"law_nm/max_error", [=](Axis a) { return when(compared, a.law_error_nm.max()); },
           "law error Nm", "{:.3g}"},
          {"law_nm/rms_error", [=](Axis a) { return when(compared, a.law_error_nm.rms()); }, "rms",
           "{:.3g}"},
          {"law_nm/ticks", [=](Axis a) { return when(compared, a.law_error_nm.count()); }},
          {"law_nm/bound", [=](Axis a) { return when(compared, a.bound_nm); }, "bound", "{:.3g}"},
          {"limits", [](Axis a) { return acted_json(a.limits); }},
          {"", [](Axis a) { return acted_text(a.limits); }, "<limits"},
          {"faults", [](Axis a) { return acted_json(a.faults); }},
          {"", [](Axis a) { return acted_text(a.faults); }, "<faults"}};
}

/// Signals, each once, in the order of the alphabet.
std::vector<std::string> signals_of(const AxesResult& r) {
  std::vector<std::string> all;
  for (const auto& [name, value] : r.figures) {
    constexpr std::string_view end = ".swing";
    if (name.size() < end.size() || name.compare(name.size() - end.size(), end.size(), end) != 0) {
      continue;
    }
    const std::string signal = name.substr(0, name.size() - end.size());
    if (signal.rfind("limits", 0) == 0 || signal.rfind("faults", 0) == 0) continue;
    all.push_back(signal);
  }
  return all;
}

std::string axes_text(const AxesResult& r) {
  std::string text = large_error_lines(r);
  text +=
      fmt::format("scene {}, device {}, design {}, law {}\n", r.subject, r.device, r.design, r.law);
  text += fmt::format("{:.6g} s, {} clocks, {} ticks", r.simulated_s, r.clocks, r.ticks);
  if (r.lock_step) text += fmt::format("; mismatches between RTL and twin: {}", r.mismatches);
  text += fmt::format("; {:.3g} times real time\n", r.simulated_s / std::max(r.busy_s, 1e-9));
  if (!r.first_mismatch.empty()) text += fmt::format("first mismatch: {}\n", r.first_mismatch);
  text += "\n" + table(columns_of(r), r.axes);
  text +=
      r.reference.empty()
          ? "law error: none, for without double or quad beside it\n"
          : fmt::format(
                "law error: commanded torque against the law in {} on the words that the "
                "engine got, where no ramp or limit holds it; bound: {}\n",
                r.reference,
                bounded(r) ? "proven" : "none, for the law jumps, or has states without an end");
  text += stale_line(r.law_stale);
  std::vector<Cells> lines{{"signal", "min", "max", "end (mean)", "swing"}};
  for (const std::string& signal : signals_of(r)) {
    lines.push_back({signal});
    for (const char* of : {".min", ".max", ".end", ".swing"}) {
      lines.back().push_back(fmt::format("{:.6g}", r.figures.at(signal + of)));
    }
  }
  text += "\n" + files::aligned(lines) + "\n" + energy_lines(r.energy) +
          expectation_line(r.expectations);
  for (const std::string& jump : r.speed_jumps) text += fmt::format("note: {}\n", jump);
  for (const std::string& broken : r.broken) text += fmt::format("not as expected: {}\n", broken);
  return text;
}

std::string axes_json(const AxesResult& r) {
  Json j{{"schema", "feltgate-axes-run/1"},
         {"version", FELTGATE_VERSION},
         {"scene", r.subject},
         {"device", r.device},
         {"design", r.design},
         {"law", r.law}};
  j.update(session_json(r));
  j["homing_clocks"] = r.homing_clocks;
  j["axes"] = array_of(columns_of(r), r.axes);
  j["energy"] = energy_json(r.energy);
  j["figures"] = r.figures;
  j["expectations"] = {{"checked", r.expectations.size()}, {"broken", r.broken}};
  if (!r.speed_jumps.empty()) j["speed_jumps"] = r.speed_jumps;
  return files::json_text(j);
}

std::unique_ptr<SceneLaw> law_of(const AxesScene& scene, const DesignInfo& design) {
  const Scenario& s = scene.scenario;
  if (s.law.empty()) {
    throw std::invalid_argument(
        fmt::format("{}:{}: a device of several axes needs a law; name one of rtl/laws that has a "
                    "torque for each of {}'s {}: law = \"NAME\"",
                    s.path, s.scene_line, device_of(scene), axes_of(scene)));
  }
  return make_axes_law(law_file(s), design, axes_of(scene));
}

void write_row(std::FILE* to, const std::vector<double>& row) {
  fmt::memory_buffer line;
  for (const double value : row) {
    fmt::format_to(std::back_inserter(line), line.size() > 0 ? ",{:.9g}" : "{:.9g}", value);
  }
  line.push_back('\n');
  std::fwrite(line.data(), 1, line.size(), to);
}

int run_axes_scene(const std::string& path, const RunArguments& given) {
  RunArguments a = given;
  AxesScene scene = device_scene(path);
  if (a.design.empty()) a.design = own_design(scene);
  if (a.columns) {
    fmt::print("{}\n", fmt::join(axes_columns(scene), "\n"));
    return exit_ok;
  }
  const DesignInfo& design = design_named(a.design);
  if (design.axes != static_cast<int>(axes_of(scene))) {
    throw std::invalid_argument(
        fmt::format("{}: device {} has {} axes, and design {} {}; leave --design out for {}", path,
                    device_of(scene), axes_of(scene), a.design, design.axes, own_design(scene)));
  }
  const std::unique_ptr<SceneLaw> law = law_of(scene, design);
  resolve_amounts(scene.scenario, design, law.get());
  apply_settings(a.set, design, law.get(), scene.scenario);
  check_asked(scene.scenario, design, law.get());
  if (scene.plane) PlaneHost::check(*scene.plane, path, *law);
  if (a.every > 0 && a.csv.empty()) {
    throw std::invalid_argument("--every thins out the rows of --csv; add --csv FILE");
  }

  AxesRunOptions options;
  options.design = a.design;
  options.engine = a.engine;
  options.seed = a.seed;
  options.law = law.get();
  files::Outputs outputs;
  for (const std::string& read : {path, scene.device_path, law_file(scene.scenario)}) {
    outputs.reads(read);
  }
  for (const std::string& read : hand_files(scene)) outputs.reads(read);
  files::OutputFile* json = outputs.open("--json", a.json);
  files::OutputFile* csv = outputs.open("--csv", a.csv);
  files::OutputFile* fst = outputs.open("--fst", a.fst);
  if (fst != nullptr) options.fst = fst->named();
  if (csv != nullptr) {
    const auto ticks =
        static_cast<std::int64_t>(scene.scenario.duration_s * static_cast<double>(design.tick_hz));
    options.row_every = a.every > 0 ? a.every : sane_every(ticks);
    fmt::print(csv->handle(), "{}\n", fmt::join(axes_columns(scene), ","));
    options.row = [csv](const std::vector<double>& row) { write_row(csv->handle(), row); };
  }
  Progress progress(scene.scenario.name + " on " + a.design, a.quiet);
  options.progress = [&progress](double done) { progress.update(done); };
  const AxesResult result = run_axes(scene, options);
  if (json != nullptr) json->write(axes_json(result));
  if (!a.quiet) outputs.say(axes_text(result));
  outputs.commit();
  if (a.quiet) {
    for (const std::string& line : result.broken) std::fprintf(stderr, "%s\n", line.c_str());
  }
  show_mismatch(result, options, [&](const BackendOptions& same) {
    const std::unique_ptr<SceneLaw> from_start = law_of(scene, design);
    AxesRunOptions again;
    static_cast<BackendOptions&>(again) = same;
    again.law = from_start.get();
    AxesScene shorter = scene;
    shorter.scenario = cut_after(scene.scenario, result, same.fst_to + 1 - result.homing_clocks);
    run_axes(shorter, again);
  });
  return result.as_expected() ? exit_ok : exit_failed;
}

/// Linked is known: before main().
[[maybe_unused]] const bool known = [] {
  law_scenes() = {make_scene_law, run_axes_scene};
  return true;
}();

}  // namespace

AxesScene device_scene(const std::string& path) {
  return read_axes_scene(
      path, [](const std::string& name) { return find_file(name, "vectors/devices"); });
}

}  // namespace feltgate
