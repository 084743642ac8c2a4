// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Meshes that move under a pen that is held, edges by both of their planes, and a hollow in which a
// pen swings by itself, in closed loop, against closed forms. docs/touch.md
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "touch_meshes.hpp"

namespace feltgate::test {
namespace {

using plant::length;
using touch::Mesh;

TEST_CASE("touch: a mesh that comes to the pen is felt as one that the pen goes to") {
  // A plate rises with 20 mm/s under a pen that is held.
  const Mesh plate = touch::clean(box({0.02, 0.02, 0.002}));
  touch::TouchRequest request;
  request.host.stiffness_n_m = 300;
  request.stroke = {{0, {0.003, 0, 0.004}}, {0.2, {0.003, 0, 0.004}}};
  request.mesh_way = {{0, {0, 0, 0}, {}}, {0.2, {0, 0, 4e-3}, {0, 0, 3}}};
  const touch::TouchRun rising = run_on(plate, "twin,double", request);
  CHECK(rising.result.broken.empty());
  int felt = 0;
  for (const touch::TouchRow& row : rising.rows) {
    const double deep_m = std::max(0.0, 0.02 * row.time_s + 0.002 - 0.004);
    if (row.time_s < 0.12) continue;
    ++felt;
    // A plane is up to 3.1 ms old, the pen is counted to 15 um.
    CHECK(row.force_n.z < 300 * (deep_m + 15e-6));
    CHECK(row.force_n.z > 300 * (deep_m - 0.02 * 3.1e-3 - 15e-6));
    CHECK(std::hypot(row.force_n.x, row.force_n.y) < 1e-3);
  }
  CHECK(felt > 70);
}

TEST_CASE("touch: a wall that turns about the vertical turns the force with it") {
  // The pen presses into the side y = -10 mm of a box, 1.5 mm deep; then the box turns by 0.3 rad.
  const Mesh wall = touch::clean(box({0.03, 0.01, 0.02}));
  touch::TouchRequest request;
  request.host.stiffness_n_m = 300;
  request.stroke = {{0, {0, -0.012, 0}}, {0.03, {0, -0.0085, 0}}, {0.2, {0, -0.0085, 0}}};
  request.mesh_way = {
      {0, {}}, {0.05, {}}, {0.15, {}, {0, 0, 0.3}}, {0.2, {}, {0, 0, 0.3}}};
  const touch::TouchRun run = run_on(wall, "twin,double", request);
  CHECK(run.result.broken.empty());
  int felt = 0;
  for (const touch::TouchRow& row : run.rows) {
    if (row.time_s < 0.04) continue;
    ++felt;
    const double turn_rad = std::clamp((row.time_s - 0.05) / 0.1, 0.0, 1.0) * 0.3;
    // 3 rad/s for 3.1 ms, and a count of 15 um along each axis of 1.5 mm.
    CHECK(std::abs(std::atan2(row.force_n.x, -row.force_n.y) - turn_rad) < 0.01 + 0.02);
    const double deep_m = 0.01 - 0.0085 * std::cos(turn_rad);
    CHECK(length(row.force_n) == Approx(300 * deep_m).margin(300 * 40e-6));
  }
  CHECK(felt > 150);
}

/// Rodrigues' formula: v turned about `by_rad` by its length.
Vec3 turned(Vec3 v, Vec3 by_rad) {
  const double rad = length(by_rad), c = std::cos(rad), s = std::sin(rad);
  const Vec3 k = 1 / rad * by_rad;
  return c * v + s * plant::cross(k, v) + (1 - c) * plant::dot(k, v) * k;
}

TEST_CASE("touch: a mesh that moves, turns about any direction and grows, as a rigid body's") {
  // About its middle (5, -2, 3) mm, not about the frame's.
  Soup soup = box({0.02, 0.01, 0.03});
  const Vec3 middle{0.005, -0.002, 0.003};
  for (Vec3& v : soup.at) v = v + middle;
  const Mesh mesh = touch::clean(soup);
  SplitMix64 random(3);
  const auto some = [&](double most) {
    return Vec3{random.between(-most, most), random.between(-most, most),
                random.between(-most, most)};
  };
  for (int run = 0; run < 300; ++run) {
    // It turns at one rate about one direction, so that its speed has a closed form.
    const Vec3 at = some(0.05), speed = some(0.2), turn = some(2);
    const double rad_s = random.between(-5, 5), scale = random.between(0.2, 4),
                 grows_1_s = random.between(-1, 1);
    const touch::Actor actor(
        mesh, {{0, at, turn, scale},
               {0.1, at + 0.1 * speed, (1 + 0.1 * rad_s) * turn, scale + 0.1 * grows_1_s}});
    const double t = random.between(0, 0.099), size = scale + t * grows_1_s;
    const Vec3 p = some(0.03), arm = turned(p - middle, (1 + t * rad_s) * turn);
    const Vec3 is = actor.in_device(p, t);
    CHECK(length(is - (middle + at + t * speed + size * arm)) < 1e-12);
    CHECK(length(actor.in_mesh(is, t) - p) < 1e-12);
    const Vec3 goes = speed + grows_1_s * arm + size * rad_s * plant::cross(turn, arm);
    CHECK(length(actor.velocity_m_s(p, t) - goes) < 1e-5 + 1e-4 * length(goes));
    touch::Touched found;
    found.point_m = p, found.normal = 1 / length(p) * p, found.depth_m = 1e-3;
    const touch::Touched told = actor.in_device(found, t);
    CHECK(length(told.point_m - is) == 0);
    CHECK(length(told.normal - turned(found.normal, (1 + t * rad_s) * turn)) < 1e-12);
    CHECK(told.depth_m == Approx(1e-3 * size));
    CHECK(length(actor.velocity_m_s(p, 0.2)) == 0);
  }
}

TEST_CASE("touch: a ball that grows under the pen pushes it, and damps by the speed between both") {
  // Its top rises by 20 mm/s; the pen is held 1 mm above where it was.
  const Mesh ball = touch::clean(icosphere(0.02, 4));
  touch::TouchRequest request;
  request.proxy.shading = true;
  request.host.stiffness_n_m = 300;
  request.stroke = {{0, {0, 0, 0.021}}, {0.2, {0, 0, 0.021}}};
  request.mesh_way = {{0, {}, {}, 1}, {0.2, {}, {}, 1.2}};
  touch::TouchRun runs[2];
  for (const int n : {0, 1}) {
    request.host.damping_ns_m = n;
    runs[n] = run_on(ball, "twin,double", request);
    CHECK(runs[n].result.broken.empty());
  }
  int felt = 0;
  for (std::size_t n = 0; n < runs[0].rows.size(); ++n) {
    const touch::TouchRow &bare = runs[0].rows[n], &damped = runs[1].rows[n];
    if (bare.time_s < 0.06) continue;
    ++felt;
    const double deep_m = 0.02 * bare.time_s - 1e-3;
    // A plane is up to 3.1 ms old; the facets' planes are up to 20 um below the ball.
    CHECK(bare.force_n.z < 300 * (deep_m + 30e-6));
    CHECK(bare.force_n.z > 300 * (deep_m - 0.02 * 3.1e-3 - 60e-6));
    if (deep_m > 0.2e-3)
      CHECK(damped.force_n.z - bare.force_n.z == Approx(1 * 0.02).margin(3e-3));
  }
  CHECK(felt > 130);
}

TEST_CASE("touch: a plate that slides under a held pen takes it along, by friction and no more") {
  const Mesh plate = touch::clean(box({0.08, 0.08, 0.005}));
  touch::TouchRequest request;
  request.host.stiffness_n_m = 300;
  request.host.friction = 0.5;
  request.stroke = {{0, {0, 0, 0.007}}, {0.03, {0, 0, 0.003}}, {0.3, {0, 0, 0.003}}};
  // 5 Ns/m of grip: 0.05 N at 10 mm/s, and from 60 mm/s on half of 0.6 N.
  request.mesh_way = {{0, {}}, {0.1, {}}, {0.2, {1e-3, 0, 0}}, {0.3, {1e-3, 0.02, 0}}};
  const touch::TouchRun run = run_on(plate, "twin,double", request);
  CHECK(run.result.broken.empty());
  int felt = 0;
  for (const touch::TouchRow& row : run.rows) {
    if (row.time_s < 0.045) continue;
    const auto within = [&](double from, double to) {
      return row.time_s > from + 4e-3 && row.time_s < to;
    };
    Vec3 drag{};
    if (within(0.1, 0.2)) drag = {5 * 0.01, 0, 0};
    if (within(0.2, 0.3)) drag = {0, 0.5 * 0.6, 0};
    if (!within(0.045, 0.1) && length(drag) == 0) continue;
    ++felt;
    CHECK(length(row.force_n - Vec3{drag.x, drag.y, 0.6}) < 300 * 30e-6);
  }
  CHECK(felt > 230);
}

TEST_CASE("touch: the parts of a vibrating material are felt by its frequency, the others not") {
  // A plate of two halves, stone to the right; both are pressed 2 mm deep for 0.1 s.
  Soup soup = box({0.03, 0.03, 0.005});
  Soup right = box({0.03, 0.03, 0.005});
  soup.materials = {"moss", "slab"};
  soup.parts.assign(soup.triangles.size(), 0);
  const auto first = static_cast<std::uint32_t>(soup.at.size());
  for (const Vec3& v : right.at) soup.at.push_back(v + Vec3{0.061, 0, 0});
  for (const touch::Triangle& t : right.triangles) {
    soup.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    soup.parts.push_back(1);
  }
  const Mesh mesh = touch::clean(soup);
  for (const bool slab : {false, true}) {
    const double x = slab ? 0.061 : 0;
    touch::TouchRequest request;
    request.host.stiffness_n_m = 300;
    request.materials["slab"] = {300, 0, 0, 0.2, 50};
    request.stroke = {{0, {x, 0, 0.007}}, {0.03, {x, 0, 0.003}}, {0.145, {x, 0, 0.003}}};
    const touch::TouchRun run = run_on(mesh, "twin,double", request);
    CHECK(run.result.broken.empty());
    // Five periods of 20 ms, a row a millisecond.
    double sum = 0, squares = 0, sine = 0, cosine = 0;
    int rows = 0;
    for (const touch::TouchRow& row : run.rows) {
      if (row.time_s < 0.0405 || rows == 100) continue;
      ++rows;
      const double off = row.force_n.z - 0.6, angle = full_turn * 50 * row.time_s;
      sum += off, squares += off * off, sine += off * std::sin(angle),
          cosine += off * std::cos(angle);
    }
    CHECK(rows == 100);
    CHECK(sum / rows == Approx(0).margin(300 * 20e-6));
    const double amplitude_n = 2 * std::hypot(sine, cosine) / rows;
    CHECK(amplitude_n == Approx(slab ? 0.2 : 0).margin(4e-3));
    CHECK(squares / rows == Approx(amplitude_n * amplitude_n / 2).margin(2e-5));
  }
  touch::TouchRequest both;
  both.proxy.edges = true;
  both.materials["slab"] = {300, 0, 0, 0.2, 50};
  both.stroke = {{0, {0, 0, 0.007}}, {0.03, {0, 0, 0.003}}};
  CHECK_THROWS_WITH(run_on(mesh, "twin", both), Catch::Contains("no room for a vibration"));
}

/// The most that the force changes from one row to the next, 1 ms later.
double most_change_n(const touch::TouchRun& run, double from_s) {
  double most = 0;
  for (std::size_t n = 1; n < run.rows.size(); ++n) {
    if (run.rows[n - 1].time_s < from_s) continue;
    most = std::max(most, length(run.rows[n].force_n - run.rows[n - 1].force_n));
  }
  return most;
}

touch::TouchRequest edge_stroke(touch::Stroke stroke, bool edges) {
  touch::TouchRequest request;
  request.proxy.edges = edges;
  request.host.stiffness_n_m = 300;
  request.stroke = std::move(stroke);
  return request;
}

TEST_CASE(
    "touch: off a cube and into it again, one plane steps by all of the force, two by nothing") {
  // 2 mm deep over the upper face and off it at 0.1 m/s, then back in from the side, 1.5 mm deep.
  const Mesh cube = touch::clean(box({0.02, 0.02, 0.02}));
  const touch::Stroke over = {{0, {0.012, 0.003, 0.023}},
                              {0.03, {0.012, 0.003, 0.018}},
                              {0.14, {0.023, 0.003, 0.018}},
                              {0.185, {0.0185, 0.003, 0.018}},
                              {0.2, {0.0185, 0.003, 0.018}}};
  const touch::TouchRun one = run_on(cube, "twin,double", edge_stroke(over, false));
  const touch::TouchRun two = run_on(cube, "twin,double", edge_stroke(over, true));
  CHECK((one.result.broken.empty() && two.result.broken.empty()));
  INFO(one.result.figures.at("plane_step_n.max")
       << " N, " << most_change_n(one, 0.04) << " N; " << two.result.figures.at("plane_step_n.max")
       << " N, " << most_change_n(two, 0.04) << " N");
  // The pen is counted to 15 um.
  CHECK(one.result.figures.at("plane_step_n.max") == Approx(0.6).margin(5e-3));
  CHECK(most_change_n(one, 0.04) > 0.55);
  CHECK(two.result.figures.at("plane_step_n.max") < 1e-3);
  // A way of 0.1 mm and two counts of an energy whose force changes by at most K (1 + d / (1.4
  // mm)).
  CHECK(most_change_n(two, 0.04) < 300 * 0.13e-3 * (1 + 2 / 1.414));
  for (const touch::TouchRow& row : two.rows) {
    if (row.time_s > 0.04 && row.pen_m.x < 0.0169)
      CHECK(length(row.force_n - Vec3{0, 0, 0.6}) < 300 * 30e-6);
    if (row.time_s > 0.12 && row.pen_m.x > 0.02001) CHECK(length(row.force_n) < 300 * 20e-6);
  }
  // In again from the side, the side holds it, but for what the rounded edge takes: 0.0625 mm.
  const Vec3 end = two.rows.back().force_n;
  CHECK(end.x > 0.29);
  CHECK(length(end) < 0.46);
}

TEST_CASE("touch: both walls of a groove push at once, and do not wait for a plane") {
  // Two slopes of 45 degrees; the pen is led across, 2 mm below the bottom.
  const Mesh groove = touch::clean(grid(2, 2, [](double u, double v) {
    return Vec3{0.04 * (u - 0.5), 0.04 * (v - 0.5), std::abs(0.04 * (u - 0.5))};
  }));
  const touch::Stroke across = {
      {0, {-0.004, 0.003, 0.008}}, {0.04, {-0.004, 0.003, -0.002}}, {0.12, {0.004, 0.003, -0.002}}};
  double off_n[2] = {};
  for (const bool edges : {false, true}) {
    const touch::TouchRun run = run_on(groove, "twin,double", edge_stroke(across, edges));
    CHECK(run.result.broken.empty());
    for (const touch::TouchRow& row : run.rows) {
      if (row.time_s < 0.05) continue;
      // To the nearest free point: the bottom, or a slope.
      const Vec3 at = row.pen_m;
      const double aside = std::abs(at.x) <= -at.z ? 0 : (std::abs(at.x) + at.z) / 2;
      const Vec3 to{at.x < 0 ? -aside : aside, at.y, aside};
      off_n[edges] = std::max(off_n[edges], length(row.force_n - 300 * (to - at)));
    }
  }
  INFO(off_n[0] << " N with one plane, " << off_n[1] << " N with two");
  // 0.1 m/s for 1 to 3 ms with one, counts and a run of the engine with two.
  CHECK((off_n[0] > 0.03 && off_n[0] < 300 * 0.1 * 3.1e-3 * 1.1));
  CHECK(off_n[1] < 300 * 30e-6);
}

TEST_CASE("touch: over a cube's edge, RTL and twin in every clock", "[lockstep]") {
  const touch::TouchRun run = run_on(touch::clean(box({0.02, 0.02, 0.02})), "all",
                                     edge_stroke({{0, {0.016, 0.003, 0.022}},
                                                  {0.01, {0.016, 0.003, 0.018}},
                                                  {0.022, {0.0165, 0.003, 0.018}},
                                                  {0.039, {0.0202, 0.003, 0.018}}},
                                                 true));
  CHECK(run.result.lock_step);
  CHECK(run.result.mismatches == 0);
  CHECK(run.result.clocks > 1'800'000);
  CHECK(run.result.broken.empty());
  CHECK(run.result.figures.at("tau_ref_nm.0.max") > 2e-3);
  CHECK(run.result.figures.at("tau_ref_nm.2.max") > 3e-3);
}

TEST_CASE("touch: materials by name have the shares of their scenes") {
  for (const touch::MaterialPreset& preset : touch::material_presets) {
    std::ifstream file(FELTGATE_ROOT + ("/vectors/scenes/material_" + std::string(preset.name)) +
                       ".toml");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const auto value = [&](const std::string& key) {
      const auto at = text.find("\n" + key + " = ");
      return at == std::string::npos ? 0 : std::stod(text.substr(at + key.size() + 4));
    };
    INFO(preset.name);
    CHECK(preset.hardness == value("hardness"));
    CHECK(preset.damping == Approx(value("damping") / 50));  // of 50 mNm s/rad
    CHECK(preset.friction == value("dynamic"));
    CHECK(preset.vibration == Approx(value("vibration") / 0.1));
    CHECK(preset.frequency_hz == value("frequency"));
    CHECK(touch::material_of(preset, 400).stiffness_n_m == Approx(400 * value("hardness")));
  }
}

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
