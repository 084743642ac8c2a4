// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Fewer faces of a mesh: what they keep, how far they are off, the step of the force at an edge,
// and how firm and rough a ball of them feels; a signed distance from a mesh beside the proxy; each
// against closed forms. docs/touch.md
#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "feltgate/random.hpp"
#include "touch_meshes.hpp"

namespace feltgate::test {
namespace {

using plant::length;
using touch::clean;
using touch::Mesh;

constexpr double degree = 3.14159265358979323846 / 180;

/// Two planes that fall to both sides of the line x = 0, z = 0; their normals differ by `turn_rad`.
Soup roof(double turn_rad) {
  const double fall = std::tan(turn_rad / 2);
  return grid(2, 1, [=](double u, double v) {
    const double x = 0.08 * (u - 0.5);
    return Vec3{x, 0.08 * (v - 0.5), -fall * std::abs(x)};
  });
}

TEST_CASE("touch: fewer faces of a torus are a torus, near by as the closed form says") {
  constexpr double ring_m = 0.03, tube_m = 0.01;
  const Mesh all = clean(torus(ring_m, tube_m, 60));
  CHECK(all.triangles.size() == 14400);
  const Mesh few = clean(touch::decimate(all, 1500));
  CHECK(few.triangles.size() <= 1500);
  CHECK(few.triangles.size() > 1300);
  REQUIRE(few.report.components.size() == 1);
  CHECK(few.report.components[0].genus() == 1);
  CHECK(few.report.border_edges == 0);
  // The distance from the smooth torus needs no mesh.
  const auto off_m = [&](const Mesh& mesh) {
    double most = 0;
    for (const auto& t : mesh.triangles) {
      const Vec3 at = (1.0 / 3) * (mesh.at[t[0]] + mesh.at[t[1]] + mesh.at[t[2]]);
      most = std::max(most, std::abs(std::hypot(std::hypot(at.x, at.y) - ring_m, at.z) - tube_m));
    }
    return most;
  };
  const double apart_m = touch::hausdorff_m(few, all);
  CHECK(apart_m > off_m(few) - off_m(all));
  CHECK(apart_m < 2 * off_m(few));
  CHECK(apart_m < 0.5e-3);
  // Around the tube a face turns by 6 degrees; of a tenth of the faces by three times that.
  CHECK(touch::jumps_of(all).largest_rad == Approx(full_turn / 60).epsilon(0.01));
  CHECK(touch::jumps_of(few).most_rad > 2 * full_turn / 60);
  CHECK(touch::jumps_of(few).most_rad < 6 * full_turn / 60);
}

TEST_CASE("touch: the distance of two meshes is that of a corner that moved, from both sides") {
  const Mesh flat = clean(sheet(0.06, 10));
  Soup dented = sheet(0.06, 10);
  dented.at[60].z -= 1.25e-3;  // its middle
  const Mesh dent = clean(dented);
  CHECK(std::abs(touch::hausdorff_m(flat, dent) - 1.25e-3) < 1e-9);
  CHECK(std::abs(touch::hausdorff_m(dent, flat) - 1.25e-3) < 1e-9);
  CHECK(touch::hausdorff_m(flat, flat) < 1e-15);
  // A part that one of them lacks counts too.
  CHECK(touch::hausdorff_m(clean(sheet(0.04, 4)), flat) > 0.013);
}

TEST_CASE("touch: a dent of few edges is told as the largest turn, not as that of most") {
  Soup dented = sheet(0.06, 40);
  dented.at[41 * 20 + 20].z -= 1e-3;
  const touch::Jumps jumps = touch::jumps_of(clean(dented));
  CHECK(jumps.largest_rad > 0.5);
  CHECK(jumps.most_rad < 1e-9);
}

TEST_CASE("touch: a flat sheet of two materials needs few faces, and no gap opens between them") {
  Soup two = sheet(0.06, 16);
  two.materials = {"left", "right"};
  two.parts.clear();
  for (const auto& t : two.triangles) {
    const double x = two.at[t[0]].x + two.at[t[1]].x + two.at[t[2]].x;
    two.parts.push_back(x < 0 ? 0 : 1);
  }
  const Mesh all = clean(two);
  const Mesh few = clean(touch::decimate(all, 200));
  CHECK(few.triangles.size() < all.triangles.size() / 2);
  CHECK(few.report.components.size() == 1);
  CHECK(few.report.components[0].border_loops == 1);
  CHECK(touch::hausdorff_m(few, all) < 1e-8);
  for (std::size_t n = 0; n < few.triangles.size(); ++n) {
    const auto& t = few.triangles[n];
    const double x = few.at[t[0]].x + few.at[t[1]].x + few.at[t[2]].x;
    CHECK((x < 0) == (few.parts[n] == 0));
  }
}

TEST_CASE("touch: over an edge the force steps by K d 2 sin(phi / 2)") {
  for (const double turn_rad : {5 * degree, 15 * degree, 30 * degree}) {
    const Mesh mesh = clean(roof(turn_rad));
    CHECK(std::abs(touch::jumps_of(mesh).largest_rad - turn_rad) < 1e-9);
    CHECK(std::abs(touch::jumps_of(mesh).most_rad - turn_rad) < 1e-9);
    touch::Proxy proxy(mesh, {});
    constexpr double depth_m = 2e-3;
    const auto pen = [&](double x) {
      return Vec3{x, 1e-3,
                  -std::tan(turn_rad / 2) * std::abs(x) - depth_m / std::cos(turn_rad / 2)};
    };
    proxy.begin(pen(-0.02) + Vec3{0, 0, 0.01});
    double step = 0, deep_m = 0;
    Vec3 before{};
    for (int n = 0; n <= 4000; ++n) {
      const touch::Touched t = proxy.move(pen(-0.02 + 1e-5 * n));
      REQUIRE(t.touching);
      const Vec3 force = t.depth_m * t.normal;  // of a spring of 1 N/m
      const double jumped = n > 0 ? plant::length(force - before) : 0;
      if (jumped > step) deep_m = std::max(t.depth_m, plant::length(before));
      step = std::max(step, jumped);
      before = force;
    }
    INFO(turn_rad / degree << " degrees: " << step << " N, at a depth of " << deep_m << " m");
    CHECK(std::abs(step / (deep_m * 2 * std::sin(turn_rad / 2)) - 1) < 0.05);
  }
}

/// A ball of 30 mm under a pen that is led 60 mm over it, 2 mm below the sphere, at 300 N/m.
struct Roughness {
  static constexpr double radius_m = 0.03, depth_m = 2e-3, stiffness_n_m = 300, way_m = 0.06;
  double faces = 0, turn_rad = 0;       ///< largest between two faces
  double step_n = 0, off_rms_n = 0;     ///< largest step; force off the sphere's
  double firmness = 0, edges_a_mm = 0;  ///< force over that of the sphere, mean; steps of the force
};

Roughness felt_on_ball(int times, bool shading) {
  const Mesh ball = clean(icosphere(Roughness::radius_m, times));
  touch::ProxySettings settings;
  settings.shading = shading;
  touch::Proxy proxy(ball, settings);
  const Vec3 from{0.36, 0.48, 0.8}, to{0.48, 0.64, -0.6};
  constexpr int poses = 12000;
  Roughness r;
  r.faces = static_cast<double>(ball.triangles.size());
  r.turn_rad = touch::jumps_of(ball).largest_rad;
  const double whole_n = Roughness::stiffness_n_m * Roughness::depth_m;
  proxy.begin(1.1 * Roughness::radius_m * from);
  Vec3 before{};
  for (int n = 0; n < poses; ++n) {
    const double turn = Roughness::way_m / Roughness::radius_m * n / poses;
    const Vec3 out = std::cos(turn) * from + std::sin(turn) * to;
    const touch::Touched t = proxy.move((Roughness::radius_m - Roughness::depth_m) * out);
    REQUIRE(t.touching);
    const Vec3 force = Roughness::stiffness_n_m * t.depth_m * t.normal;
    const double step_n = n > 0 ? length(force - before) : 0;
    before = force;
    r.step_n = std::max(r.step_n, step_n);
    if (step_n > 0.1 * whole_n * r.turn_rad) r.edges_a_mm += 1e-3 / Roughness::way_m;
    r.off_rms_n += plant::dot(force - whole_n * out, force - whole_n * out) / poses;
    r.firmness += plant::dot(force, out) / whole_n / poses;
  }
  r.off_rms_n = std::sqrt(r.off_rms_n);
  return r;
}

/// Of N equal triangles on a sphere: the angle between two, and how far they are within it.
double equal_turn_rad(double faces) {
  return std::sqrt(16 * 3.14159265358979323846 / (3 * std::sqrt(3.0) * faces));
}
double equal_gap_m(double faces) {
  return full_turn * Roughness::radius_m / (std::sqrt(3.0) * faces);
}

TEST_CASE("touch: finer meshes of a ball are firmer and smoother, as the closed form says") {
  for (int times = 2; times <= 4; ++times) {
    const Roughness facets = felt_on_ball(times, false), shaded = felt_on_ball(times, true);
    INFO(facets.faces << " faces: step " << facets.step_n << " N, off " << facets.off_rms_n
                      << " N, firmness " << facets.firmness);
    const double whole_n = Roughness::stiffness_n_m * Roughness::depth_m;
    // An icosphere's triangles are not equal; the largest turn is up to a quarter above the mean.
    CHECK(facets.turn_rad > equal_turn_rad(facets.faces));
    CHECK(facets.turn_rad < 1.25 * equal_turn_rad(facets.faces));
    CHECK(facets.step_n < 1.001 * whole_n * 2 * std::sin(facets.turn_rad / 2));
    CHECK(facets.step_n > 0.7 * whole_n * 2 * std::sin(facets.turn_rad / 2));
    const double loss = equal_gap_m(facets.faces) / Roughness::depth_m;
    CHECK(1 - facets.firmness == Approx(loss).epsilon(0.25));
    // With shading the force turns over a whole face, in steps of 5 um.
    CHECK(shaded.step_n < 0.2 * facets.step_n);
    CHECK(shaded.off_rms_n < facets.off_rms_n);
  }
}

TEST_CASE("touch: how firm and how rough a ball of more and more faces is", "[.table]") {
  for (int times = 2; times <= 7; ++times) {
    const Roughness r = felt_on_ball(times, false), s = felt_on_ball(times, true);
    const double degrees = r.turn_rad / degree;
    WARN(r.faces << " faces: turn " << degrees << ", " << r.edges_a_mm << " edges a mm, step "
                 << 1e3 * r.step_n << " mN (" << 600 * 2 * std::sin(r.turn_rad / 2) << "), off "
                 << 1e3 * r.off_rms_n << " mN rms, shaded " << 1e3 * s.off_rms_n << " and step "
                 << 1e3 * s.step_n << "; firmness " << r.firmness << " ("
                 << 1 - equal_gap_m(r.faces) / Roughness::depth_m << "); steps of 10 mN at "
                 << 0.01 / (Roughness::depth_m * 2 * std::sin(r.turn_rad / 2)) << " N/m");
  }
}

/// Signed distance from a box in closed form.
double box_distance_m(Vec3 half_m, Vec3 at) {
  const double q[] = {std::abs(at.x) - half_m.x, std::abs(at.y) - half_m.y,
                      std::abs(at.z) - half_m.z};
  double out = 0;
  for (const double part : q) out += std::max(0.0, part) * std::max(0.0, part);
  return std::sqrt(out) + std::min(0.0, std::max({q[0], q[1], q[2]}));
}

TEST_CASE(
    "touch: the signed distance of a box is its closed form, of a torus its side is by winding") {
  const Vec3 half_m{0.01, 0.02, 0.03};
  const Mesh cuboid = clean(box(half_m)), ring = clean(torus(0.02, 0.008, 24));
  touch::SignedDistance distance(cuboid), of_ring(ring);
  SplitMix64 random(11);
  int inside = 0, corners = 0;
  for (int n = 0; n < 2000; ++n) {
    const Vec3 at{random.between(-0.04, 0.04), random.between(-0.04, 0.04),
                  random.between(-0.04, 0.04)};
    const auto place = distance.at(at);
    const double is_m = box_distance_m(half_m, at);
    CHECK(place.distance_m == Approx(is_m).margin(1e-12));
    CHECK(length(at - place.point_m - is_m * place.gradient) < 1e-9);
    CHECK(length(place.gradient) == Approx(1));
    inside += is_m < 0 ? 1 : 0;
    corners += std::abs(at.x) > half_m.x && std::abs(at.y) > half_m.y ? 1 : 0;
    if (n < 400) CHECK((of_ring.at(at).distance_m < 0) == (touch::winding(ring, at) > 0.5));
  }
  CHECK((inside > 100 && corners > 500));
  const auto on_it = distance.at({0.01, 0.003, 0.004});
  CHECK(on_it.distance_m == Approx(0).margin(1e-15));
  CHECK(on_it.gradient.x == Approx(1));
  Soup inwards = icosphere(0.01, 1);
  for (auto& t : inwards.triangles) std::swap(t[0], t[1]);
  const Mesh open = clean(open_plate(0.04, 1e-4, 2)), inner = clean(inwards);
  CHECK_THROWS_WITH(touch::SignedDistance(open), Catch::Contains("not closed"));
  CHECK_THROWS_WITH(touch::SignedDistance(inner), Catch::Contains("inwards"));
}

/// Where a pen is that is led 2 mm deep, and the force of both; 300 N/m.
struct Both {
  double worst_n[2] = {}, sum_n2[2] = {}, most_step_n[2] = {};  ///< of the proxy, of the distance
  double rms_n(int k, int poses) const { return std::sqrt(sum_n2[k] / poses); }
};

template <class Way, class Should>
Both felt_by_both(const Mesh& mesh, int poses, Vec3 start, Way&& way, Should&& should) {
  touch::Proxy proxy(mesh, {});
  touch::SignedDistance distance(mesh);
  proxy.begin(start);
  Both b;
  Vec3 before[2];
  for (int n = 0; n < poses; ++n) {
    const Vec3 pen = way(1.0 * n / poses);
    const touch::Touched told[] = {proxy.move(pen), distance.touched(pen)};
    for (int k = 0; k < 2; ++k) {
      const Vec3 force = 300 * told[k].depth_m * told[k].normal;
      const double off_n = length(force - should(pen));
      b.worst_n[k] = std::max(b.worst_n[k], off_n);
      b.sum_n2[k] += off_n * off_n;
      if (n > 0) b.most_step_n[k] = std::max(b.most_step_n[k], length(force - before[k]));
      before[k] = force;
    }
  }
  return b;
}

TEST_CASE(
    "touch: a signed distance is as exact on a ball, turns before an edge and crosses a plate") {
  constexpr int poses = 4000;
  const Mesh ball = clean(icosphere(0.03, 3));
  const Both round = felt_by_both(
      ball, poses, {0, 0, 0.031},
      [](double u) {
        const double turn = 6 * u;
        return 0.028 * Vec3{std::sin(turn), 0.3 * std::cos(turn) * std::sin(turn),
                            std::cos(turn) * std::sqrt(1 - 0.09 * std::sin(turn) * std::sin(turn))};
      },
      [](Vec3 at) { return 300 * (0.03 - length(at)) / length(at) * at; });
  // Over a cube, off its edge; the truth of a body that remembers its side.
  const Mesh cube = clean(box({0.02, 0.02, 0.02}));
  const Both edge = felt_by_both(
      cube, poses, {0.01, 0.003, 0.021},
      [](double u) {
        return Vec3{0.01 + 0.013 * u, 0.003, 0.018};
      },
      [](Vec3 at) {
        return Vec3{0, 0, at.x < 0.02 ? 0.6 : 0.0};
      });
  // 2 mm deep in a plate of 1 mm: the pen is through.
  const Mesh plate = clean(box({0.02, 0.02, 0.0005}));
  const Both thin = felt_by_both(
      plate, poses, {0.001, 0.003, 0.001},
      [](double u) {
        return Vec3{0.001, 0.003, 0.0006 - 0.0021 * u};
      },
      [](Vec3 at) {
        return Vec3{0, 0, 300 * std::max(0.0, 0.0005 - at.z)};
      });
  for (const auto& [name, b] : {std::pair{"ball", round}, {"cube", edge}, {"plate", thin}}) {
    for (int k = 0; k < 2; ++k) {
      UNSCOPED_INFO(name << (k == 0 ? ", proxy: " : ", distance: ") << b.worst_n[k] << " N worst, "
                         << b.rms_n(k, poses) << " N rms, step " << b.most_step_n[k] << " N");
    }
  }
  // 2 mm at 300 N/m with normals within 5.5 degrees, and facets that are 0.137 mm lower.
  for (int k = 0; k < 2; ++k) CHECK(round.worst_n[k] < 0.6 * 0.0953 + 300 * 0.137e-3);
  CHECK(round.rms_n(1, poses) == Approx(round.rms_n(0, poses)).epsilon(0.2));
  // The proxy is a ball of 10 um, which is three poses.
  CHECK(edge.rms_n(0, poses) < 0.6 * std::sqrt(4.0 / poses));
  CHECK(edge.most_step_n[0] == Approx(0.6).margin(1e-3));
  CHECK(edge.most_step_n[1] == Approx(0.6 * std::sqrt(2.0)).margin(2e-3));
  CHECK(thin.worst_n[0] < 1e-6);
  CHECK(thin.most_step_n[1] == Approx(2 * 300 * 0.5e-3).margin(2e-3));
  CHECK(thin.worst_n[1] > 0.44);
}

/// What the middle one of many poses takes, us.
template <class Step>
double median_us(Step&& step) {
  std::vector<double> took;
  for (int n = 0; n < 3000; ++n) {
    const auto from = std::chrono::steady_clock::now();
    const double deep_m = step(n / 3000.0);
    const std::chrono::duration<double> one = std::chrono::steady_clock::now() - from;
    took.push_back(1e6 * one.count());
    CHECK(deep_m > 0);
  }
  std::sort(took.begin(), took.end());
  return touch::quantile(took, 0.5);
}

TEST_CASE("touch: what an update of proxy, edges and distance takes", "[.table]") {
  const auto on_ball = [](double u) { return 0.028 * Vec3{std::sin(6 * u), 0, std::cos(6 * u)}; };
  for (const int times : {3, 7}) {
    const Mesh ball = clean(icosphere(0.03, times));
    touch::Proxy proxy(ball, {});
    touch::SignedDistance distance(ball);
    proxy.begin({0, 0, 0.031});
    const double one_us = median_us([&](double u) { return proxy.move(on_ball(u)).depth_m; });
    const double other_us =
        median_us([&](double u) { return distance.touched(on_ball(u)).depth_m; });
    WARN(ball.triangles.size() << " faces: proxy " << one_us << " us, distance " << other_us);
  }
  // Teeth of 90 degrees, 0.6 mm high.
  const Mesh teeth = clean(grid(200, 200, [](double u, double v) {
    const double tooth = std::abs(2 * (50 * u - std::floor(50 * u)) - 1);
    return Vec3{0.06 * (u - 0.5), 0.06 * (v - 0.5), 0.6e-3 * tooth};
  }));
  for (const bool edges : {false, true}) {
    touch::ProxySettings settings;
    settings.edges = edges;
    touch::Proxy proxy(teeth, settings);
    proxy.begin({-0.028, 0.001, 0.005});
    const double us = median_us([&](double u) {
      return proxy.move({-0.028 + 0.056 * u, 0.001 + 1e-3 * u, -1e-3}).depth_m;
    });
    WARN(teeth.triangles.size() << " faces with teeth: " << (edges ? "two planes " : "one plane ")
                                << us << " us");
  }
}

}  // namespace

// A hollow in which a pen swings by itself: the host in the loop, against the linear loop with the
// age of its planes. docs/touch.md

namespace {

using touch::Mesh;

/// A pen of 45 g that a force presses into a hollow of 30 mm, the inside of a ball, and that
/// nothing else holds: it swings sideways, and all of its spring is the host's.
struct Hollow {
  static constexpr double radius_m = 0.03, stiffness_n_m = 600, mass_kg = 0.045;
  double rate_hz = 1000, latency_s = 1e-3, jitter_s = 1e-3, lost = 0;
  double friction_ns_m = 0.1;
  int times = 5;  ///< 20 * 4^times faces
  bool shading = true;

  /// Mean age of the plane in force: a plane is held until the next one that is not lost.
  double age_s() const {
    return (1 + lost) / (1 - lost) / (2 * rate_hz) + latency_s + 0.5 * jitter_s;
  }
  /// Growth of the swing by the linear loop, 1/s: the pole near the one without a host.
  double modelled_1_s(double press_n) const {
    using Complex = std::complex<double>;
    // Of design and device: window and filters of the velocity, writes and run of the law, PWM.
    constexpr double window_s = 767e-6, cutoff_rad_s = 500, words_s = 65e-6, pwm_s = 30e-6;
    constexpr double winding_s = 0.24e-3 / 2.44, emf_ns_m = 0.0234 * 0.0234 / 2.44 / 1e-4;
    const double spring_n_m = press_n / (radius_m + press_n / stiffness_n_m);
    const auto rest = [&](Complex s) {
      const Complex seen = (1.0 - std::exp(-s * window_s)) / (s * window_s) * cutoff_rad_s /
                           (s + cutoff_rad_s) * std::exp(-s * pwm_s);
      const Complex drive = 1.0 / (1.0 + s * winding_s);
      return mass_kg * s * s + friction_ns_m * s + emf_ns_m * drive * s * (1.0 - seen) +
             spring_n_m * drive * std::exp(-s * (age_s() + words_s + pwm_s));
    };
    Complex s(0, std::sqrt(spring_n_m / mass_kg));
    for (int n = 0; n < 30; ++n) {
      const Complex step(1e-6, 0);
      s -= rest(s) * step / (rest(s + step) - rest(s));
    }
    return s.real();
  }
  double border_n() const {
    double quiet = 0.1, loud = 10;
    for (int n = 0; n < 40; ++n) {
      const double middle = 0.5 * (quiet + loud);
      (modelled_1_s(middle) < 0 ? quiet : loud) = middle;
    }
    return quiet;
  }

  /// Way of the pen across the press, m, one row a millisecond from 0.25 s on.
  std::vector<double> swing_m(double press_n, double until_s) const {
    // Along all axes, so that no current changes its sign.
    const Vec3 down{0.55, 0.5, -std::sqrt(1 - 0.55 * 0.55 - 0.25)};
    const Vec3 across = 1 / std::hypot(down.x, down.y) * Vec3{-down.y, down.x, 0};
    // A part of the ball, for a pen cannot begin in a closed one.
    Soup part = icosphere(radius_m, times);
    const auto above = [&](const touch::Triangle& t) {
      return plant::dot(part.at[t[0]], down) < 0.8 * radius_m;
    };
    part.triangles.erase(std::remove_if(part.triangles.begin(), part.triangles.end(), above),
                         part.triangles.end());
    const Mesh mesh = touch::clean(part);
    AxesScene scene = scene_named("stylus_sphere");
    scene.scenario.effects.lugre = false;
    scene.scenario.effects.viscous = true;
    scene.scenario.duration_s = until_s;
    scene.scenario.expectations.clear();
    auto& setup = std::get<StylusSetup>(scene.device);
    const double capstan_m = setup.parameters.lever.lever.radius_m;
    setup.parameters.lever.lever.viscous_nm_s_rad = friction_ns_m * capstan_m * capstan_m;
    const Vec3 start = (radius_m - 0.3e-3) * (std::cos(0.08) * down + std::sin(0.08) * across);
    const double parts[] = {down.x, down.y, down.z}, places[] = {start.x, start.y, start.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      plant::Hand& hand = setup.hand[axis] = {};
      hand.start_rad = places[axis] / capstan_m;
      plant::HandPhase& press = hand.phases.emplace_back();
      press.kind = plant::HandPhase::Kind::kTorque;
      plant::Segment wait, ramp;
      wait.kind = plant::Segment::Kind::kHold;
      wait.duration_s = 0.03;
      ramp.kind = plant::Segment::Kind::kMinimumJerk;
      ramp.duration_s = 0.05;
      ramp.to = press_n * parts[axis] * capstan_m;
      press.profile = {wait, ramp};
    }
    touch::ProxySettings settings;
    settings.shading = shading;
    touch::Proxy proxy(mesh, settings);
    proxy.begin(start);
    PlaneHostSettings& host = *scene.plane;
    host.rate_hz = rate_hz;
    host.latency_s = latency_s;
    host.jitter_s = jitter_s;
    host.lost = lost;
    host.search = [&proxy](Vec3 pen_m) {
      const touch::Touched t = proxy.move(pen_m);
      return std::pair{Plane{t.point_m, t.normal}, PlaneMaterial{stiffness_n_m, 1, 0}};
    };
    const std::vector<std::string> names = axes_columns(scene);
    const auto first =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), "pen_x_m") - names.begin());
    std::vector<double> swing;
    const AxesResult result = run_scene(
        scene, "twin",
        [&](const std::vector<double>& row) {
          const Vec3 pen{row.at(first), row.at(first + 1), row.at(first + 2)};
          if (row[0] > 0.25) swing.push_back(plant::dot(pen, across));
        },
        1000);
    CHECK(result.figures.at("faults") == 0);
    return swing;
  }
};

/// Growth of a swing, 1/s, from its values a millisecond apart: least squares of each by those a
/// quarter and half a period before.
double growth_1_s(const std::vector<double>& swing, double period_s) {
  const auto lag = static_cast<std::size_t>(250 * period_s);
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();
  for (std::size_t n = 2 * lag; n < swing.size(); ++n) {
    const Eigen::Vector3d known(1, 1e3 * swing[n - lag], 1e3 * swing[n - 2 * lag]);
    squares += known * known.transpose();
    sums += known * (1e3 * swing[n]);
  }
  const Eigen::Vector3d found = squares.ldlt().solve(sums);
  return std::log(-found[2]) / (2e-3 * static_cast<double>(lag));
}

/// Force at which the swing in the hollow neither grows nor dies, N, between two runs beside it of
/// so many times 2 m / b each.
double measured_border_n(const Hollow& hollow, double times) {
  const double until_s = 0.25 + times * 2 * Hollow::mass_kg / hollow.friction_ns_m;
  double growth[2], force_n[2];
  for (int n = 0; n < 2; ++n) {
    force_n[n] = hollow.border_n() * (n == 0 ? 0.9 : 1.1);
    const double period_s = full_turn * std::sqrt(Hollow::mass_kg * Hollow::radius_m / force_n[n]);
    growth[n] = growth_1_s(hollow.swing_m(force_n[n], until_s), period_s);
    UNSCOPED_INFO(force_n[n] << " N: " << growth[n] << " 1/s, model "
                             << hollow.modelled_1_s(force_n[n]));
  }
  return force_n[0] - growth[0] * (force_n[1] - force_n[0]) / (growth[1] - growth[0]);
}

/// With friction for a border of about 1.5 N.
Hollow hollow_of(double rate_hz, double latency_s, double jitter_s, double lost) {
  Hollow h;
  h.rate_hz = rate_hz, h.latency_s = latency_s, h.jitter_s = jitter_s, h.lost = lost;
  h.friction_ns_m = 1.5 * h.age_s() / 0.0325;
  return h;
}

TEST_CASE("touch: how hard a pen may be pressed into a hollow is told by the age of its planes") {
  const Hollow hollow = hollow_of(100, 1e-3, 10e-3, 0);
  const double is_n = measured_border_n(hollow, 3), should_n = hollow.border_n();
  INFO(should_n << " N, twin " << is_n << " N");
  CHECK(should_n == Approx(1.5).epsilon(0.05));
  CHECK(is_n == Approx(should_n).epsilon(0.05));
}

TEST_CASE("touch: borders in a hollow as a table", "[.table]") {
  struct Case {
    const char* name;
    Hollow hollow;
  };
  for (const Case& c :
       {Case{"1 kHz, 1 to 2 ms late", hollow_of(1000, 1e-3, 1e-3, 0)},
        Case{"1 kHz, 6 ms late", hollow_of(1000, 6e-3, 0, 0)},
        Case{"100 Hz, 1 ms late", hollow_of(100, 1e-3, 0, 0)},
        Case{"100 Hz, 1 to 11 ms late", hollow_of(100, 1e-3, 10e-3, 0)},
        Case{"1 kHz, 1 to 2 ms late, half lost", hollow_of(1000, 1e-3, 1e-3, 0.5)},
        Case{"1 kHz, 1 to 2 ms late, 80 % lost", hollow_of(1000, 1e-3, 1e-3, 0.8)}}) {
    // What is lost at random takes longer to even out.
    const double is_n = measured_border_n(c.hollow, c.hollow.lost > 0 ? 15 : 3);
    const double should_n = c.hollow.border_n();
    WARN(c.name << ": age " << 1e3 * c.hollow.age_s() << " ms, " << c.hollow.friction_ns_m
                << " Ns/m: " << should_n << " N, twin " << is_n << " N, "
                << 100 * (is_n / should_n - 1) << " %");
    CHECK(is_n == Approx(should_n).epsilon(0.05));
  }
}

TEST_CASE("touch: what facets leave of a swing in a hollow", "[.table]") {
  // At half the border. Over an edge the force to the side changes its sign, an age late: a relay
  // of F sin(turn / 2) behind a mass with friction b swings by 4 / pi of it times age / b.
  for (const int times : {3, 4, 5}) {
    Hollow hollow = hollow_of(1000, 6e-3, 0, 0);
    hollow.times = times;
    hollow.shading = false;
    const double press_n = 0.5 * hollow.border_n();
    const std::vector<double> swing = hollow.swing_m(press_n, 3);
    const auto [low, high] = std::minmax_element(swing.end() - 300, swing.end());
    const double faces = 20 * std::pow(4, times), turn_rad = std::sqrt(9.674 / faces);
    WARN(faces << " faces: swing " << 0.5e3 * (*high - *low) << " mm, relay "
               << 1e3 * 4 / 3.14159265 * press_n * std::sin(turn_rad / 2) * hollow.age_s() /
                      hollow.friction_ns_m);
  }
}

}  // namespace
}  // namespace feltgate::test
