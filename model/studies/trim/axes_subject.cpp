// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A scene of a device with several axes. Documentation: docs/speed-for-accuracy.md
#include <algorithm>
#include <cmath>
#include <variant>

#include "sim/axes_loop/axes_columns.hpp"
#include "sim/axes_loop/axes_run.hpp"
#include "sim/backends/axes_cores.hpp"
#include "sim/loop/felt.hpp"
#include "studies/trim/subject.hpp"

namespace feltgate::trim {

namespace {

constexpr int step_clocks = 250;  // of the loop of several axes

bool starts(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }
bool ends(const std::string& text, const std::string& with) {
  return text.size() >= with.size() &&
         text.compare(text.size() - with.size(), with.size(), with) == 0;
}

/// A column of axes_columns() that is compared, and where its signal goes.
struct Column {
  std::size_t at;
  std::vector<Signal>* to;
  std::size_t signal;
  double start = 0;
};

Felt feel(const AxesScene& scene, const Options& options, const Model& model, const LawMaker& law) {
  AxesScene s = scene;
  s.scenario.effects = model.effects;
  const DesignInfo design = design_named(options.design);
  const Clock window = std::llround(options.window_s * static_cast<double>(design.clock_hz));
  Felt felt;
  std::vector<Column> columns;
  const std::vector<std::string> names = axes_columns(s);
  const auto compare_column = [&](std::size_t at, std::vector<Signal>& to, double least) {
    columns.push_back({at, &to, to.size()});
    to.emplace_back(window, least);
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    if (starts(name, "motor_torque_nm.")) compare_column(i, felt.torque, least_torque_nm);
    if (starts(name, "theta_rad.")) compare_column(i, felt.position, least_position_rad);
    const bool hand = starts(name, "hand_") || name == "met_nm";
    if (hand && ends(name, "_n")) compare_column(i, felt.force, least_force_n);
    if (hand && ends(name, "_nm")) compare_column(i, felt.force, least_torque_nm);
  }
  const std::unique_ptr<SceneLaw> own = law();
  bool first = true;
  AxesRunOptions run;
  run.design = options.design;
  run.engine = "twin";
  run.law = own.get();
  run.row = [&](const std::vector<double>& row) {
    for (Column& c : columns) {
      if (first && c.to == &felt.position) c.start = row[c.at];
      (*c.to)[c.signal].add(design.clocks_per_tick, row[c.at] - c.start);
    }
    first = false;
  };
  const double begin = thread_cpu_s();
  const AxesResult result = run_axes(s, run);
  felt.cpu_s = thread_cpu_s() - begin;
  felt.simulated_s = result.simulated_s;
  felt.broken = result.broken;
  for (const AxisFigures& axis : result.axes) {
    if (felt.fault.empty()) felt.fault = first_fault(axis.faults);
  }
  return felt;
}

Course course(const AxesMotion& motion, const Options& options, const LawMaker& law) {
  const auto feel_it = [motion, options, law](const Model& model) {
    return feel(motion.scene, options, model, law);
  };
  return {motion.amplitude, motion.speed, feel_it};
}

}  // namespace

Subject axes_subject(const AxesScene& scene, const Options& options, const LawMaker& law) {
  const plant::Effects of_device = std::visit(
      [](const auto& setup) -> plant::Effects { return setup.parameters.effects; }, scene.device);
  Model full = full_model(scene.scenario, of_device, step_clocks);
  full.gates = false;
  const auto parts = [mass = has_mass(scene.device)](const Model& m) { return parts_of(m, mass); };
  const auto other = [scene, options, law](std::uint64_t seed) {
    return course(perturbed(scene, seed), options, law);
  };
  return {full, parts, course({scene}, options, law), other};
}

}  // namespace feltgate::trim
