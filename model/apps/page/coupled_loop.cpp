// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/page.md
#include "apps/page/coupled_loop.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace feltgate::page {

void CoupledLoop::hold(int lever) {
  if (lever != 0 && lever != 1) throw std::invalid_argument("there are levers 0 and 1");
  if (lever == held_) return;
  held_ = lever;
  hand_rad_ = wanted_rad_ = theta_rad(lever);
}

void CoupledLoop::meet(Met what, double strength) {
  if (!(strength >= 0)) throw std::invalid_argument("what is met has a strength of 0 or more");
  met_ = what;
  strength_ = strength;
}

void CoupledLoop::lead(double theta_rad) {
  wanted_rad_ = std::clamp(theta_rad, -most_rad, most_rad);
}

void CoupledLoop::advance(double seconds) {
  const double dt = law_.period_s();
  const int runs = pace_.runs(seconds, dt);
  if (runs < 1) return;
  const double rate = (wanted_rad_ - hand_rad_) / (runs * dt);
  for (int i = 0; i < runs; ++i) step(dt, rate);
  hand_rad_ = wanted_rad_;
}

double CoupledLoop::given_nm(double theta_rad) const {
  switch (met_) {
    case Met::nothing:
      break;
    case Met::spring:
      return -strength_ * theta_rad;
    case Met::wall:
      return -strength_ * std::max(theta_rad - wall_rad, 0.0);
    case Met::weight:
      return -strength_;
  }
  return 0;
}

void CoupledLoop::step(double dt, double hand_rad_s) {
  for (int n = 0; n < 2; ++n) {
    const Lever& lever = levers_[index(n)];
    law_.joint(n, lever.theta_rad, lever.speed_rad_s, lever.observed_nm);
  }
  law_.run();
  met_nm_ = given_nm(theta_rad(1));
  hand_rad_ += hand_rad_s * dt;
  for (int n = 0; n < 2; ++n) {
    Lever& lever = levers_[index(n)];
    lever.torque_nm = law_.torque_nm(n);
    double outside_nm = n == 1 ? met_nm_ : 0, inertia = inertia_kg_m2_;
    if (n == held_) {
      outside_nm += hand_.torque_nm(hand_rad_, hand_rad_s, lever.theta_rad, lever.speed_rad_s);
      inertia += hand_.inertia_kg_m2();
    }
    const double rad_s2 = (lever.torque_nm + outside_nm) / inertia;
    // The motor's torque less what the lever's own inertia takes: what it gives to the world.
    const double given = lever.torque_nm - inertia_kg_m2_ * rad_s2;
    lever.observed_nm += (given - lever.observed_nm) * std::min(1.0, dt / observer_s);
    lever.speed_rad_s += rad_s2 * dt;
    lever.theta_rad += lever.speed_rad_s * dt;
  }
  time_s_ += dt;
}

}  // namespace feltgate::page
