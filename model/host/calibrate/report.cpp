// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Text and JSON of a calibration's results. Documentation: docs/calibration.md
#include "host/calibrate/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace feltgate::host {

namespace {

using nlohmann::ordered_json;

std::string rows(const std::vector<Residual>& residuals, const char* command, bool relative) {
  std::string text =
      fmt::format("{:>10}  {:>10}  {:>10}  {:>10}  {}{}\n", command, "gauge Nm", "line Nm",
                  "rest mNm", "in sigmas", relative ? "  error of the torque" : "");
  for (const Residual& r : residuals) {
    text += fmt::format("{:>10.4g}  {:>10.4f}  {:>10.4f}  {:>10.2f}  ", r.command, r.measured_nm,
                        r.fitted_nm, 1e3 * r.residual_nm());
    if (r.dead) {
      text += "in the dead zone";
    } else {
      text += std::isfinite(r.studentised) ? fmt::format("{:>9.1f}", r.studentised) : "        -";
      if (relative) text += fmt::format("  {:>+18.1f} %", 100 * (r.measured_nm / r.command - 1));
    }
    text += "\n";
  }
  return text;
}

std::string warnings_text(const std::vector<std::string>& warnings) {
  std::string text;
  for (const std::string& w : warnings) text += "note: " + w + "\n";
  return text;
}

std::string found(const std::string& what, const Interval& i, const std::string& unit) {
  return fmt::format("{:<18} {} {}\n", what, text_of(i), unit);
}

std::string noise_text(double noise_nm, int freedom, double confidence) {
  return fmt::format("{:<18} {:.2g} mNm, {} degree{} of freedom; intervals: {:g} %\n", "noise",
                     1e3 * noise_nm, freedom, freedom == 1 ? "" : "s", 100 * confidence);
}

ordered_json residuals_json(const std::vector<Residual>& residuals) {
  ordered_json rows = ordered_json::array();
  for (const Residual& r : residuals) {
    ordered_json row{{"command", r.command},
                     {"measured_nm", r.measured_nm},
                     {"fitted_nm", r.fitted_nm},
                     {"residual_nm", r.residual_nm()},
                     {"dead", r.dead}};
    row["studentised"] = std::isfinite(r.studentised) ? ordered_json(r.studentised) : nullptr;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

std::string report_text(const OpenLoop& open, const design::Elaborated& e) {
  std::string text = rows(open.residuals, "V", false) + "\n";
  text += found("slope", open.slope_nm_v, "Nm/V");
  text += found("dead voltage", open.dead_voltage_v, "V");
  text += found("R = Kt/slope", open.resistance_ohm, "ohm");
  if (open.gauge_offset_nm) text += found("gauge's offset", *open.gauge_offset_nm, "Nm");
  if (open.observer_slope_nm_v) {
    text += found("observer's slope", *open.observer_slope_nm_v, "Nm/V");
    if (!e.design.emf_in_law()) {
      const Interval ratio = slope_ratio(open);
      text += found("gauge/observer", ratio, "");
      text += fmt::format("{:<18} voltage_to_current = {:.4g} brings the slopes together\n", "",
                          open.slope_nm_v.value / e.design.torque_constant_nm_a);
    }
  }
  text += noise_text(open.noise_nm, open.freedom, open.confidence);
  return text + warnings_text(open.warnings);
}

std::string report_text(const ClosedLoop& closed, const design::Elaborated& e) {
  std::string text = rows(closed.residuals, "asked Nm", true) + "\n";
  text += found("slope", closed.slope, "(1 is right)");
  text += found("offset", closed.offset_nm, "Nm (0 is right)");
  if (closed.model) {
    text += found("R", closed.model->resistance_ohm, "ohm");
    text += found("dead voltage", closed.model->dead_voltage_v, "V with the dead time's part");
    if (closed.slope.contains(1) && closed.offset_nm.contains(0)) {
      text += "the design's constants lie within the intervals: nothing to change\n";
    }
  }
  if (closed.regions) {
    const Regions& r = *closed.regions;
    if (r.border_nm) text += found("region border", *r.border_nm, "Nm");
    text += found(r.border_nm ? "Kv below" : "Kv", r.low, "");
    if (r.border_nm) text += found("Kv above", r.high, "");
    text += fmt::format("{:<18} {:.1f} % at these torques, with the new gains\n", "error left",
                        100 * r.worst_error);
  }
  (void)e;
  text += noise_text(closed.noise_nm, closed.freedom, closed.confidence);
  return text + warnings_text(closed.warnings);
}

std::string changes_text(const std::vector<Change>& changes) {
  std::string text;
  for (const Change& c : changes) {
    text += fmt::format("  [{}] {} = {}  # {}\n", c.section, c.key, toml_of(c), c.reason);
  }
  return text;
}

ordered_json report_json(const Interval& i) {
  return {{"value", i.value}, {"low", i.low}, {"high", i.high}};
}

ordered_json report_json(const OpenLoop& open) {
  ordered_json j{{"schema", "feltgate-calibrate/1"},
                 {"procedure", "open_loop"},
                 {"confidence", open.confidence},
                 {"slope_nm_v", report_json(open.slope_nm_v)},
                 {"dead_voltage_v", report_json(open.dead_voltage_v)},
                 {"resistance_ohm", report_json(open.resistance_ohm)}};
  if (open.gauge_offset_nm) j["gauge_offset_nm"] = report_json(*open.gauge_offset_nm);
  if (open.observer_slope_nm_v) j["observer_slope_nm_v"] = report_json(*open.observer_slope_nm_v);
  if (open.bend) {
    j["bend"] = {{"at_v", report_json(open.bend->at_v)},
                 {"slope_below_nm_v", report_json(open.bend->slope_below_nm_v)},
                 {"slope_above_nm_v", report_json(open.bend->slope_above_nm_v)},
                 {"chance", open.bend->chance}};
  }
  j["noise_nm"] = open.noise_nm;
  j["freedom"] = open.freedom;
  j["readings"] = residuals_json(open.residuals);
  j["warnings"] = open.warnings;
  return j;
}

ordered_json report_json(const ClosedLoop& closed) {
  ordered_json j{{"schema", "feltgate-calibrate/1"},
                 {"procedure", "closed_loop"},
                 {"confidence", closed.confidence},
                 {"slope", report_json(closed.slope)},
                 {"offset_nm", report_json(closed.offset_nm)}};
  if (closed.model) {
    j["resistance_ohm"] = report_json(closed.model->resistance_ohm);
    j["dead_voltage_v"] = report_json(closed.model->dead_voltage_v);
  }
  if (closed.regions) {
    j["kv_low"] = report_json(closed.regions->low);
    j["kv_high"] = report_json(closed.regions->high);
    j["region_nm"] = closed.regions->border_nm ? report_json(*closed.regions->border_nm) : nullptr;
    j["worst_error"] = closed.regions->worst_error;
  }
  j["noise_nm"] = closed.noise_nm;
  j["freedom"] = closed.freedom;
  j["readings"] = residuals_json(closed.residuals);
  j["warnings"] = closed.warnings;
  return j;
}

ordered_json report_json(const std::vector<Change>& changes) {
  ordered_json rows = ordered_json::array();
  for (const Change& c : changes) {
    ordered_json row{{"key", c.section + "." + c.key}, {"value", c.value}, {"reason", c.reason}};
    rows.push_back(row);
  }
  return rows;
}

}  // namespace feltgate::host
