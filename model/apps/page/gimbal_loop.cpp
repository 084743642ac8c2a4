// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/page.md
#include "apps/page/gimbal_loop.hpp"

#include <algorithm>
#include <cmath>

#include "feltgate/generated/gimbal_law.hpp"

namespace feltgate::page {

using plant::Quaternion;
using plant::Vec3;

namespace {

/// `q`, turned by a vector about the axes of the base; of length 1.
Quaternion turned(const Quaternion& q, Vec3 rad) {
  const double angle = plant::length(rad);
  if (angle == 0) return q;
  const Quaternion next = Quaternion::about(1 / angle * rad, angle) * q;
  const double size = std::hypot(next.w, plant::length(next.vector()));
  return {next.w / size, next.x / size, next.y / size, next.z / size};
}

}  // namespace

DesignInfo gimbal_design() { return design_info<GimbalLaw>(); }

GimbalLoop::GimbalLoop(const std::string& image_text, const BodyWords& body)
    : law_(image_text, gimbal_design()),
      body_(body),
      runs_per_host_(static_cast<int>(std::lround(1 / (host_hz * law_.period_s())))) {}

void GimbalLoop::turn(Vec3 rad) {
  if (std::isfinite(plant::length(rad))) wanted_rad_ = wanted_rad_ + rad;
}

void GimbalLoop::advance(double seconds) {
  const double dt = law_.period_s();
  const int runs = pace_.runs(seconds, dt);
  if (runs < 1) return;
  const Vec3 rate = 1 / (runs * dt) * wanted_rad_;
  for (int n = 0; n < runs; ++n) step(dt, rate);
  wanted_rad_ = {};
}

void GimbalLoop::step(double dt, Vec3 hand_rad_s) {
  if (runs_-- <= 0) {
    runs_ = runs_per_host_ - 1;
    law_.set({{"ow", handle_.w}, {"ox", handle_.x}, {"oy", handle_.y}, {"oz", handle_.z}});
  }
  // The law reads how fast the axes turn, and no angle.
  law_.joint(0, 0, speed_rad_s_.x);
  law_.joint(1, 0, speed_rad_s_.y);
  law_.joint(2, 0, speed_rad_s_.z);
  law_.run();
  torque_nm_ = {law_.torque_nm(0), law_.torque_nm(1), law_.torque_nm(2)};
  constexpr double squared_m2 = LeverHand::radius_m * LeverHand::radius_m;
  const Vec3 spring =
      plant::coupling_nm(held_.impedance.stiffness_n_m * squared_m2, hand_, handle_);
  const Vec3 damper = held_.impedance.damping_ns_m * squared_m2 * (hand_rad_s - speed_rad_s_);
  speed_rad_s_ = speed_rad_s_ + dt / held_.inertia_kg_m2() * (spring + damper + torque_nm_);
  handle_ = turned(handle_, dt * speed_rad_s_);
  hand_ = turned(hand_, dt * hand_rad_s);
  time_s_ += dt;
}

Quaternion GimbalLoop::body() const {
  return {law_.state(body_[0]), law_.state(body_[1]), law_.state(body_[2]), law_.state(body_[3])};
}

double GimbalLoop::twist_rad() const {
  return 2 * std::acos(std::min(1.0, std::abs((body() * handle_.inverse()).w)));
}

}  // namespace feltgate::page
