// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Closed loops of the cases. Documentation: docs/extremes.md
#include "campaigns/extremes/closed_loop.hpp"

#include <cmath>

#include "sim/plant/plant_file.hpp"

namespace feltgate::extremes {

plant::Parameters shipped_plant(const Settings& settings, const std::string& name) {
  return plant::read_plant_file(settings.root + "/vectors/plants/" + name + ".toml");
}

plant::Parameters linear_plant(const Settings& settings, double b_nm_s_rad) {
  plant::Parameters p = shipped_plant(settings, "p24");
  p.effects = {};
  p.effects.dead_voltage = p.effects.lugre = p.effects.dead_time = false;
  p.effects.viscous = b_nm_s_rad > 0;
  p.lever.viscous_nm_s_rad = b_nm_s_rad;
  return p;
}

RunResult run_loop(const Scenario& scenario, const plant::Parameters& plant,
                   const std::string& design, Driver driver, Outcome* outcome,
                   const std::function<void(const Row&)>& row) {
  Scenario s = scenario;
  s.effects = plant.effects;
  RunOptions options;
  options.design = design;
  options.engine = driver == Driver::lock_step ? "all" : driver == Driver::twin ? "twin" : "double";
  options.row = row;
  const RunResult r = run_scenario(s, plant, options);
  if (outcome->mismatches == 0) outcome->first_mismatch = r.first_mismatch;
  outcome->mismatches += r.mismatches;
  if (driver == Driver::lock_step) outcome->rtl_s += r.simulated_s;
  if (driver != Driver::real) outcome->twin_s += r.simulated_s;
  return r;
}

void fill(Finding* finding, Driver driver, double value) {
  if (driver == Driver::lock_step) finding->rtl = value;
  if (driver == Driver::real) {
    finding->real = value;
  } else {
    finding->twin = value;
  }
}

double Spread::rms() const { return n_ == 0 ? 0 : std::sqrt(sum_ / static_cast<double>(n_)); }

}  // namespace feltgate::extremes
