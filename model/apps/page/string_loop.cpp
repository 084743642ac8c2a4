// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/page.md
#include "apps/page/string_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace feltgate::page {

StringLoop::StringLoop(const std::string& image_text, const StateWord& heard)
    : law_(image_text), heard_(heard) {
  const auto& events = law_.event_names();
  if (events.size() != 1 || events[0].name != "slip") {
    throw std::invalid_argument(fmt::format("law {} tells no slips", law_.name()));
  }
  if (heard.address < 0 || heard.address >= EngineMap::data_words) {
    throw std::invalid_argument(fmt::format("an engine has no data word {}", heard.address));
  }
  slip_s_ = events[0].scale;
}

void StringLoop::lead(double theta_rad) {
  if (std::isfinite(theta_rad)) wanted_rad_ = std::clamp(theta_rad, -farthest_rad, farthest_rad);
}

void StringLoop::draw(double bow_m_s) {
  const double rad_s = std::isfinite(bow_m_s) ? std::fabs(bow_m_s) / law_.value("reach") : 0;
  if (rad_s == 0 && drawn_rad_s_ != 0) wanted_rad_ = hand_rad_;
  drawn_rad_s_ = std::copysign(rad_s, drawn_rad_s_);
}

void StringLoop::advance(double seconds) {
  slips_.clear();
  heard_m_s_.clear();
  const double dt = law_.period_s();
  const int runs = pace_.runs(seconds, dt);
  if (runs < 1) return;
  const double led = (wanted_rad_ - hand_rad_) / (runs * dt);
  mean_nm_ = 0;
  for (int i = 0; i < runs; ++i) {
    step(dt, hand_rad_s(led, dt));
    mean_nm_ += torque_nm_ / runs;
  }
  if (drawn_rad_s_ == 0) hand_rad_ = wanted_rad_;
}

double StringLoop::hand_rad_s(double led_rad_s, double dt_s) {
  if (drawn_rad_s_ == 0) return led_rad_s;
  const double ahead = hand_rad_ + drawn_rad_s_ * dt_s;
  // Only away from the middle, so that a hand from beyond the turn comes back.
  if (std::fabs(ahead) > turn_rad && ahead * drawn_rad_s_ > 0) drawn_rad_s_ = -drawn_rad_s_;
  return drawn_rad_s_;
}

void StringLoop::step(double dt, double hand_rad_s) {
  law_.joint(0, theta_rad_, speed_rad_s_);
  law_.run();
  torque_nm_ = law_.torque_nm(0);
  heard_m_s_.push_back(static_cast<float>(law_.state(heard_)));
  for (const law::MachineEvent& e : law_.events()) slips_.push_back({time_s_, slip_s_ * e.value});
  hand_rad_ += hand_rad_s * dt;
  const double held_nm = hand_.torque_nm(hand_rad_, hand_rad_s, theta_rad_, speed_rad_s_);
  speed_rad_s_ += (held_nm + torque_nm_) * dt / hand_.inertia_kg_m2();
  theta_rad_ += speed_rad_s_ * dt;
  time_s_ += dt;
}

}  // namespace feltgate::page
