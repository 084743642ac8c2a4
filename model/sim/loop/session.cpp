// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What every run of a scene has. Documentation: docs/architecture.md, docs/scenes.md
#include "sim/loop/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "feltgate/nearest.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/loop/scenario_check.hpp"

namespace feltgate {

void note_mismatches(SessionResult& out, const AnyBackend& backend) {
  out.lock_step = backend.name() == std::string("lockstep");
  out.mismatches = backend.mismatches();
  out.first_mismatch = backend.first_mismatch();
  out.first_mismatch_clock = backend.first_mismatch_clock();
}

Session::Session(const Scenario& scenario, RunHost& host, const SessionOptions& options)
    : s_(scenario),
      host_(host),
      options_(options),
      feed_(scenario, options.law, host.design().clock_hz),
      end_(clock_of(scenario.duration_s)),
      arm_at_(host.design().request_at(clock_of(scenario.arm_s))),
      scene_(scene_number(host.design(), scenario.scene)),
      mode_(scenario.mode) {}

void Session::begin() {
  host_.set_parameters(s_.parameters);
  control();
}

void Session::arm() {
  arm_at_ = never;
  if (armed_) return;
  armed_ = true;
  control();
}

void Session::apply(const Event& e) {
  host_.set_parameters(e.set);
  if (e.stop) host_.backend().stop(*e.stop);
  if (!e.encoder.empty()) host_.backend().break_encoder(e.encoder);
  if (!e.scene && !e.mode && !e.arm) return;
  if (e.scene) scene_ = scene_number(host_.design(), *e.scene);
  mode_ = e.mode.value_or(mode_);
  armed_ = e.arm.value_or(armed_);
  control();
}

void Session::fill_result(SessionResult& out) const {
  if (options_.progress) options_.progress(1.0);
  const DesignInfo& d = host_.design();
  out.design = d.name;
  out.subject = s_.name;
  out.clocks = end_;
  out.ticks = ticks_;
  out.simulated_s = static_cast<double>(end_) / static_cast<double>(d.clock_hz);
  note_mismatches(out, host_.backend());
  const double tick_s = 1 / static_cast<double>(d.tick_hz);
  out.law_stale = {static_cast<double>(stale_ticks_) * tick_s,
                   static_cast<double>(stale_from_) * tick_s};
  out.figures["mismatches"] = static_cast<double>(out.mismatches);
  out.figures["faults"] = faults_;
}

void note_large_error(SessionResult& out, const std::string& figure, double off_nm, double asked_nm,
                      double lsb_nm) {
  constexpr double large = 0.1;
  if (!(off_nm > lsb_nm && off_nm > large * std::fabs(asked_nm))) return;
  const auto known = [&](const Expected& e) { return e.figure == figure; };
  if (std::any_of(out.expectations.begin(), out.expectations.end(), known)) return;
  out.large.push_back(
      fmt::format("{} = {:.4g}: so far is the torque from that in {}, {:.4g} Nm at most were "
                  "asked, and no bound "
                  "is proven",
                  figure, off_nm, out.reference, std::fabs(asked_nm)));
  out.broken.push_back(out.large.back());
}

void Session::check_expectations(SessionResult& out) const {
  for (const Expectation& x : s_.expectations) {
    if (x.design && *x.design != out.design) continue;
    // A run without a reference has no error.
    if (x.figure == "torque_error_nm" && out.reference.empty()) continue;
    const auto it = out.figures.find(x.figure);
    if (it == out.figures.end()) {
      std::vector<std::string> names;
      for (const auto& [name, value] : out.figures) names.push_back(name);
      throw config::ConfigError(
          fmt::format("{}:{}: figure \"{}\" is not one of this run; {}docs/scenes.md lists them",
                      s_.path, x.line, x.figure, config::did_you_mean(x.figure, names)));
    }
    const Expected& e =
        out.expectations.emplace_back(Expected{x.figure, it->second, x.low, x.high, x.line});
    if (e.kept()) continue;
    out.broken.push_back(fmt::format("{}:{}: {} = {:.6g} is outside its bounds; expected {}",
                                     s_.path, x.line, x.figure, e.value, e.wanted()));
  }
}

}  // namespace feltgate
