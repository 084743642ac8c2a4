// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate run of a scene whose device has several axes. Documentation: docs/devices.md
#include "tools/run_axes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "files/output_file.hpp"
#include "law_loop/scene_law.hpp"
#include "loop/scenario_check.hpp"
#include "tools/commands.hpp"
#include "tools/csv.hpp"
#include "tools/run_laws.hpp"
#include "tools/run_output.hpp"

namespace feltgate {

namespace {

std::unique_ptr<AxesLaw> law_of(const AxesScene& scene, const DesignInfo& design) {
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

void show_mismatch(const AxesScene& scene, AxesRunOptions again, const AxesResult& result) {
  files::OutputFile waveform("waveform", mismatch_path(result.subject, result.design));
  again.fst = waveform.named();
  again.fst_from = result.first_mismatch_clock - mismatch_before;
  again.fst_to = result.first_mismatch_clock + mismatch_after;
  again.row = nullptr;
  again.progress = nullptr;
  AxesScene shorter = scene;
  shorter.scenario.duration_s = std::max(
      1e-5, result.simulated_s * static_cast<double>(again.fst_to + 1 - result.homing_clocks) /
                static_cast<double>(result.clocks));
  shorter.scenario.expectations.clear();
  run_axes(shorter, again);
  waveform.commit();
  tell_mismatch(result.first_mismatch, waveform.path());
}

int run_axes_scene(const AxesArguments& a) {
  AxesScene scene = read_axes_scene(
      a.scene_path, [](const std::string& name) { return find_file(name, "vectors/devices"); });
  if (a.columns) {
    fmt::print("{}\n", fmt::join(axes_columns(scene), "\n"));
    return exit_ok;
  }
  const AxesDesignMakers* made = find_axes_design(a.design);
  if (made == nullptr) {
    throw std::invalid_argument(
        fmt::format("{}: device {} has {} axes, and this program's design {} one; ./feltgate run "
                    "builds the device's own, or name it: --design {}_law",
                    a.scene_path, device_of(scene), axes_of(scene), a.design, device_of(scene)));
  }
  const DesignInfo design = made->info();
  const std::unique_ptr<AxesLaw> law = law_of(scene, design);
  resolve_amounts(scene.scenario, design, &law->host());
  apply_settings(a.set, design, &law->host(), scene.scenario);
  check_asked(scene.scenario, design, &law->host());
  if (scene.plane) PlaneHost::check(*scene.plane, a.scene_path, law->host());
  if (a.every > 0 && a.csv.empty()) {
    throw std::invalid_argument("--every thins out the rows of --csv; add --csv FILE");
  }

  AxesRunOptions options;
  options.design = a.design;
  options.engine = a.engine;
  options.seed = a.seed;
  options.law = law.get();
  files::Outputs outputs;
  for (const std::string& path : {a.scene_path, scene.device_path}) outputs.reads(path);
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
  if (result.mismatches > 0) {
    options.fst.clear();
    show_mismatch(scene, options, result);
  }
  return result.mismatches == 0 && result.broken.empty() ? exit_ok : exit_failed;
}

/// Linked is known: before main().
[[maybe_unused]] const bool known = [] {
  law_scenes() = {make_scene_law, run_axes_scene};
  return true;
}();

}  // namespace

}  // namespace feltgate
