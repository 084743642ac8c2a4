// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate design. Documentation: docs/designs.md
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/commands/commands.hpp"
#include "design/design.hpp"
#include "design/generate.hpp"
#include "files/output_file.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/bounds/error_bounds.hpp"
#include "studies/stability/for_plant.hpp"
#include "studies/stability/loop_poles.hpp"

namespace feltgate {

namespace {

struct DesignArguments {
  std::string name, plant, for_plant, output;
  double nominal_a = 0;
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
  for (const design::Scene& scene : registers.scenes) {
    if (scene.name != "free" && laws.count(scene.name) == 0) left_out += " " + scene.name;
  }
  if (left_out.empty()) left_out = " none";
  const std::string design_path = find_file(a.name, "rtl/designs");
  const std::string text = design::text_for_scenes(
      design_path, laws, "Written by: " + command + "\nWithout the scenes:" + left_out);
  files::Outputs outputs;
  outputs.reads(design_path);
  outputs.open("--output", a.output.empty() ? "-" : a.output)->write(text);
  outputs.commit();
  if (!a.output.empty()) {
    outputs.say(fmt::format("{}: without the scenes:{}\n", a.output, left_out));
  }
  return exit_ok;
}

/// The design's name, "mine" for a file that becomes rtl/designs/mine.toml.
std::string name_for(const std::string& plant, const std::string& output) {
  if (!output.empty() && output != "-") return std::filesystem::path(output).stem().string();
  std::string name;
  for (const char c : std::filesystem::path(plant).stem().string()) {
    const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const bool plain = (small >= 'a' && small <= 'z') || (small >= '0' && small <= '9');
    name += plain ? small : '_';
  }
  return name.empty() || name[0] < 'a' || name[0] > 'z' ? "for_" + name : name;
}

std::string next_steps(const std::string& name, const std::string& output,
                       const std::string& plant) {
  namespace fs = std::filesystem;
  const fs::path place = fs::path(repository()) / "rtl/designs" / (name + ".toml");
  const bool there = !output.empty() && output != "-" &&
                     fs::weakly_canonical(output) == fs::weakly_canonical(place);
  std::string text = "next, in simulation:\n";
  if (!there)
    text +=
        fmt::format("  put it into rtl/designs/{}.toml: its engines are built from there\n", name);
  return text + fmt::format(
                    "  ./feltgate generate\n"
                    "  ./feltgate run torque_step --design {0} --plant {1}\n",
                    name, plant);
}

int design_for_plant(const DesignArguments& a, const design::RegisterMap& registers) {
  const std::string base = a.name.empty() ? "lever" : a.name;
  const std::string base_path = find_file(base, "rtl/designs");
  const std::string plant_path = find_file(a.for_plant, "vectors/plants");
  const std::string name = name_for(plant_path, a.output);
  const std::string path = a.output.empty() || a.output == "-" ? name + ".toml" : a.output;
  const stability::PlantDesign made = stability::design_for_plant(
      base_path, plant::read_plant_file(plant_path), a.nominal_a, a.for_plant, path, registers);
  files::Outputs outputs;
  outputs.reads(base_path);
  outputs.reads(plant_path);
  outputs.open("--output", a.output.empty() ? "-" : a.output)->write(made.text);
  outputs.commit();
  std::string told =
      fmt::format("{}: {} with the constants of {}; stable around it\n", path, base, a.for_plant);
  for (const stability::Constant& c : made.changed) {
    told += fmt::format("  {:<18} {:.6g} instead of {:.6g} {}\n", c.name, c.of_plant, c.of_design,
                        c.unit);
  }
  for (const std::string& note : made.notes) told += fmt::format("note: {}\n", note);
  outputs.say(told + next_steps(name, a.output, a.for_plant));
  return exit_ok;
}

int table_of(const DesignArguments& a, const design::RegisterMap& registers) {
  const auto e = elaborate(design::read_design(find_file(a.name, "rtl/designs")), registers);
  std::string text = design_table(e);
  if (!e.design.mt) {
    text += "\n" + bound_table(bounds::error_bounds(e)) +
            source_table(bounds::source_bounds(bounds::chain_numbers(e)));
  }
  if (!a.plant.empty()) {
    const auto p = plant::read_plant_file(find_file(a.plant, "vectors/plants"));
    stability::refuse_unstable(e, p);
    text += stability::loop_table(stability::closed_loop(e, p));
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
      R"(  feltgate design lever --plant p24                  the table and the poles of the loop
  feltgate design --for-plant p48 --nominal-current 3.1 -o rtl/designs/mine.toml
                                                     lever with the constants of p48
  feltgate design lever --for membrane               the design file with that scene alone
  feltgate design lever --for membrane torque_step -o rtl/designs/mine.toml
                                                     a design of its own: feltgate generate
Exit code: 0 fine, 2 a design that cannot work, is unstable around the plant, or unusable input.)");
  option(*sub, "design", a->name, "DESIGN", "name in rtl/designs or a path");
  auto* plant = option(*sub, "--plant", a->plant, "PLANT",
                       "name in vectors/plants or a path: also the poles of the loop around it; an "
                       "unstable one is refused");
  auto* scenes =
      option(*sub, "--for", a->scenes, "SCENE",
             "torque laws or scene files: print the design file that builds only what these need");
  scenes->excludes(plant);
  auto* for_plant = option(
      *sub, "--for-plant", a->for_plant, "PLANT",
      "name in vectors/plants or a path: print DESIGN (default: lever) with the constants of this "
      "plant, once it is stable around it");
  for_plant->excludes(plant)->excludes(scenes);
  auto* nominal =
      option(*sub, "--nominal-current", a->nominal_a, "AMPERES",
             "with --for-plant: the current that the motor carries without limit in time, "
             "as its data sheet has it; all limits follow from it");
  nominal->check(CLI::Range(0.01, 100.0))->needs(for_plant);
  option(*sub, "-o,--output", a->output, "FILE", "with --for or --for-plant: write it here");
  sub->callback([a, exit_code] {
    if (!a->output.empty() && a->scenes.empty() && a->for_plant.empty()) {
      throw std::invalid_argument(
          "--output is for --for and --for-plant; the table goes to stdout");
    }
    if (a->name.empty() && a->for_plant.empty()) {
      throw std::invalid_argument("design: DESIGN is missing; feltgate design --help");
    }
    if (!a->for_plant.empty() && a->nominal_a == 0) {
      throw std::invalid_argument(
          "design: --for-plant needs --nominal-current AMPERES, which no plant file says: the "
          "current that the motor carries without limit in time; its data sheet has it");
    }
    const auto registers = design::read_registers(repository() + "/rtl/registers.toml");
    *exit_code = !a->for_plant.empty() ? design_for_plant(*a, registers)
                 : a->scenes.empty()   ? table_of(*a, registers)
                                       : design_for(*a, registers);
  });
}

}  // namespace feltgate
