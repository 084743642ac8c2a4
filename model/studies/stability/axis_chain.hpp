// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The state of an axis of the core from tick to tick, without quantisation: estimator, observer,
// torque of a scene or a host, voltage. Derivation: docs/speed-for-accuracy.md
#pragma once

#include <Eigen/Core>
#include <vector>

#include "studies/stability/linear_loop.hpp"

namespace feltgate::stability {

/// Period and delay of a torque, which is held in between.
struct Renewal {
  int scene_ticks = 1;
  int delay_ticks = 0;  ///< from the samples to the first tick in which their torque acts
};

/// A tick calls, in this order: begin(), see() with the angle, ask() for a torque, drive().
struct AxisChain {
  double velocity = 0, observer = 0, reference = 0;
  double volts_new = 0, volts = 0;     ///< newest, and in force in this PWM period
  double torque = 0, torque_next = 0;  ///< of the host: in force, and under way
  std::vector<double> window;          ///< angles of the last m1 ticks, a ring
  std::size_t oldest = 0;

  static constexpr Eigen::Index scalars = 7;

  void begin(const LoopModel& m, const Renewal& r, long k) {
    if (k % m.pwm_ticks == 0) volts = volts_new;
    if (r.delay_ticks > 0 && (k - r.delay_ticks) % r.scene_ticks == 0) torque = torque_next;
  }
  void see(const LoopModel& m, double angle) {
    const double travel = angle - window[oldest];
    window[oldest] = angle;
    if (++oldest == window.size()) oldest = 0;
    velocity += m.velocity_a1 * (m.raw_rad_s_rad * travel - velocity);
    observer += m.observer_a1 * (m.torque_constant * reference + inertia(m) - observer);
  }
  /// The observer's torque, the law's tau_hat.
  double observed(const LoopModel& m) const { return observer - inertia(m); }
  void ask(const Renewal& r, long k, double asked) {
    if (k % r.scene_ticks != 0) return;
    torque_next = asked;
    if (r.delay_ticks == 0) torque = asked;
  }
  void drive(const LoopModel& m) {
    reference = m.torque_gain * torque + m.observer_gain * observed(m);
    volts_new = m.applied * (m.voltage_gain * reference + m.emf_constant * velocity);
  }

  /// From a vector of scalars + m1 numbers, and to one: the window with its oldest angle first.
  void unpack(const LoopModel& m, const double* v) {
    velocity = v[0];
    observer = v[1];
    reference = v[2];
    volts_new = v[3];
    volts = v[4];
    torque = v[5];
    torque_next = v[6];
    window.assign(v + scalars, v + scalars + m.m1);
    oldest = 0;
  }
  void pack(double* v) const {
    const double all[] = {velocity, observer, reference, volts_new, volts, torque, torque_next};
    for (const double x : all) *v++ = x;
    for (std::size_t i = 0; i < window.size(); ++i) *v++ = window[(oldest + i) % window.size()];
  }

 private:
  double inertia(const LoopModel& m) const { return m.inertia_gain * velocity; }
};

}  // namespace feltgate::stability
