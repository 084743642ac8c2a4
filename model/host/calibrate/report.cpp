// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Text and JSON of a calibration's results. Documentation: docs/calibration.md
#include "host/calibrate/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "design/text_edit.hpp"
#include "files/table.hpp"

namespace feltgate::host {

namespace {

using files::Columns;
using files::Json;
using files::when;

/// `command`: what was asked for, with its unit; a torque has an error relative to it.
Columns<Residual> residual_columns(const std::string& command, bool relative) {
  return {{"command", &Residual::command, command, "{:10.4g}"},
          {"measured_nm", &Residual::measured_nm, "gauge Nm", "{:10.4f}"},
          {"fitted_nm", &Residual::fitted_nm, "line Nm", "{:10.4f}"},
          {"residual_nm", &Residual::residual_nm, "rest mNm", "{:10.2f}", 1e3},
          {"dead", &Residual::dead},
          {"studentised", &Residual::studentised},
          {"", [](auto& r) { return r.dead ? Json("in the dead zone") : Json(r.studentised); },
           "in sigmas", "{:.1f}"},
          {"", [](auto& r) { return when(!r.dead, 100 * (r.measured_nm / r.command - 1)); },
           relative ? "error of the torque" : "", "{:+.1f} %"}};
}

std::vector<Figure> figures_of(const OpenLoop& o) {
  return {{"slope", "slope_nm_v", "Nm/V", o.slope_nm_v},
          {"dead voltage", "dead_voltage_v", "V", o.dead_voltage_v},
          {"R = Kt/slope", "resistance_ohm", "ohm", o.resistance_ohm},
          {"gauge's offset", "gauge_offset_nm", "Nm", o.gauge_offset_nm},
          {"observer's slope", "observer_slope_nm_v", "Nm/V", o.observer_slope_nm_v}};
}

std::vector<Figure> figures_of(const ClosedLoop& c) {
  std::vector<Figure> all{{"slope", "slope", "(1 is right)", c.slope},
                          {"offset", "offset_nm", "Nm (0 is right)", c.offset_nm}};
  if (c.model) {
    all.push_back({"R", "resistance_ohm", "ohm", c.model->resistance_ohm});
    all.push_back(
        {"dead voltage", "dead_voltage_v", "V with the dead time's part", c.model->dead_voltage_v});
  }
  if (c.regions) {
    const bool two = c.regions->border_nm.has_value();
    all.push_back({"region border", "region_nm", "Nm", c.regions->border_nm});
    all.push_back({two ? "Kv below" : "Kv", "kv_low", "", c.regions->low});
    all.push_back({two ? "Kv above" : "", "kv_high", "", c.regions->high});
  }
  return all;
}

/// What both calibrations end with.
template <class Loop>
std::string end_text(const Loop& l) {
  return fmt::format("{:<18} {:.2g} mNm, {} degree{} of freedom; intervals: {:g} %\n", "noise",
                     1e3 * l.noise_nm, l.freedom, l.freedom == 1 ? "" : "s", 100 * l.confidence) +
         notes_text(l.warnings);
}

template <class Loop>
Json loop_json(const char* procedure, const Loop& l) {
  Json j{{"schema", "feltgate-calibrate/1"},
         {"procedure", procedure},
         {"confidence", l.confidence},
         {"noise_nm", l.noise_nm},
         {"freedom", l.freedom},
         {"readings", array_of(residual_columns("", false), l.residuals)},
         {"warnings", l.warnings}};
  for (const Figure& f : figures_of(l)) {
    if (f.value) j[f.key] = report_json(*f.value);
  }
  return j;
}

}  // namespace

std::string figures_text(const std::vector<Figure>& figures) {
  std::size_t width = 18;
  for (const Figure& f : figures) width = std::max(width, f.name.size());
  std::string text;
  for (const Figure& f : figures) {
    if (!f.value || f.name.empty()) continue;
    text += fmt::format("{:<{}} {} {}\n", f.name, width, text_of(*f.value), f.unit);
  }
  return text;
}

std::string notes_text(const std::vector<std::string>& notes) {
  std::string text;
  for (const std::string& note : notes) text += "note: " + note + "\n";
  return text;
}

std::string report_text(const OpenLoop& open, const design::Elaborated& e) {
  std::string text = table(residual_columns("V", false), open.residuals) + "\n";
  text += figures_text(figures_of(open));
  if (open.observer_slope_nm_v && !e.design.emf_in_law()) {
    text += figures_text({{"gauge/observer", "", "", slope_ratio(open)}});
    text += fmt::format("{:<18} voltage_to_current = {:.4g} brings the slopes together\n", "",
                        open.slope_nm_v.value / e.design.torque_constant_nm_a);
  }
  return text + end_text(open);
}

std::string report_text(const ClosedLoop& closed) {
  std::string text = table(residual_columns("asked Nm", true), closed.residuals) + "\n";
  text += figures_text(figures_of(closed));
  if (closed.model && closed.slope.contains(1) && closed.offset_nm.contains(0)) {
    text += "the design's constants lie within the intervals: nothing to change\n";
  }
  if (closed.regions) {
    text += fmt::format("{:<18} {:.1f} % at these torques, with the new gains\n", "error left",
                        100 * closed.regions->worst_error);
  }
  return text + end_text(closed);
}

std::string changes_text(const std::vector<Change>& changes) {
  std::string text;
  for (const Change& c : changes) {
    text += fmt::format("  [{}] {} = {}  # {}\n", c.section, c.key, toml_of(c), c.reason);
  }
  return text;
}

Json report_json(const Interval& i) {
  return {{"value", i.value}, {"low", i.low}, {"high", i.high}};
}

Json report_json(const OpenLoop& open) { return loop_json("open_loop", open); }

Json report_json(const ClosedLoop& closed) {
  Json j = loop_json("closed_loop", closed);
  if (closed.regions) {
    if (!closed.regions->border_nm) j["region_nm"] = nullptr;
    j["worst_error"] = closed.regions->worst_error;
  }
  return j;
}

Json report_json(const std::vector<Change>& changes) {
  Json rows = Json::array();
  for (const Change& c : changes) {
    rows.push_back({{"key", c.section + "." + c.key}, {"value", c.value}, {"reason", c.reason}});
  }
  return rows;
}

// Changes design files by measured values.

namespace {

/// The part of the dead voltage that the generator adds for the dead time, V.
double of_dead_time_v(const design::Elaborated& e) {
  const double brushes = e.design.emf_in_law() ? e.design.dead_voltage_v : 0.0;
  return e.word("dead_voltage").si - brushes;
}

/// The change of [voltage] dead_voltage_v, from the measured total.
Change brushes(const design::Elaborated& e, const Interval& whole, double confidence,
               std::vector<std::string>* warnings) {
  const double part = of_dead_time_v(e);
  if (whole.high < part) {
    warnings->push_back(fmt::format(
        "the dead time alone should take {:.3g} V, and only {} was measured; is [pwm] what the "
        "bridge does? dead_voltage_v becomes 0",
        part, text_of(whole)));
  }
  return {"voltage", "dead_voltage_v", std::max(0.0, whole.value - part),
          fmt::format("measured, {:g} % {}; less {:.3g} V of the dead time", 100 * confidence,
                      text_of(whole), part)};
}

std::string measured(const Interval& i, double confidence) {
  return fmt::format("measured, {:g} % {}", 100 * confidence, text_of(i));
}

}  // namespace

std::string toml_of(const Change& c) { return fmt::format("{:.6g}", c.value); }

std::string text_of(const Interval& i) {
  // As many digits as the interval justifies, and one more.
  const double size = std::max(std::abs(i.low), std::abs(i.high)), half = std::abs(i.half());
  int digits = 6;
  if (size > 0 && half > 0) {
    digits = static_cast<int>(std::floor(std::log10(size)) - std::floor(std::log10(half))) + 2;
  }
  digits = std::min(std::max(digits, 2), 7);
  return fmt::format("{:.{}g} ({:.{}g} to {:.{}g})", i.value, digits, i.low, digits, i.high,
                     digits);
}

std::vector<Change> changes_of(const OpenLoop& open, const design::Elaborated& e,
                               double torque_constant_nm_a, bool constant_given,
                               std::vector<std::string>* warnings) {
  std::vector<Change> changes;
  const std::string how = fmt::format(
      "{}, Kt = {:g} Nm/A", measured(open.resistance_ohm, open.confidence), torque_constant_nm_a);
  const bool model = e.design.emf_in_law();
  if (model || constant_given) {
    changes.push_back({"motor", "resistance_ohm", open.resistance_ohm.value, how});
  }
  if (model) {
    changes.push_back(brushes(e, open.dead_voltage_v, open.confidence, warnings));
    if (constant_given) {
      changes.push_back({"observer", "torque_constant_nm_a", torque_constant_nm_a, "given"});
      changes.push_back(
          {"motor", "emf_constant_v_s_rad", torque_constant_nm_a, "as the torque constant, given"});
    }
  }
  return changes;
}

std::vector<Change> changes_of(const ClosedLoop& closed, const design::Elaborated& e,
                               std::vector<std::string>* warnings) {
  std::vector<Change> changes;
  const double c = closed.confidence;
  if (closed.model) {
    changes.push_back({"motor", "resistance_ohm", closed.model->resistance_ohm.value,
                       measured(closed.model->resistance_ohm, c)});
    changes.push_back(brushes(e, closed.model->dead_voltage_v, c, warnings));
  }
  if (closed.regions) {
    const Regions& r = *closed.regions;
    changes.push_back({"voltage", "kv_low", r.low.value, measured(r.low, c)});
    changes.push_back({"voltage", "kv_high", r.high.value, measured(r.high, c)});
    if (r.border_nm) {
      changes.push_back({"voltage", "region_nm", r.border_nm->value, measured(*r.border_nm, c)});
    }
  }
  return changes;
}

std::string changed_design(const std::string& path, const std::string& name,
                           const std::vector<Change>& changes,
                           const design::RegisterMap& registers) {
  design::TextEdit edit(path, "measured");
  for (const Change& c : changes) {
    edit.because(c.reason);
    edit.set(c.section, c.key, toml_of(c));
  }
  const auto old = edit.text_of("", "description");
  if (old && old->size() > 2) {
    edit.set_description(old->substr(1, old->size() - 2) + "; calibrated");
  }
  const std::string text =
      fmt::format("# {}: {} with constants that were measured; see docs/calibration.md\n", name,
                  path.substr(path.rfind('/') + 1)) +
      edit.text();
  (void)elaborate(design::design_from_text(text, name + ".toml"), registers);
  return text;
}

}  // namespace feltgate::host
