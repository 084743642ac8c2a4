// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A host with a world. Documentation: docs/devices/local_plane.md
#include "axes_loop/plane_host.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace feltgate {

using plant::Vec2;

PlaneHostSettings read_plane_host(config::TomlReader r) {
  PlaneHostSettings s;
  s.line = r.line("rate_hz");
  if (r.has("sends")) s.sends_force = r.choice("sends", {"plane", "force"}) == 1;
  const std::string shape = r.has("circle_m") ? "circle_m" : "floor_m";
  const std::vector<double> at = r.numbers(shape, {-0.25, 0.25});
  const std::size_t wanted = shape == "circle_m" ? 3 : 1;
  if (at.size() != wanted || (wanted == 3 && at[2] <= 0)) {
    r.fail(shape, "not what a world is described by",
           "write circle_m = [x, y, radius] with a radius above 0, or floor_m = [height]");
  }
  s.centre_m = wanted == 3 ? Vec2{at[0], at[1]} : Vec2{0, at[0]};
  s.radius_m = wanted == 3 ? at[2] : 0;
  s.stiffness_n_m = r.number("stiffness_n_m", {0, 1000});
  s.damping_ns_m = r.number_or("damping_ns_m", 0, {0, 2});
  s.friction = r.number_or("friction", 0, {0, 2});
  if (s.sends_force && (s.damping_ns_m > 0 || s.friction > 0)) {
    r.fail("sends", "a force of the spring alone",
           "leave damping_ns_m and friction out, or send the plane");
  }
  s.rate_hz = r.number("rate_hz", {10, 10e3});
  s.latency_s = r.number_or("latency_s", 0, {0, 0.1});
  s.jitter_s = r.number_or("jitter_s", 0, {0, 0.1});
  s.lost = r.number_or("lost", 0, {0, 0.9});
  if (r.has("seed")) s.seed = static_cast<std::uint64_t>(r.integer("seed", 0, 1'000'000'000));
  r.finish();
  return s;
}

Plane nearest_plane(const PlaneHostSettings& world, Vec2 pen_m) {
  if (world.radius_m <= 0) return {world.centre_m, {0, 1}};
  const Vec2 out = pen_m - world.centre_m;
  const double far = plant::length(out);
  // In the very centre every direction is as good.
  const Vec2 normal = far > 0 ? 1 / far * out : Vec2{0, 1};
  return {world.centre_m + world.radius_m * normal, normal};
}

Vec2 spring_force(const PlaneHostSettings& world, const Plane& plane, Vec2 pen_m) {
  const double depth = std::max(0.0, plant::dot(plane.normal, plane.point_m - pen_m));
  return world.stiffness_n_m * depth * plane.normal;
}

PlaneHost::PlaneHost(const PlaneHostSettings& settings, const plant::LinkageGeometry& linkage,
                     std::int64_t clock_hz)
    : settings_(settings),
      linkage_(linkage),
      clock_hz_(static_cast<double>(clock_hz)),
      random_(settings.seed) {}

void PlaneHost::check(const PlaneHostSettings& settings, const std::string& path,
                      const SceneLaw& law) {
  PlaneHostSettings any = settings;
  any.radius_m = 0;
  const PlaneHost host(any, {}, 1);
  for (const auto& [name, value] : host.words({})) {
    if (law.is_mailbox(name)) continue;
    throw config::ConfigError(fmt::format(
        "{}:{}: law {} has no mailbox \"{}\", which [plane] sends; take the law {}", path,
        settings.line, law.name(), name, settings.sends_force ? "sent_force" : "local_plane"));
  }
}

Clock PlaneHost::clock_of(std::int64_t sample) const {
  return std::llround(static_cast<double>(sample) * clock_hz_ / settings_.rate_hz);
}

Clock PlaneHost::next() const {
  return under_way_.empty() ? next_sample_ : std::min(next_sample_, under_way_.front().at);
}

std::map<std::string, double> PlaneHost::words(const Update& u) const {
  if (settings_.sends_force) {
    const Vec2 force = spring_force(settings_, u.plane, u.pen_m);
    return {{"force_x", force.x}, {"force_y", force.y}};
  }
  return {{"point_x", u.plane.point_m.x},         {"point_y", u.plane.point_m.y},
          {"normal_x", u.plane.normal.x},         {"normal_y", u.plane.normal.y},
          {"stiffness", settings_.stiffness_n_m}, {"damping", settings_.damping_ns_m},
          {"friction", settings_.friction}};
}

std::map<std::string, double> PlaneHost::act(Clock now, const plant::Joints& theta_rad) {
  if (now >= next_sample_) {
    const Vec2 pen = linkage_.pose(theta_rad).pen;
    const double late = settings_.latency_s + settings_.jitter_s * random_.uniform();
    // The first one always comes: before it there is no world.
    const bool lost = random_.uniform() < settings_.lost && samples_ > 0;
    Update u{now, now + std::llround(late * clock_hz_), nearest_plane(settings_, pen), pen};
    // One that would overtake those before it makes them worthless.
    while (!lost && !under_way_.empty() && under_way_.back().at >= u.at) under_way_.pop_back();
    lost_ += lost ? 1 : 0;
    if (!lost) under_way_.push_back(u);
    next_sample_ = clock_of(++samples_);
  }
  std::map<std::string, double> arriving;
  for (; !under_way_.empty() && under_way_.front().at <= now; under_way_.pop_front()) {
    if (!before_) before_ = now_;
    now_ = under_way_.front();
    ++arrived_;
    arriving = words(*now_);
  }
  return arriving;
}

std::vector<std::string> PlaneHost::names() {
  return {"plane_normal_x", "plane_normal_y", "plane_tilt_rad", "plane_age_s", "plane_step_n"};
}

void PlaneHost::add(Clock now, Vec2 pen_m, std::vector<double>& row) {
  if (!now_) {
    row.insert(row.end(), names().size(), 0.0);
    return;
  }
  const Vec2 is = now_->plane.normal, should = nearest_plane(settings_, pen_m).normal;
  double step_n = 0;
  if (before_) {
    const auto force = [&](const Update& u) {
      return spring_force(settings_, u.plane, settings_.sends_force ? u.pen_m : pen_m);
    };
    step_n = plant::length(force(*now_) - force(*before_));
    before_.reset();
  }
  row.insert(row.end(), {is.x, is.y, std::atan2(plant::cross(is, should), plant::dot(is, should)),
                         static_cast<double>(now - now_->sampled) / clock_hz_, step_n});
}

void PlaneHost::add_figures(std::map<std::string, double>& figures) const {
  figures["planes_arrived"] = static_cast<double>(arrived_);
  figures["planes_lost"] = static_cast<double>(lost_);
}

}  // namespace feltgate
