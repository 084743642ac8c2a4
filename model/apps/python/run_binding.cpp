// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Closed loop and replay for Python. Documentation: docs/python.md
#include <algorithm>
#include <optional>

#include "apps/python/bindings.hpp"
#include "apps/python/design_names.hpp"
#include "apps/python/plant_binding.hpp"
#include "apps/python/recording_binding.hpp"
#include "apps/python/run_result.hpp"
#include "sim/loop/scenario_bounds.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/loop/speed_jumps.hpp"

namespace feltgate::python {
namespace {

/// What both kinds of run are told about design and engines.
struct What {
  std::string design, design_path, registers_path, engines;
  int every = 1;
  std::uint64_t seed = 1;

  design::Elaborated elaborated() const { return elaborated_files(design_path, registers_path); }
  std::size_t rows(double duration_s) const {
    const auto tick_hz = design_named(design).tick_hz;
    return static_cast<std::size_t>(duration_s * static_cast<double>(tick_hz) / every) + 4;
  }
};

py::dict run(Scenario scenario, const PyPlant& plant, const What& what,
             const std::map<std::string, double>& set, std::optional<double> duration_s,
             const plant::Hand* hand, const py::object& progress) {
  const DesignInfo design = design_named(what.design);
  resolve_amounts(scenario, design);
  for (const auto& [name, value] : set) {
    quantise_parameter(parameter_of(design, name), value);
    scenario.parameters[name] = value;
  }
  if (hand != nullptr) scenario.hand = *hand;
  if (duration_s) {
    if (!(*duration_s >= 1e-5 && *duration_s <= 1e5)) {
      throw std::invalid_argument(fmt::format("duration_s is {}; give 1e-5 to 1e5 s", *duration_s));
    }
    scenario.duration_s = *duration_s;
  }
  // What a scene expects, it expects of its own hand, to the end.
  if (hand != nullptr || duration_s) scenario.expectations.clear();
  resolve_effects(scenario, plant.constants().effects);

  RunOptions options;
  options.design = what.design;
  options.engine = what.engines;
  options.seed = what.seed;
  options.row_every = what.every;
  RowArrays rows(true, choose_backends(what.engines).names(), what.rows(scenario.duration_s));
  options.row = [&rows](const Row& r) { rows.add(r); };
  options.progress = progress_for(progress);
  const auto e = what.elaborated();
  RunResult result;
  {
    const py::gil_scoped_release free;
    result = run_within_bounds(e, scenario, plant.constants(), options);
  }
  for (const std::string& jump : speed_jumps(scenario, plant.constants())) {
    if (PyErr_WarnEx(PyExc_UserWarning, jump.c_str(), 1) != 0) throw py::error_already_set();
  }
  py::dict out = result_dict(result);
  out["columns"] = rows.take();
  return out;
}

py::dict replay(const PyRecording& recording, const What& what, const std::string& scene, bool arm,
                const py::object& progress) {
  const auto clock_hz = design_named(what.design).clock_hz;
  if (clock_hz != recording.clock_hz) {
    throw std::invalid_argument(fmt::format(
        "the recording counts {} clocks per second, design {} has {}; read it with clock_hz={}",
        recording.clock_hz, what.design, clock_hz, clock_hz));
  }
  ReplayOptions options;
  options.design = what.design;
  options.engine = what.engines;
  options.scene = scene;
  options.arm = arm;
  options.seed = what.seed;
  options.row_every = what.every;
  const auto length = static_cast<double>(recording.edges.length);
  RowArrays rows(false, choose_backends(what.engines).names(),
                 what.rows(length / static_cast<double>(clock_hz)));
  options.row = [&rows](const Row& r) { rows.add(r); };
  options.progress = [tell = progress_for(progress), length](Clock done) {
    tell(std::min(1.0, static_cast<double>(done) / length));
  };
  const auto e = what.elaborated();
  RunResult result;
  {
    const py::gil_scoped_release free;
    traces::MemorySource source(recording.edges);
    result = replay_within_bounds(e, source, recording.name, options);
  }
  py::dict out = result_dict(result);
  out["columns"] = rows.take();
  return out;
}

}  // namespace

void bind_runs(py::module_& m) {
  py::class_<What>(m, "What")
      .def(py::init<std::string, std::string, std::string, std::string, int, std::uint64_t>(),
           py::arg("design"), py::arg("design_path"), py::arg("registers_path"), py::arg("engines"),
           py::arg("every"), py::arg("seed"))
      .def_readonly("every", &What::every);
  m.def("run", &run, py::arg("scene"), py::arg("plant"), py::arg("what"), py::arg("set"),
        py::arg("duration_s"), py::arg("hand"), py::arg("progress"));
  m.def("replay", &replay, py::arg("recording"), py::arg("what"), py::arg("scene"), py::arg("arm"),
        py::arg("progress"));
  m.def("backend_names",
        [](const std::string& engines) { return choose_backends(engines).names(); });
}

}  // namespace feltgate::python
