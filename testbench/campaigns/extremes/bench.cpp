// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core on a bench. Documentation: docs/extremes.md
#include "campaigns/extremes/bench.hpp"

#include <cmath>
#include <stdexcept>

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

Finding finding(Cores cores, const std::string& what, const std::string& unit,
                const Expected& expected, double core, std::optional<double> real) {
  Finding f;
  f.what = what;
  f.unit = unit;
  f.expected = expected;
  if (cores == Cores::lock_step) f.rtl = core;
  f.twin = core;
  f.real = real;
  return f;
}

}  // namespace feltgate::extremes
