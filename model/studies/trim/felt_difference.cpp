// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Computes the quantities that a hand feels in a run. Documentation: docs/trim.md
#include "studies/trim/felt_difference.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>

#include "feltgate/largest.hpp"
#include "sim/plant/plant.hpp"

namespace feltgate::trim {

namespace {

// Below these values a relative error has no meaning.
constexpr double least_torque_nm = 1e-3, least_position_rad = 1.534e-3, least_force_n = 1e-2;

double thread_cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Means of a signal, one per window, each weighted by a triangle of two windows around it.
class Means {
 public:
  explicit Means(Clock window) : window_(static_cast<double>(window)) {}
  /// `value` held over the `clocks` after those before.
  void add(Clock clocks, double value) {
    const double length = static_cast<double>(clocks);
    const double at = (static_cast<double>(now_) + 0.5 * length) / window_;
    const auto left = static_cast<std::size_t>(at);
    if (means.size() < left + 2) means.resize(left + 2, 0.0);
    const double share = value * length / window_;
    const double right = at - static_cast<double>(left);
    means[left] += share * (1 - right);
    means[left + 1] += share * right;
    now_ += clocks;
  }
  /// The first and the last mean have half a triangle.
  std::vector<double> means;

 private:
  double window_;
  Clock now_ = 0;
};

Loss loss(const std::vector<double>& reference, const std::vector<double>& other, double least) {
  const std::size_t n = std::min(reference.size(), other.size());
  double peak = least, worst = 0, squares = 0, error_squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double error = other[i] - reference[i];
    peak = larger(peak, std::abs(reference[i]));
    worst = larger(worst, std::abs(error));
    squares += reference[i] * reference[i];
    error_squares += error * error;
  }
  const double count = static_cast<double>(std::max<std::size_t>(n, 1));
  return {worst / peak,
          std::sqrt(error_squares / count) / std::max(least, std::sqrt(squares / count))};
}

}  // namespace

Felt feel(const Scenario& scene, const plant::Parameters& plant, const std::string& design,
          const Model& model, double window_s) {
  Scenario s = scene;
  s.effects = model.effects;
  s.switched = model.gates;
  s.step_clocks = model.step_clocks;
  s.step_given = true;
  const Clock window = std::llround(window_s * static_cast<double>(design_named(design).clock_hz));
  Means torque(window), position(window), force(window);
  const double start_rad = s.hand.initial_rad();
  RunOptions options;
  options.design = design;
  options.engine = "twin";
  options.plant_step = [&](Clock clocks, const plant::Observables& o) {
    torque.add(clocks, o.motor_torque_mean_nm);
    position.add(clocks, o.theta_rad - start_rad);
    force.add(clocks, o.hand_force_n);
  };
  const double begin = thread_cpu_s();
  const RunResult run = run_scenario(s, plant, options);
  Felt felt;
  felt.cpu_s = thread_cpu_s() - begin;
  felt.torque_nm = std::move(torque.means);
  felt.position_rad = std::move(position.means);
  felt.force_n = std::move(force.means);
  felt.simulated_s = run.simulated_s;
  felt.states = run.plant_states;
  felt.evaluations = run.evaluations;
  felt.broken = run.broken;
  return felt;
}

double Difference::worst() const {
  return std::max({torque.peak, torque.rms, position.peak, position.rms, force.peak, force.rms});
}

Difference compare(const Felt& reference, const Felt& other) {
  return {loss(reference.torque_nm, other.torque_nm, least_torque_nm),
          loss(reference.position_rad, other.position_rad, least_position_rad),
          loss(reference.force_n, other.force_n, least_force_n)};
}

}  // namespace feltgate::trim
