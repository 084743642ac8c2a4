// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A run of several axes for reading and as JSON. Documentation: docs/json.md
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "apps/commands/run_output.hpp"
#include "files/table.hpp"

namespace feltgate {

using files::Cells;
using files::Columns;
using files::Json;
using files::when;

namespace {

bool bounded(const AxesResult& r) {
  return std::any_of(r.axes.begin(), r.axes.end(),
                     [](const AxisFigures& a) { return std::isfinite(a.bound_nm); });
}

Columns<AxisFigures> columns_of(const AxesResult& r) {
  using Axis = const AxisFigures&;
  const bool compared = !r.reference.empty();
  return {{"", [&r](Axis a) { return &a - r.axes.data(); }, "axis"},
          {"asked_peak_nm", [](Axis a) { return a.torque.asked.value; }, "asked Nm", "{:.4g}"},
          {"commanded_peak_nm", [](Axis a) { return a.torque.commanded.value; }},
          {"motor_peak_nm", [](Axis a) { return a.torque.motor.value; }, "motor Nm", "{:.4g}"},
          {"law_nm/max_error", [=](Axis a) { return when(compared, a.law_error_nm.max()); },
           "law error Nm", "{:.3g}"},
          {"law_nm/rms_error", [=](Axis a) { return when(compared, a.law_error_nm.rms()); }, "rms",
           "{:.3g}"},
          {"law_nm/ticks", [=](Axis a) { return when(compared, a.law_error_nm.count()); }},
          {"law_nm/bound", [=](Axis a) { return when(compared, a.bound_nm); }, "bound", "{:.3g}"},
          {"limits", [](Axis a) { return acted_json(a.limits); }},
          {"", [](Axis a) { return acted_text(a.limits); }, "<limits"},
          {"faults", [](Axis a) { return acted_json(a.faults); }},
          {"", [](Axis a) { return acted_text(a.faults); }, "<faults"}};
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
  text += "\n" + table(columns_of(r), r.axes);
  text +=
      r.reference.empty()
          ? "law error: none, for without double or quad beside it\n"
          : fmt::format(
                "law error: commanded torque against the law in {} on the words that the "
                "engine got, where no ramp or limit holds it; bound: {}\n",
                r.reference,
                bounded(r) ? "proven" : "none, for the law jumps, or has states without an end");
  text += stale_line(r.law_stale);
  std::vector<Cells> lines{{"signal", "min", "max", "end (mean)", "swing"}};
  for (const std::string& signal : signals_of(r)) {
    lines.push_back({signal});
    for (const char* of : {".min", ".max", ".end", ".swing"}) {
      lines.back().push_back(fmt::format("{:.6g}", r.figures.at(signal + of)));
    }
  }
  text += "\n" + files::aligned(lines) + "\n" + energy_lines(r.energy) +
          expectation_line(r.expectations);
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
  j.update(session_json(r));
  j["homing_clocks"] = r.homing_clocks;
  j["axes"] = array_of(columns_of(r), r.axes);
  j["energy"] = energy_json(r.energy);
  j["figures"] = r.figures;
  j["expectations"] = {{"checked", r.expectations.size()}, {"broken", r.broken}};
  if (!r.speed_jumps.empty()) j["speed_jumps"] = r.speed_jumps;
  return files::json_text(j);
}

}  // namespace feltgate
