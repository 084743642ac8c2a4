// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Names that a design knows. Documentation: docs/python.md
#include "apps/python/design_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "feltgate/nearest.hpp"

namespace feltgate::python {

design::Elaborated elaborated_files(const std::string& design_path,
                                    const std::string& registers_path) {
  auto d = design::read_design(design_path);
  d.allow_coarse = true;
  return design::elaborate(d, design::read_registers(registers_path));
}

const ParameterInfo& parameter_of(const DesignInfo& design, const std::string& name) {
  if (const ParameterInfo* info = design.find(name)) return *info;
  std::vector<std::string> names;
  for (int i = 0; i < design.parameter_count; ++i) names.emplace_back(design.parameters[i].name);
  throw std::invalid_argument(
      fmt::format("parameter \"{}\" is unknown; {}feltgate.parameters(\"{}\") lists them", name,
                  config::did_you_mean(name, names), design.name));
}

int scene_of(const DesignInfo& design, const std::string& name) {
  const int number = design.scene_number(name);
  if (number >= 0) return number;
  throw std::invalid_argument(
      fmt::format("scene \"{}\" is not built in design {}; feltgate.laws(\"{}\") lists them", name,
                  design.name, design.name));
}

int mode_of(const std::string& name) {
  const std::vector<std::string> modes{"closed_loop", "open_loop", "voltage"};
  const auto found = std::find(modes.begin(), modes.end(), name);
  if (found == modes.end()) {
    throw std::invalid_argument(
        fmt::format("mode \"{}\" is unknown; {}choose closed_loop, open_loop or voltage", name,
                    config::did_you_mean(name, modes)));
  }
  return static_cast<int>(found - modes.begin());
}

}  // namespace feltgate::python
