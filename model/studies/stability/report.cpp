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

/// What the borders were measured of.
std::string model_text(const LoopModel& m) {
  return fmt::format(
      "\nb = {:.3g} Nm s/rad of friction and {:.3g} of the motor, of which the voltage law "
      "compensates {:.4g};\ntd = {:.4g} us at 1 MHz, {:.4g} us behind a host; estimator lag "
      "{:.4g} ms, J = {:.3g} kg m^2\n",
      m.damping_nm_s_rad, m.motor_damping_nm_s_rad, m.compensated, 1e6 * actuator_delay_s(m, 1),
      1e6 * actuator_delay_s(m, 2), 1e3 * m.velocity_delay_s, m.inertia_kg_m2);
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
         fmt::format(
             "friction of plant {} holds a lever between two counts below 2f/q = {:.3f} Nm/rad\n",
             s.full_plant, s.rule_nm_rad);
}

std::string study_json(const Study& s) {
  const Json out{{"schema", "feltgate-stability/2"},
                 {"design", s.design},
                 {"linear_plant", s.linear_plant},
                 {"full_plant", s.full_plant},
                 {"encoder_rule_nm_rad", s.rule_nm_rad},
                 {"actuator_delay_s", actuator_delay_s(s.model, 1)},
                 {"borders", array_of(border_columns, s.borders)}};
  return files::json_text(nlohmann::json(out));  // keys in the order of the alphabet
}

}  // namespace feltgate::stability
