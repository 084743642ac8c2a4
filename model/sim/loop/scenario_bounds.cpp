// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Error bounds of a whole run. Documentation: docs/error-bounds.md
#include "sim/loop/scenario_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "feltgate/largest.hpp"
#include "files/toml/toml_reader.hpp"

namespace feltgate {

namespace {

using bounds::ErrorBound;
using bounds::ErrorBounds;
using bounds::SourceBound;

constexpr double endless = std::numeric_limits<double>::infinity();

ErrorBound worse(const ErrorBound& a, const ErrorBound& b) {
  return {std::max(a.against_quantised, b.against_quantised),
          std::max(a.against_reference, b.against_reference),
          std::max(a.against_exact, b.against_exact)};
}

void make_worse(ErrorBounds& a, const ErrorBounds& b) {
  for (ErrorBound ErrorBounds::*m :
       {&ErrorBounds::velocity_rad_s, &ErrorBounds::tau_hat_nm, &ErrorBounds::tau_ref_nm,
        &ErrorBounds::current_a, &ErrorBounds::torque_nm, &ErrorBounds::unlimited_tau_hat_nm,
        &ErrorBounds::unlimited_current_a}) {
    a.*m = worse(a.*m, b.*m);
  }
}

}  // namespace

RunBounds::RunBounds(const design::Elaborated& e, double velocity_rad_s)
    : numbers_(bounds::chain_numbers(e)) {
  region_.velocity_rad_s = velocity_rad_s;
}

void RunBounds::run_law(const SceneLaw* law, std::size_t axis) {
  law_ = law;
  if (law != nullptr) region_.law_nm = law->bound_nm(axis);
}

void RunBounds::render(const std::string& scene, int mode) {
  region_.scene = scene;
  region_.mode = mode;
  add();
}

void RunBounds::set(const std::string& parameter, double value, bool in_the_middle) {
  if (law_ != nullptr && law_->has(parameter)) return;  // the law's bound holds for all values
  numbers_.set(parameter, value);
  // Bounds do not depend on set-points.
  if (!in_the_middle || parameter == "setpoint_torque" || parameter == "voltage_setpoint") return;
  lost_ = lost_ || parameter == "velocity_a1" || parameter == "observer_a1" ||
          parameter == "inertia_gain";
  add();
}

void RunBounds::add() {
  const ErrorBounds b = bounds::error_bounds(numbers_, region_);
  const auto sources = bounds::source_bounds(numbers_, region_);
  if (!started_) {
    worst_ = b;
    sources_ = sources;
    started_ = true;
  }
  make_worse(worst_, b);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    SourceBound& s = sources_[i];
    s.velocity_rad_s = larger(s.velocity_rad_s, sources[i].velocity_rad_s);
    s.tau_hat_nm = larger(s.tau_hat_nm, sources[i].tau_hat_nm);
    s.tau_ref_nm = larger(s.tau_ref_nm, sources[i].tau_ref_nm);
    s.current_a = larger(s.current_a, sources[i].current_a);
  }
  if (!lost_) return;
  const ErrorBound none{endless, endless, endless};
  worst_.velocity_rad_s = worst_.tau_hat_nm = worst_.tau_ref_nm = worst_.current_a =
      worst_.torque_nm = worst_.unlimited_tau_hat_nm = worst_.unlimited_current_a = none;
  for (SourceBound& s : sources_) s = {s.name, endless, endless, endless, endless};
}

RunBounds scenario_bounds(const design::Elaborated& e, const Scenario& scenario,
                          double velocity_rad_s, const SceneLaw* law, std::size_t axis) {
  RunBounds run(e, velocity_rad_s);
  run.run_law(law, axis);
  for (const auto& [name, value] : scenario.parameters) run.set(name, value, false);
  std::string scene = scenario.scene;
  int mode = scenario.mode;
  // Reports a scene that is not built, with its line in the file.
  const auto render = [&](int line) {
    try {
      run.render(scene, mode);
    } catch (const std::invalid_argument& error) {
      if (line == 0) throw;
      throw config::ConfigError(fmt::format("{}:{}: {}", scenario.path, line, error.what()));
    }
  };
  render(scenario.scene_line);
  for (const Event& event : scenario.events) {
    for (const auto& [name, value] : event.set) run.set(name, value, true);
    if (!event.scene && !event.mode) continue;
    scene = event.scene.value_or(scene);
    mode = event.mode.value_or(mode);
    render(event.line);
  }
  return run;
}

// Runs whose errors are compared with their bounds.

namespace {

void hold(RunResult& r, const RunBounds& run, bool of_law, double torque_lsb_nm) {
  const bounds::ErrorBounds& b = run.worst();
  std::vector<bounds::SourceBound> sources = run.sources();
  for (bounds::SourceBound& s : sources) {
    if (of_law && s.name == "scenes") s.name = "law";
  }
  r.bound_sources = source_table(sources);
  for (const BackendFigures& e : r.engines) {
    if (!is_core(e)) continue;
    const FeltError errors[] = {
        {"velocity_rad_s", e.velocity_rad_s, b.velocity_rad_s.against_reference},
        {"tau_hat_nm", e.tau_hat_nm, b.tau_hat_nm.against_reference},
        {"torque_nm", e.torque_nm, b.torque_nm.against_reference}};
    r.felt.errors.assign(std::begin(errors), std::end(errors));  // RTL and twin are equal
    for (const FeltError& x : errors) {
      if (x.holds()) continue;
      r.broken.push_back(fmt::format("{}: {} is off by {:.4g}, above its proven bound {:.4g}",
                                     e.name, x.signal, x.error.max(), x.bound));
    }
  }
  const auto figure = r.figures.find("torque_error_nm");
  if (figure == r.figures.end() || std::isfinite(b.torque_nm.against_reference)) return;
  note_large_error(r, figure->first, figure->second, r.felt.torque.asked.value, torque_lsb_nm);
}

bool comparable(const BackendChoice& choice) {
  return choice.reference() == "quad" && !choice.rider_drives;
}

// The strictest bound decides before the run which ticks count; the bound itself follows from the
// motion of the run.
template <class Options, class Run, class BoundsUpTo>
RunResult held(const design::Elaborated& e, Options& options, bool of_law, Run&& run,
               BoundsUpTo&& up_to) {
  // A chain in real arithmetic has no clocks of edges.
  if (e.design.mt && options.engine == "all") options.engine = "rtl,twin";
  if (!comparable(choose_backends(options.engine))) return run();
  const bounds::Coverage coverage(up_to(hardly_any_rad_s).worst(), bounds::chain_numbers(e));
  options.coverage = &coverage;
  RunResult r = run();
  hold(r, up_to(std::max(r.largest_velocity_rad_s, hardly_any_rad_s)), of_law,
       std::ldexp(1.0, -e.design.torque.fraction));
  return r;
}

}  // namespace

bool is_core(const BackendFigures& e) {
  return e.compared && (e.name == "rtl" || e.name == "twin");
}

RunResult run_within_bounds(const design::Elaborated& e, const Scenario& scenario,
                            const plant::Parameters& plant, RunOptions options) {
  return held(
      e, options, options.law != nullptr, [&] { return run_scenario(scenario, plant, options); },
      [&](double velocity_rad_s) {
        return scenario_bounds(e, scenario, velocity_rad_s, options.law);
      });
}

RunResult replay_within_bounds(const design::Elaborated& e, EncoderSource& source,
                               const std::string& subject, ReplayOptions options) {
  return held(
      e, options, false, [&] { return run_replay(source, subject, options); },
      [&](double velocity_rad_s) {
        RunBounds bounds(e, velocity_rad_s);
        bounds.render(options.scene, 0);
        return bounds;
      });
}

}  // namespace feltgate
