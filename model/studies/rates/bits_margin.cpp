// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/speed-for-accuracy.md
#include "studies/rates/rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "law/diagnostics.hpp"
#include "studies/rates/sweep.hpp"

namespace feltgate::rates {

namespace {

using Index = Eigen::Index;

/// The law with parameters and states of a place.
law::Evaluation<double> placed(const law::Law& law, const Place& place) {
  law::Evaluation<double> out(law);
  for (std::size_t i = 0; i < law.parameters.size(); ++i) {
    if (law.parameters[i].derived < 0) out.set_parameter(i, place.parameters[i]);
  }
  return out;
}

/// The law as it is at rest there, with its states and lines.
law::Evaluation<double> resting(const law::Law& law, const Place& rest) {
  law::Evaluation<double> out = placed(law, rest);
  for (std::size_t i = 0; i < law.states.size(); ++i) out.set_state(i, rest.states[i]);
  for (std::size_t i = 0; i < rest.lines.size(); ++i) {
    for (std::size_t k = 0; k < rest.lines[i].size(); ++k) {
      out.set_line(i, k + 1, rest.lines[i][k]);
    }
  }
  return out;
}

/// Torques of a run at these angles; the host has sampled the same angles.
Eigen::VectorXd run(const law::Law& law, law::Evaluation<double>& at, const Eigen::VectorXd& u,
                    const HostWords& words) {
  const Index axes = u.size() / 3;
  if (words) words(u.head(axes), u.head(axes), at);
  std::vector<double> inputs;
  for (const law::Input& in : law.inputs) {
    inputs.push_back(u[static_cast<Index>(in.source) * axes + in.axis]);
  }
  at.run(inputs);
  Eigen::VectorXd nm = Eigen::VectorXd::Zero(axes);
  for (std::size_t i = 0; i < law.outputs.size(); ++i) nm[law.outputs[i].axis] = at.outputs()[i];
  return nm;
}

}  // namespace

std::optional<Place> at_rest(const law::Law& law, const Place& place, double run_s,
                             const HostWords& words, Eigen::VectorXd* nm) {
  Place rest = place;
  const Index axes = rest.inputs.size() / 3;
  rest.inputs.segment(axes, axes).setZero();
  law::Evaluation<double> at = placed(law, rest);
  std::vector<std::vector<double>> lines(law.lines.size());
  const bool remembers = !law.states.empty() || !law.lines.empty();
  const auto runs = remembers ? static_cast<std::int64_t>(std::ceil(0.3 / run_s)) : 1;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::int64_t i = 0; i < runs; ++i) {
    *nm = run(law, at, rest.inputs, words);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      lines[k].push_back(at.value(law.lines[k].written));
    }
    if (i < runs * 9 / 10) continue;
    low = std::min(low, nm->minCoeff() + nm->sum());
    high = std::max(high, nm->minCoeff() + nm->sum());
  }
  if (!(high - low <= 1e-5 + 1e-3 * nm->cwiseAbs().maxCoeff())) return {};
  for (std::size_t i = 0; i < law.states.size(); ++i) rest.states[i] = at.state(i);
  rest.lines.clear();
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const auto length = static_cast<std::size_t>(law.lines[k].length);
    const std::size_t kept = std::min(length, lines[k].size());
    rest.lines.emplace_back(lines[k].rbegin(),
                            lines[k].rbegin() + static_cast<std::ptrdiff_t>(kept));
  }
  return rest;
}

bool Envelope::add(double time_s, const Eigen::VectorXd& angles_rad) {
  if (left_ <= 0) return false;
  if (time_s < next_s_) {
    if (begun_) {
      low_ = low_.cwiseMin(angles_rad);
      high_ = high_.cwiseMax(angles_rad);
    }
    return true;
  }
  if (begun_) {
    last_ = (high_ - low_).norm() / 2;
    if (logs_.empty()) first_ = last_;
    times_s_.push_back(next_s_);
    logs_.push_back(std::log(last_));
    if (--left_ == 0 || !(last_ > least_ && last_ < most_)) {
      left_ = 0;
      return false;
    }
  }
  begun_ = true;
  low_ = high_ = angles_rad;
  next_s_ += period_s_;
  return true;
}

double Envelope::growth_1_s() const {
  const auto n = static_cast<double>(logs_.size());
  if (n < 4) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (n > 0 && last_ >= most_) return infinity;
    return n > 0 && last_ <= least_ ? -infinity : std::nan("");
  }
  double t = 0, y = 0, tt = 0, ty = 0;
  for (std::size_t i = 0; i < logs_.size(); ++i) {
    t += times_s_[i];
    y += logs_[i];
    tt += times_s_[i] * times_s_[i];
    ty += times_s_[i] * logs_[i];
  }
  return (n * ty - t * y) / (n * tt - t * t);
}

double border_of(double linear, const std::function<double(double factor)>& growth_1_s) {
  double low = 0.95, high = 1.05;
  double dies = growth_1_s(low * linear), grows = growth_1_s(high * linear);
  for (; !(dies < 0); low /= 1.15) {
    if (!(dies >= 0) || low < 0.5) return std::nan("");
    high = low;
    grows = dies;
    dies = growth_1_s(low / 1.15 * linear);
  }
  for (; !(grows > 0); high *= 1.15) {
    if (!(grows <= 0) || high > 2) return std::nan("");
    low = high;
    dies = grows;
    grows = growth_1_s(high * 1.15 * linear);
  }
  while (high - low > 0.02 * high || !std::isfinite(grows - dies)) {
    if (high - low < 0.005 * high) return (low + high) / 2 * linear;
    const double middle = (low + high) / 2, is = growth_1_s(middle * linear);
    if (std::isnan(is)) return is;
    (is > 0 ? high : low) = middle;
    (is > 0 ? grows : dies) = is;
  }
  return (low + (high - low) * dies / (dies - grows)) * linear;
}

namespace {

/// Torques of a swing by `by` along `direction` in its third period: what has its frequency.
Eigen::VectorXcd swung_nm(const law::Law& law, const Place& rest, const Eigen::VectorXd& direction,
                          double by, double rad_s, double run_s, const HostWords& words) {
  const Index axes = direction.size();
  law::Evaluation<double> at = resting(law, rest);
  const auto period = static_cast<Index>(std::ceil(2 * 3.141592653589793 / (rad_s * run_s)));
  Eigen::VectorXcd out = Eigen::VectorXcd::Zero(axes);
  for (Index i = 0; i < 3 * period; ++i) {
    const double phase = rad_s * run_s * static_cast<double>(i);
    Eigen::VectorXd u = rest.inputs;
    u.head(axes) += by * std::sin(phase) * direction;
    u.segment(axes, axes) += by * rad_s * std::cos(phase) * direction;
    const Eigen::VectorXd nm = run(law, at, u, words);
    if (i >= 2 * period) out += nm * std::polar(1.0 / static_cast<double>(period), -phase);
  }
  return out;
}

}  // namespace

bool swings_linearly(const law::Law& law, const Place& rest, const Eigen::VectorXd& direction,
                     double by, double rad_s, double run_s, const HostWords& words) {
  // What rests is as little a swing as there is; it is in the sum where a period is no whole number
  // of runs.
  const Eigen::VectorXcd still = swung_nm(law, rest, direction, 0, rad_s, run_s, words);
  const Eigen::VectorXcd wide = swung_nm(law, rest, direction, by, rad_s, run_s, words) - still;
  const Eigen::VectorXcd narrow =
      16 * (swung_nm(law, rest, direction, by / 16, rad_s, run_s, words) - still);
  return (wide - narrow).norm() <= 0.03 * narrow.norm();
}

double linear_range_rad(const law::Law& law, const Place& rest, const Eigen::VectorXd& direction,
                        double count_rad, double most_rad, const HostWords& words) {
  const Index axes = direction.size();
  const auto nm = [&](double by) {
    law::Evaluation<double> at = resting(law, rest);
    Eigen::VectorXd u = rest.inputs;
    u.head(axes) += by * direction;
    return run(law, at, u, words);
  };
  const Eigen::VectorXd middle = nm(0);
  const auto slope = [&](double by) -> Eigen::VectorXd { return (nm(by) - middle) / by; };
  const double small = count_rad / 2;
  const Eigen::VectorXd wanted = (slope(small) + slope(-small)) / 2;
  for (double by = most_rad; by >= 5 * count_rad; by *= 0.85) {
    const Eigen::VectorXd up = slope(by), down = slope(-by);
    const bool even = ((up + down) / 2 - wanted).norm() <= 0.02 * wanted.norm() + 1e-12;
    if (even && (up - down).norm() <= 0.5 * wanted.norm() + 1e-12) return by;
  }
  return 0;
}

namespace {

constexpr double most_nm = 1.2;                          ///< that a motor is asked for
constexpr double most_counts = 100, enough_counts = 60;  ///< of a swing
constexpr double hold_s = 0.14;                          ///< arming, and the way to the place
constexpr double settle_s = 0.3;                         ///< as at_rest()
constexpr int periods = 9;
constexpr double begins = 0.7;  ///< a swing, of the range in which the law is linear

double largest(const ParameterInfo& p) {
  const int bits = p.format.width() - p.format.sign;
  return std::ldexp(std::ldexp(1.0, bits) - 1, -p.format.fraction);
}

/// The direction in which the law is the stiffest against the inertia.
Eigen::VectorXd steepest_direction(const stability::LinearLaw& law, double period_s,
                                   const Eigen::MatrixXd& per_torque) {
  const Eigen::MatrixXd spring = -stability::torque_per_angle(law, period_s, 5).real();
  const Eigen::VectorXd out = stability::dominant_eigenvector(per_torque.lazyProduct(spring));
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
                         const Swing& swing, double give_rad_nm) {
  GainMargin out;
  out.of = of;
  // A law in the engine stands for a block of the core.
  const auto& rows = report_.rows;
  RateRow row = rows.back().block ? rows[rows.size() - 2] : rows.back();
  const double tick_s = model.axis.tick_s;
  law::Law law = read(source_, 1 / (row.ticks * tick_s));
  law.rate_hz = 1 / (row.ticks * tick_s);
  if (row.ticks == 1) {
    // With its factor it takes a few more clocks, for which a tick may be too short.
    try {
      law::compile(scaled(law, 1.5), target_);
    } catch (const law::Refused&) {
      row.ticks = 2;
      law = read(source_, 1 / (row.ticks * tick_s));
      law.rate_hz = 1 / (row.ticks * tick_s);
      out.of += ", at " + rate_text(law.rate_hz);
    }
  }
  const double run_s = row.ticks * tick_s;
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
  double slides_1_s = 0;
  const auto ratio = [&] {
    const Margin m = margin(model, *linear, 1, row.ticks, delay_of(row));
    slides_1_s = m.slides_1_s;
    return m.ratio;
  };
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
  if (!options_.bits) {
    out.why = "left out";
    return out;
  }
  if (slides_1_s > least_slide_1_s) {
    out.why = fmt::format("the pen slides off by {:.3g} 1/s and shows no swing", slides_1_s);
    return out;
  }
  const auto poles = stability::poles(model, *linear, out.linear, 1e-7, row.ticks, delay_of(row));
  out.rad_s = poles.front().imag();
  if (!(out.rad_s > 1)) {
    out.why = "at the border the device drifts away and does not swing";
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
    const double most_rad = std::min(
        (direction.size() > 1 ? 0.4 : 1) * most_counts * design_.count_rad, left_nm / steep);
    double range = linear_range_rad(law, *rest, direction, design_.count_rad, most_rad, words);
    while (range > range_rad && range >= 5 * design_.count_rad &&
           !swings_linearly(law, *rest, direction, range, out.rad_s, run_s, words)) {
      range *= 0.7;
    }
    if (range <= range_rad || range < 5 * design_.count_rad) continue;
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
  out.swing_counts = begins * range_rad / design_.count_rad;
  out.swing_nm = out.linear * steep * begins * range_rad;
  const double duty_nm =
      model.axis.torque_per_volt * e_.design.supply_v / e_.design.pwm_period_clocks();
  out.large = out.swing_counts >= 6 && out.swing_nm >= 2.5 * duty_nm;
  const double gives_rad = out.linear * nm.cwiseAbs().maxCoeff() * give_rad_nm;
  if (gives_rad > 0.3 * range_rad) {
    out.why = fmt::format("the grip gives way by {:.3g} counts, and the law is linear over {:.3g}",
                          gives_rad / design_.count_rad, out.swing_counts);
    return out;
  }
  const double period_s = 2 * 3.141592653589793 / out.rad_s;
  try {
    out.bits = border_of(out.linear, [&](double factor) {
      law::Compiled compiled = law::compile(scaled(law, factor), target_);
      const bool remembers = !law.states.empty() || !law.lines.empty();
      Let let{*rest, -factor * nm, begins * range_rad * direction, hold_s, 0, 1};
      if (remembers || words) let.begin_s += settle_s;
      let.end_s = let.begin_s + (periods + 2) * period_s;
      let.row_every = std::max(1, static_cast<int>(period_s / tick_s / 64));
      Envelope envelope(let.begin_s + period_s, period_s, 2.5 * design_.count_rad,
                        1.05 * range_rad * direction.norm(), periods);
      swing(std::move(compiled), let,
            [&](double t, const Eigen::VectorXd& at) { envelope.add(t, at); });
      return envelope.growth_1_s();
    });
    out.disagrees = std::isnan(out.bits);
    if (out.disagrees) out.why = "the bits show no border between half and twice of it";
  } catch (const law::Refused& r) {
    out.why = "the law is refused with that factor: " + r.reason;
  } catch (const std::invalid_argument& error) {
    out.why = error.what();
  }
  return out;
}

}  // namespace feltgate::rates
