// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Text and JSON of an identification's results. Documentation: docs/identify.md
#include "host/identify/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/calibrate/report.hpp"

namespace feltgate::host {

namespace {

using nlohmann::ordered_json;

std::string line(const char* what, const Interval& i, const char* unit) {
  return fmt::format("  {:<22} {} {}\n", what, text_of(i), unit);
}

std::string line(const char* what, const std::optional<Interval>& i, const char* unit) {
  return i ? line(what, *i, unit) : "";
}

void add(ordered_json* j, const char* name, const std::optional<Interval>& i) {
  (*j)[name] = i ? report_json(*i) : nullptr;
}

}  // namespace

std::string report_text(const Drive& drive, const std::optional<Coast>& coast, const Constants& c,
                        double confidence) {
  std::string text = fmt::format(
      "driven: {} windows, {} left out, up to {:.3g} rad/s, noise {:.2g} mV; intervals: {:g} %\n",
      drive.windows, drive.left_out, drive.fastest_rad_s, 1e3 * drive.noise_v, 100 * confidence);
  text += line("J R/Kt", drive.inertia_v_s2, "V s^2/rad");
  text += line("Ke + B R/Kt", drive.speed_v_s, "V s/rad");
  text += line("F R/Kt + dead voltage", drive.both_v, "V");
  text += line("F R/Kt", drive.friction_v, "V");
  text += line("dead voltage", drive.dead_v, "V");
  if (coast) {
    text += fmt::format("coast-down: {:.3g} s from {:.3g} rad/s, noise {:.2g} mrad\n",
                        coast->length_s, coast->fastest_rad_s, 1e3 * coast->noise_rad);
    text += line("B/J", coast->damping_1_s, "1/s");
    text += line("F/J", coast->friction_rad_s2, "rad/s^2");
  }
  text += "constants:\n";
  text += line("Ke = Kt", c.emf_v_s_rad, "V s/rad, Nm/A");
  text += line("R", c.resistance_ohm, "ohm");
  text += line("J", c.inertia_kg_m2, "kg m^2");
  text += line("B", c.damping_nm_s_rad, "Nm s/rad");
  text += line("F", c.friction_nm, "Nm");
  text += line("dead voltage", c.dead_voltage_v, "V with the dead time's part");
  if (!c.emf_v_s_rad && !c.resistance_ohm) text += "  none yet: these recordings give products\n";
  for (const std::string& w : c.warnings) text += "note: " + w + "\n";
  for (const std::string& n : c.next) text += "next: " + n + "\n";
  return text;
}

ordered_json report_json(const Drive& drive, const std::optional<Coast>& coast, const Constants& c,
                         double confidence) {
  ordered_json j{{"schema", "feltgate-identify/1"}, {"confidence", confidence}};
  ordered_json d{{"j_r_over_kt_v_s2", report_json(drive.inertia_v_s2)},
                 {"ke_plus_b_r_over_kt_v_s", report_json(drive.speed_v_s)},
                 {"friction_and_dead_v", report_json(drive.both_v)}};
  add(&d, "f_r_over_kt_v", drive.friction_v);
  add(&d, "dead_voltage_v", drive.dead_v);
  d["windows"] = drive.windows;
  d["left_out"] = drive.left_out;
  d["fastest_rad_s"] = drive.fastest_rad_s;
  d["noise_v"] = drive.noise_v;
  j["driven"] = d;
  j["coast"] = nullptr;
  if (coast) {
    j["coast"] = {{"b_over_j_1_s", report_json(coast->damping_1_s)},
                  {"f_over_j_rad_s2", report_json(coast->friction_rad_s2)},
                  {"length_s", coast->length_s},
                  {"fastest_rad_s", coast->fastest_rad_s},
                  {"noise_rad", coast->noise_rad}};
  }
  ordered_json k;
  add(&k, "ke_v_s_rad", c.emf_v_s_rad);
  add(&k, "resistance_ohm", c.resistance_ohm);
  add(&k, "inertia_kg_m2", c.inertia_kg_m2);
  add(&k, "damping_nm_s_rad", c.damping_nm_s_rad);
  add(&k, "friction_nm", c.friction_nm);
  add(&k, "dead_voltage_v", c.dead_voltage_v);
  j["constants"] = k;
  j["warnings"] = c.warnings;
  j["next"] = c.next;
  return j;
}

std::string report_text(const EncoderError& e, double confidence) {
  std::string text = fmt::format("{:.3g} turns at {:.3g} to {:.3g} rad/s{}; intervals: {:g} %\n",
                                 e.turns, e.slowest_rad_s, e.fastest_rad_s,
                                 e.by_reference ? ", against the reference" : "", 100 * confidence);
  text += fmt::format("{:>9}  {:>30}  {:>30}\n", "per turn", "cosine, mrad", "sine, mrad");
  for (std::size_t k = 0; k + 1 < e.terms_rad.size(); k += 2) {
    text += fmt::format("{:>9}  {:>30}  {:>30}\n", k / 2 + 1, text_of(e.terms_rad[k].times(1e3)),
                        text_of(e.terms_rad[k + 1].times(1e3)));
  }
  text += fmt::format("largest error {:.3g} mrad; left over {:.2g} mrad\n", 1e3 * e.largest_rad,
                      1e3 * e.noise_rad);
  for (const std::string& w : e.warnings) text += "note: " + w + "\n";
  return text;
}

ordered_json report_json(const EncoderError& e, double confidence) {
  ordered_json j{{"schema", "feltgate-calibrate/1"}, {"procedure", "encoder"},
                 {"confidence", confidence},         {"turns", e.turns},
                 {"slowest_rad_s", e.slowest_rad_s}, {"fastest_rad_s", e.fastest_rad_s},
                 {"by_reference", e.by_reference},   {"largest_rad", e.largest_rad},
                 {"noise_rad", e.noise_rad},         {"freedom", e.freedom}};
  j["harmonics"] = ordered_json::array();
  for (std::size_t k = 0; k + 1 < e.terms_rad.size(); k += 2) {
    j["harmonics"].push_back({{"per_turn", k / 2 + 1},
                              {"cosine_rad", report_json(e.terms_rad[k])},
                              {"sine_rad", report_json(e.terms_rad[k + 1])}});
  }
  j["warnings"] = e.warnings;
  return j;
}

std::string report_text(const Cogging& c, double confidence) {
  std::string text =
      fmt::format("{:.3g} turns up at {:.3g} rad/s, {:.3g} down at {:.3g}; intervals: {:g} %\n",
                  c.turns_up, c.rad_s_up, c.turns_down, c.rad_s_down, 100 * confidence);
  text += fmt::format("friction {:.3g} mNm, steady torque on the lever {:.3g} mNm\n",
                      1e3 * c.friction_nm, 1e3 * c.steady_nm);
  if (c.terms.empty()) {
    return text + fmt::format("no cogging: none of {} harmonics has {:.2g} mNm and stands out\n",
                              c.searched, 1e3 * c.least_nm);
  }
  text += fmt::format("{:>9}  {:>26}  {:>10}  {:>10}\n", "per turn", "amplitude, mNm", "phase, rad",
                      "% of all");
  double all = 0;
  for (const CoggingTerm& t : c.terms) all += t.amplitude_nm.value;
  for (const CoggingTerm& t : c.terms) {
    text += fmt::format("{:>9}  {:>26}  {:>10.3f}  {:>10.1f}\n", t.per_turn,
                        text_of(t.amplitude_nm.times(1e3)), std::atan2(t.cosine_nm, t.sine_nm),
                        100 * t.amplitude_nm.value / all);
  }
  text += fmt::format(
      "largest cogging {:.3g} mNm, repeats {} times per turn; of {} harmonics, "
      "noise {:.2g} mNm\n",
      1e3 * c.largest_nm, c.period, c.searched, 1e3 * c.noise_nm);
  for (const std::string& w : c.warnings) text += "note: " + w + "\n";
  return text;
}

ordered_json report_json(const Cogging& c, double confidence) {
  ordered_json j{{"schema", "feltgate-calibrate/1"},
                 {"procedure", "cogging"},
                 {"confidence", confidence},
                 {"turns_up", c.turns_up},
                 {"turns_down", c.turns_down},
                 {"rad_s_up", c.rad_s_up},
                 {"rad_s_down", c.rad_s_down},
                 {"friction_nm", c.friction_nm},
                 {"steady_nm", c.steady_nm},
                 {"largest_nm", c.largest_nm},
                 {"period", c.period},
                 {"noise_nm", c.noise_nm},
                 {"searched", c.searched}};
  j["harmonics"] = ordered_json::array();
  for (const CoggingTerm& t : c.terms) {
    j["harmonics"].push_back({{"per_turn", t.per_turn},
                              {"cosine_nm", t.cosine_nm},
                              {"sine_nm", t.sine_nm},
                              {"amplitude_nm", report_json(t.amplitude_nm)},
                              {"odd_nm", t.odd_nm}});
  }
  j["warnings"] = c.warnings;
  return j;
}

std::vector<Change> changes_of(const EncoderError& e, const design::Elaborated& design) {
  std::vector<double> terms = design.design.absolute_error_mrad;
  terms.resize(std::max(terms.size(), e.terms_rad.size()));
  for (std::size_t k = 0; k < e.terms_rad.size(); ++k) terms[k] += 1e3 * e.terms_rad[k].value;
  return {{"absolute_encoder", "error_mrad", 0, fmt::format("measured over {:.3g} turns", e.turns),
           terms}};
}

std::vector<Change> changes_of(const Constants& c, const design::Elaborated& e, double confidence) {
  std::vector<Change> changes;
  const auto add_change = [&](const char* section, const char* key,
                              const std::optional<Interval>& i) {
    if (!i) return;
    changes.push_back({section, key, i->value,
                       i->half() > 0
                           ? fmt::format("measured, {:g} % {}", 100 * confidence, text_of(*i))
                           : "given"});
  };
  add_change("motor", "resistance_ohm", c.resistance_ohm);
  add_change("motor", "emf_constant_v_s_rad", c.emf_v_s_rad);
  if (!e.design.emf_in_law()) return changes;
  add_change("observer", "torque_constant_nm_a", c.emf_v_s_rad);
  add_change("observer", "inertia_kg_m2", c.inertia_kg_m2);
  if (c.dead_voltage_v) {
    const double part = e.word("dead_voltage").si - e.design.dead_voltage_v;
    changes.push_back({"voltage", "dead_voltage_v", std::max(0.0, c.dead_voltage_v->value - part),
                       fmt::format("measured, {:g} % {}; less {:.3g} V of the dead time",
                                   100 * confidence, text_of(*c.dead_voltage_v), part)});
  }
  return changes;
}

}  // namespace feltgate::host
