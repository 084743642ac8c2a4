// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The loop of a pen on a floor as a matrix: one run of pantograph_filtered.law to the next, linear
// around a pen that is pressed in. Equations: docs/devices/pantograph.md
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/plant/pantograph/linkage_mechanics.hpp"
#include "sim/plant/pantograph/pantograph.hpp"
#include "studies/stability/linear_loop.hpp"

namespace feltgate::test {

struct WallLoop {
  double stiffness_n_m = 50.0, damping_ns_m = 0.0;
  bool filtered = true;
  double height_m = 0.1;  ///< where the pen rests

  // The law: one run a millisecond, its torque there two steps of the PWM later at most.
  static constexpr double run_s = 1e-3;
  static constexpr int steps = 100;  ///< of the plant in a run
  static constexpr double step_s = run_s / steps;
  static constexpr int window = 77;  ///< steps of the N-method's window, 767 us
  static constexpr double cutoff_rad_s = 500.0;

  /// What grows or dies by itself: at most the largest of its eigenvalues a run.
  struct State {
    double y = 0, v = 0, current = 0, speed_estimate = 0;
    std::array<double, window> angles{};  ///< oldest first
    double before = 0, speed = 0, force = 0, asked = 0, voltage = 0;
  };
  static constexpr int size = 4 + window + 5;

  /// Growth of an oscillation by itself, 1/s; below 0 it dies.
  double growth_1_s(const plant::PantographParameters& p, double joint_viscous_nm_s_rad) const {
    Eigen::MatrixXd m(size, size);
    for (int k = 0; k < size; ++k) {
      Eigen::VectorXd unit = Eigen::VectorXd::Zero(size);
      unit(k) = 1.0;
      m.col(k) = packed(run(unpacked(unit), p, joint_viscous_nm_s_rad));
    }
    return std::log(stability::eigenvalues(m).cwiseAbs().maxCoeff()) / run_s;
  }

  /// Joint's viscous friction at which it neither grows nor dies, Nm s/rad.
  double border_nm_s_rad(const plant::PantographParameters& p) const {
    double low = 0.0, high = 0.05;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      (growth_1_s(p, middle) > 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  /// Turn of a crank per way of the pen along y, rad/m; both cranks, opposite ways.
  double turn_rad_m(const plant::PantographParameters& p) const {
    const double l = p.linkage.crank_1_m, s = height_m / (2 * l);
    return 1.0 / (2 * l * std::sqrt(1 - s * s));
  }
  /// Mass of what moves, felt along y, kg.
  double mass_kg(const plant::PantographParameters& p) const {
    const plant::LinkageDynamics dynamics(p.linkage, p.bodies);
    const double first = std::asin(height_m / (2 * p.linkage.crank_1_m));
    const plant::JointMatrix m =
        dynamics.mass(dynamics.linkage().pose({first, 3.14159265358979323846 - first}));
    const double g = turn_rad_m(p);
    return g * g * (m.m11 - 2 * m.m15 + m.m55);
  }

 private:
  static State unpacked(const Eigen::VectorXd& x) {
    State s;
    s.y = x(0), s.v = x(1), s.current = x(2), s.speed_estimate = x(3);
    for (int k = 0; k < window; ++k) s.angles[static_cast<std::size_t>(k)] = x(4 + k);
    const int n = 4 + window;
    s.before = x(n), s.speed = x(n + 1), s.force = x(n + 2), s.asked = x(n + 3);
    s.voltage = x(n + 4);
    return s;
  }
  static Eigen::VectorXd packed(const State& s) {
    Eigen::VectorXd x(size);
    x(0) = s.y, x(1) = s.v, x(2) = s.current, x(3) = s.speed_estimate;
    for (int k = 0; k < window; ++k) x(4 + k) = s.angles[static_cast<std::size_t>(k)];
    const int n = 4 + window;
    x(n) = s.before, x(n + 1) = s.speed, x(n + 2) = s.force, x(n + 3) = s.asked;
    x(n + 4) = s.voltage;
    return x;
  }

  State run(State s, const plant::PantographParameters& p, double joint_viscous) const {
    const double ratio = p.joint.ratio(), g = turn_rad_m(p), mass = mass_kg(p);
    const double kt = ratio * p.motor.torque_constant_nm_a;
    const double ke = ratio * p.motor.back_emf_constant_v_s_rad;
    const double friction = 2 * g * g * joint_viscous;
    // Torque of a crank per force at the pen, and the other way: power is 2 * torque * turn.
    const double nm_n = 1.0 / (2 * g);
    const double asked = law(s);
    const double decay = std::exp(-p.motor.resistance_ohm / p.motor.inductance_h * step_s);
    for (int k = 0; k < steps; ++k) {
      if (k == 1) s.asked = asked;
      const double angle = g * s.y;
      const double raw = (angle - s.angles.front()) / (window * step_s);
      std::rotate(s.angles.begin(), s.angles.begin() + 1, s.angles.end());
      s.angles.back() = angle;
      s.speed_estimate += (1 - std::exp(-cutoff_rad_s * step_s)) * (raw - s.speed_estimate);
      if (k % 2 == 0) {  // a period of the PWM
        s.voltage = p.motor.resistance_ohm * nm_n * s.asked / kt + ke * s.speed_estimate;
      }
      const double settled = (s.voltage - ke * g * s.v) / p.motor.resistance_ohm;
      const double before = s.current;
      s.current = settled + (s.current - settled) * decay;
      const double force = 0.5 * (before + s.current) * kt / nm_n;
      // Middle of the step: second order.
      const double middle = s.v + 0.5 * step_s * (force - friction * s.v) / mass;
      s.v += step_s * (force - friction * middle) / mass;
      s.y += step_s * middle;
    }
    return s;
  }

  /// pantograph_filtered.law around a depth that is never left.
  double law(State& s) const {
    const double raw = (s.y - s.before) / run_s;
    s.before = s.y;
    s.speed = 0.95 * s.speed + 0.05 * raw;
    const double push = -stiffness_n_m * s.y - damping_ns_m * (filtered ? s.speed : raw);
    s.force = 0.7 * s.force + 0.3 * push;
    return filtered ? s.force : push;
  }
};

}  // namespace feltgate::test
