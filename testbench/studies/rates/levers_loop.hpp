// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two free levers coupled position to position, as a matrix from one period of the PWM to the next:
// they move against each other, so one of them is enough. docs/devices/pantograph.md
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/plant/parameters.hpp"
#include "studies/stability/linear_loop.hpp"

namespace feltgate::test {

struct LeversLoop {
  double stiffness_nm_rad = 4.0, damping_nm_s_rad = 0.005;

  static constexpr double step_s = 10e-6;
  static constexpr int steps = 2;    ///< of a period of the PWM
  static constexpr int window = 77;  ///< steps of the N-method's window, 767 us
  static constexpr double cutoff_rad_s = 500.0;
  static constexpr int size = 5 + window;

  /// Growth of a swing by itself, 1/s; below 0 it dies. Without friction.
  double growth_1_s(const plant::Parameters& p) const {
    Eigen::MatrixXd m(size, size);
    for (int k = 0; k < size; ++k) {
      State s{};
      s[static_cast<std::size_t>(k)] = 1.0;
      period(s, p);
      for (int row = 0; row < size; ++row) m(row, k) = s[static_cast<std::size_t>(row)];
    }
    return std::log(stability::eigenvalues(m).cwiseAbs().maxCoeff()) / (steps * step_s);
  }

  /// The largest stiffness that is quiet with this damping, Nm/rad.
  double border_nm_rad(const plant::Parameters& p) const {
    double low = stiffness_nm_rad, high = 32.0;
    for (int k = 0; k < 30; ++k) {
      LeversLoop between = *this;
      between.stiffness_nm_rad = 0.5 * (low + high);
      (between.growth_1_s(p) < 0 ? low : high) = between.stiffness_nm_rad;
    }
    return 0.5 * (low + high);
  }

 private:
  /// Angle, speed, current, estimated speed, voltage, the window's angles with the oldest first.
  using State = std::array<double, size>;

  void period(State& s, const plant::Parameters& p) const {
    double &angle = s[0], &speed = s[1], &current = s[2], &estimate = s[3], &voltage = s[4];
    const double kt = p.motor.torque_constant_nm_a, ke = p.motor.back_emf_constant_v_s_rad;
    const double r = p.motor.resistance_ohm;
    const double decay = std::exp(-r / p.motor.inductance_h * step_s);
    for (int k = 0; k < steps; ++k) {
      const double raw = (angle - s[5]) / (window * step_s);
      std::rotate(s.begin() + 5, s.begin() + 6, s.end());
      s.back() = angle;
      estimate += (1 - std::exp(-cutoff_rad_s * step_s)) * (raw - estimate);
      // The other lever stands at the same angle on the other side.
      if (k == 0) {
        const double pull = 2 * (stiffness_nm_rad * angle + damping_nm_s_rad * estimate);
        voltage = -r * pull / kt + ke * estimate;
      }
      const double settled = (voltage - ke * speed) / r, before = current;
      current = settled + (current - settled) * decay;
      const double change = step_s * 0.5 * (before + current) * kt / p.lever.inertia_kg_m2;
      angle += step_s * (speed + 0.5 * change);
      speed += change;
    }
  }
};

}  // namespace feltgate::test
