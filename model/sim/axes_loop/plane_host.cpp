// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A host that knows a world. Documentation: docs/devices/pantograph.md
#include "sim/axes_loop/plane_host.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "files/toml/toml_reader.hpp"

namespace feltgate {

using plant::Vec3;
using World = PlaneHostSettings::World;

namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

/// Adds one word for each axis.
void add_words(std::map<std::string, double>& words, const std::string& name, Vec3 v, int axes) {
  const double parts[] = {v.x, v.y, v.z};
  for (int n = 0; n < axes; ++n) words[name + "_" + kAxes[n]] = parts[n];
}

struct WorldKey {
  const char* key;
  int axes;  ///< number of axes; 0: two or three
  World world;
  const char* form;
};
constexpr WorldKey kWorlds[] = {{"floor_m", 0, World::kFloor, "[height]"},
                                {"circle_m", 2, World::kDisc, "[x, y, radius]"},
                                {"sphere_m", 3, World::kSphere, "[x, y, z, radius]"},
                                {"cube_m", 3, World::kCube, "[x, y, z, half an edge]"}};

void read_world(config::TomlReader& r, PlaneHostSettings& s) {
  std::string forms;
  const WorldKey* found = nullptr;
  for (const WorldKey& k : kWorlds) {
    if (k.axes != 0 && k.axes != s.axes) continue;
    forms += fmt::format("{}{} = {}", forms.empty() ? "" : ", or ", k.key, k.form);
    if (found == nullptr && r.has(k.key)) found = &k;
  }
  if (found == nullptr) r.fail("rate_hz", "no world in [plane]", "write " + forms);
  const std::vector<double> at = r.numbers(found->key, {-0.25, 0.25});
  const bool floor = found->world == World::kFloor;
  const std::size_t wanted = floor ? 1 : static_cast<std::size_t>(s.axes) + 1;
  if (at.size() != wanted || (!floor && at.back() <= 0)) {
    r.fail(found->key, "not what a world is described by",
           "write " + forms + (floor ? "" : " with a radius above 0"));
  }
  s.world = found->world;
  if (floor) {
    s.centre_m = s.axes == 2 ? Vec3{0, at[0], 0} : Vec3{0, 0, at[0]};
    return;
  }
  s.centre_m = {at[0], at[1], s.axes == 2 ? 0 : at[2]};
  s.radius_m = at.back();
}

/// The two outermost faces of a cube, as one of its edges.
Plane edge_of_cube(Vec3 from, double half_m) {
  const double at[] = {from.x, from.y, from.z};
  Vec3 out[] = {{at[0] < 0 ? -1.0 : 1.0, 0, 0},
                {0, at[1] < 0 ? -1.0 : 1.0, 0},
                {0, 0, at[2] < 0 ? -1.0 : 1.0}};
  std::sort(out, out + 3,
            [&](Vec3 a, Vec3 b) { return plant::dot(a, from) > plant::dot(b, from); });
  return {half_m * out[0], out[0], half_m * out[1], out[1], true};
}

/// The nearest face of a cube or, from outside, its nearest edge or corner; `from` is relative to
/// the cube's centre.
Plane nearest_of_cube(Vec3 from, double half_m) {
  const double at[] = {from.x, from.y, from.z};
  double point[3], far_m = 0;
  std::size_t outmost = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    point[n] = std::clamp(at[n], -half_m, half_m);
    far_m += (at[n] - point[n]) * (at[n] - point[n]);
    if (std::abs(at[n]) > std::abs(at[outmost])) outmost = n;
  }
  if (far_m > 0) {
    const Vec3 on{point[0], point[1], point[2]};
    return {on, 1 / std::sqrt(far_m) * (from - on)};
  }
  double normal[3] = {};
  normal[outmost] = at[outmost] < 0 ? -1 : 1;
  const Vec3 out{normal[0], normal[1], normal[2]};
  return {from + (half_m - std::abs(at[outmost])) * out, out};
}

}  // namespace

PlaneHostSettings read_plane_host(config::TomlReader r, int axes) {
  PlaneHostSettings s;
  s.axes = axes;
  s.line = r.line("rate_hz");
  if (r.has("sends")) s.sends_force = r.choice("sends", {"plane", "force"}) == 1;
  if (s.sends_force && axes != 2) {
    r.fail("sends", "a force is for two axes, by the law sent_force", "send the plane");
  }
  read_world(r, s);
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
  if (r.flag_or("edges", false)) {
    s.edges = true;
    if (s.world != World::kCube)
      r.fail("edges", "only a cube has edges", "write cube_m, or leave it out");
  }
  if (r.has("seed")) s.seed = static_cast<std::uint64_t>(r.integer("seed", 0, 1'000'000'000));
  r.finish();
  return s;
}

Plane nearest_plane(const PlaneHostSettings& world, Vec3 pen_m) {
  const Vec3 up = world.axes == 2 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  if (world.world == World::kFloor) return {world.centre_m, up};
  const Vec3 out = pen_m - world.centre_m;
  if (world.world == World::kCube) {
    Plane plane =
        world.edges ? edge_of_cube(out, world.radius_m) : nearest_of_cube(out, world.radius_m);
    for (Vec3* at : {&plane.point_m, &plane.second_point_m}) *at = *at + world.centre_m;
    return plane;
  }
  const double far = plant::length(out);
  // At the centre every direction is equally near.
  const Vec3 normal = far > 0 ? 1 / far * out : up;
  return {world.centre_m + world.radius_m * normal, normal};
}

std::map<std::string, double> plane_words(const PlaneHostSettings& world,
                                          const PlaneMaterial& material, const Plane& plane,
                                          Vec3 pen_m) {
  std::map<std::string, double> words;
  if (world.sends_force) {
    add_words(words, "force", spring_force(material, plane, pen_m), world.axes);
    return words;
  }
  words = {{"stiffness", material.stiffness_n_m},
           {"damping", material.damping_ns_m},
           {"friction", material.friction}};
  if (world.edges) {
    const double lean = plant::dot(plane.normal, plane.second);
    add_words(words, "second", plane.second, world.axes);
    words["height"] = plant::dot(plane.normal, plane.point_m);
    words["second_height"] = plant::dot(plane.second, plane.second_point_m);
    words["lean"] = lean;
    words["spread"] = plane.convex ? 0 : 1 / (1 - lean * lean);
  } else {
    add_words(words, "point", plane.point_m, world.axes);
  }
  add_words(words, "normal", plane.normal, world.axes);
  if (world.moves) add_words(words, "speed", plane.velocity_m_s, world.axes);
  if (world.vibrates) {
    words["vibration"] = material.vibration_n;
    words["frequency"] = material.frequency_hz;
  }
  return words;
}

std::map<std::string, double> plane_words(const PlaneHostSettings& world, Vec3 pen_m) {
  return plane_words(world, world, nearest_plane(world, pen_m), pen_m);
}

Vec3 spring_force(const PlaneMaterial& material, const Plane& plane, Vec3 pen_m) {
  const double deep = plant::dot(plane.normal, plane.point_m - pen_m);
  if (!plane.edge()) return material.stiffness_n_m * std::max(0.0, deep) * plane.normal;
  const double other = plant::dot(plane.second, plane.second_point_m - pen_m);
  double by = 0, by_other = 0;
  if (plane.convex) {
    // The shorter way out, rounded where both are as long.
    const double nearer = std::clamp((other - deep) / edge_round_m, -1.0, 1.0);
    const double rounding = 1 - std::abs(nearer);
    const double way =
        std::max(0.0, std::min(deep, other) - edge_round_m / 4 * rounding * rounding);
    by = (1 + nearer) / 2 * way;
    by_other = way - by;
  } else {
    // To the nearest point of the free room: on one of the planes, or where they meet.
    const double lean = plant::dot(plane.normal, plane.second), spread = 1 / (1 - lean * lean);
    by = spread * (deep - lean * other);
    by_other = spread * (other - lean * deep);
    if (by <= 0 || by_other <= 0) {
      const bool first = by_other <= 0;
      by = first ? std::max(0.0, deep) : 0;
      by_other = first ? 0 : std::max(0.0, other);
    }
  }
  return material.stiffness_n_m * (by * plane.normal + by_other * plane.second);
}

PlaneHost::PlaneHost(const PlaneHostSettings& settings, std::int64_t clock_hz)
    : settings_(settings), clock_hz_(static_cast<double>(clock_hz)), random_(settings.seed) {}

void PlaneHost::check(const PlaneHostSettings& settings, const std::string& path,
                      const SceneLaw& law) {
  for (const auto& [name, value] : plane_words(settings, {})) {
    if (law.is_mailbox(name)) continue;
    throw config::ConfigError(
        fmt::format("{}:{}: law {} has no mailbox \"{}\", which [plane] sends; take the law {}",
                    path, settings.line, law.name(), name,
                    settings.sends_force ? "sent_force"
                    : settings.edges     ? "local_edge"
                    : settings.vibrates  ? "local_vibration"
                    : settings.axes == 2 ? "local_plane"
                                         : "local_space"));
  }
}

Clock PlaneHost::clock_of(std::int64_t sample) const {
  return std::llround(static_cast<double>(sample) * clock_hz_ / settings_.rate_hz);
}

Clock PlaneHost::next() const {
  return under_way_.empty() ? next_sample_ : std::min(next_sample_, under_way_.front().at);
}

std::map<std::string, double> PlaneHost::act(Clock now, Vec3 counted_m) {
  if (now >= next_sample_) {
    const double late = settings_.latency_s + settings_.jitter_s * random_.uniform();
    // The first update is never lost: before it there is no world.
    const bool lost = random_.uniform() < settings_.lost && samples_ > 0;
    Update u{now, now + std::llround(late * clock_hz_), {}, settings_, counted_m};
    if (settings_.search) {
      std::tie(u.plane, u.material) = settings_.search(counted_m);
    } else {
      u.plane = nearest_plane(settings_, counted_m);
    }
    last_ = u.plane;
    // An update that would arrive before older ones replaces them.
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
    arriving = plane_words(settings_, now_->material, now_->plane, now_->pen_m);
  }
  return arriving;
}

std::vector<std::string> PlaneHost::names(int axes) {
  std::vector<std::string> all;
  for (int n = 0; n < axes; ++n) all.push_back(std::string("plane_normal_") + kAxes[n]);
  for (const char* name : {"plane_tilt_rad", "plane_age_s", "plane_step_n"}) all.push_back(name);
  return all;
}

void PlaneHost::add(Clock now, Vec3 pen_m, std::vector<double>& row) {
  if (!now_) {
    row.insert(row.end(), names(settings_.axes).size(), 0.0);
    return;
  }
  const Vec3 is = now_->plane.normal;
  const Vec3 should = (settings_.search ? last_ : nearest_plane(settings_, pen_m)).normal;
  double step_n = 0;
  if (before_) {
    const auto force = [&](const Update& u) {
      return spring_force(u.material, u.plane, settings_.sends_force ? u.pen_m : pen_m);
    };
    step_n = plant::length(force(*now_) - force(*before_));
    before_.reset();
  }
  const Vec3 turn = plant::cross(is, should);
  const bool space = settings_.axes == 3;
  row.insert(row.end(), {is.x, is.y});
  if (space) row.push_back(is.z);
  row.insert(row.end(), {std::atan2(space ? plant::length(turn) : turn.z, plant::dot(is, should)),
                         static_cast<double>(now - now_->sampled) / clock_hz_, step_n});
}

void PlaneHost::add_figures(std::map<std::string, double>& figures) const {
  figures["planes_arrived"] = static_cast<double>(arrived_);
  figures["planes_lost"] = static_cast<double>(lost_);
}

}  // namespace feltgate
