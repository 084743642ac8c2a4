// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Text and JSON of a calibration's results. Documentation: docs/calibration.md
#include "host/calibrate/report.hpp"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "design/text_edit.hpp"

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
