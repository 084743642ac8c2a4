// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's pen, stylus and body in space against closed forms: how the hand swings, what it and a
// law's spring hold, planes as old as their poses, friction to its cone, a body that arrives where
// the hand turned. Documentation: docs/page.md
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "apps/page/felt_mesh.hpp"
#include "feltgate/largest.hpp"
#include "law_loops.hpp"
#include "sim/axes_loop/axes_scene.hpp"
#include "studies/shape/shape_law.hpp"

namespace feltgate::page {
namespace {

using plant::Quaternion;
using plant::Vec3;
using Matrix = Eigen::Matrix3d;

constexpr double count_m = 15.4e-6;  // of a capstan of 10 mm
constexpr double run_s = 1e-5;

std::string square_at(double centre_x_m) {
  shape::Placing placing;
  placing.centre_m = {centre_x_m, 0.12};
  const auto outline = shape::placed(shape::read_svg(root + "/vectors/shapes/square.svg"), placing);
  const shape::Polygon polygon = shape::sampled(shape::rounded(outline, 2e-3), 40);
  const auto law = law::compile_text(shape::law_text(polygon, {"square"}), "square.law",
                                     law::target_of(design_named("lever")));
  return law::text(law.image);
}

const std::string& image() {
  static const std::string text = image_of("local_space", "stylus_law");
  return text;
}

Stylus slides() {
  Stylus s;
  s.capstan_m = 0.01;
  s.own_kg = 0.045;
  s.own_ns_m = 0.003;
  return s;
}

/// The world of a shipped scene under a host that is exactly on time.
PlaneHostSettings world_of(const std::string& scene, double rate_hz, double age_s) {
  const auto device = [](const std::string& name) {
    return root + "/vectors/devices/" + name + ".toml";
  };
  PlaneHostSettings w = *read_axes_scene(root + "/vectors/scenes/" + scene + ".toml", device).plane;
  w.damping_ns_m = w.friction = w.jitter_s = w.lost = 0;
  w.rate_hz = rate_hz;
  w.latency_s = age_s;
  return w;
}

/// The hand goes there within 10 ms, and all comes to rest: e^(-5 t) of its swing is left.
template <class Loop>
void rest(Loop& loop, typename Loop::Place lead_m) {
  loop.lead(lead_m);
  loop.advance(0.01);
  loop.advance(3);
}

GimbalLoop handle() {
  const law::Compiled law = shipped("rigid_body", "gimbal_law");
  const auto word = [&](const char* state) { return state_word(law, state); };
  return GimbalLoop(law::text(law.image), Handle({word("dw"), word("dx"), word("dy"), word("dz")}));
}

/// A rotation about axis 0, 1 or 2.
Matrix about(int axis, double rad) {
  return Eigen::AngleAxisd(rad, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
}
/// How far the body's three axes are from the columns of a matrix.
double off(const Quaternion& q, const Matrix& m) {
  const Matrix body = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
  return (body - m).colwise().norm().maxCoeff();
}

void turn_slowly(GimbalLoop& loop, Vec3 rad) {
  for (int n = 0; n < 100; ++n) {
    turn(loop, 0.01 * rad);
    loop.advance(0.005);
  }
}

}  // namespace

TEST_CASE("page: outside the shape the pen follows the hand as its closed form") {
  PenLoop loop(square_at(0));
  loop.place({0.04, 0.12});
  loop.lead({0.05, 0.12});
  const double dt = loop.law().period_s();
  CHECK(1 / dt == Approx(1e6 / 13));
  loop.advance(dt);  // the step of the hand, within a run
  const Swing swing(hand.mass_kg);
  for (int k = 1; k <= 40; ++k) {
    loop.advance(0.01);
    const double t = loop.time_s();
    INFO("at " << t << " s");
    CHECK(loop.at().x == Approx(0.05 - 0.01 * swing.left(t)).margin(2e-6));
    CHECK(std::fabs(loop.at().y - 0.12) < 1e-9);
    CHECK(std::hypot(loop.force().x, loop.force().y) == 0);
  }
}

TEST_CASE("page: in a square the hand and the law hold each other") {
  PenLoop loop(square_at(0));
  for (const double stiffness : {30.0, 50.0, 120.0}) {
    loop.set("stiffness", stiffness);
    loop.place({0.04, 0.12});
    loop.advance(0.02);
    // 10 mm behind the face at 30 mm: depth d with K d = K_hand (10 mm - d).
    rest(loop, {0.02, 0.12});
    const double depth = 0.01 * hand.stiffness_n_m / (hand.stiffness_n_m + stiffness);
    INFO(stiffness << " N/m");
    // A count is 153 um of the pen, and angles are cut, not rounded.
    CHECK(loop.at().x == Approx(0.03 - depth).margin(160e-6));
    CHECK(loop.force().x == Approx(stiffness * depth).margin(stiffness * 160e-6));
    CHECK(std::fabs(loop.force().y) < stiffness * 160e-6);
  }
  CHECK_THROWS_AS(loop.set("stiffness", 1000), std::invalid_argument);
}

TEST_CASE("page: joints turn as the pen moves, and a shape's damping brakes it") {
  for (const shape::Point p : {shape::Point{0.03, 0.12}, {-0.05, 0.08}, {0, 0.18}}) {
    for (const shape::Point v : {shape::Point{0.1, 0}, {0, 0.1}, {-0.2, 0.3}}) {
      const double dt = 1e-6;
      const auto before = shape::cranks(p - v * dt), after = shape::cranks(p + v * dt);
      const auto speed = shape::crank_speeds(p, v);
      for (const std::size_t n : {0U, 1U}) {
        CHECK(speed[n] == Approx((after[n] - before[n]) / (2 * dt)).epsilon(1e-5));
      }
    }
  }
  // Along the face of a square, from outside to inside and on.
  PenLoop loop(square_at(0));
  loop.set("damping", 0.15);
  loop.place({0.04, 0.11});
  loop.advance(0.02);
  rest(loop, {0.02, 0.11});
  loop.lead({0.02, 0.13});
  for (int k = 0; k < 10; ++k) {
    loop.advance(0.01);
    INFO(loop.speed().y << " m/s");
    CHECK(loop.force().y == Approx(-0.15 * loop.speed().y).margin(1e-3));
  }
  CHECK(loop.speed().y > 0.05);
}

TEST_CASE("page: another law takes the pen where it is, and it stays within reach") {
  const std::string left = square_at(-0.03);
  PenLoop loop(square_at(0));
  loop.place({0.02, 0.12});
  loop.advance(0.1);
  CHECK(loop.force().x > 0.1);  // inside, from the start: the nearest face
  loop.load(left);
  loop.advance(0.5);
  CHECK(std::hypot(loop.force().x, loop.force().y) == 0);
  for (const auto& [x, y] : std::vector<std::pair<double, double>>{
           {1, 1}, {-1, 0.1}, {0, 0}, {0, -1}, {0.001, 0.03}, {NAN, 0.1}, {0.1, INFINITY}}) {
    loop.lead({x, y});
    loop.advance(0.3);
    const double r = std::hypot(loop.at().x, loop.at().y);
    CHECK(std::isfinite(r));
    CHECK(r >= Pen::nearest_m - 1e-9);
    CHECK(r <= Pen::farthest_m + 1e-9);
    CHECK(loop.at().y >= Pen::front_m - 1e-9);
  }
}

TEST_CASE("page: above the plane hand and stylus swing as one mass") {
  StylusLoop loop(image(), slides());
  loop.touch(world_of("stylus_floor", 1000, 0.001));
  loop.place({0, 0, 0.04});
  loop.lead({0.01, -0.01, 0.045});
  CHECK(loop.law().period_s() == Approx(run_s));
  loop.advance(run_s);  // the step of the hand, within a run
  const Swing swing(hand.mass_kg + 0.045, 0.003);
  for (int k = 1; k <= 40; ++k) {
    loop.advance(0.01);
    const double t = loop.time_s();
    const double share = 1 - swing.left(t);
    INFO("at " << t << " s");
    CHECK(loop.at().x == Approx(0.01 * share).margin(2e-6));
    CHECK(loop.at().y == Approx(-0.01 * share).margin(2e-6));
    CHECK(loop.at().z == Approx(0.04 + 0.005 * share).margin(2e-6));
    CHECK(plant::length(loop.force()) == 0);
    CHECK(loop.depth_m() == Approx(-loop.at().z));
  }
}

TEST_CASE("page: 3.3 N are 16 mm of 206 N/m, and more is not to be had") {
  StylusLoop loop(image(), slides());
  loop.touch(world_of("stylus_floor", 1000, 0.001));
  const double depth_m = 3.3 / 206, lead_m = depth_m + 3.3 / hand.stiffness_n_m;
  loop.place({0, 0, 0});
  // A count less, and a millimetre more.
  rest(loop, {0, 0, -lead_m + 5 * count_m});
  CHECK(loop.depth_m() == Approx(0.01602).margin(5 * count_m));
  CHECK(loop.force().z == Approx(3.3).margin(206 * 5 * count_m));
  CHECK_FALSE(loop.limited);
  rest(loop, {0, 0, -lead_m - 1e-3});
  CHECK(loop.limited);
  CHECK(loop.force().z == 3.3);
  CHECK(loop.depth_m() == Approx(depth_m + 1e-3).margin(1e-6));
}

TEST_CASE("page: on a sphere the sent normal lags by the pose's age times speed over radius") {
  StylusLoop loop(image(), slides());
  loop.touch(world_of("stylus_sphere", 50, 0.001));
  // The hand goes around a great circle that leans by 30 degrees, 5 rad/s, as the pen at last.
  const double lead_m = 0.022, rad_s = 5;
  const auto on_circle = [&](double t) {
    const double c = lead_m * std::cos(rad_s * t), s = lead_m * std::sin(rad_s * t);
    return Vec3{c * std::sqrt(0.75), c * 0.5, s};
  };
  loop.place(on_circle(0));
  double oldest_s = 0, youngest_s = 1, worst_rad = 0;
  for (int k = 1; k <= 2000; ++k) {
    loop.lead(on_circle(1e-3 * k));
    loop.advance(1e-3);
    if (k < 1500) continue;
    const Vec3 pen = loop.at();
    const double turned_rad_s =
        plant::length(plant::cross(pen, loop.speed())) / plant::dot(pen, pen);
    worst_rad = larger(worst_rad, std::abs(loop.tilt_rad() - turned_rad_s * loop.age_s()));
    oldest_s = std::max(oldest_s, loop.age_s());
    youngest_s = std::min(youngest_s, loop.age_s());
  }
  CHECK(worst_rad < 1e-3);  // counts, cut: half a mrad at 28 mm along each axis, of pose and pen
  CHECK(loop.depth_m() > 0);
  // Seen each millisecond, after a run.
  CHECK(youngest_s == Approx(0.001 + run_s).margin(1.001e-3));
  CHECK(oldest_s == Approx(0.001 + 0.02).margin(1.001e-3));
}

TEST_CASE("page: a world that changes is felt from its first plane on; reach and words have ends") {
  StylusLoop loop(image(), slides());
  CHECK_FALSE(loop.plane());
  loop.place({0, 0, -0.001});
  loop.advance(0.1);
  CHECK(plant::length(loop.force()) == 0);
  CHECK(loop.depth_m() == 0);
  loop.touch(world_of("stylus_floor", 50, 0.002));
  loop.advance(0.0019);
  CHECK_FALSE(loop.plane());
  CHECK(loop.age_s() == 0);
  loop.advance(0.0002);
  CHECK(loop.age_s() == Approx(0.0021).margin(2 * run_s));
  CHECK(loop.force().z == Approx(0.206).margin(206 * count_m));
  for (const Vec3 p : {Vec3{1, 1, 1}, {-1, 0, 0}, {0, NAN, 0}, {0, 0, INFINITY}, {0, 0, -1}}) {
    loop.lead(p);
    loop.advance(1);
    const Vec3 at = loop.at();
    for (const double part : {at.x, at.y, at.z}) CHECK(std::abs(part) <= Stylus::reach_m);
  }
  CHECK_THROWS_AS(loop.set("grip", 11), std::invalid_argument);
}

TEST_CASE("page stylus: a mesh holds the pen as a plane does, and shading turns its normals") {
  // A roof of two faces that rises by 1 in 4 on both sides of x = 0.
  touch::Soup roof;
  roof.at = {{-0.04, -0.04, 0}, {0, -0.04, 0.01}, {0, 0.04, 0.01},
             {-0.04, 0.04, 0},  {0.04, -0.04, 0}, {0.04, 0.04, 0}};
  roof.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  roof.parts = {0, 0, 0, 0};
  roof.materials = {"none"};
  FeltMesh felt(touch::clean(roof));
  PlaneHostSettings world = world_of("stylus_floor", 1000, 0);
  world.stiffness_n_m = 300;
  world.search = [&](Vec3 pen_m) { return std::pair{felt.move(pen_m), PlaneMaterial(world)}; };
  StylusLoop loop(image(), slides());
  loop.place({-0.02, 0, 0.03});
  felt.begin(loop.at());
  loop.touch(world);
  rest(loop, {-0.02, 0, 0});
  // Perpendicular to the face, the springs of hand and mesh are equal; along it the hand leads.
  const Vec3 normal = 1 / std::sqrt(17.0) * Vec3{-1, 0, 4};
  const double below_m = 0.005 * 4 / std::sqrt(17.0);
  const double depth_m = below_m * hand.stiffness_n_m / (hand.stiffness_n_m + 300);
  CHECK(felt.touched.touching);
  CHECK(felt.touched.depth_m == Approx(depth_m).margin(2 * count_m));
  CHECK(plant::length(loop.force() - 300 * depth_m * normal) < 300 * 3 * count_m);
  felt.proxy.shade(true);
  loop.advance(0.1);
  // Halfway to the roof's edge, whose normal is upright.
  CHECK(felt.touched.normal.z > normal.z + 0.001);
}

TEST_CASE("page: the body in space arrives where the hand has turned") {
  GimbalLoop first = handle(), second = handle();
  turn_slowly(first, {0.9, 0, 0});
  turn_slowly(first, {0, -0.7, 0});
  turn_slowly(second, {0, -0.7, 0});
  turn_slowly(second, {0.9, 0, 0});
  for (GimbalLoop* loop : {&first, &second}) loop->advance(5);
  const Matrix x = about(0, 0.9), y = about(1, -0.7);
  CHECK(off(body_of(first), y * x) < 0.01);
  CHECK(off(body_of(second), x * y) < 0.01);
  CHECK(off(body_of(first), x * y) > 0.3);  // the order counts
  CHECK(twist_rad(first) < 0.01);
  CHECK(plant::length(first.force()) < 1e-3);
}

TEST_CASE("page: a whole turn of the body's hand leaves no torque; what is not finite is ignored") {
  GimbalLoop loop = handle();
  turn(loop, {std::numeric_limits<double>::quiet_NaN(), 0, 0});
  for (int n = 0; n < 4; ++n) turn_slowly(loop, {0, 0, M_PI / 2});
  loop.advance(5);
  CHECK(twist_rad(loop) < 0.01);
  CHECK(plant::length(loop.force()) < 1e-3);
  CHECK(off(body_of(loop), about(2, 0)) < 0.01);
  CHECK_THROWS_AS(loop.set("stiffness", 9), std::invalid_argument);
}

}  // namespace feltgate::page
