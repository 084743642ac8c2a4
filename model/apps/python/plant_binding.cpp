// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The plant for Python. Documentation: docs/python.md
#include <cmath>

#include "apps/python/bindings.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/plant/drive.hpp"
#include "sim/plant/plant_table.hpp"

namespace feltgate::python {
namespace {

toml::table changed(const std::string& path, const std::map<std::string, double>& set) {
  toml::table root = config::parse_toml_file(path);
  for (const auto& [name, value] : set) {
    const auto dot = name.find('.');
    const std::string section = name.substr(0, dot);
    const std::string key = dot == std::string::npos ? "" : name.substr(dot + 1);
    toml::table* table = root[section].as_table();
    toml::node* node = table == nullptr ? nullptr : table->get(key);
    if (node == nullptr || !node->is_number()) {
      throw std::invalid_argument(fmt::format(
          "\"{}\" is no number of the plant {}; feltgate.Plant(...).parameters lists them", name,
          path));
    }
    // In its place, so that errors name its line.
    if (toml::value<double>* real = node->as_floating_point()) {
      real->get() = value;
    } else if (value == std::floor(value) && std::abs(value) < 1e15) {
      node->as_integer()->get() = static_cast<std::int64_t>(value);
    } else {
      throw std::invalid_argument(fmt::format("\"{}\" = {} is no integer; round it", name, value));
    }
  }
  return root;
}

}  // namespace

PyPlant::PyPlant(const std::string& path, const std::map<std::string, double>& set,
                 const std::string& design, const plant::Hand& hand)
    : table_(changed(path, set)),
      constants_(plant::read_plant(table_, path)),
      drive_(plant::drive_of(design_named(design))),
      hand_(hand) {
  reset();
}

void PyPlant::reset() {
  plant_ = std::make_unique<plant::Plant>(constants_, constants_.effects, drive_, hand_);
}

std::map<std::string, double> PyPlant::parameters() const {
  std::map<std::string, double> all;
  for (const auto& [section, node] : table_) {
    const toml::table* table = node.as_table();
    if (table == nullptr) continue;
    for (const auto& [key, value] : *table) {
      if (!value.is_number()) continue;
      all[std::string(section.str()) + "." + std::string(key.str())] = *value.value<double>();
    }
  }
  return all;
}

py::dict PyPlant::run(const Doubles& duty, Clock step_clocks, bool gates_on) {
  if (step_clocks < 1 || step_clocks > 250) {
    throw std::invalid_argument(
        fmt::format("step_clocks is {}; give 1 to 250, 25 is usual", step_clocks));
  }
  const std::vector<double> duties = to_vector(duty, "duty");
  struct Shown {
    double time_s;
    plant::Observables of;
    std::int64_t counts;
  };
  std::vector<Shown> rows;
  rows.reserve(duties.size());
  {
    const py::gil_scoped_release free;
    for (std::size_t i = 0; i < duties.size(); ++i) {
      if (i % 100'000 == 99'999) check_interrupt();
      if (!(std::abs(duties[i]) <= 1)) {
        throw std::invalid_argument(fmt::format("duty[{}] is {}; give -1 to 1", i, duties[i]));
      }
      plant_->advance(plant::Bridge::averaged(duties[i], gates_on), step_clocks);
      rows.push_back({time_s(), plant_->observables(), counts()});
    }
  }
  using Of = plant::Observables;
  const auto of = [&](double Of::*value) {
    return column(rows, [value](const Shown& s) { return s.of.*value; });
  };
  return py::dict(
      "time_s"_a = column(rows, &Shown::time_s), "theta_rad"_a = of(&Of::theta_rad),
      "omega_rad_s"_a = of(&Of::omega_rad_s), "motor_current_a"_a = of(&Of::motor_current_a),
      "motor_torque_nm"_a = of(&Of::motor_torque_nm), "friction_nm"_a = of(&Of::friction_nm),
      "hand_torque_nm"_a = of(&Of::hand_torque_nm),
      "supply_current_a"_a = of(&Of::supply_current_a), "bus_v"_a = of(&Of::bus_v),
      "counts"_a = column(rows, &Shown::counts));
}

void bind_plant(py::module_& m) {
  py::class_<PyPlant>(m, "Plant")
      .def(py::init<const std::string&, const std::map<std::string, double>&, const std::string&,
                    const plant::Hand&>(),
           "path"_a, "set"_a, "design"_a, "hand"_a)
      .def_property_readonly("name", [](const PyPlant& p) { return p.constants().name; })
      .def_property_readonly("parameters", &PyPlant::parameters)
      .def_property_readonly("theta_rad", &PyPlant::theta_rad)
      .def_property_readonly("counts", &PyPlant::counts)
      .def_property_readonly("time_s", &PyPlant::time_s)
      .def("reset", &PyPlant::reset)
      .def("run", &PyPlant::run, "duty"_a, "step_clocks"_a, "gates_on"_a);
}

}  // namespace feltgate::python
