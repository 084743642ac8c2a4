// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/stability/study.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace feltgate::stability {

namespace {

constexpr double kTenHz = 62.83185307179586;  // rad/s
constexpr double kDegree = 0.017453292519943295;

BorderPoint border_point(const design::Elaborated& design, const plant::Parameters& plant,
                         const LoopModel& model, double rate_hz, double damping, bool bits) {
  BorderPoint p;
  p.rate_hz = rate_hz;
  p.damping_nm_s_rad = damping;
  p.scene_ticks = scene_ticks(design.design, rate_hz);
  p.exact = border(model, damping, p.scene_ticks);
  p.closed_nm_rad = closed_form(model, damping, p.scene_ticks);
  p.estimator_nm_rad = closed_form_with_estimator(model, damping, p.scene_ticks);
  p.z_width = p.exact.stiffness_nm_rad / free_impedance_nm_rad(model, kTenHz);
  p.bits_nm_rad = std::nan("");
  if (p.exact.stiffness_nm_rad > 0) {
    p.swing_counts = swing_rad(p.exact.stiffness_nm_rad) / design.design.count_rad();
    if (bits) p.bits_nm_rad = measured_border(design, plant, damping, p.scene_ticks, p.exact);
  }
  return p;
}

std::vector<LocusPoint> locus(const LoopModel& model, double damping) {
  std::vector<LocusPoint> out;
  const double top = 2 * border(model, damping, 1).stiffness_nm_rad;
  constexpr int steps = 60;
  for (int i = 0; i <= steps && top > 0; ++i) {
    const double k = top * std::pow(0.01, 1 - static_cast<double>(i) / steps);
    LocusPoint p{k, {}};
    for (const Pole& s : poles(model, {k, damping, 1})) {
      // Faster ones are gone within a tenth of a millisecond.
      if (s.real() > -1e4) p.poles_rad_s.push_back(s);
    }
    out.push_back(p);
  }
  return out;
}

std::vector<HostRow> host_rows(const design::Elaborated& design, const plant::Parameters& plant) {
  const double stiff = 2 / kDegree, soft = 0.2 / kDegree, noise = 0.05 * kDegree;
  std::vector<HostRow> rows{
      {"encoder, 2 Nm/deg", {490, stiff, 0, 1}, {}},
      {"encoder, 0.2 Nm/deg", {490, soft, 0, 1}, {}},
      {"encoder, throttled", {144, soft, 0, 1}, {}},
      {"with noise", {144, soft, noise, 1}, {}},
      {"with noise, smoothed", {144, soft, noise, 0.5}, {}},
  };
  for (HostRow& r : rows) r.figures = host_wall(design, plant, r.setting);
  return rows;
}

/// Whatever calls: not a number would never end.
void check(const StudyOptions& o) {
  for (const double rate : o.rates_hz) {
    if (rate >= 1 && rate <= 1e6) continue;
    throw std::invalid_argument(
        fmt::format("a scene rate of {} Hz cannot be studied; choose 1 to 1e6 Hz", rate));
  }
  for (const double damping : o.damping_nm_s_rad) {
    if (damping >= 0 && damping <= 1) continue;
    throw std::invalid_argument(
        fmt::format("a wall's damping of {} Nm s/rad cannot be studied; choose 0 to 1", damping));
  }
}

}  // namespace

std::vector<KnownNumber> known_numbers() {
  std::vector<KnownNumber> out;
  const auto add = [&](const char* what, double published, double computed) {
    out.push_back({what, published, computed});
  };
  // A finger device: friction 0.003 N s/m, force by backward difference, ideal actuator.
  const auto finger = [](double period_s, double damping, double mass = 0.045) {
    return MassLoop{mass, 0.003, period_s, damping, 0, 0};
  };
  add("1 kHz, B 0: 2(b+B)/T, N/m", 6, closed_form(finger(1e-3, 0)));
  add("1 kHz, B 0.05 N s/m", 106, closed_form(finger(1e-3, 0.05)));
  add("1 kHz, B 0.1", 206, closed_form(finger(1e-3, 0.1)));
  add("1 kHz, B 0.2", 406, closed_form(finger(1e-3, 0.2)));
  add("2 kHz, B 0.1", 412, closed_form(finger(5e-4, 0.1)));
  add("5 kHz, B 0.1", 1030, closed_form(finger(2e-4, 0.1)));
  add("1 kHz, B 0.1, eigenvalues, 10 g", 204.0, stiffest(finger(1e-3, 0.1, 0.010)));
  add("the same, 45 g", 205.5, stiffest(finger(1e-3, 0.1)));
  add("the same, 1 kg", 206.0, stiffest(finger(1e-3, 0.1, 1.0)));
  add("Z-width at 10 Hz, 1 kHz", 1093, z_width(closed_form(finger(1e-3, 0.1)), 0.003, 10));
  add("Z-width, 2 kHz", 2185.7, z_width(closed_form(finger(5e-4, 0.1)), 0.003, 10));
  add("Z-width, 5 kHz", 5464.3, z_width(closed_form(finger(2e-4, 0.1)), 0.003, 10));
  // The lever's inertia on a 2 kHz current loop, b = 1e-3 Nm s/rad, B = 0; t_d = 80 + 30 us.
  const auto loop = [](double rate_hz) {
    return MassLoop{1.22e-4, 1e-3, 1 / rate_hz, 0, 1 / (6.283185307179586 * 2000), 30e-6};
  };
  add("current loop, 144 Hz, Nm/rad", 0.28, stiffest(loop(144)));
  add("current loop, 490 Hz", 0.89, stiffest(loop(490)));
  add("current loop, 1 kHz", 1.64, stiffest(loop(1e3)));
  add("current loop, 40 kHz", 8.20, stiffest(loop(40e3)));
  add("current loop, 1 MHz", 9.09, stiffest(loop(1e6)));
  // A wrist device: what b a wall of 2 Nm/deg at 490 Hz and of 0.2 at 144 Hz takes, b = K T/2.
  add("2 Nm/deg at 490 Hz takes b, Nm s/rad", 0.1169, 2 / kDegree / 490 / 2);
  add("0.2 Nm/deg at 144 Hz takes b", 0.0398, 0.2 / kDegree / 144 / 2);
  return out;
}

Study run_study(const design::Elaborated& design, const plant::Parameters& linear,
                const plant::Parameters& full, const StudyOptions& o) {
  check(o);
  Study s;
  s.design = design.design.name;
  s.linear_plant = linear.name;
  s.full_plant = full.name;
  s.model = make_model(design, linear);
  const std::size_t all = o.rates_hz.size() * o.damping_nm_s_rad.size() + (o.experiments ? 17 : 0);
  std::size_t done = 0;
  const auto step = [&] {
    if (o.progress) o.progress(static_cast<double>(++done) / static_cast<double>(all));
  };
  for (const double rate : o.rates_hz) {
    for (const double damping : o.damping_nm_s_rad) {
      s.borders.push_back(border_point(design, linear, s.model, rate, damping, o.bits));
      step();
    }
  }
  s.locus_damping_nm_s_rad = 0.005;
  s.locus = locus(s.model, s.locus_damping_nm_s_rad);
  s.known = known_numbers();
  s.friction_nm = full.lugre.coulomb_nm;
  s.rule_nm_rad = encoder_rule_nm_rad(design, full);
  if (!o.experiments) return s;
  s.rest_damping_nm_s_rad = 0.005;
  const auto rest = [&](double k, double count, int presses) {
    const Wall wall{k, s.rest_damping_nm_s_rad, 1};
    s.rests.push_back(rest_in_wall(design, full, wall, count, presses));
    step();
  };
  for (const double k : {2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0}) rest(k, 10.5, 6);
  for (const double k : {3.0, 6.0}) rest(k, 10, 6);
  s.hosts = host_rows(design, full);
  for (int i = 0; i < 5; ++i) step();
  s.count_rad = design.design.count_rad();
  for (const double rate_hz : {144.0, 490.0, 10e3}) {
    s.held.push_back(held_wall(design, linear, full, rate_hz, 2 / kDegree));
    step();
  }
  return s;
}

}  // namespace feltgate::stability
