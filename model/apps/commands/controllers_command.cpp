// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate controllers. Documentation: docs/speed-for-accuracy.md
#include <memory>

#include "apps/commands/commands.hpp"
#include "files/output_file.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/controllers/controllers.hpp"

namespace feltgate {

namespace {

struct ControllersArguments {
  std::string json, picture;
};

int run(const ControllersArguments& a) {
  const std::string plant = find_file("p24", "vectors/plants"),
                    linear = find_file("linear", "vectors/plants"),
                    design = find_file("lever", "rtl/designs");
  files::Outputs outputs;
  for (const std::string& read : {plant, linear, design}) outputs.reads(read);
  files::OutputFile* json = outputs.open("--json", a.json);
  files::OutputFile* picture = outputs.open("--output", a.picture);
  if (picture != nullptr) (void)picture->named();  // not stdout: told before the work
  const controllers::Bench bench{elaborated_design("lever"), plant::read_plant_file(plant),
                                 plant::read_plant_file(linear)};
  Progress progress("controllers", false);
  const auto update = [&progress](double done) { progress.update(done); };
  const controllers::Report report = controllers::measure(bench, update);
  progress.finish();
  outputs.say(controllers::report_text(report));
  const std::string text = controllers::report_json(report);
  if (json != nullptr) json->write(text);
  if (picture != nullptr) {
    const int status = draw_from_json("study_pictures.py", text, picture->named(), outputs);
    if (status != exit_ok) return status;
  }
  outputs.commit();
  return exit_ok;
}

}  // namespace

void add_controllers(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<ControllersArguments>();
  CLI::App* sub = app.add_subcommand(
      "controllers",
      "the disturbance observer beside feed-forward, PI, PID and a reaction-torque observer");
  sub->footer(
      R"(Five torque controllers around the same velocity estimate, voltage law, motor and hand,
each in fixed point and in double. The observer is the chain of the core with the paper's
Jn*Kp; feed-forward is the design `lever` as it is. The experiments: torque steps at stall,
also with R +20 % and Kt -50 %; a push on the free lever; a hand of 0 to 20 Nm/rad; Jn/J
from 0.5 to 4; encoders of 500 to 10000 lines; the largest wall that does not swing.
It prints Markdown tables, in ten seconds.
  feltgate controllers
  feltgate controllers --json all.json -o all.svg
Exit code: 0 measured, 2 unusable input. docs/speed-for-accuracy.md explains every row.)");
  option(*sub, "-o,--output", a->picture, "FILE", "the comparison as a picture, SVG");
  option(*sub, "--json", a->json, "FILE", "all figures and step responses as JSON");
  sub->callback([a, exit_code] { *exit_code = run(*a); });
}

}  // namespace feltgate
