// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/rates.md
#include "rates/continuous.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "feltgate/generated/causes.hpp"
#include "law/load.hpp"

namespace feltgate::rates {

namespace {

constexpr int look_every = 20;  ///< runs between two looks at the slope
constexpr double speed_step_rad_s = 1e-3;
/// The torque is not the law's in these.
constexpr int left_out =
    static_cast<int>(limit::ramp | limit::gates_closed | limit::hold | limit::chatter);

}  // namespace

std::vector<Change> changes_of(const Scenario& scene, const law::Law& law,
                               const law::Image* image) {
  std::vector<Change> all;
  std::optional<law::LoadedParameters> words;
  if (image != nullptr) words.emplace(*image);
  const auto add = [&](double at_s, const std::map<std::string, double>& set) {
    for (std::size_t i = 0; i < law.parameters.size(); ++i) {
      const law::Parameter& p = law.parameters[i];
      const auto it = p.derived < 0 ? set.find(p.name) : set.end();
      if (it == set.end()) continue;
      double value = it->second;
      if (words) {
        words->set(p.name, value);
        value = words->value(p.name);
      }
      all.push_back({at_s, i, value * p.to_si});
    }
  };
  if (words) {
    for (std::size_t i = 0; i < law.parameters.size(); ++i) {
      const law::Parameter& p = law.parameters[i];
      if (p.derived < 0) all.push_back({0, i, words->value(p.name) * p.to_si});
    }
  }
  add(0, scene.parameters);
  for (const Event& e : scene.events) add(e.at_s, e.set);
  return all;
}

Continuous::Continuous(const law::Law& law, std::vector<Change> changes, const Setting& setting)
    : law_(law), changes_(std::move(changes)), setting_(setting), true_(law), sampled_(law) {}

void Continuous::fill(double position_rad, double velocity_rad_s, double tau_hat_nm) {
  inputs_.clear();
  for (const law::Input& in : law_.inputs) {
    inputs_.push_back(in.source == law::Source::position   ? position_rad
                      : in.source == law::Source::velocity ? velocity_rad_s
                                                           : tau_hat_nm);
  }
}

double Continuous::torque(law::Evaluation<double>& law) {
  law.run(inputs_);
  return std::clamp(law.outputs().front(), -setting_.limit_nm, setting_.limit_nm);
}

double Continuous::probe(double position_rad, double velocity_rad_s, double tau_hat_nm) {
  law::Evaluation<double> copy = true_;
  fill(position_rad, velocity_rad_s, tau_hat_nm);
  return torque(copy);
}

// A slope is one that a count and a sixteenth of it show alike; a difference that does not shrink
// with the distance is a jump.
void Continuous::look(double position_rad, double velocity_rad_s, double tau_hat_nm) {
  const auto fall = [&](double h) {
    return probe(position_rad - h, velocity_rad_s, tau_hat_nm) -
           probe(position_rad + h, velocity_rad_s, tau_hat_nm);
  };
  const double h = setting_.count_rad / 2, wide = fall(h), narrow = fall(h / 16);
  const double tiny = 1e-9 * setting_.limit_nm;
  if (std::fabs(wide - 16 * narrow) > 0.05 * std::fabs(wide) + tiny) {
    if (std::fabs(narrow) > 0.5 * std::fabs(wide)) {
      slope_.jump_nm = std::max(slope_.jump_nm, std::fabs(narrow));
    }
    return;
  }
  const double stiffness = wide / (2 * h);
  const double damping = (probe(position_rad, velocity_rad_s - speed_step_rad_s, tau_hat_nm) -
                          probe(position_rad, velocity_rad_s + speed_step_rad_s, tau_hat_nm)) /
                         (2 * speed_step_rad_s);
  if (slope_.stiffness_nm_rad <= 0 && stiffness <= 0) {
    slope_.damping_nm_s_rad = std::max(slope_.damping_nm_s_rad, damping);
    return;
  }
  // Of places that are as steep, the one with the most torque: there the law is not about to end.
  const double here_nm = std::fabs(probe(position_rad, velocity_rad_s, tau_hat_nm));
  const bool steeper = stiffness > 1.001 * slope_.stiffness_nm_rad;
  const bool as_steep = stiffness > 0.999 * slope_.stiffness_nm_rad && here_nm > steepest_nm_;
  if (!steeper && !as_steep) return;
  slope_.stiffness_nm_rad = std::max(stiffness, slope_.stiffness_nm_rad);
  slope_.damping_nm_s_rad = damping;
  steepest_nm_ = here_nm;
}

void Continuous::tick(const Row& r) {
  if (!placed_) {
    placed_ = true;
    const double q = setting_.count_rad;
    // The core counts from where it was reset. An encoder's zero is anywhere: a count is taken for
    // the middle of its angles.
    zero_rad_ = std::floor(r.theta_rad / q) * q - r.position_rad + q / 2;
  }
  for (; next_ < changes_.size() && changes_[next_].at_s <= r.time_s; ++next_) {
    true_.set_parameter(changes_[next_].parameter, changes_[next_].si);
    sampled_.set_parameter(changes_[next_].parameter, changes_[next_].si);
  }
  if ((r.limits & static_cast<int>(limit::gates_closed)) != 0) {
    true_.reset();
    sampled_.reset();
    ticks_ = 0;
    return;
  }
  const double position_rad = r.theta_rad - zero_rad_;
  if (ticks_++ % setting_.every == 0) {
    if (setting_.slope) {
      if (runs_++ % look_every == 0) look(position_rad, r.omega_rad_s, r.tau_hat_nm);
      fill(r.position_rad, r.velocity_rad_s, r.tau_hat_nm);
      of_counts_nm_ = torque(sampled_);
    }
    fill(position_rad, r.omega_rad_s, r.tau_hat_nm);
    ideal_nm_ = torque(true_);
  }
  if ((r.limits & left_out) != 0) return;
  error_.add(r.tau_ref_nm - ideal_nm_);
  sum_nm_ += r.tau_ref_nm - ideal_nm_;
  largest_nm_ = std::max(largest_nm_, std::fabs(ideal_nm_));
  if (setting_.slope) floor_.add(of_counts_nm_ - ideal_nm_);
}

}  // namespace feltgate::rates
