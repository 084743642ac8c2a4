// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core on a bench, and closed loops. Documentation: docs/extremes.md
#include "campaigns/extremes/bench.hpp"

#include <Vextremes_wide.h>

#include <cmath>
#include <stdexcept>

#include "sim/backends/make_backends.hpp"
#include "sim/plant/plant_file.hpp"
#include "wide.hpp"

namespace feltgate::extremes {

namespace {

BackendChoice choice(Cores cores) {
  return {cores == Cores::lock_step ? "lockstep" : "twin", {"double"}, false};
}

}  // namespace

EncoderPins pins_at(std::int64_t count) {
  const int phase = static_cast<int>(count & 3);
  return {phase >= 2, phase == 1 || phase == 2, false};
}

Bench::Bench(const std::string& design, Cores cores)
    : cores_(cores), ensemble_(design, choice(cores), 1, pins_at(0), Waveform{}) {
  // The host takes control; the self-test is off, so that it does not hold back the torque; no ramp
  // smooths a step.
  ensemble_.skip_self_test();
  control("free", false);
  set("ramp_step", 1.0);
}

void Bench::control(const std::string& scene, bool arm, int mode) {
  const int number = design().scene_number(scene);
  if (number < 0) throw std::invalid_argument("scene \"" + scene + "\" is not built");
  ensemble_.set_control(number, mode, arm);
}

void Bench::arm(const std::string& scene, int mode) {
  control(scene, false, mode);
  control(scene, true, mode);
  bool armed = false;
  for (int k = 0; k < 200 && !armed; ++k) {
    run(1, [&](const Sample& s) { armed = s.raw.armed; });
  }
  if (!armed) throw std::runtime_error("the core does not arm");
}

void Bench::stop(bool pressed) {
  Panel panel;
  panel.stop = pressed;
  ensemble_.lead().set_panel(panel);
}

void Bench::move(Clock at, int by) {
  count_ += by;
  edges_.push_back({at, pins_at(count_)});
}

void Bench::turn(Clock from, double counts_per_s, std::int64_t count) {
  const double clocks = static_cast<double>(design().clock_hz) / std::abs(counts_per_s);
  for (std::int64_t k = 1; k <= count; ++k) {
    move(from + static_cast<Clock>(std::ceil(static_cast<double>(k) * clocks)),
         counts_per_s > 0 ? 1 : -1);
  }
}

std::int64_t Bench::ticks(double seconds) const {
  return std::llround(seconds * static_cast<double>(design().tick_hz));
}

Sample Bench::sample(const Snapshot& s) {
  Sample out{ticks_++, s, {}, {}};
  out.core = {ensemble_.velocity_rad_s(s), ensemble_.torque_nm(s.tau_hat),
              ensemble_.torque_nm(s.tau_ref), ensemble_.current_a(s), ensemble_.voltage_v(s)};
  const ChainOut& r = ensemble_.rider(0)->out();
  out.real = {r.velocity_rad_s, r.tau_hat_nm, r.tau_ref_nm, r.current_a, r.voltage_v};
  return out;
}

void Bench::report(Outcome* outcome) const {
  const Backend& lead = ensemble_.lead_const();
  const double seconds = static_cast<double>(now()) / static_cast<double>(design().clock_hz);
  outcome->twin_s += seconds;
  if (cores_ != Cores::lock_step) return;
  outcome->rtl_s += seconds;
  if (outcome->mismatches == 0) outcome->first_mismatch = lead.first_mismatch();
  outcome->mismatches += lead.mismatches();
}

void use_wide_design() { add_rtl(Wide::name, Wide::design_crc, make_rtl<Vextremes_wide>); }

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

}  // namespace feltgate::extremes
