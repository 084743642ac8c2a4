// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/stability/study.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "studies/stability/bit_loop.hpp"

namespace feltgate::stability {

namespace {

constexpr double kTenHz = 62.83185307179586;  // rad/s

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

Study run_study(const design::Elaborated& design, const plant::Parameters& linear,
                const plant::Parameters& full, const StudyOptions& o) {
  check(o);
  Study s;
  s.design = design.design.name;
  s.linear_plant = linear.name;
  s.full_plant = full.name;
  s.model = make_model(design, linear);
  const std::size_t all = o.rates_hz.size() * o.damping_nm_s_rad.size();
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
  s.rule_nm_rad = 2 * full.lugre.coulomb_nm / design.design.count_rad();
  return s;
}

}  // namespace feltgate::stability
