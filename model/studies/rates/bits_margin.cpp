// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/stability.md
#include "studies/rates/bits_margin.hpp"

#include <algorithm>
#include <cmath>

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

law::Law scaled(law::Law law, double gain) {
  for (law::Output& o : law.outputs) {
    law::Node factor;
    factor.op = law::Op::constant;
    factor.value = gain;
    factor.place = o.place;
    law::Node product;
    product.op = law::Op::multiply;
    product.unit = law.nodes[static_cast<std::size_t>(o.value)].unit;
    product.place = o.place;
    product.arguments = {o.value, static_cast<law::NodeId>(law.nodes.size())};
    law.nodes.push_back(factor);
    law.nodes.push_back(product);
    o.value = static_cast<law::NodeId>(law.nodes.size() - 1);
  }
  return law;
}

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

double linear_range_rad(const law::Law& law, const Place& rest, const Eigen::VectorXd& direction,
                        double count_rad, double most_rad, const HostWords& words) {
  const Index axes = direction.size();
  const auto nm = [&](double by) {
    law::Evaluation<double> at = placed(law, rest);
    for (std::size_t i = 0; i < law.states.size(); ++i) at.set_state(i, rest.states[i]);
    for (std::size_t i = 0; i < rest.lines.size(); ++i) {
      for (std::size_t k = 0; k < rest.lines[i].size(); ++k) {
        at.set_line(i, k + 1, rest.lines[i][k]);
      }
    }
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

}  // namespace feltgate::rates
