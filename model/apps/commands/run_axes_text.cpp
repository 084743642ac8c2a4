// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A run of several axes for reading and as JSON. Documentation: docs/json.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/commands/run_output.hpp"
#include "files/json_text.hpp"

namespace feltgate {

using Json = nlohmann::ordered_json;

namespace {

std::string axis_line(std::size_t n, const AxisFigures& a) {
  const std::string bound = std::isfinite(a.bound_nm) ? fmt::format("{:.3g}", a.bound_nm) : "none";
  return fmt::format("{:<5} {:>10.4g} {:>10.4g} {:>12.3g} {:>10.3g} {:>10}   limits: {}\n", n,
                     a.torque.asked.value, a.torque.motor.value, a.law_error_nm.max(),
                     a.law_error_nm.rms(), bound, acted_text(a.limits)) +
         (a.faults.empty() ? "" : fmt::format("{:<5} faults: {}\n", "", acted_text(a.faults)));
}

std::string range_line(const AxesResult& r, const std::string& signal) {
  const auto of = [&](const char* what) { return r.figures.at(signal + what); };
  return fmt::format("  {:<18} {:>12.6g} {:>12.6g} {:>12.6g} {:>12.3g}\n", signal, of(".min"),
                     of(".max"), of(".end"), of(".swing"));
}

bool bounded(const AxesResult& r) {
  return std::any_of(r.axes.begin(), r.axes.end(),
                     [](const AxisFigures& a) { return std::isfinite(a.bound_nm); });
}

Json errors_json(const AxisFigures& a) {
  Json j{{"max_error", a.law_error_nm.max()},
         {"rms_error", a.law_error_nm.rms()},
         {"ticks", a.law_error_nm.count()}};
  j["bound"] = std::isfinite(a.bound_nm) ? Json(a.bound_nm) : Json(nullptr);
  return j;
}

Json acted_json(const std::map<std::string, Acted>& all) {
  Json j = Json::object();
  for (const auto& [name, acted] : all) {
    j[name] = {{"seconds", acted.seconds}, {"first_s", acted.first_s}};
  }
  return j;
}

/// Signals, each once, in the order of the alphabet.
std::vector<std::string> signals_of(const AxesResult& r) {
  std::vector<std::string> all;
  for (const auto& [name, value] : r.figures) {
    constexpr std::string_view end = ".swing";
    if (name.size() < end.size() || name.compare(name.size() - end.size(), end.size(), end) != 0) {
      continue;
    }
    const std::string signal = name.substr(0, name.size() - end.size());
    if (signal.rfind("limits", 0) == 0 || signal.rfind("faults", 0) == 0) continue;
    all.push_back(signal);
  }
  return all;
}

}  // namespace

std::string axes_text(const AxesResult& r) {
  std::string text = large_error_lines(r);
  text +=
      fmt::format("scene {}, device {}, design {}, law {}\n", r.subject, r.device, r.design, r.law);
  text += fmt::format("{:.6g} s, {} clocks, {} ticks", r.simulated_s, r.clocks, r.ticks);
  if (r.lock_step) text += fmt::format("; mismatches between RTL and twin: {}", r.mismatches);
  text += fmt::format("; {:.3g} times real time\n", r.simulated_s / std::max(r.busy_s, 1e-9));
  if (!r.first_mismatch.empty()) text += fmt::format("first mismatch: {}\n", r.first_mismatch);
  text += fmt::format("\n{:<5} {:>10} {:>10} {:>12} {:>10} {:>10}\n", "axis", "asked Nm",
                      "motor Nm", "law error Nm", "rms", "bound");
  for (std::size_t n = 0; n < r.axes.size(); ++n) text += axis_line(n, r.axes[n]);
  text +=
      r.reference.empty()
          ? "law error: none, for without double or quad beside it\n"
          : fmt::format(
                "law error: commanded torque against the law in {} on the words that the "
                "engine got, where no ramp or limit holds it; bound: {}\n",
                r.reference,
                bounded(r) ? "proven" : "none, for the law jumps, or has states without an end");
  text += stale_line(r.law_stale);
  text += fmt::format("\n  {:<18} {:>12} {:>12} {:>12} {:>12}\n", "signal", "min", "max",
                      "end (mean)", "swing");
  for (const std::string& signal : signals_of(r)) text += range_line(r, signal);
  text += "\n" + energy_lines(r.energy) + expectation_lines(r.expectations);
  for (const std::string& jump : r.speed_jumps) text += fmt::format("note: {}\n", jump);
  for (const std::string& broken : r.broken) text += fmt::format("not as expected: {}\n", broken);
  return text;
}

std::string axes_json(const AxesResult& r) {
  Json j{{"schema", "feltgate-axes-run/1"},
         {"version", FELTGATE_VERSION},
         {"scene", r.subject},
         {"device", r.device},
         {"design", r.design},
         {"law", r.law}};
  j["simulated_s"] = r.simulated_s;
  j["clocks"] = r.clocks;
  j["homing_clocks"] = r.homing_clocks;
  j["ticks"] = r.ticks;
  if (r.lock_step) j["mismatches"] = r.mismatches;
  if (!r.first_mismatch.empty()) j["first_mismatch"] = r.first_mismatch;
  if (!r.reference.empty()) j["reference"] = r.reference;
  for (const AxisFigures& a : r.axes) {
    Json axis{{"asked_peak_nm", a.torque.asked.value},
              {"commanded_peak_nm", a.torque.commanded.value},
              {"motor_peak_nm", a.torque.motor.value}};
    if (!r.reference.empty()) axis["law_nm"] = errors_json(a);
    axis["limits"] = acted_json(a.limits);
    axis["faults"] = acted_json(a.faults);
    j["axes"].push_back(axis);
  }
  j["energy"] = {{"taken_from_hand_j", r.energy.taken_from_hand_j},
                 {"given_to_hand_j", r.energy.given_to_hand_j},
                 {"net_from_hand_j", r.energy.net_from_hand_j()},
                 {"peak_from_hand_j", r.energy.peak_from_hand_j},
                 {"peak_to_hand_j", r.energy.peak_to_hand_j}};
  if (r.law_stale.seconds > 0) {
    j["law_stale"] = {{"seconds", r.law_stale.seconds}, {"first_s", r.law_stale.first_s}};
  }
  j["figures"] = r.figures;
  j["expectations"] = {{"checked", r.expectations.size()}, {"broken", r.broken}};
  if (!r.speed_jumps.empty()) j["speed_jumps"] = r.speed_jumps;
  return files::json_text(j);
}

}  // namespace feltgate
