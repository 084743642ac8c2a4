// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/page.md
#include "apps/page/stick_loop.hpp"

#include <algorithm>

namespace feltgate::page {

StickLoop::StickLoop(const std::string& image_text) : law_(image_text) {}

void StickLoop::lead(double theta_rad) {
  wanted_rad_ = std::clamp(theta_rad, lowest_rad, highest_rad);
}

void StickLoop::advance(double seconds) {
  events_.clear();
  const double dt = law_.period_s();
  const int runs = pace_.runs(seconds, dt);
  if (runs < 1) return;
  const double rate = (wanted_rad_ - hand_rad_) / (runs * dt);
  for (int i = 0; i < runs; ++i) step(dt, rate);
  hand_rad_ = wanted_rad_;
}

void StickLoop::step(double dt, double hand_rad_s) {
  law_.joint(0, theta_rad_, speed_rad_s_);
  law_.run();
  torque_nm_ = law_.torque_nm(0);
  for (const law::MachineEvent& e : law_.events()) {
    for (const law::ImageEvent& named : law_.event_names()) {
      if (named.number == e.number) {
        events_.push_back({named.name, named.scale * e.value, time_s_});
      }
    }
  }
  hand_rad_ += hand_rad_s * dt;
  const double held_nm = hand_.torque_nm(hand_rad_, hand_rad_s, theta_rad_, speed_rad_s_);
  speed_rad_s_ += (held_nm + torque_nm_) * dt / hand_.inertia_kg_m2();
  theta_rad_ += speed_rad_s_ * dt;
  time_s_ += dt;
}

}  // namespace feltgate::page
