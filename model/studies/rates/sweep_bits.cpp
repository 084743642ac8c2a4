// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The margin at rest beside the swing of the bits. Documentation: docs/stability.md
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "law/diagnostics.hpp"
#include "studies/rates/sweep.hpp"

namespace feltgate::rates {

namespace {

constexpr double most_nm = 1.2;                          ///< that a motor is asked for
constexpr double most_counts = 100, enough_counts = 60;  ///< of a swing
constexpr double hold_s = 0.14;                          ///< arming, and the way to the place
constexpr double settle_s = 0.3;                         ///< as at_rest()
constexpr int periods = 9;

double largest(const ParameterInfo& p) {
  const int bits = p.format.width() - p.format.sign;
  return std::ldexp(std::ldexp(1.0, bits) - 1, -p.format.fraction);
}

/// The direction in which the law is the stiffest against the inertia.
Eigen::VectorXd steepest_direction(const stability::LinearLaw& law, double period_s,
                                   const Eigen::MatrixXd& per_torque) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(
      per_torque * -stability::torque_per_angle(law, period_s, 5).real());
  Eigen::Index best = 0;
  solver.eigenvalues().real().maxCoeff(&best);
  Eigen::VectorXd out = solver.eigenvectors().col(best).real();
  return out.cwiseAbs().maxCoeff() > 0 ? (out / out.cwiseAbs().maxCoeff()).eval() : out;
}

}  // namespace

std::map<std::string, double> Sweep::linear_parameters(const law::Law& law,
                                                       const Place& place) const {
  std::map<std::string, double> out{
      {"dead_voltage", 0}, {"dead_voltage_slope", 0}, {"torque_limit", 1.5}};
  for (const char* name : {"region_torque", "current_limit", "voltage_window"}) {
    if (const ParameterInfo* p = design_.find(name)) out[name] = largest(*p);
  }
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    const law::Parameter& p = law.parameters[i];
    if (p.derived < 0) out[p.name] = place.parameters[i] / p.to_si;
  }
  return out;
}

GainMargin Sweep::judged(const std::string& of, const stability::AxesLoopModel& model,
                         const stability::HostLink& host, const HostWords& words,
                         const Swing& swing) {
  GainMargin out;
  out.of = of;
  // A law in the engine stands for a block of the core.
  const auto& rows = report_.rows;
  const RateRow& row = rows.back().block ? rows[rows.size() - 2] : rows.back();
  const double tick_s = model.axis.tick_s, run_s = row.ticks * tick_s;
  law::Law law = read(source_, 1 / run_s);
  law.rate_hz = 1 / run_s;
  std::optional<Place> rest;
  std::optional<stability::LinearLaw> linear;
  Eigen::VectorXd nm;
  const auto look = [&](const Place& place) {
    rest = at_rest(law, place, run_s, words, &nm);
    if (!rest) return false;
    linear = linearised(law, *rest, design_.count_rad, words);
    if (linear) linear->host = host;
    return linear.has_value();
  };
  const auto ratio = [&] { return margin(model, *linear, 1, row.ticks, delay_of(row)).ratio; };
  if (!look(*report_.place)) {
    out.why = rest ? "the law has a jump at rest there" : "the law does not come to rest there";
    return out;
  }
  const double steep = stability::steepness(*linear, run_s, model.per_torque).most_nm_rad;
  out.linear = ratio();
  if (!(out.linear > 0)) {
    out.why = "no torque is stable there, not even a ten-thousandth";
    return out;
  }
  const Eigen::VectorXd direction = steepest_direction(*linear, run_s, model.per_torque);
  // Beside that place, as steep: where the law is linear over the widest swing that the motor can
  // follow.
  double range_rad = 0;
  std::optional<Place> best;
  for (const int counts : {0,  2,   -2, 4,   -4, 6,   -6, 8,   -8, 12,  -12, 16,  -16,
                           24, -24, 32, -32, 48, -48, 64, -64, 96, -96, 128, -128}) {
    Place beside = *report_.place;
    beside.inputs.head(direction.size()) += counts * design_.count_rad * direction;
    if (range_rad > enough_counts * design_.count_rad || !look(beside)) continue;
    const double here = stability::steepness(*linear, run_s, model.per_torque).most_nm_rad;
    if (!(std::abs(here - steep) < 0.02 * steep)) continue;
    const double left_nm = most_nm / (1.1 * out.linear) - nm.cwiseAbs().maxCoeff();
    const double most_rad = std::min(most_counts * design_.count_rad, left_nm / steep);
    const double range =
        linear_range_rad(law, *rest, direction, design_.count_rad, most_rad, words);
    if (range <= range_rad) continue;
    range_rad = range;
    best = beside;
  }
  if (range_rad == 0) {
    out.why = fmt::format(
        "nowhere beside that place is the law linear over 5 counts with at most {:g} Nm at the "
        "border",
        most_nm);
    return out;
  }
  look(*best);
  out.linear = ratio();
  out.swing_counts = range_rad / design_.count_rad;
  const auto poles = stability::poles(model, *linear, out.linear, 1e-7, row.ticks, delay_of(row));
  out.rad_s = poles.front().imag();
  if (!(out.rad_s > 1)) {
    out.why = "at the border the device drifts away and does not swing";
    return out;
  }
  const double period_s = 2 * 3.141592653589793 / out.rad_s;
  try {
    out.bits = border_of(out.linear, [&](double factor) {
      law::Compiled compiled = law::compile(scaled(law, factor), target_);
      const bool remembers = !law.states.empty() || !law.lines.empty();
      Let let{*rest, -factor * nm, range_rad * direction, hold_s, 0, 1};
      if (remembers || words) let.begin_s += settle_s;
      let.end_s = let.begin_s + (periods + 2) * period_s;
      let.row_every = std::max(1, static_cast<int>(period_s / tick_s / 64));
      Envelope envelope(let.begin_s + period_s, period_s, 2.5 * design_.count_rad,
                        3 * range_rad * direction.norm(), periods);
      swing(std::move(compiled), let,
            [&](double t, const Eigen::VectorXd& at) { envelope.add(t, at); });
      return envelope.growth_1_s();
    });
    if (std::isnan(out.bits)) out.why = "bits show no border between half and twice of it";
  } catch (const law::Refused& r) {
    out.why = "the law is refused with that factor: " + r.reason;
  } catch (const std::invalid_argument& error) {
    out.why = error.what();
  }
  return out;
}

}  // namespace feltgate::rates
