// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A run as text for a terminal, as JSON and as CSV. Documentation: docs/json.md
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands/run_output.hpp"
#include "files/table.hpp"
#include "sim/loop/scenario_bounds.hpp"

namespace feltgate {

using files::cell;
using files::Cells;
using files::Columns;
using files::Json;
using files::when;

namespace {

const Columns<StepFigures> step_columns{
    {"tau_ref_nm", &StepFigures::tau_ref_nm, "<step Nm", "{:.4g}"},
    {"tau_hat_settling_ms", [](auto& s) { return s.tau_hat.settling_ms; }},
    {"", [](auto& s) { return s.tau_hat_void ? Json("void") : Json(s.tau_hat.settling_ms); },
     "tau_hat settles", "{:.3f} ms"},
    {"torque_settling_ms", [](auto& s) { return s.torque.settling_ms; }, "motor settles",
     "{:.3f} ms"},
    {"overshoot_pct", [](auto& s) { return s.torque.overshoot_pct; }, "overshoot", "{:.2f} %"},
    {"tau_hat_void", [](auto& s) { return when(s.tau_hat_void, true); }},
    // A relative error of a step to 0 means nothing.
    {"final_error_pct", [](auto& s) { return when(s.tau_ref_nm != 0, s.torque.final_error_pct); },
     "final error", "{:.3f} %"},
    {"tau_hat_final_error_pct",
     [](auto& s) { return when(s.tau_ref_nm != 0, s.tau_hat.final_error_pct); }},
    {"", [](auto& s) { return s.tau_hat_void ? Json("void") : Json(s.tau_hat.final_error_pct); },
     "tau_hat error", "{:.4f} %"}};

/// Where the bound holds, and beside it where it does not, if there are such ticks.
Json error_json(const ErrorFigure& e) {
  Json j{{"max_error", e.max()}, {"rms_error", e.rms()}};
  if (e.outside() > 0) {
    j["max_error_outside"] = e.max_outside();
    j["ticks_outside"] = e.outside();
  }
  return j;
}

Json backend_json(const BackendFigures& e, const RunResult& r) {
  Json j = Json::object();
  if (e.compared) {
    j["velocity_rad_s"] = error_json(e.velocity_rad_s);
    j["tau_hat_nm"] = error_json(e.tau_hat_nm);
    j["torque_nm"] = error_json(e.torque_nm);
  }
  if (is_core(e) && !r.felt.errors.empty()) {
    for (const FeltError& x : r.felt.errors) j[x.signal]["bound"] = x.bound;
    j["ticks_out_of_bounds"] = e.torque_nm.outside();
  }
  if (!e.steps.empty()) {
    j["step_responses"] = array_of(step_columns, e.steps);
    j["ripple_nm"] = e.steps.back().torque.ripple_nm;
  }
  if (e.name == "rtl" || e.name == "twin") j["saturations"] = e.saturations;
  if (e.busy_s > 0) j["speed"] = r.simulated_s / e.busy_s;
  return j;
}

std::string engine_table(const RunResult& r) {
  std::vector<Cells> lines{{"engine", "velocity max", "rms rad/s", "tau_hat max", "rms Nm",
                            "command max", "rms Nm", "speed"}};
  for (const BackendFigures& e : r.engines) {
    const Json j = backend_json(e, r);
    lines.push_back({e.name});
    for (const std::string signal : {"/velocity_rad_s", "/tau_hat_nm", "/torque_nm"}) {
      for (const char* of : {"/max_error", "/rms_error"}) {
        lines.back().push_back(cell(j.value(Json::json_pointer(signal + of), Json()), "{:.3g}"));
      }
    }
    lines.back().push_back(cell(j.value("speed", Json()), "{:.3g}x"));
  }
  std::string text = "\n" + files::aligned(lines);
  if (r.reference.empty()) return text + "errors: none, for without double or quad among them\n";
  text += fmt::format(
      "errors against {} on the same sampled counts; \"command\" is the torque that the core "
      "commands\n",
      r.reference);
  if (r.felt.errors.empty()) return text;
  return text +
         fmt::format(
             "bound: proven for any motion up to this one's {:.4g} rad/s before the low-pass\n",
             r.largest_velocity_rad_s) +
         r.bound_sources;
}

std::string step_table(const RunResult& r) {
  for (const BackendFigures& e : r.engines) {
    if (!e.steps.empty()) return "\n" + table(step_columns, e.steps);  // RTL and twin show the same
  }
  return {};
}

std::string line(const char* name, const std::string& text) {
  return fmt::format("  {:<14} {}\n", name, text);
}

}  // namespace

std::string acted_text(const std::map<std::string, Acted>& all) {
  std::vector<std::string> items;
  for (const auto& [name, a] : all) {
    items.push_back(fmt::format("{} {:.4g} s (from {:.4g} s)", name, a.seconds, a.first_s));
  }
  return items.empty() ? "none" : fmt::format("{}", fmt::join(items, ", "));
}

Json acted_json(const Acted& a) { return {{"seconds", a.seconds}, {"first_s", a.first_s}}; }

Json acted_json(const std::map<std::string, Acted>& all) {
  Json j = Json::object();
  for (const auto& [name, acted] : all) j[name] = acted_json(acted);
  return j;
}

std::string large_error_lines(const SessionResult& r) {
  std::string text;
  for (const std::string& large : r.large) text += fmt::format("failed: {}\n", large);
  return text;
}

std::string stale_line(const Acted& stale) {
  if (stale.seconds == 0) return {};
  return fmt::format(
      "note: the law's mailbox is stale for {:.4g} s, from {:.4g} s: no torque then; add [feed] "
      "rate_hz (or raise it), or a longer max_age\n",
      stale.seconds, stale.first_s);
}

std::string energy_lines(const FeltEnergy& e) {
  const std::string owed =
      e.peak_to_hand_j > 0
          ? fmt::format("gave up to {:.3g} J more than it had taken", e.peak_to_hand_j)
          : "never gave more than it had taken";
  return line("energy", fmt::format("taken from the hand {:.4g} J, given to it {:.4g} J",
                                    e.taken_from_hand_j, e.given_to_hand_j)) +
         line("", fmt::format("net taken {:.4g} J, {:.4g} J at the peak; {}", e.net_from_hand_j(),
                              e.peak_from_hand_j, owed));
}

Json energy_json(const FeltEnergy& e) {
  return {{"taken_from_hand_j", e.taken_from_hand_j},
          {"given_to_hand_j", e.given_to_hand_j},
          {"net_from_hand_j", e.net_from_hand_j()},
          {"peak_from_hand_j", e.peak_from_hand_j},
          {"peak_to_hand_j", e.peak_to_hand_j}};
}

Json session_json(const SessionResult& r) {
  Json j{{"simulated_s", r.simulated_s}, {"clocks", r.clocks}, {"ticks", r.ticks}};
  if (r.lock_step) j["mismatches"] = r.mismatches;
  if (!r.first_mismatch.empty()) j["first_mismatch"] = r.first_mismatch;
  if (!r.reference.empty()) j["reference"] = r.reference;
  if (r.law_stale.seconds > 0) j["law_stale"] = acted_json(r.law_stale);
  return j;
}

std::string expectation_line(const std::vector<Expected>& all) {
  std::vector<std::string> kept;
  for (const Expected& e : all) {
    if (e.kept()) kept.push_back(e.figure);
  }
  const std::string none = all.empty() ? "none was checked" : "none";
  return line("kept", kept.empty() ? none : fmt::format("{}", fmt::join(kept, ", ")));
}

namespace {

std::string error_text(const FeltError& e) {
  const auto unit = e.signal == "velocity_rad_s" ? "rad/s" : "Nm";
  const auto name = e.signal == "velocity_rad_s" ? "velocity"
                    : e.signal == "tau_hat_nm"   ? "observed torque"
                                                 : "commanded torque";
  if (!std::isfinite(e.bound)) {
    return fmt::format("{} {:.3g} {}, no bound is proven", name, e.error.max(), unit);
  }
  const std::string outside =
      e.error.outside() > 0
          ? fmt::format(", and {:.3g} in ticks that the bound is not for", e.error.max_outside())
          : "";
  return fmt::format("{} {:.3g} {}, {} the proven {:.3g}{}", name, e.error.max(), unit,
                     e.holds() ? "within" : "ABOVE", e.bound, outside);
}

/// Motor and hand only where there are some.
std::vector<std::pair<const char*, Peak>> peaks(const Felt& f) {
  const FeltTorque& t = f.torque;
  if (!f.closed_loop) return {{"asked", t.asked}, {"commanded", t.commanded}};
  return {{"asked", t.asked}, {"commanded", t.commanded}, {"motor", t.motor}, {"hand", t.hand}};
}

std::string felt_text(const RunResult& r) {
  const Felt& f = r.felt;
  std::string text =
      f.closed_loop ? "\nWhat was felt (motor and hand: means over 1 ms)\n" : "\nWhat was felt\n";
  for (const auto& [name, peak] : peaks(f)) {
    text += line(name, fmt::format("up to {:.4g} Nm at {:.4g} s", peak.value, peak.at_s));
  }
  if (f.closed_loop) {
    text += line("motor off", fmt::format("from asked by up to {:.3g} Nm, rms {:.3g} Nm",
                                          f.torque.motor_error.max(), f.torque.motor_error.rms()));
    text += energy_lines(f.energy);
  }
  bool first = true;
  for (const FeltError& e : f.errors) {
    text += line(first ? "largest error" : "", error_text(e));
    first = false;
  }
  text += line("limits", acted_text(f.limits));
  if (f.tau_hat_void.seconds > 0) {
    text += line("tau_hat", fmt::format("void for {:.4g} s (from {:.4g} s): voltage or duty at the "
                                        "limit, the motor gives less than tau_hat says",
                                        f.tau_hat_void.seconds, f.tau_hat_void.first_s));
  }
  text += line("faults", acted_text(f.faults));
  if (f.closed_loop) text += expectation_line(r.expectations);
  return text;
}

/// Explains an unexpected result: constants that differ between plant and design.
std::string differing_lines(const RunLabels& labels) {
  if (labels.differing.empty()) return {};
  std::string text = "the plant is not the one that the design counts on:\n";
  for (const stability::Constant& c : labels.differing) {
    text += fmt::format("  {:<18} design {:.4g}, plant {:.4g} {}", c.name, c.of_design, c.of_plant,
                        c.unit);
    if (std::isfinite(c.excess())) text += fmt::format(" ({:+.1f} %)", 100 * c.excess());
    text += "\n";
  }
  return text +
         fmt::format(
             "a design for this plant: feltgate design --for-plant {} --nominal-current AMPERES -o "
             "rtl/designs/mine.toml\n",
             labels.plant_as_named);
}

Json felt_json(const RunResult& r) {
  const Felt& f = r.felt;
  Json j;
  for (const auto& [name, peak] : peaks(f)) {
    j["torque"][name] = {{"peak_nm", peak.value}, {"at_s", peak.at_s}};
  }
  if (f.closed_loop) {
    j["torque"]["motor_less_asked_nm"] = error_json(f.torque.motor_error);
    j["energy"] = energy_json(f.energy);
  }
  for (const FeltError& x : f.errors) {
    j["errors"][x.signal] = error_json(x.error);
    j["errors"][x.signal].update({{"bound", x.bound}, {"holds", x.holds()}});
  }
  j["limits"] = acted_json(f.limits);
  if (f.tau_hat_void.seconds > 0) j["tau_hat_void"] = acted_json(f.tau_hat_void);
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
  j.update(session_json(r));
  j["position"] = {{"steps", r.position.steps},
                   {"illegal", r.position.illegal},
                   {"reversals", r.position.reversals}};
  for (const BackendFigures& e : r.engines) j["engines"][e.name] = backend_json(e, r);
  j["felt"] = felt_json(r);
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

std::string run_text(const RunResult& r, const RunLabels& labels) {
  std::string text = large_error_lines(r);
  text += fmt::format("{} {}, design {}", labels.subject_key, r.subject, r.design);
  if (!labels.plant.empty()) text += fmt::format(", plant {}", labels.plant);
  text += fmt::format("\n{:.6g} s, {} clocks, {} ticks", r.simulated_s, r.clocks, r.ticks);
  if (r.lock_step) text += fmt::format("; mismatches between RTL and twin: {}", r.mismatches);
  text += labels.encoder.empty()
              ? fmt::format("\nencoder: {} step{}, {} illegal, {} reversal{}\n", r.position.steps,
                            r.position.steps == 1 ? "" : "s", r.position.illegal,
                            r.position.reversals, r.position.reversals == 1 ? "" : "s")
              : fmt::format("\nencoder: {}\n", labels.encoder);
  if (r.felt.closed_loop) {
    const bool longer = r.longest_step_clocks > labels.step_clocks;
    text += fmt::format("plant: steps of {}{} clocks; effects off: {}\n", labels.step_clocks,
                        longer ? fmt::format(" to {}", r.longest_step_clocks) : "",
                        labels.effects_off.empty()
                            ? "none"
                            : fmt::format("{}", fmt::join(labels.effects_off, " ")));
  }
  text += differing_lines(labels);
  if (!r.first_mismatch.empty()) text += fmt::format("first mismatch: {}\n", r.first_mismatch);
  if (r.engines.size() > 1) {
    text += engine_table(r);
  } else if (r.engines.front().busy_s > 0) {
    text += fmt::format("engine: {}, {:.3g} times real time\n", r.engines.front().name,
                        r.simulated_s / r.engines.front().busy_s);
  }
  text += step_table(r) + felt_text(r) + stale_line(r.law_stale);
  for (const std::string& jump : labels.speed_jumps) text += fmt::format("note: {}\n", jump);
  if (labels.never_armed_s > 0) {
    text += fmt::format("note: the motor never arms: arm_s = {:g}, and the scene ends at {:g} s\n",
                        labels.never_armed_s, r.simulated_s);
  }
  for (const std::string& note : labels.notes) text += fmt::format("note: {}\n", note);
  for (const std::string& broken : r.broken) text += fmt::format("not as expected: {}\n", broken);
  return text;
}

namespace {

// Mean size of a value with its comma during motion; values at rest and round numbers are shorter.
constexpr double bytes_per_value = 15;

}  // namespace

int sane_every(std::int64_t ticks) {
  for (int decade = 1; decade < 1'000'000'000; decade *= 10) {
    for (const int every : {decade, 2 * decade, 5 * decade}) {
      if ((ticks + every - 1) / every <= most_rows) return every;
    }
  }
  return 1'000'000'000;
}

CsvWriter::CsvWriter(std::FILE* to, std::vector<Column> columns)
    : to_(to), columns_(std::move(columns)) {
  std::string header;
  for (const Column& c : columns_) header += (header.empty() ? "" : ",") + c.name;
  header += '\n';
  std::fwrite(header.data(), 1, header.size(), to_);
}

void CsvWriter::add(const Row& row) {
  fmt::memory_buffer line;
  const auto end = std::back_inserter(line);
  for (const Column& c : columns_) {
    if (line.size() > 0) line.push_back(',');
    const double value = c.value(row);
    if (c.digits > 0) {
      fmt::format_to(end, "{:.{}g}", value, c.digits);
    } else {
      fmt::format_to(end, "{}", value);
    }
  }
  line.push_back('\n');
  std::fwrite(line.data(), 1, line.size(), to_);
}

std::string CsvWriter::forecast(std::int64_t ticks, int every) const {
  const std::int64_t rows = (ticks + every - 1) / every;
  const double mb =
      1e-6 * bytes_per_value * static_cast<double>(rows) * static_cast<double>(columns_.size());
  return fmt::format("CSV: {} rows of {} columns, up to about {:.2g} MB{}", rows, columns_.size(),
                     mb,
                     every == 1 ? "" : fmt::format(" (--every {}; --every 1: all ticks)", every));
}

}  // namespace feltgate
