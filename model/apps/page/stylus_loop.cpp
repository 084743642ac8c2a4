// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/page.md
#include "apps/page/stylus_loop.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "feltgate/generated/stylus_law.hpp"

namespace feltgate::page {

using plant::Vec3;

namespace {

Vec3 within_reach(Vec3 p) {
  const auto drawn = [](double m) {
    return std::clamp(m, -StylusLoop::reach_m, StylusLoop::reach_m);
  };
  return {drawn(p.x), drawn(p.y), drawn(p.z)};
}

}  // namespace

StylusSlides slides_of(const plant::Parameters& slide) {
  const double r = slide.lever.radius_m;
  return {slide.lever.inertia_kg_m2 / (r * r), slide.lever.viscous_nm_s_rad / (r * r), r};
}

DesignInfo stylus_design() { return design_info<StylusLaw>(); }

StylusLoop::StylusLoop(const std::string& image_text, const StylusSlides& slides)
    : law_(image_text, stylus_design()), slides_(slides) {
  place({0, 0, 0.05});
}

void StylusLoop::set(const std::string& parameter, double value) {
  law_.set(parameter, value);
  sent_.clear();
}

void StylusLoop::touch(const PlaneHostSettings& world) {
  world_ = world;
  host_.emplace(world, std::llround(1 / law_.period_s()));
  host_runs_ = 0;
}

void StylusLoop::place(Vec3 at) {
  pen_m_ = hand_m_ = wanted_m_ = within_reach(at);
  velocity_m_s_ = force_n_ = {};
}

void StylusLoop::lead(Vec3 to) {
  if (std::isfinite(to.x) && std::isfinite(to.y) && std::isfinite(to.z)) {
    wanted_m_ = within_reach(to);
  }
}

double StylusLoop::depth_m() const {
  if (!host_) return 0;
  const Plane p = nearest_plane(world_, pen_m_);
  return plant::dot(p.normal, p.point_m - pen_m_);
}

double StylusLoop::steady_hollow_m() const {
  const double force_n = plant::length(force_n_);
  if (!host_ || !(force_n > 0) || !(world_.stiffness_n_m > 0)) return 0;
  // m s^2 + b s + k + F / (R + d) e^(-s age) = 0 at s = i w: what is left of the first two terms
  // grows with w until age w = pi.
  constexpr double half_turn = 3.141592653589793;
  const double age_s =
      world_.latency_s + 0.5 * (world_.jitter_s + 1 / world_.rate_hz + law_.period_s());
  const double mass_kg = hand_.mass_kg + slides_.mass_kg;
  const double damping_ns_m = hand_.damping_ns_m + slides_.friction_ns_m;
  double low = 0, high = half_turn / age_s;
  for (int half = 0; half < 60; ++half) {
    const double w = 0.5 * (low + high);
    const bool over =
        mass_kg * w * w - hand_.stiffness_n_m > damping_ns_m * w / std::tan(w * age_s);
    (over ? high : low) = w;
  }
  const double spring_n_m = damping_ns_m * low / std::sin(low * age_s);
  return std::max(0.0, force_n / spring_n_m - force_n / world_.stiffness_n_m);
}

void StylusLoop::advance(double seconds) {
  const double dt = law_.period_s();
  const int runs = pace_.runs(seconds, dt);
  if (runs < 1) return;
  const Vec3 rate = 1 / (runs * dt) * (wanted_m_ - hand_m_);
  for (int i = 0; i < runs; ++i) step(dt, rate);
  hand_m_ = wanted_m_;
  look();
}

void StylusLoop::step(double dt, Vec3 hand_m_s) {
  const std::array<double, 3> at = {pen_m_.x, pen_m_.y, pen_m_.z};
  const std::array<double, 3> speed = {velocity_m_s_.x, velocity_m_s_.y, velocity_m_s_.z};
  for (std::size_t n = 0; n < 3; ++n) {
    law_.joint(static_cast<int>(n), at[n] / slides_.capstan_m, speed[n] / slides_.capstan_m);
  }
  if (host_ && host_runs_ >= host_->next()) {
    // The host knows the pen where the cores count it.
    const Vec3 counted{law_.counted_rad(0), law_.counted_rad(1), law_.counted_rad(2)};
    auto words = host_->act(host_runs_, slides_.capstan_m * counted);
    // The same plane once more changes nothing, and costs as much as a run of the law.
    if (!words.empty() && words != sent_) {
      law_.set(words);
      sent_ = std::move(words);
    }
  }
  ++host_runs_;
  law_.run();
  limited_ = false;
  const auto force = [&](int axis) {
    const double asked_n = law_.torque_nm(axis) / slides_.capstan_m;
    limited_ = limited_ || std::abs(asked_n) > most_n;
    return std::clamp(asked_n, -most_n, most_n);
  };
  force_n_ = {force(0), force(1), force(2)};
  hand_m_ = hand_m_ + dt * hand_m_s;
  const Vec3 held = hand_.stiffness_n_m * (hand_m_ - pen_m_) +
                    hand_.damping_ns_m * (hand_m_s - velocity_m_s_) -
                    slides_.friction_ns_m * velocity_m_s_;
  // The hand holds the pen fast: both move as one mass.
  velocity_m_s_ = velocity_m_s_ + dt / (hand_.mass_kg + slides_.mass_kg) * (held + force_n_);
  const Vec3 next = pen_m_ + dt * velocity_m_s_;
  pen_m_ = within_reach(next);
  // At an end of the reach the pen loses its speed along that axis.
  if (next.x != pen_m_.x) velocity_m_s_.x = 0;
  if (next.y != pen_m_.y) velocity_m_s_.y = 0;
  if (next.z != pen_m_.z) velocity_m_s_.z = 0;
  time_s_ += dt;
}

void StylusLoop::look() {
  tilt_rad_ = age_s_ = 0;
  if (!host_) return;
  // As the rows of a native run have it: normal, tilt, age, step.
  std::vector<double> row;
  host_->add(host_runs_, pen_m_, row);
  tilt_rad_ = row[3];
  age_s_ = row[4];
}

}  // namespace feltgate::page
