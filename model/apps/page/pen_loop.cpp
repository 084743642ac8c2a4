// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/page.md
#include "apps/page/pen_loop.hpp"

#include <algorithm>
#include <cmath>

namespace feltgate::page {

using shape::Point;

PenLoop::PenLoop(const std::string& image_text) {
  load(image_text);
  place({0, 0.06});
}

void PenLoop::load(const std::string& image_text) { law_ = std::make_unique<ImageLaw>(image_text); }

void PenLoop::place(Point at) {
  pen_m_ = hand_m_ = wanted_m_ = within_reach(at);
  velocity_m_s_ = force_n_ = {};
}

Point PenLoop::within_reach(Point p) {
  p.y = std::max(p.y, front_m);
  const double r = std::hypot(p.x, p.y);
  p = p * (std::clamp(r, nearest_m, farthest_m) / r);
  if (p.y >= front_m) return p;
  // Drawn in from far beside the motors.
  return {std::copysign(std::sqrt(farthest_m * farthest_m - front_m * front_m), p.x), front_m};
}

void PenLoop::lead(Point to) {
  if (std::isfinite(to.x) && std::isfinite(to.y)) wanted_m_ = within_reach(to);
}

void PenLoop::advance(double seconds) {
  const double dt = law_->period_s();
  const int runs = pace_.runs(seconds, dt);
  if (runs < 1) return;
  const Point rate = (wanted_m_ - hand_m_) * (1 / (runs * dt));
  for (int i = 0; i < runs; ++i) step(dt, rate);
  hand_m_ = wanted_m_;
}

void PenLoop::step(double dt, Point hand_m_s) {
  const auto angle = shape::cranks(pen_m_);
  const auto speed = shape::crank_speeds(pen_m_, velocity_m_s_);
  for (int n = 0; n < 2; ++n) {
    law_->joint(n, angle[static_cast<std::size_t>(n)], speed[static_cast<std::size_t>(n)]);
  }
  law_->run();
  force_n_ = shape::force_at(pen_m_, {law_->torque_nm(0), law_->torque_nm(1)});
  hand_m_ = hand_m_ + hand_m_s * dt;
  const Point held =
      (hand_m_ - pen_m_) * hand_.stiffness_n_m + (hand_m_s - velocity_m_s_) * hand_.damping_ns_m;
  velocity_m_s_ = velocity_m_s_ + (held + force_n_) * (dt / hand_.mass_kg);
  const Point next = pen_m_ + velocity_m_s_ * dt;
  pen_m_ = within_reach(next);
  // At the edge of the reach the pen loses its speed.
  if (std::hypot(next.x - pen_m_.x, next.y - pen_m_.y) > 1e-12) velocity_m_s_ = {};
  time_s_ += dt;
}

}  // namespace feltgate::page
