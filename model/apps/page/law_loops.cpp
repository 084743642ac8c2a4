// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Documentation: docs/page.md
#include "apps/page/law_loops.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "feltgate/generated/gimbal_law.hpp"
#include "feltgate/generated/stylus_law.hpp"
#include "studies/shape/rhombus.hpp"

namespace feltgate::page {

using plant::Quaternion;
using plant::Vec3;
using shape::Point;

double Lever::within(double rad) const { return std::clamp(rad, -most_rad, most_rad); }

double Lever::hand_rate(double led, double hand, double dt) {
  if (drawn_rad_s == 0) return led;
  const double ahead = hand + drawn_rad_s * dt;
  // Only away from the middle, so that a hand from beyond the turn comes back.
  if (std::fabs(ahead) > turn_rad && ahead * drawn_rad_s > 0) drawn_rad_s = -drawn_rad_s;
  return drawn_rad_s;
}

void StickBody::note(const ImageLaw& law, double time_s) {
  for (const law::MachineEvent& e : law.events()) {
    for (const law::ImageEvent& named : law.event_names()) {
      if (named.number == e.number) told.push_back({named.name, named.scale * e.value, time_s});
    }
  }
}

void BowBody::note(const ImageLaw& law, double time_s) {
  heard.push_back(static_cast<float>(law.state(arrives)));
  for (const law::MachineEvent& e : law.events()) told.push_back({time_s, slip_s * e.value});
}

StringLoop::StringLoop(const std::string& image, const StateWord& heard)
    : LeverLoop(std::make_unique<ImageLaw>(image), BowBody(heard)) {
  const auto& events = law_->event_names();
  if (events.size() != 1 || events[0].name != "slip") {
    throw std::invalid_argument(fmt::format("law {} tells no slips", law_->name()));
  }
  if (heard.address < 0 || heard.address >= EngineMap::data_words) {
    throw std::invalid_argument(fmt::format("an engine has no data word {}", heard.address));
  }
  slip_s = events[0].scale;
}

void StringLoop::draw(double bow_m_s) {
  const double rad_s = std::isfinite(bow_m_s) ? std::fabs(bow_m_s) / law_->value("reach") : 0;
  if (rad_s == 0 && drawn_rad_s != 0) wanted_ = hand_;
  drawn_rad_s = std::copysign(rad_s, drawn_rad_s);
}

void CoupledBody::sense(ImageLaw& law, const Pair& rad, const Pair& rad_s) {
  period_s = law.period_s();
  for (std::size_t n = 0; n < 2; ++n) {
    law.joint(static_cast<int>(n), rad[n], rad_s[n], observed_nm[n]);
  }
}

Pair CoupledBody::acceleration(const Pair& held, const Pair& pushed, const Pair& rad, const Pair&) {
  met_nm = met == Met::spring   ? -strength * rad[1]
           : met == Met::wall   ? -strength * std::max(rad[1] - CoupledLoop::wall_rad, 0.0)
           : met == Met::weight ? -strength
                                : 0;
  Pair given = pushed + Pair{{0, met_nm}}, inertia{{inertia_kg_m2, inertia_kg_m2}};
  given[lever] += held[lever];
  inertia[lever] += grip.mass_kg;
  const Pair rad_s2{{given[0] / inertia[0], given[1] / inertia[1]}};
  // The motor's torque less what the lever's own inertia takes: what it gives to the world.
  observed_nm = observed_nm + std::min(1.0, period_s / CoupledLoop::observer_s) *
                                  (pushed - inertia_kg_m2 * rad_s2 - observed_nm);
  return rad_s2;
}

void CoupledLoop::hold(int n) {
  if (n != 0 && n != 1) throw std::invalid_argument("there are levers 0 and 1");
  if (n == held()) return;
  lever = static_cast<std::size_t>(n);
  hand_ = wanted_ = at_;
}

void CoupledLoop::meet(Met what, double how_strong) {
  if (!(how_strong >= 0)) throw std::invalid_argument("what is met has a strength of 0 or more");
  met = what;
  strength = how_strong;
}

void CoupledLoop::lead(double theta_rad) {
  if (std::isfinite(theta_rad)) wanted_[lever] = std::clamp(theta_rad, -most_rad, most_rad);
}

Point Pen::within(Point p) {
  p.y = std::max(p.y, PenLoop::front_m);
  const double r = std::hypot(p.x, p.y), most_m = PenLoop::farthest_m;
  p = p * (std::clamp(r, PenLoop::nearest_m, most_m) / r);
  if (p.y >= PenLoop::front_m) return p;
  // Drawn in from far beside the motors.
  const double front_m = PenLoop::front_m;
  return {std::copysign(std::sqrt(most_m * most_m - front_m * front_m), p.x), front_m};
}

void Pen::stop(Point& at, Point& speed) {
  const Point inside = within(at);
  if (std::hypot(at.x - inside.x, at.y - inside.y) > 1e-12) speed = {};
  at = inside;
}

void Pen::sense(ImageLaw& law, Point at, Point speed) {
  const auto angle = shape::cranks(at), rate = shape::crank_speeds(at, speed);
  for (std::size_t n = 0; n < 2; ++n) law.joint(static_cast<int>(n), angle[n], rate[n]);
}

Point Pen::force(const ImageLaw& law, Point at) {
  return shape::force_at(at, {law.torque_nm(0), law.torque_nm(1)});
}

StylusSlides slides_of(const plant::Parameters& slide) {
  const double r = slide.lever.radius_m;
  return {slide.lever.inertia_kg_m2 / (r * r), slide.lever.viscous_nm_s_rad / (r * r), r};
}

DesignInfo stylus_design() { return design_info<StylusLaw>(); }
DesignInfo gimbal_design() { return design_info<GimbalLaw>(); }

namespace {

Vec3 limited_to(double most, Vec3 v) {
  return {std::clamp(v.x, -most, most), std::clamp(v.y, -most, most), std::clamp(v.z, -most, most)};
}

}  // namespace

Vec3 StylusBody::within(const Vec3& p) { return limited_to(StylusLoop::reach_m, p); }

void StylusBody::stop(Vec3& at, Vec3& speed) {
  const Vec3 inside = within(at);
  if (at.x != inside.x) speed.x = 0;
  if (at.y != inside.y) speed.y = 0;
  if (at.z != inside.z) speed.z = 0;
  at = inside;
}

void StylusBody::sense(ImageLaw& law, const Vec3& at, const Vec3& speed) {
  const double r = slides.capstan_m;
  law.joint(0, at.x / r, speed.x / r);
  law.joint(1, at.y / r, speed.y / r);
  law.joint(2, at.z / r, speed.z / r);
  if (host && host_runs >= host->next()) {
    // The host knows the pen where the cores count it.
    const Vec3 counted{law.counted_rad(0), law.counted_rad(1), law.counted_rad(2)};
    auto words = host->act(host_runs, r * counted);
    // The same plane once more changes nothing, and costs as much as a run of the law.
    if (!words.empty() && words != sent) {
      law.set(words);
      sent = std::move(words);
    }
  }
  ++host_runs;
}

Vec3 StylusBody::force(const ImageLaw& law, const Vec3&) {
  const double r = slides.capstan_m;
  const Vec3 asked{law.torque_nm(0) / r, law.torque_nm(1) / r, law.torque_nm(2) / r};
  const Vec3 given = limited_to(StylusLoop::most_n, asked);
  limited = given.x != asked.x || given.y != asked.y || given.z != asked.z;
  return given;
}

void StylusLoop::touch(const PlaneHostSettings& world) {
  world_ = world;
  host.emplace(world, std::llround(1 / law_->period_s()));
  host_runs = 0;
}

double StylusLoop::depth_m() const {
  if (!host) return 0;
  const Plane p = nearest_plane(world_, at_);
  return plant::dot(p.normal, p.point_m - at_);
}

double StylusLoop::steady_hollow_m() const {
  const double force_n = plant::length(force_);
  if (!host || !(force_n > 0) || !(world_.stiffness_n_m > 0)) return 0;
  // m s^2 + b s + k + F / (R + d) e^(-s age) = 0 at s = i w: what is left of the first two terms
  // grows with w until age w = pi.
  constexpr double half_turn = 3.141592653589793;
  const double age_s =
      world_.latency_s + 0.5 * (world_.jitter_s + 1 / world_.rate_hz + law_->period_s());
  const double mass_kg = grip.mass_kg + slides.mass_kg;
  const double damping_ns_m = grip.damping_ns_m + slides.friction_ns_m;
  double low = 0, high = half_turn / age_s;
  for (int half = 0; half < 60; ++half) {
    const double w = 0.5 * (low + high);
    const bool over = mass_kg * w * w - grip.stiffness_n_m > damping_ns_m * w / std::tan(w * age_s);
    (over ? high : low) = w;
  }
  const double spring_n_m = damping_ns_m * low / std::sin(low * age_s);
  return std::max(0.0, force_n / spring_n_m - force_n / world_.stiffness_n_m);
}

double StylusLoop::seen(std::size_t column) const {
  if (!host) return 0;
  // As the rows of a native run have it: normal, tilt, age, step. A copy, because add() notes what
  // it told.
  PlaneHost told = *host;
  std::vector<double> row;
  told.add(host_runs, at_, row);
  return row[column];
}

Quaternion HandleBody::moved(const Quaternion& q, const Vec3& rad) {
  const double angle = plant::length(rad);
  if (angle == 0) return q;
  const Quaternion next = Quaternion::about(1 / angle * rad, angle) * q;
  const double size = std::hypot(next.w, plant::length(next.vector()));
  return {next.w / size, next.x / size, next.y / size, next.z / size};
}

void HandleBody::sense(ImageLaw& law, const Quaternion& at, const Vec3& speed) {
  if (runs-- <= 0) {
    runs = runs_per_host - 1;
    law.set({{"ow", at.w}, {"ox", at.x}, {"oy", at.y}, {"oz", at.z}});
  }
  // The law reads how fast the axes turn, and no angle.
  law.joint(0, 0, speed.x);
  law.joint(1, 0, speed.y);
  law.joint(2, 0, speed.z);
}

GimbalLoop::GimbalLoop(const std::string& image, const BodyWords& body)
    : LawLoop(std::make_unique<ImageLaw>(image, gimbal_design())), body_(body) {
  runs_per_host = static_cast<int>(std::lround(1 / (host_hz * law_->period_s())));
}

Quaternion GimbalLoop::body() const {
  return {law_->state(body_[0]), law_->state(body_[1]), law_->state(body_[2]),
          law_->state(body_[3])};
}

double GimbalLoop::twist_rad() const {
  return 2 * std::acos(std::min(1.0, std::abs((body() * at_.inverse()).w)));
}

}  // namespace feltgate::page
