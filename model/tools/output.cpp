// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// JSON, CSV and text of a run. Documentation: docs/json.md
#include "tools/output.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "files/json_text.hpp"

namespace feltgate {

using Json = nlohmann::ordered_json;

CsvWriter::CsvWriter(std::FILE* to, int every) : to_(to), every_(every) {
  std::fputs(
      "time_s,theta_rad,omega_rad_s,motor_torque_nm,hand_torque_nm,position_rad,velocity_rad_s,"
      "tau_ref_nm,tau_hat_nm,current_a,voltage_v,duty,quad_velocity_rad_s,quad_tau_hat_nm,"
      "quad_current_a,limits,faults\n",
      to_);
}

void CsvWriter::add(const Row& r) {
  if (count_++ % every_ != 0) return;
  std::fprintf(
      to_, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.12g,%.12g,%.12g,%d,%d\n",
      r.time_s, r.theta_rad, r.omega_rad_s, r.motor_torque_nm, r.hand_torque_nm, r.position_rad,
      r.velocity_rad_s, r.tau_ref_nm, r.tau_hat_nm, r.current_a, r.voltage_v, r.duty,
      r.quad_velocity_rad_s, r.quad_tau_hat_nm, r.quad_current_a, r.limits, r.faults);
}

namespace {

Json error_json(const ErrorFigure& e) { return {{"max_error", e.max()}, {"rms_error", e.rms()}}; }

/// The engines in fixed point, whose errors have bounds.
bool bounded(const EngineFigures& e) { return e.compared && (e.name == "rtl" || e.name == "twin"); }

/// Infinity has no number in JSON.
Json bound_json(double bound) { return std::isfinite(bound) ? Json(bound) : Json(nullptr); }

Json engine_json(const EngineFigures& e, double simulated_s, const bounds::ErrorBounds* bounds) {
  Json j = Json::object();
  if (e.compared && e.name != "quad") {
    j["velocity_rad_s"] = error_json(e.velocity_rad_s);
    j["tau_hat_nm"] = error_json(e.tau_hat_nm);
    j["torque_nm"] = error_json(e.torque_nm);
  }
  if (bounds != nullptr && bounded(e)) {
    const auto add = [&](const char* signal, const ErrorFigure& covered, double bound) {
      j[signal]["bound"] = bound_json(bound);
      j[signal]["max_error_in_bounds"] = covered.max();
    };
    add("velocity_rad_s", e.covered_velocity_rad_s, bounds->velocity_rad_s.against_reference);
    add("tau_hat_nm", e.covered_tau_hat_nm, bounds->tau_hat_nm.against_reference);
    add("torque_nm", e.covered_torque_nm, bounds->torque_nm.against_reference);
    j["ticks_out_of_bounds"] = e.uncovered;
  }
  if (!e.steps.empty()) {
    for (const StepFigures& s : e.steps) {
      Json step{{"tau_ref_nm", s.tau_ref_nm},
                {"tau_hat_settling_ms", s.tau_hat.settling_ms},
                {"torque_settling_ms", s.torque.settling_ms},
                {"overshoot_pct", s.torque.overshoot_pct}};
      // A relative error of a step to 0 means nothing.
      if (s.tau_ref_nm != 0) {
        step["final_error_pct"] = s.torque.final_error_pct;
        step["tau_hat_final_error_pct"] = s.tau_hat.final_error_pct;
      }
      j["step_responses"].push_back(step);
    }
    j["ripple_nm"] = e.steps.back().torque.ripple_nm;
  }
  if (e.name == "rtl" || e.name == "twin") j["saturations"] = e.saturations;
  if (e.busy_s > 0) j["speed"] = simulated_s / e.busy_s;
  return j;
}

/// The bounds below the table of errors, and which ticks they are not for.
std::string bound_lines(const RunResult& r, const bounds::ErrorBounds& b) {
  for (const EngineFigures& e : r.engines) {
    if (!bounded(e)) continue;
    char line[240];
    std::snprintf(line, sizeof line, "%-8s %14.3g %12s %12.3g %12s %12.3g %12s\n", "bound",
                  b.velocity_rad_s.against_reference, "", b.tau_hat_nm.against_reference, "",
                  b.torque_nm.against_reference, "");
    std::string text = line;
    if (e.uncovered > 0) {
      std::snprintf(line, sizeof line, "%-8s %14.3g %12s %12.3g %12s %12.3g %12s\n", "in it",
                    e.covered_velocity_rad_s.max(), "", e.covered_tau_hat_nm.max(), "",
                    e.covered_torque_nm.max(), "");
      text += line;
      text += "the bound is not for " + std::to_string(e.uncovered) +
              " ticks, of a ramp or saturation and what follows; \"in it\" leaves them out\n";
    }
    std::snprintf(line, sizeof line,
                  "bound: proven for any motion up to this one's %.4g rad/s before the low-pass\n",
                  r.largest_velocity_rad_s);
    return text + line;  // RTL and twin show the same
  }
  return {};
}

}  // namespace

void check_bounds(RunResult& result, const bounds::ErrorBounds& b) {
  for (const EngineFigures& e : result.engines) {
    if (!bounded(e)) continue;
    const auto check = [&](const char* signal, const ErrorFigure& error, double bound) {
      if (error.max() <= bound) return;
      result.broken.push_back(e.name + ": " + signal + " is off by " + std::to_string(error.max()) +
                              ", above its proven bound " + std::to_string(bound));
    };
    check("velocity", e.covered_velocity_rad_s, b.velocity_rad_s.against_reference);
    check("tau_hat", e.covered_tau_hat_nm, b.tau_hat_nm.against_reference);
    check("torque", e.covered_torque_nm, b.torque_nm.against_reference);
  }
}

std::string run_json(const RunResult& r, const RunLabels& labels) {
  Json j{{"schema", "feltgate-run-1"}, {"version", FELTGATE_VERSION}, {"design", r.design}};
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
  for (const EngineFigures& e : r.engines) {
    j["engines"][e.name] = engine_json(e, r.simulated_s, labels.bounds);
  }
  if (labels.closed_loop) {
    j["plant_step_clocks"] = labels.step_clocks;
    j["effects_off"] = labels.effects_off;
    j["figures"] = r.figures;
    j["expectations"] = {{"checked", labels.expectations}, {"broken", r.broken}};
  }
  return files::json_text(j);
}

std::string run_text(const RunResult& r, const RunLabels& labels) {
  std::ostringstream s;
  char line[240];
  s << labels.subject_key << " " << r.subject << ", design " << r.design;
  if (!labels.plant.empty()) s << ", plant " << labels.plant;
  std::snprintf(line, sizeof line, "\n%.6g s, %lld clocks, %lld ticks", r.simulated_s,
                static_cast<long long>(r.clocks), static_cast<long long>(r.ticks));
  s << line;
  if (r.lock_step) s << "; mismatches between RTL and twin: " << r.mismatches;
  s << "\nencoder: " << r.position.steps << " steps, " << r.position.illegal << " illegal, "
    << r.position.reversals << " reversals\n";
  if (labels.closed_loop) {
    s << "plant: steps of " << labels.step_clocks << " clocks; effects off:";
    for (const std::string& name : labels.effects_off) s << " " << name;
    s << (labels.effects_off.empty() ? " none\n" : "\n");
  }
  if (!r.first_mismatch.empty()) s << "first mismatch: " << r.first_mismatch << "\n";
  std::snprintf(line, sizeof line, "\n%-8s %14s %12s %12s %12s %12s %12s %10s\n", "engine",
                "velocity max", "rms rad/s", "tau_hat max", "rms Nm", "torque max", "rms Nm",
                "speed");
  s << line;
  for (const EngineFigures& e : r.engines) {
    const double speed = e.busy_s > 0 ? r.simulated_s / e.busy_s : 0;
    if (e.compared && e.name != "quad") {
      std::snprintf(line, sizeof line, "%-8s %14.3g %12.3g %12.3g %12.3g %12.3g %12.3g %9.3gx\n",
                    e.name.c_str(), e.velocity_rad_s.max(), e.velocity_rad_s.rms(),
                    e.tau_hat_nm.max(), e.tau_hat_nm.rms(), e.torque_nm.max(), e.torque_nm.rms(),
                    speed);
    } else {
      std::snprintf(line, sizeof line, "%-8s %14s %12s %12s %12s %12s %12s %9.3gx\n",
                    e.name.c_str(), "-", "-", "-", "-", "-", "-", speed);
    }
    s << line;
  }
  if (labels.bounds != nullptr) s << bound_lines(r, *labels.bounds);
  for (const EngineFigures& e : r.engines) {
    if (e.steps.empty()) continue;
    std::snprintf(line, sizeof line, "\n%-10s %16s %16s %12s %14s %16s\n", "step Nm",
                  "tau_hat settles", "torque settles", "overshoot", "final error", "tau_hat error");
    s << line;
    for (const StepFigures& f : e.steps) {
      std::snprintf(line, sizeof line,
                    "%-10.4g %13.3f ms %13.3f ms %10.2f %% %12.3f %% %14.4f %%\n", f.tau_ref_nm,
                    f.tau_hat.settling_ms, f.torque.settling_ms, f.torque.overshoot_pct,
                    f.torque.final_error_pct, f.tau_hat.final_error_pct);
      s << line;
    }
    break;  // RTL and twin show the same
  }
  for (const std::string& broken : r.broken) s << "not as expected: " << broken << "\n";
  return s.str();
}

}  // namespace feltgate
