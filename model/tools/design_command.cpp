// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate design. Documentation: docs/designs.md
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "bounds/error_bounds.hpp"
#include "design/for_scenes.hpp"
#include "design/generate.hpp"
#include "design/loop_poles.hpp"
#include "files/output_file.hpp"
#include "loop/scenario.hpp"
#include "plant/plant_file.hpp"
#include "tools/commands.hpp"

namespace feltgate {

namespace {

struct DesignArguments {
  std::string name, plant, output;
  std::vector<std::string> scenes;
};

/// Torque laws of what the user named: laws themselves, and scene files with all that they switch
/// to.
std::set<std::string> laws_of(const std::vector<std::string>& names,
                              const design::RegisterMap& registers) {
  std::set<std::string> laws;
  for (const std::string& name : names) {
    const bool law = registers.scene_number(name) >= 0;
    if (law) laws.insert(name);
    if (law && !std::filesystem::exists(repository() + "/vectors/scenes/" + name + ".toml")) {
      continue;
    }
    laws.merge(scenes_used(read_scenario(find_file(name, "vectors/scenes"))));
  }
  return laws;
}

int design_for(const DesignArguments& a, const design::RegisterMap& registers) {
  const std::set<std::string> laws = laws_of(a.scenes, registers);
  std::string command = "feltgate design " + a.name + " --for";
  for (const std::string& s : a.scenes) command += " " + s;
  std::string left_out;
  for (const std::string& block : blocks_left_out(laws, registers)) left_out += " " + block;
  if (left_out.empty()) left_out = " none";
  const std::string design_path = find_file(a.name, "rtl/designs");
  const std::string text = design::text_for_scenes(
      design_path, laws, "Written by: " + command + "\nBlocks left out:" + left_out);
  files::Outputs outputs;
  outputs.reads(design_path);
  outputs.open("--output", a.output.empty() ? "-" : a.output)->write(text);
  outputs.commit();
  if (!a.output.empty()) {
    outputs.say(fmt::format("{}: blocks left out:{}\n", a.output, left_out));
  }
  return exit_ok;
}

int table_of(const DesignArguments& a, const design::RegisterMap& registers) {
  const auto e = elaborate(design::read_design(find_file(a.name, "rtl/designs")), registers);
  std::string text = design_table(e) + "\n" + bound_table(bounds::error_bounds(e));
  if (!a.plant.empty()) {
    const auto p = plant::read_plant_file(find_file(a.plant, "vectors/plants"));
    refuse_unstable(e, p);
    text += loop_table(closed_loop(e, p));
  }
  std::fputs(text.c_str(), stdout);
  return exit_ok;
}

}  // namespace

void add_design(CLI::App& app, int* exit_code) {
  auto a = std::make_shared<DesignArguments>();
  CLI::App* sub = app.add_subcommand(
      "design", "the table of a design point: value, integer, error, range, headroom");
  sub->footer(
      "  feltgate design lever --plant p24                  the table and the poles of the loop\n"
      "  feltgate design lever --for membrane               the design file with that scene alone\n"
      "  feltgate design lever --for membrane torque_step -o rtl/designs/mine.toml\n"
      "                                                     a design of its own: feltgate "
      "generate");
  sub->add_option("design", a->name, "name in rtl/designs or a path")
      ->required()
      ->type_name("DESIGN");
  auto* plant =
      sub->add_option("--plant", a->plant,
                      "name in vectors/plants or a path: also the poles of the loop around it; an "
                      "unstable one is refused");
  plant->type_name("PLANT");
  auto* scenes = sub->add_option(
      "--for", a->scenes,
      "torque laws or scene files: print the design file that builds only what these need");
  scenes->type_name("SCENE")->excludes(plant);
  sub->add_option("-o,--output", a->output, "with --for: write it here")->needs(scenes);
  sub->callback([a, exit_code] {
    const auto registers = design::read_registers(repository() + "/rtl/registers.toml");
    *exit_code = a->scenes.empty() ? table_of(*a, registers) : design_for(*a, registers);
  });
}

}  // namespace feltgate
