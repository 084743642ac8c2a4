// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/stability/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "files/json_text.hpp"

namespace feltgate::stability {

namespace {

template <class... Values>
void add(std::string& out, const char* format, const Values&... values) {
  out += fmt::format(fmt::runtime(format), values...);
}

std::string percent(double value, double of) {
  if (!std::isfinite(value) || of == 0) return "-";
  return fmt::format("{:+.1f} %", 100 * (value / of - 1));
}

std::string number(double v) { return std::isfinite(v) ? fmt::format("{:.4g}", v) : "-"; }

std::string rate(double hz) {
  if (hz >= 1e6) return fmt::format("{:g} MHz", hz / 1e6);
  return hz >= 1e3 ? fmt::format("{:g} kHz", hz / 1e3) : fmt::format("{:g} Hz", hz);
}

void borders(std::string& out, const Study& s) {
  add(out,
      "stiffest stable wall, Nm/rad: design {}, plant {}, lever pressed by a constant torque\n\n"
      "scene rate       B   chain's bits   eigenvalues  (bits)   swing  closed form            "
      "with estimator        Z-width\n"
      "           Nms/rad                                      counts  (b+B)/(T/2+td)\n",
      s.design.c_str(), s.linear_plant.c_str());
  double before = 0;
  for (const BorderPoint& p : s.borders) {
    const double k = p.exact.stiffness_nm_rad;
    if (before != 0 && before != p.rate_hz) out += "\n";
    add(out, "{:<9}  {:7.4f}", before == p.rate_hz ? "" : rate(p.rate_hz).c_str(),
        p.damping_nm_s_rad);
    before = p.rate_hz;
    if (k == 0) {
      out += "           none: the loop grows at any stiffness\n";
      continue;
    }
    add(out, "  {:>13} {:>13}  {:<8} {:5.0f}  {:>10} {:<10}  {:>10} {:<10}  {:6.1f}\n",
        number(p.bits_nm_rad).c_str(), number(k).c_str(), percent(p.bits_nm_rad, k).c_str(),
        p.swing_counts, number(p.closed_nm_rad).c_str(), percent(p.closed_nm_rad, k).c_str(),
        number(p.estimator_nm_rad).c_str(), percent(p.estimator_nm_rad, k).c_str(), p.z_width);
  }
  const LoopModel& m = s.model;
  add(out,
      "\nb = {:.3g} Nm s/rad of friction and {:.3g} of the motor, of which the voltage law "
      "compensates "
      "{:.4g};\ntd = {:.4g} us at 1 MHz, {:.4g} us behind a host; estimator lag {:.4g} ms, J = "
      "{:.3g} kg "
      "m^2\n",
      m.damping_nm_s_rad, m.motor_damping_nm_s_rad, m.compensated, 1e6 * actuator_delay_s(m, 1),
      1e6 * actuator_delay_s(m, 2), 1e3 * m.velocity_delay_s, m.inertia_kg_m2);
}

void experiments(std::string& out, const Study& s) {
  add(out,
      "\ncounts and friction: the core's own wall, plant {}, B = {:.3g} Nm s/rad. A press half way "
      "between the\ntorques of two counts is the worst: friction holds it below 2f/q = {:.3f} "
      "Nm/rad. "
      "A press of a whole\ncount leaves the lever anywhere in it, now and then on an edge\n\n"
      "Nm/rad  press, counts   quiet   counts moved   torque rms   K*q/2   motor torque rms, mNm\n",
      s.full_plant.c_str(), s.rest_damping_nm_s_rad, s.rule_nm_rad);
  for (const Rest& r : s.rests) {
    add(out, "{:6.2f}   {:4.1f} to {:4.1f}  {:2} of {:<2}   {:11}  {:11.2f}  {:6.2f}  {:17.2f}\n",
        r.stiffness_nm_rad, r.first_count, r.first_count + r.presses - 1, r.quiet, r.presses,
        r.counts, 1e3 * r.torque_rms_nm, 1e3 * s.friction_nm * r.stiffness_nm_rad / s.rule_nm_rad,
        1e3 * r.motor_torque_rms_nm);
  }
  add(out,
      "\na hand leans on a wall that a host renders from a position with Gaussian noise\n\n"
      "                           rate   Nm/rad   noise mrad   alpha   torque rms mNm   lever rms "
      "mrad\n");
  for (const HostRow& r : s.hosts) {
    add(out, "{:<22} {:8.1f}  {:7.2f}  {:11.3f}  {:6.2g}  {:15.2f}  {:15.3f}\n", r.what.c_str(),
        r.figures.rate_hz, r.setting.stiffness_nm_rad, 1e3 * r.setting.noise_rad,
        r.setting.smoothing, 1e3 * r.figures.torque_rms_nm, 1e3 * r.figures.angle_rms_rad);
  }
}

/// Whether it swings by itself, or by no more than counts make.
const char* verdict(const HeldWall& w) {
  const double border = std::isfinite(w.bits_nm_rad) ? w.bits_nm_rad : w.border_nm_rad;
  const double share = w.stiffness_nm_rad / border;
  return share < 0.95 ? "stable" : share > 1.05 ? "swings" : "at it";
}

void held(std::string& out, const Study& s) {
  if (s.held.empty()) return;
  const double k = s.held.front().stiffness_nm_rad;
  add(out,
      "\na wall of 2 Nm/deg = {:.2f} Nm/rad that a host renders, in a hand; a count is {:.4f} mrad "
      "and {:.1f} mNm,\nfriction holds a lever between two counts below 2f/q = {:.2f} Nm/rad\n\n"
      "            takes b       border with the hand, Nm/rad     leaning, 20 mNm         "
      "pressing, "
      "0.25 Nm\n"
      "     rate   Nm s/rad   eigenvalues     bits             counts  mNm p-p     rms   counts  "
      "mNm "
      "p-p     rms\n",
      k, 1e3 * s.count_rad, 1e3 * k * s.count_rad, s.rule_nm_rad);
  for (const HeldWall& w : s.held) {
    add(out,
        "{:>9}   {:8.4f}   {:>11}  {:>7}   {:>6}   {:>6}  {:7.1f}  {:6.1f}   {:>6}  {:7.1f}  "
        "{:6.1f}\n",
        rate(std::round(w.rate_hz)).c_str(), w.needed_nm_s_rad, number(w.border_nm_rad).c_str(),
        number(w.bits_nm_rad).c_str(), verdict(w), w.leaning.counts,
        1e3 * w.leaning.torque_swing_nm, 1e3 * w.leaning.torque_rms_nm, w.pressing.counts,
        1e3 * w.pressing.torque_swing_nm, 1e3 * w.pressing.torque_rms_nm);
  }
}

nlohmann::json json_number(double v) {
  return std::isfinite(v) ? nlohmann::json(v) : nlohmann::json(nullptr);
}

}  // namespace

std::string study_text(const Study& s) {
  std::string out;
  borders(out, s);
  out +=
      "\nthe textbook loop (mass, held force, backward difference) against published numbers\n\n";
  for (const KnownNumber& k : s.known) {
    add(out, "  {:<40} {:8g}   computed {:9.4f}  {}\n", k.what.c_str(), k.published, k.computed,
        percent(k.computed, k.published).c_str());
  }
  if (!s.rests.empty()) experiments(out, s);
  held(out, s);
  return out;
}

std::string study_json(const Study& s) {
  using nlohmann::json;
  json out{{"schema", "feltgate-stability/1"},
           {"design", s.design},
           {"linear_plant", s.linear_plant},
           {"full_plant", s.full_plant},
           {"encoder_rule_nm_rad", s.rule_nm_rad},
           {"actuator_delay_s", actuator_delay_s(s.model, 1)},
           {"locus_damping_nm_s_rad", s.locus_damping_nm_s_rad},
           {"rest_damping_nm_s_rad", s.rest_damping_nm_s_rad}};
  out["borders"] = json::array();
  for (const BorderPoint& p : s.borders) {
    out["borders"].push_back({{"rate_hz", p.rate_hz},
                              {"scene_ticks", p.scene_ticks},
                              {"damping_nm_s_rad", p.damping_nm_s_rad},
                              {"eigenvalues_nm_rad", p.exact.stiffness_nm_rad},
                              {"swing_rad_s", p.exact.rad_s},
                              {"bits_nm_rad", json_number(p.bits_nm_rad)},
                              {"closed_nm_rad", p.closed_nm_rad},
                              {"with_estimator_nm_rad", json_number(p.estimator_nm_rad)},
                              {"swing_counts", p.swing_counts},
                              {"z_width", p.z_width}});
  }
  out["locus"] = json::array();
  for (const LocusPoint& p : s.locus) {
    json poles = json::array();
    for (const Pole& z : p.poles_rad_s) poles.push_back({z.real(), z.imag()});
    out["locus"].push_back({{"stiffness_nm_rad", p.stiffness_nm_rad}, {"poles_rad_s", poles}});
  }
  out["known"] = json::array();
  for (const KnownNumber& k : s.known) {
    out["known"].push_back(
        {{"what", k.what}, {"published", k.published}, {"computed", k.computed}});
  }
  out["rests"] = json::array();
  for (const Rest& r : s.rests) {
    out["rests"].push_back({{"stiffness_nm_rad", r.stiffness_nm_rad},
                            {"first_count", r.first_count},
                            {"presses", r.presses},
                            {"quiet", r.quiet},
                            {"counts", r.counts},
                            {"torque_rms_nm", r.torque_rms_nm},
                            {"motor_torque_rms_nm", r.motor_torque_rms_nm}});
  }
  out["hosts"] = json::array();
  for (const HostRow& r : s.hosts) {
    out["hosts"].push_back({{"what", r.what},
                            {"rate_hz", r.figures.rate_hz},
                            {"stiffness_nm_rad", r.setting.stiffness_nm_rad},
                            {"noise_rad", r.setting.noise_rad},
                            {"smoothing", r.setting.smoothing},
                            {"torque_rms_nm", r.figures.torque_rms_nm},
                            {"angle_rms_rad", r.figures.angle_rms_rad}});
  }
  const auto figures = [](const HostFigures& f) {
    return json{{"counts", f.counts},
                {"torque_swing_nm", f.torque_swing_nm},
                {"torque_rms_nm", f.torque_rms_nm},
                {"angle_rms_rad", f.angle_rms_rad}};
  };
  out["held"] = json::array();
  for (const HeldWall& w : s.held) {
    out["held"].push_back({{"rate_hz", w.rate_hz},
                           {"stiffness_nm_rad", w.stiffness_nm_rad},
                           {"needed_nm_s_rad", w.needed_nm_s_rad},
                           {"border_nm_rad", json_number(w.border_nm_rad)},
                           {"bits_nm_rad", json_number(w.bits_nm_rad)},
                           {"leaning", figures(w.leaning)},
                           {"pressing", figures(w.pressing)}});
  }
  return files::json_text(out);
}

}  // namespace feltgate::stability
