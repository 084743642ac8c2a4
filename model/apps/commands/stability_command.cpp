// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate stability. Documentation: docs/speed-for-accuracy.md
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/commands/commands.hpp"
#include "files/output_file.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/stability/study.hpp"

namespace feltgate {

namespace {

namespace fs = std::filesystem;

struct StabilityArguments {
  std::string design = "lever", linear = "linear", plant = "p24", json, plot;
  std::vector<double> rates, damping;
  bool no_bits = false;
};

/// Exit code: 1 when the chain's bits and the eigenvalues differ by more than 5 % for a swing that
/// spans enough counts for the comparison.
int verdict(const stability::Study& study, const files::Outputs& outputs) {
  constexpr double enough_counts = 8, tolerance = 0.05;
  int off = 0;
  for (const auto& p : study.borders) {
    if (p.exact.stiffness_nm_rad == 0 || p.swing_counts < enough_counts) continue;
    const double ratio = p.bits_nm_rad / p.exact.stiffness_nm_rad;
    if (ratio > 1 - tolerance && ratio < 1 + tolerance) continue;
    outputs.say(
        fmt::format("bits and eigenvalues differ by more than 5 %: {:g} Hz, B = {:g} Nm s/rad\n",
                    p.rate_hz, p.damping_nm_s_rad));
    ++off;
  }
  return off == 0 ? exit_ok : exit_failed;
}

/// Whether this is a scene and no design: a name in vectors/scenes, or a file with a torque law.
bool is_scene(const std::string& name) {
  const fs::path path(name);
  if (path.has_parent_path() || path.has_extension()) {
    return fs::exists(path) &&
           (names_device(name) || config::parse_toml_file(name).contains("core"));
  }
  return !fs::exists(fs::path(repository()) / "rtl/designs" / (name + ".toml")) &&
         fs::exists(fs::path(repository()) / "vectors/scenes" / (name + ".toml"));
}

/// Whether two designs differ at most in what registers hold.
int run(const StabilityArguments& a) {
  const auto e = elaborated_design(a.design);
  const auto linear = plant::read_plant_file(find_file(a.linear, "vectors/plants"));
  const auto full = plant::read_plant_file(find_file(a.plant, "vectors/plants"));
  files::Outputs outputs;
  outputs.reads(find_file(a.design, "rtl/designs"));
  outputs.reads(find_file(a.linear, "vectors/plants"));
  outputs.reads(find_file(a.plant, "vectors/plants"));
  outputs.folder("--plot", a.plot);
  files::OutputFile* json = outputs.open("--json", a.json);
  // The pictures are drawn from a file.
  std::string json_path = a.json;
  if (!a.plot.empty() && (json == nullptr || json->in_place())) {
    json_path = a.plot + "/stability.json";
  }
  files::OutputFile* plot_json = json_path == a.json ? nullptr : outputs.open("--plot", json_path);
  stability::StudyOptions options;
  if (!a.rates.empty()) options.rates_hz = a.rates;
  if (!a.damping.empty()) options.damping_nm_s_rad = a.damping;
  options.bits = !a.no_bits;
  Progress progress("stability of " + e.design.name, false);
  options.progress = [&progress](double done) { progress.update(done); };
  const auto study = run_study(e, linear, full, options);
  outputs.say(stability::study_text(study));
  for (files::OutputFile* file : {json, plot_json}) {
    if (file != nullptr) file->write(stability::study_json(study));
  }
  outputs.commit();
  if (!a.plot.empty()) {
    const int status = run_script("study_pictures.py", {"--", json_path, a.plot}, outputs.text());
    if (status != 0) return status < exit_signal ? exit_unusable : status;
  }
  return options.bits ? verdict(study, outputs) : exit_ok;
}

int scene(const StabilityArguments& a) {
  if (!a.rates.empty() || !a.damping.empty() || !a.plot.empty()) {
    throw std::invalid_argument(
        fmt::format("{} is a scene, which has its own rate and damping and no plot; leave out "
                    "--rate, --damping "
                    "and --plot, or name a design",
                    a.design));
  }
  return scene_stability(a.design, a.json, !a.no_bits);
}

}  // namespace

void add_stability(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<StabilityArguments>();
  CLI::App* sub = app.add_subcommand(
      "stability", "how stiff a wall may be before it shakes, by damping and scene rate");
  sub->footer(
      R"(The border of a wall's stiffness three ways: by bisection on the chain's own bits around a
linear plant, by the eigenvalues of the loop, and by (b+B)/(T/2+td). Between two updates of
the scene its torque is held: a host reads, computes and writes the setpoint; at the tick
rate it is the core's own wall.
Of a scene: the factor on its law's torque at which the device begins to swing by itself, by
the linear loop of the law's own derivative (filters, states, delay lines, and the host of a
tracker or a plane) and by the swing of the core's bits; without a hand, and with the scene's
if it has a mass.
  feltgate stability lever                          half a minute
  feltgate stability wall_tracked                   a scene, in a minute
  feltgate stability lever --plot out               with a picture in out/
  feltgate stability lever --rate 500 --damping 0.003,0.004
Exit code: 0 bits and eigenvalues agree within 5 % (where the swing is large enough), 1
otherwise, 2 unusable input. docs/speed-for-accuracy.md explains every column.)");
  defaulted(*sub, "design", a->design, "SCENE|DESIGN",
            "a scene, in vectors/scenes or a path; or a design, in rtl/designs or a path");
  defaulted(*sub, "--linear-plant", a->linear, "PLANT",
            "plant of the borders, in vectors/plants or a path: without friction, dead "
            "voltage and dead time");
  defaulted(*sub, "--plant", a->plant, "PLANT",
            "plant of the friction that holds a lever between two counts");
  option(*sub, "--rate", a->rates, "", "scene rates in Hz; default 144,490,1000,40000,1000000",
         checks::number(1, 1e6, "Hz"))
      ->delimiter(',');
  option(*sub, "--damping", a->damping, "",
         "dampings B of the wall in Nm s/rad; default 0,0.001,0.002,0.005,0.01,0.02",
         checks::number(0, 1, "Nm s/rad"))
      ->delimiter(',');
  sub->add_flag("--no-bits", a->no_bits, "without the chain's bits: 0.3 s");
  option(*sub, "--json", a->json, "FILE", "write all numbers to this file");
  option(*sub, "--plot", a->plot, "DIR", "draw the K-B plot into this folder");
  sub->callback([a, exit_code] { *exit_code = is_scene(a->design) ? scene(*a) : run(*a); });
}

}  // namespace feltgate
