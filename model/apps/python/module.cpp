// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The extension module feltgate._core. Documentation: docs/python.md
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "apps/python/bindings.hpp"
#include "design/info.hpp"
#include "feltgate/nearest.hpp"

namespace feltgate::python {

namespace {

/// The data of this package; FELTGATE_ROOT of the environment goes before them.
std::string& data_folder() {
  static std::string folder;
  return folder;
}

/// A design by the path of its file, or by its name in rtl/designs.
DesignInfo read_named(const std::string& name) {
  const char* given = std::getenv("FELTGATE_ROOT");
  const std::string root = given != nullptr && *given != 0 ? given : data_folder();
  std::string path = design::is_path(name) ? name : root + "/rtl/designs/" + name + ".toml";
  if (!std::filesystem::exists(path)) path = data_folder() + "/rtl/designs/" + name + ".toml";
  return design::info_of(elaborated_files(path, root + "/rtl/registers.toml"));
}

}  // namespace

design::Elaborated elaborated_files(const std::string& design_path,
                                    const std::string& registers_path) {
  auto d = design::read_design(design_path);
  d.allow_coarse = true;
  return design::elaborate(d, design::read_registers(registers_path));
}

const ParameterInfo& parameter_of(const DesignInfo& design, const std::string& name) {
  if (const ParameterInfo* info = design.find(name)) return *info;
  std::vector<std::string> names;
  for (const ParameterInfo& p : design.parameters) names.emplace_back(p.name);
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

PYBIND11_MODULE(_core, m) {
  m.doc() = "The C++ side of the package feltgate.";
  py::register_exception_translator(translate);
  m.attr("version") = FELTGATE_VERSION;
  set_design_source({read_named, [] { return std::vector<std::string>(); }});
  m.def("set_data", [](const std::string& folder) { data_folder() = folder; });
  bind_scenes(m);
  bind_plant(m);
  bind_chain(m);
  bind_twin(m);
  bind_recordings(m);
  bind_runs(m);
}

}  // namespace feltgate::python
