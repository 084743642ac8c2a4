// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs whose errors are compared with their bounds. Documentation: docs/error-bounds.md
#include "sim/loop/bounded.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/loop/scenario_bounds.hpp"

namespace feltgate {

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
