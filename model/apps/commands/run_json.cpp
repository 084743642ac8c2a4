// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Writes a run as JSON. Documentation: docs/json.md
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/commands/run_output.hpp"
#include "files/json_text.hpp"
#include "sim/loop/scenario_bounds.hpp"

namespace feltgate {

using Json = nlohmann::ordered_json;

namespace {

/// Where the bound holds, and beside it where it does not, if there are such ticks.
Json error_json(const ErrorFigure& e) {
  Json j{{"max_error", e.max()}, {"rms_error", e.rms()}};
  if (e.outside() > 0) {
    j["max_error_outside"] = e.max_outside();
    j["ticks_outside"] = e.outside();
  }
  return j;
}

/// Converts a number to JSON, which has no infinity.
Json finite_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json step_json(const StepFigures& s) {
  Json step{{"tau_ref_nm", s.tau_ref_nm},
            {"tau_hat_settling_ms", s.tau_hat.settling_ms},
            {"torque_settling_ms", s.torque.settling_ms},
            {"overshoot_pct", s.torque.overshoot_pct}};
  if (s.tau_hat_void) step["tau_hat_void"] = true;
  // A relative error of a step to 0 means nothing.
  if (s.tau_ref_nm != 0) {
    step["final_error_pct"] = s.torque.final_error_pct;
    step["tau_hat_final_error_pct"] = s.tau_hat.final_error_pct;
  }
  return step;
}

Json backend_json(const BackendFigures& e, const RunResult& r) {
  Json j = Json::object();
  if (e.compared) {
    j["velocity_rad_s"] = error_json(e.velocity_rad_s);
    j["tau_hat_nm"] = error_json(e.tau_hat_nm);
    j["torque_nm"] = error_json(e.torque_nm);
  }
  if (is_core(e) && !r.felt.errors.empty()) {
    for (const FeltError& x : r.felt.errors) {
      j[x.signal]["bound"] = finite_json(x.bound);
    }
    j["ticks_out_of_bounds"] = e.torque_nm.outside();
  }
  for (const StepFigures& s : e.steps) j["step_responses"].push_back(step_json(s));
  if (!e.steps.empty()) j["ripple_nm"] = e.steps.back().torque.ripple_nm;
  if (e.name == "rtl" || e.name == "twin") j["saturations"] = e.saturations;
  if (e.busy_s > 0) j["speed"] = r.simulated_s / e.busy_s;
  return j;
}

Json peak_json(const Peak& p) { return {{"peak_nm", p.value}, {"at_s", p.at_s}}; }

Json acted_json(const std::map<std::string, Acted>& all) {
  Json j = Json::object();
  for (const auto& [name, acted] : all) {
    j[name] = {{"seconds", acted.seconds}, {"first_s", acted.first_s}};
  }
  return j;
}

Json felt_json(const RunResult& r) {
  const Felt& f = r.felt;
  Json j;
  j["torque"] = {{"asked", peak_json(f.torque.asked)},
                 {"commanded", peak_json(f.torque.commanded)}};
  if (f.closed_loop) {
    j["torque"]["motor"] = peak_json(f.torque.motor);
    j["torque"]["hand"] = peak_json(f.torque.hand);
    j["torque"]["motor_less_asked_nm"] = error_json(f.torque.motor_error);
    j["energy"] = {{"taken_from_hand_j", f.energy.taken_from_hand_j},
                   {"given_to_hand_j", f.energy.given_to_hand_j},
                   {"net_from_hand_j", f.energy.net_from_hand_j()},
                   {"peak_from_hand_j", f.energy.peak_from_hand_j},
                   {"peak_to_hand_j", f.energy.peak_to_hand_j}};
  }
  for (const FeltError& x : f.errors) {
    j["errors"][x.signal] = error_json(x.error);
    j["errors"][x.signal].update({{"bound", finite_json(x.bound)}, {"holds", x.holds()}});
  }
  j["limits"] = acted_json(f.limits);
  if (f.tau_hat_void.seconds > 0) {
    j["tau_hat_void"] = {{"seconds", f.tau_hat_void.seconds}, {"first_s", f.tau_hat_void.first_s}};
  }
  j["faults"] = acted_json(f.faults);
  if (f.closed_loop) j["expectations"] = Json::array();
  for (const Expected& x : r.expectations) {
    Json e{{"figure", x.figure}, {"value", x.value}};
    if (std::isfinite(x.low)) e["low"] = x.low;
    if (std::isfinite(x.high)) e["high"] = x.high;
    e["line"] = x.line;
    e["kept"] = x.kept();
    j["expectations"].push_back(e);
  }
  return j;
}

}  // namespace

std::string run_json(const RunResult& r, const RunLabels& labels) {
  Json j{{"schema", "feltgate-run/1"}, {"version", FELTGATE_VERSION}, {"design", r.design}};
  j[labels.subject_key] = r.subject;
  if (!labels.probes.empty()) j["probes"] = labels.probes;
  if (!labels.plant.empty()) j["plant"] = labels.plant;
  j["simulated_s"] = r.simulated_s;
  j["clocks"] = r.clocks;
  j["ticks"] = r.ticks;
  if (r.lock_step) j["mismatches"] = r.mismatches;
  if (!r.first_mismatch.empty()) j["first_mismatch"] = r.first_mismatch;
  j["position"] = {{"steps", r.position.steps},
                   {"illegal", r.position.illegal},
                   {"reversals", r.position.reversals}};
  if (!r.reference.empty()) j["reference"] = r.reference;
  for (const BackendFigures& e : r.engines) j["engines"][e.name] = backend_json(e, r);
  j["felt"] = felt_json(r);
  if (r.law_stale.seconds > 0) {
    j["law_stale"] = {{"seconds", r.law_stale.seconds}, {"first_s", r.law_stale.first_s}};
  }
  if (r.felt.closed_loop) {
    j["plant_step_clocks"] = labels.step_clocks;
    j["plant_longest_step_clocks"] = r.longest_step_clocks;
    j["effects_off"] = labels.effects_off;
    if (!labels.speed_jumps.empty()) j["speed_jumps"] = labels.speed_jumps;
    for (const stability::Constant& c : labels.differing) {
      j["plant_differs"].push_back(
          {{"constant", c.key}, {"design", c.of_design}, {"plant", c.of_plant}});
    }
    j["figures"] = r.figures;
    j["expectations"] = {{"checked", r.expectations.size()}, {"broken", r.broken}};
  }
  return files::json_text(j);
}

}  // namespace feltgate
