// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate bench, a program of its own, built only when asked for. Documentation:
// docs/speed-for-accuracy.md
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "apps/commands/commands.hpp"
#include "feltgate/largest.hpp"
#include "files/output_file.hpp"
#include "studies/bench/measure.hpp"
#include "studies/bench/work.hpp"

namespace {

using namespace feltgate;

struct Arguments {
  std::string json;
  std::vector<std::string> engines = bench::runner_names();
  std::vector<std::string> scenes;
  int repetitions = 0;
  bool quick = false, quiet = false;
};

/// The largest bounds over all works.
bench::ErrorLimits bounds_of(const std::vector<bench::Work>& works) {
  const auto e = elaborated_design("lever");
  bench::ErrorLimits worst;
  for (const bench::Work& work : works) {
    const bounds::ErrorBounds b = bench::work_bounds(e, work);
    worst.velocity_rad_s = larger(worst.velocity_rad_s, b.velocity_rad_s.against_reference);
    worst.tau_hat_nm = larger(worst.tau_hat_nm, b.tau_hat_nm.against_reference);
    worst.torque_nm = larger(worst.torque_nm, b.torque_nm.against_reference);
  }
  return worst;
}

int run(const Arguments& a) {
  std::vector<std::string> scenes = a.scenes;
  if (scenes.empty()) {
    scenes = a.quick ? std::vector<std::string>{"torque_step_cord"}
                     : std::vector<std::string>{"torque_step_cord", "damper", "wall"};
  }
  // The output is opened before the run: an unwritable name must not waste the run.
  files::Outputs outputs;
  files::OutputFile* json = outputs.open("--json", a.json);
  std::vector<std::unique_ptr<bench::Runner>> runners;
  for (const std::string& name : a.engines) runners.push_back(bench::make_runner(name));

  std::vector<bench::Scene> closed_loops;
  std::vector<bench::Work> works;
  for (const std::string& name : scenes) {
    closed_loops.push_back(bench::read_scene(repository(), name));
    works.push_back(bench::record_scene(closed_loops.back(), "lever"));
  }
  works.push_back(bench::slow_small_signals("lever", a.quick ? 0.05 : 0.3));

  bench::Options options;
  options.repetitions = a.repetitions > 0 ? a.repetitions : a.quick ? 1 : 3;
  Progress progress("bench", a.quiet);
  options.progress = [&progress](double done) { progress.update(done); };
  bench::Result result = bench::measure(runners, works, closed_loops, options);
  result.bounds = bounds_of(works);
  const bench::Circumstances c = bench::circumstances();
  if (json != nullptr) json->write(bench::json(result, works, c));
  if (!a.quiet) outputs.say(bench::text(result, works, c));
  outputs.commit();
  if (result.divergence.empty()) return exit_ok;
  fmt::print(stderr, "feltgate: integer back-ends differ: {}\n", result.divergence);
  return exit_failed;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"feltgate bench: the same scenes through every back-end, time against error"};
  app.name("feltgate bench");
  app.footer(
      R"(Scenes run once in closed loop; what reached the core is recorded and then given to every
engine. Errors are against 113 bits on the same counts. Times are CPU time, in interleaved
repetitions: median and ends. Back-ends:
  rtl         the Verilated RTL, every pin in every clock
  twin_clock  the C++ twin, every pin in every clock
  twin_event  the same from event to event
  twin_tick   the twin's arithmetic alone, a tick at a time
  double, float, quad   the same laws in binary64, binary32 and binary128
Examples:
  feltgate bench                        a few minutes
  feltgate bench --quick                half a minute; rougher
  feltgate bench --json bench.json      for programs; docs/json.md has the keys
  feltgate bench --engine rtl,twin_event --scene membrane
Exit code: 0 the integer back-ends agree, 1 they do not, 2 unusable input.)");
  Arguments a;
  option(app, "--json", a.json, "FILE", "figures as JSON, schema feltgate-bench/2");
  option(app, "--engine", a.engines, "ENGINES", "only these; errors need quad")->delimiter(',');
  option(app, "--scene", a.scenes, "SCENES",
         "names in vectors/scenes instead of torque_step_cord, damper, wall")
      ->delimiter(',');
  option(app, "--repetitions", a.repetitions, "", "default 3, with --quick 1",
         checks::whole(1, 1000));
  app.add_flag("--quick", a.quick, "one short scene");
  app.add_flag("--quiet", a.quiet, "print nothing");
  int exit_code = exit_ok;
  app.callback([&] { exit_code = run(a); });
  return run_command_line(app, argc, argv, exit_code);
}
