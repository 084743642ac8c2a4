// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Changes design files by measured values. Documentation: docs/calibration.md
#include "host/calibrate/design_changes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "design/text_edit.hpp"

namespace feltgate::host {

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
