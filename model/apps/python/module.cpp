// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The extension module feltgate._core. Designs beyond lever and paper, presets and files given to
// the build (FELTGATE_EXTRA_DESIGNS), are in a separate module, _designs, which is loaded when one
// of them is first used. Documentation: docs/python.md
#include <algorithm>
#include <stdexcept>
#include <vector>

#include "apps/python/bindings.hpp"
#include "feltgate/nearest.hpp"
#include "sim/reference/real_chain.hpp"

namespace feltgate::python {

namespace {

/// Loads the module _designs and returns the makers of one of its designs.
const DesignMakers& loaded(const std::string& name) {
  const py::gil_scoped_acquire hold;
  static const std::vector<DesignMakers>* all = nullptr;
  if (all == nullptr) {
    const py::capsule made = py::module_::import("feltgate._designs").attr("makers");
    all = made.get_pointer<const std::vector<DesignMakers>>();
  }
  for (const DesignMakers& d : *all) {
    if (d.name == name) return d;
  }
  throw std::logic_error("feltgate._designs has no " + name + "; install the package again");
}

/// Registers these designs for make_backend() and make_real_chain(); returns their names.
std::vector<std::string> add_extra_designs() {
  std::vector<std::string> names;
#define FELTGATE_DESIGN(name)                                                      \
  add_design({#name, [](const std::string& k) { return loaded(#name).engine(k); }, \
              [](const std::string& k) { return loaded(#name).chain(k); },         \
              [] { return loaded(#name).info(); }});                               \
  names.emplace_back(#name);
#include "extra_designs.inc"
#undef FELTGATE_DESIGN
  return names;
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

PYBIND11_MODULE(_core, m) {
  m.doc() = "The C++ side of the package feltgate.";
  py::register_exception_translator(translate);
  m.attr("version") = FELTGATE_VERSION;
  m.attr("extra_designs") = add_extra_designs();
  m.def("design_names", &design_names);
  bind_scenes(m);
  bind_plant(m);
  bind_chain(m);
  bind_twin(m);
  bind_recordings(m);
  bind_runs(m);
}

}  // namespace feltgate::python
