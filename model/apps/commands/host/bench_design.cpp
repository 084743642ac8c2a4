// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Designs of measurements. Documentation: docs/calibration.md
#include "apps/commands/host/bench_design.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "apps/commands/commands.hpp"
#include "host/calibrate/report.hpp"

namespace feltgate::host {

namespace {

design::Elaborated design_for(Session& session, const std::string& needs) {
  if (session.options.port != "-") return session.design().design;
  if (!needs.empty()) {
    throw std::invalid_argument(fmt::format(
        "{} with PORT - has no board; give the port, or the readings with --from FILE", needs));
  }
  return elaborated_design(session.options.design.empty() ? "lever" : session.options.design);
}

}  // namespace

BenchDesign::BenchDesign(Session& session, const std::string& needs)
    : design_(design_for(session, needs)) {}

std::string BenchDesign::write(const std::vector<Change>& changes, files::OutputFile* to,
                               const std::string& path) const {
  if (changes.empty()) {
    if (to != nullptr) {
      throw std::invalid_argument(
          fmt::format("--write {}: nothing was found that design {} has a key for; see the notes",
                      path, design_.design.name));
    }
    return "";
  }
  const std::string list = changes_text(changes);
  if (to == nullptr) return "for the design file (--write FILE writes it):\n" + list;
  const std::string name = std::filesystem::path(path).stem().string();
  to->write(changed_design(design_.design.path, name, changes,
                           design::read_registers(repository() + "/rtl/registers.toml")));
  return fmt::format(
      "{}: {} with\n{}`feltgate design {}` looks at it; to build it, put it into rtl/designs and "
      "run ./feltgate generate\n",
      path, design_.design.name, list, path);
}

}  // namespace feltgate::host
