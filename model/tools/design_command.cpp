// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate design. Documentation: docs/designs.md
#include <cstdio>

#include "design/generate.hpp"
#include "design/loop_poles.hpp"
#include "plant/plant_file.hpp"
#include "tools/commands.hpp"

namespace feltgate {

void add_design(CLI::App& app, int* exit_code) {
  auto name = std::make_shared<std::string>();
  auto plant = std::make_shared<std::string>();
  CLI::App* sub = app.add_subcommand(
      "design", "the table of a design point: value, integer, error, range, headroom");
  sub->add_option("design", *name, "name in rtl/designs or a path")
      ->required()
      ->type_name("DESIGN");
  sub->add_option("--plant", *plant,
                  "name in vectors/plants or a path: also the poles of the loop around it; an "
                  "unstable one is refused")
      ->type_name("PLANT");
  sub->callback([name, plant, exit_code] {
    const auto registers = design::read_registers(repository() + "/rtl/registers.toml");
    const auto e = elaborate(design::read_design(find_file(*name, "rtl/designs")), registers);
    std::string text = design_table(e);
    if (!plant->empty()) {
      const auto p = plant::read_plant_file(find_file(*plant, "vectors/plants"));
      refuse_unstable(e, p);
      text += loop_table(closed_loop(e, p));
    }
    std::fputs(text.c_str(), stdout);
    *exit_code = exit_ok;
  });
}

}  // namespace feltgate
