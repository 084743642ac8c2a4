// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/stability/study.hpp"

#include <fmt/format.h>

#include <cmath>

#include "files/table.hpp"

namespace feltgate::stability {

namespace {

using files::Columns;
using files::Json;

std::string percent(double value, double of) {
  return std::isfinite(value) && of != 0 ? fmt::format("{:+.1f} %", 100 * (value / of - 1)) : "-";
}

std::string rate(double hz) {
  if (hz >= 1e6) return fmt::format("{:g} MHz", hz / 1e6);
  return hz >= 1e3 ? fmt::format("{:g} kHz", hz / 1e3) : fmt::format("{:g} Hz", hz);
}

/// The others against the border by eigenvalues, which comes before them.
std::string beside(const BorderPoint& p, double nm_rad) {
  return percent(nm_rad, p.exact.stiffness_nm_rad);
}

const Columns<BorderPoint> border_columns{
    {"", [](auto& p) { return rate(p.rate_hz); }, "<scene rate"},
    {"rate_hz", &BorderPoint::rate_hz},
    {"scene_ticks", &BorderPoint::scene_ticks},
    {"damping_nm_s_rad", &BorderPoint::damping_nm_s_rad, "B\nNm s/rad", "{:.4f}"},
    {"eigenvalues_nm_rad", [](auto& p) { return p.exact.stiffness_nm_rad; }, "eigenvalues",
     "{:.4g}"},
    {"bits_nm_rad", &BorderPoint::bits_nm_rad, "chain's bits", "{:.4g}"},
    {"", [](auto& p) { return beside(p, p.bits_nm_rad); }, " "},
    {"swing_rad_s", [](auto& p) { return p.exact.rad_s; }},
    {"swing_counts", &BorderPoint::swing_counts, "swing\ncounts", "{:.0f}"},
    {"closed_nm_rad", &BorderPoint::closed_nm_rad, "closed form\n(b+B)/(T/2+td)", "{:.4g}"},
    {"", [](auto& p) { return beside(p, p.closed_nm_rad); }, " "},
    {"with_estimator_nm_rad", &BorderPoint::estimator_nm_rad, "with\nestimator", "{:.4g}"},
    {"", [](auto& p) { return beside(p, p.estimator_nm_rad); }, " "},
    {"z_width", &BorderPoint::z_width, "Z-width", "{:.1f}"}};

const Columns<KnownNumber> known_columns{
    {"what", &KnownNumber::what, "<"},
    {"published", &KnownNumber::published, "published", "{:g}"},
    {"computed", &KnownNumber::computed, "computed", "{:.4f}"},
    {"", [](auto& k) { return percent(k.computed, k.published); }, " "}};

Columns<Rest> rest_columns(const Study& s) {
  return {
      {"stiffness_nm_rad", &Rest::stiffness_nm_rad, "Nm/rad", "{:.2f}"},
      {"first_count", &Rest::first_count, "presses from\ncounts", "{:.1f}"},
      {"presses", &Rest::presses, "presses"},
      {"quiet", &Rest::quiet, "quiet"},
      {"counts", &Rest::counts, "counts\nmoved"},
      {"torque_rms_nm", &Rest::torque_rms_nm, "torque rms\nmNm", "{:.2f}", 1e3},
      {"", [&s](auto& r) { return s.friction_nm * r.stiffness_nm_rad / s.rule_nm_rad; },
       "K*q/2\nmNm", "{:.2f}", 1e3},
      {"motor_torque_rms_nm", &Rest::motor_torque_rms_nm, "motor torque\nrms, mNm", "{:.2f}", 1e3}};
}

const Columns<HostRow> host_columns{
    {"what", &HostRow::what, "<"},
    {"rate_hz", [](auto& r) { return r.figures.rate_hz; }, "rate, Hz", "{:.1f}"},
    {"stiffness_nm_rad", [](auto& r) { return r.setting.stiffness_nm_rad; }, "Nm/rad", "{:.2f}"},
    {"noise_rad", [](auto& r) { return r.setting.noise_rad; }, "noise, mrad", "{:.3f}", 1e3},
    {"smoothing", [](auto& r) { return r.setting.smoothing; }, "alpha", "{:.2g}"},
    {"torque_rms_nm", [](auto& r) { return r.figures.torque_rms_nm; }, "torque rms, mNm", "{:.2f}",
     1e3},
    {"angle_rms_rad", [](auto& r) { return r.figures.angle_rms_rad; }, "lever rms, mrad", "{:.3f}",
     1e3}};

/// Whether it swings by itself, or by no more than counts make.
const char* verdict(const HeldWall& w) {
  const double border = std::isfinite(w.bits_nm_rad) ? w.bits_nm_rad : w.border_nm_rad;
  const double share = w.stiffness_nm_rad / border;
  return share < 0.95 ? "stable" : share > 1.05 ? "swings" : "at it";
}

Columns<HeldWall> held_columns() {
  Columns<HeldWall> all{
      {"", [](auto& w) { return rate(std::round(w.rate_hz)); }, "<rate"},
      {"rate_hz", &HeldWall::rate_hz},
      {"stiffness_nm_rad", &HeldWall::stiffness_nm_rad},
      {"needed_nm_s_rad", &HeldWall::needed_nm_s_rad, "takes b\nNm s/rad", "{:.4f}"},
      {"border_nm_rad", &HeldWall::border_nm_rad, "border, Nm/rad\neigenvalues", "{:.4g}"},
      {"bits_nm_rad", &HeldWall::bits_nm_rad, "bits", "{:.4g}"},
      {"", verdict, " "}};
  const auto press = [&](const std::string& key, const char* title, HostFigures HeldWall::*of) {
    all.push_back({key + "/counts", [of](auto& w) { return (w.*of).counts; },
                   fmt::format("{}\ncounts", title)});
    all.push_back({key + "/torque_swing_nm", [of](auto& w) { return (w.*of).torque_swing_nm; },
                   "mNm p-p", "{:.1f}", 1e3});
    all.push_back({key + "/torque_rms_nm", [of](auto& w) { return (w.*of).torque_rms_nm; }, "rms",
                   "{:.1f}", 1e3});
    all.push_back({key + "/angle_rms_rad", [of](auto& w) { return (w.*of).angle_rms_rad; }});
  };
  press("leaning", "20 mNm", &HeldWall::leaning);
  press("pressing", "0.25 Nm", &HeldWall::pressing);
  return all;
}

/// What the borders were measured of.
std::string model_text(const LoopModel& m) {
  return fmt::format(
      "\nb = {:.3g} Nm s/rad of friction and {:.3g} of the motor, of which the voltage law "
      "compensates {:.4g};\ntd = {:.4g} us at 1 MHz, {:.4g} us behind a host; estimator lag "
      "{:.4g} ms, J = {:.3g} kg m^2\n",
      m.damping_nm_s_rad, m.motor_damping_nm_s_rad, m.compensated, 1e6 * actuator_delay_s(m, 1),
      1e6 * actuator_delay_s(m, 2), 1e3 * m.velocity_delay_s, m.inertia_kg_m2);
}

std::string experiments(const Study& s) {
  if (s.rests.empty()) return {};
  return fmt::format(
             "\ncounts and friction: the core's own wall, plant {}, B = {:.3g} Nm s/rad. A press "
             "half way between the\ntorques of two counts is the worst: friction holds it below "
             "2f/q = {:.3f} Nm/rad. A press of a whole\ncount leaves the lever anywhere in it, now "
             "and then on an edge\n\n",
             s.full_plant, s.rest_damping_nm_s_rad, s.rule_nm_rad) +
         table(rest_columns(s), s.rests) +
         "\na hand leans on a wall that a host renders from a position with Gaussian noise\n\n" +
         table(host_columns, s.hosts);
}

std::string held(const Study& s) {
  if (s.held.empty()) return {};
  const double k = s.held.front().stiffness_nm_rad;
  return fmt::format(
             "\na wall of 2 Nm/deg = {:.2f} Nm/rad that a host renders, in a hand; a count is "
             "{:.4f} mrad and {:.1f} mNm,\nfriction holds a lever between two counts below 2f/q = "
             "{:.2f} Nm/rad\n\n",
             k, 1e3 * s.count_rad, 1e3 * k * s.count_rad, s.rule_nm_rad) +
         table(held_columns(), s.held);
}

}  // namespace

std::string study_text(const Study& s) {
  std::string out = fmt::format(
      "stiffest stable wall, Nm/rad: design {}, plant {}, lever pressed by a constant torque\n\n",
      s.design, s.linear_plant);
  out += table(border_columns, s.borders);
  for (const BorderPoint& p : s.borders) {
    if (p.exact.stiffness_nm_rad > 0) continue;
    out += fmt::format("{} with B = {:g}: none: the loop grows at any stiffness\n", rate(p.rate_hz),
                       p.damping_nm_s_rad);
  }
  return out + model_text(s.model) +
         "\nthe textbook loop (mass, held force, backward difference) against published "
         "numbers\n\n" +
         table(known_columns, s.known) + experiments(s) + held(s);
}

std::string study_json(const Study& s) {
  Json out{{"schema", "feltgate-stability/1"},
           {"design", s.design},
           {"linear_plant", s.linear_plant},
           {"full_plant", s.full_plant},
           {"encoder_rule_nm_rad", s.rule_nm_rad},
           {"actuator_delay_s", actuator_delay_s(s.model, 1)},
           {"locus_damping_nm_s_rad", s.locus_damping_nm_s_rad},
           {"rest_damping_nm_s_rad", s.rest_damping_nm_s_rad},
           {"borders", array_of(border_columns, s.borders)},
           {"locus", Json::array()},
           {"known", array_of(known_columns, s.known)},
           {"rests", array_of(rest_columns(s), s.rests)},
           {"hosts", array_of(host_columns, s.hosts)},
           {"held", array_of(held_columns(), s.held)}};
  for (const LocusPoint& p : s.locus) {
    Json poles = Json::array();
    for (const Pole& z : p.poles_rad_s) poles.push_back({z.real(), z.imag()});
    out["locus"].push_back({{"stiffness_nm_rad", p.stiffness_nm_rad}, {"poles_rad_s", poles}});
  }
  return files::json_text(nlohmann::json(out));  // keys in the order of the alphabet
}

}  // namespace feltgate::stability
