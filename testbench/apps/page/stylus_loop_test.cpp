// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's stylus: a hand that swings as its closed form, a plane that holds it, a sphere whose
// planes are as old as their poses, a friction that ends at its cone. Documentation: docs/page.md
#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "apps/page/felt_mesh.hpp"
#include "apps/page/law_loops.hpp"
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "law/compile.hpp"
#include "sim/axes_loop/axes_scene.hpp"

namespace feltgate::page {
namespace {

using plant::Vec3;

const std::string root = FELTGATE_ROOT;
constexpr double count_m = 15.4e-6;  // of a capstan of 10 mm
constexpr double run_s = 1e-5;

std::string image_of(const std::string& law) {
  const law::Target target = law::target_of(stylus_design());
  return law::text(law::compile_file(root + "/rtl/laws/" + law + ".law", target).image);
}
const std::string& image() {
  static const std::string text = image_of("local_space");
  return text;
}

AxesScene scene_of(const std::string& name) {
  return read_axes_scene(root + "/vectors/scenes/" + name + ".toml", [](const std::string& device) {
    return root + "/vectors/devices/" + device + ".toml";
  });
}

StylusSlides slides() {
  return slides_of(std::get<StylusSetup>(scene_of("stylus_floor").device).parameters.lever);
}

/// The world of a shipped scene under a host that is exactly on time.
PlaneHostSettings world_of(const std::string& scene, double rate_hz, double age_s) {
  PlaneHostSettings w = *scene_of(scene).plane;
  w.damping_ns_m = w.friction = w.jitter_s = w.lost = 0;
  w.rate_hz = rate_hz;
  w.latency_s = age_s;
  return w;
}

const plant::Impedance hand;

/// The hand goes there within 10 ms, and all comes to rest: e^(-5 t) of its swing is left.
void rest(StylusLoop& loop, Vec3 lead_m) {
  loop.lead(lead_m);
  loop.advance(0.01);
  loop.advance(3);
}

}  // namespace

TEST_CASE("page: the stylus is the device's: 45 g, 0.003 Ns/m, 10 mm, 3.3 N") {
  const StylusSlides s = slides();
  CHECK(s.mass_kg == Approx(0.045));
  CHECK(s.friction_ns_m == Approx(0.003));
  CHECK(s.capstan_m == 0.01);
  std::ifstream file(root + "/vectors/devices/stylus.toml");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  CHECK(StylusLoop::most_n == 3.3);
  CHECK(text.find("; 3.3 N (TouchWorld) are 33 mNm") != std::string::npos);
}

TEST_CASE("page: above the plane hand and stylus swing as one mass") {
  StylusLoop loop(image(), slides());
  loop.touch(world_of("stylus_floor", 1000, 0.001));
  loop.place({0, 0, 0.04});
  loop.lead({0.01, -0.01, 0.045});
  CHECK(loop.law().period_s() == Approx(run_s));
  loop.advance(run_s);  // the step of the hand, within a run
  const double mass_kg = hand.mass_kg + 0.045, b = hand.damping_ns_m / mass_kg;
  const double a = b / 2 + 0.003 / mass_kg / 2;
  const double w = std::sqrt(hand.stiffness_n_m / mass_kg - a * a);
  for (int k = 1; k <= 40; ++k) {
    loop.advance(0.01);
    const double t = loop.time_s();
    // The step goes through the hand's damper too, which throws it with b; the slides' does not.
    const double share = 1 - std::exp(-a * t) * (std::cos(w * t) + (a - b) / w * std::sin(w * t));
    INFO("at " << t << " s");
    CHECK(loop.pen_m().x == Approx(0.01 * share).margin(2e-6));
    CHECK(loop.pen_m().y == Approx(-0.01 * share).margin(2e-6));
    CHECK(loop.pen_m().z == Approx(0.04 + 0.005 * share).margin(2e-6));
    CHECK(plant::length(loop.force_n()) == 0);
    CHECK(loop.depth_m() == Approx(-loop.pen_m().z));
  }
}

TEST_CASE("page: plane and hand hold the stylus where their springs are equal") {
  StylusLoop loop(image(), slides());
  for (const double rate_hz : {50.0, 1000.0, 1e5}) {
    for (const double stiffness : {50.0, 206.0, 1000.0}) {
      PlaneHostSettings world = world_of("stylus_floor", rate_hz, 0.002);
      world.stiffness_n_m = stiffness;
      // As much as the spring at most, and the same place at rest.
      world.damping_ns_m = 2;
      loop.touch(world);
      loop.place({0.01, 0.005, 0.001});
      rest(loop, {0.01, 0.005, -0.02});
      const double depth_m = 0.02 * hand.stiffness_n_m / (hand.stiffness_n_m + stiffness);
      INFO(stiffness << " N/m at " << rate_hz << " Hz");
      CHECK(loop.depth_m() == Approx(depth_m).margin(count_m));
      CHECK(loop.force_n().z == Approx(stiffness * depth_m).margin(stiffness * count_m));
      CHECK(loop.force_n().x == 0);
      CHECK(loop.force_n().y == 0);
      CHECK_FALSE(loop.limited());
    }
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
  CHECK(loop.force_n().z == Approx(3.3).margin(206 * 5 * count_m));
  CHECK_FALSE(loop.limited());
  rest(loop, {0, 0, -lead_m - 1e-3});
  CHECK(loop.limited());
  CHECK(loop.force_n().z == 3.3);
  CHECK(loop.depth_m() == Approx(depth_m + 1e-3).margin(1e-6));
}

TEST_CASE("page: on a sphere the sent normal lags by the pose's age times speed over radius") {
  // Count and cut: half a mrad at 28 mm along each axis, of pose and pen.
  constexpr double margin_rad = 1.0e-3;
  for (const double rate_hz : {50.0, 1000.0, 1e5}) {
    for (const double age_s : {0.0, 0.001, 0.002}) {
      StylusLoop loop(image(), slides());
      loop.touch(world_of("stylus_sphere", rate_hz, age_s));
      // The hand goes around a great circle that leans by 30 degrees, 5 rad/s, as the pen at last.
      const double lead_m = 0.022, rad_s = 5;
      const auto on_circle = [&](double t) {
        const double c = lead_m * std::cos(rad_s * t), s = lead_m * std::sin(rad_s * t);
        return Vec3{c * std::sqrt(0.75), c * 0.5, s};
      };
      loop.place(on_circle(0));
      double oldest_s = 0, youngest_s = 1, worst_rad = 0, largest_rad = 0;
      for (int k = 1; k <= 3000; ++k) {
        loop.lead(on_circle(1e-3 * k));
        loop.advance(1e-3);
        if (k < 2000) continue;
        const Vec3 pen = loop.pen_m();
        const double turned_rad_s =
            plant::length(plant::cross(pen, loop.velocity_m_s())) / plant::dot(pen, pen);
        worst_rad = larger(worst_rad, std::abs(loop.tilt_rad() - turned_rad_s * loop.age_s()));
        largest_rad = larger(largest_rad, loop.tilt_rad());
        oldest_s = std::max(oldest_s, loop.age_s());
        youngest_s = std::min(youngest_s, loop.age_s());
      }
      INFO(rate_hz << " Hz, " << age_s << " s");
      CHECK(worst_rad < margin_rad);
      CHECK(loop.depth_m() > 0);
      CHECK(largest_rad == Approx(rad_s * oldest_s).margin(2 * margin_rad));
      // Seen each millisecond, after a run.
      CHECK(youngest_s == Approx(age_s + run_s).margin(1.001e-3));
      CHECK(oldest_s == Approx(age_s + 1 / rate_hz).margin(1.001e-3));
      CHECK(oldest_s <= age_s + 1 / rate_hz + run_s / 2);
    }
  }
}

TEST_CASE("page: friction drags as the grip up to its cone, and slips there, along each axis") {
  StylusLoop loop(image(), slides());
  const double grip = loop.law().value("grip");
  CHECK(grip == Approx(5).epsilon(1e-4));  // a word
  for (const double along_y_m_s : {0.0, 0.05}) {
    for (const double friction : {0.0, 0.1, 1.5}) {
      PlaneHostSettings world = world_of("stylus_floor", 1000, 0.001);
      world.friction = friction;
      loop.touch(world);
      const double from_y_m = -1.5 * along_y_m_s;
      loop.place({-0.075, from_y_m, 0});
      // 1 N; 0.05 m/s across it.
      const double lead_m = 1 / 206.0 + 1 / hand.stiffness_n_m;
      for (int k = 1; k <= 300; ++k) {
        loop.lead({-0.075 + 0.0005 * k, from_y_m + 0.01 * along_y_m_s * k, -lead_m});
        loop.advance(0.01);
      }
      const Vec3 v = loop.velocity_m_s(), f = loop.force_n();
      const double cone_n = friction * f.z, drag_n = std::min(grip * 0.05, cone_n);
      INFO(friction << " of " << f.z << " N, across y at " << along_y_m_s << " m/s");
      CHECK(f.z == Approx(1).margin(206 * count_m));
      CHECK(v.x == Approx(0.05).epsilon(1e-3));
      // Words of the law: mu of 2^-10, torques of 2 uNm at 10 mm.
      CHECK(f.x == Approx(-drag_n).margin(2e-3));
      CHECK(f.y == Approx(along_y_m_s > 0 ? -drag_n : 0).margin(2e-3));
      // The pull of the hand at this distance: drag, and the slides' friction.
      CHECK(hand.stiffness_n_m * (loop.hand_m().x - loop.pen_m().x) ==
            Approx(drag_n + 0.003 * 0.05).margin(5e-3));
      const double across_n = std::hypot(f.x, f.y);
      if (friction == 0.1) {
        CHECK(across_n == Approx(cone_n * (along_y_m_s > 0 ? std::sqrt(2) : 1)).margin(3e-3));
      }
    }
  }
}

TEST_CASE("page: a cube turns the force at its edge, and outside its corner nothing pushes") {
  StylusLoop loop(image(), slides());
  const PlaneHostSettings world = world_of("stylus_cube", 1e5, 0);
  loop.touch(world);
  const double half_m = world.radius_m, depth_m = 0.01 * hand.stiffness_n_m / (135 + 300);
  loop.place({0.005, 0.005, half_m});
  rest(loop, {0.005, 0.005, half_m - 0.01});
  CHECK(loop.depth_m() == Approx(depth_m).margin(count_m));
  CHECK(loop.plane()->normal.z == 1);
  // Nearer to the side than to the top, and out by it.
  loop.place({half_m - 0.002, 0.005, half_m - 0.005});
  rest(loop, {half_m - 0.005, 0.005, half_m - 0.005});
  CHECK(loop.plane()->normal.x == 1);
  CHECK(loop.force_n().x == Approx(300 * 0.005 * 135 / (135 + 300)).margin(300 * count_m));
  CHECK(loop.force_n().z == 0);
  loop.place({half_m + 0.003, half_m + 0.004, half_m});
  loop.advance(0.001);
  CHECK(loop.depth_m() == Approx(-0.005));
  CHECK(plant::length(loop.force_n()) == 0);
}

TEST_CASE("page: a world that changes is felt from its first plane on; reach and words have ends") {
  StylusLoop loop(image(), slides());
  CHECK_FALSE(loop.plane());
  loop.place({0, 0, -0.001});
  loop.advance(0.1);
  CHECK(plant::length(loop.force_n()) == 0);
  CHECK(loop.depth_m() == 0);
  loop.touch(world_of("stylus_floor", 50, 0.002));
  loop.advance(0.0019);
  CHECK_FALSE(loop.plane());
  CHECK(loop.age_s() == 0);
  loop.advance(0.0002);
  CHECK(loop.age_s() == Approx(0.0021).margin(2 * run_s));
  CHECK(loop.force_n().z == Approx(0.206).margin(206 * count_m));
  for (const Vec3 p : {Vec3{1, 1, 1}, {-1, 0, 0}, {0, NAN, 0}, {0, 0, INFINITY}, {0, 0, -1}}) {
    loop.lead(p);
    loop.advance(1);
    const Vec3 at = loop.pen_m();
    for (const double part : {at.x, at.y, at.z}) CHECK(std::abs(part) <= StylusLoop::reach_m);
  }
  CHECK_THROWS_AS(loop.set("grip", 11), std::invalid_argument);
  CHECK_THROWS_AS(loop.set("hardness", 1), std::invalid_argument);
  CHECK_THROWS_AS(StylusLoop("nonsense", slides()), std::invalid_argument);
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
  felt.begin(loop.pen_m());
  loop.touch(world);
  rest(loop, {-0.02, 0, 0});
  // Perpendicular to the face, the springs of hand and mesh are equal; along it the hand leads.
  const Vec3 normal = 1 / std::sqrt(17.0) * Vec3{-1, 0, 4};
  const double below_m = 0.005 * 4 / std::sqrt(17.0);
  const double depth_m = below_m * hand.stiffness_n_m / (hand.stiffness_n_m + 300);
  CHECK(felt.touched().touching);
  CHECK(felt.touched().depth_m == Approx(depth_m).margin(2 * count_m));
  CHECK(plant::length(loop.force_n() - 300 * depth_m * normal) < 300 * 3 * count_m);
  felt.shade(true);
  loop.advance(0.1);
  // Halfway to the roof's edge, whose normal is upright.
  CHECK(felt.touched().normal.z > normal.z + 0.001);
}

TEST_CASE("page: over a cube's edge the force steps with one plane, and not with two") {
  double most_n[2] = {};
  for (const bool edges : {false, true}) {
    StylusLoop loop(image_of(edges ? "local_edge" : "local_space"), slides());
    PlaneHostSettings world = world_of("stylus_cube", 1000, 0.001);
    world.edges = edges;
    world.stiffness_n_m = 300;
    loop.touch(world);
    const double half_m = world.radius_m;
    loop.place({half_m - 0.006, 0, half_m + 0.001});
    rest(loop, {half_m - 0.006, 0, half_m - 0.008});
    Vec3 before = loop.force_n();
    CHECK(plant::length(before) > 0.6);
    // The hand goes off to the side at 20 mm/s; what pushes it there is the edge.
    for (int ms = 1; ms <= 800; ++ms) {
      loop.lead({half_m - 0.006 + 2e-5 * ms, 0, half_m - 0.008});
      loop.advance(1e-3);
      most_n[edges ? 1 : 0] =
          std::max(most_n[edges ? 1 : 0], plant::length(loop.force_n() - before));
      before = loop.force_n();
    }
    CHECK(plant::length(before) < 0.01);
  }
  INFO(most_n[0] << " N with one plane, " << most_n[1] << " N with two");
  CHECK(most_n[0] > 0.5);
  CHECK(most_n[1] < 0.15);
}

TEST_CASE(
    "page: in a hollow smaller than it says the pen swings, in a larger one it comes to rest") {
  // How much an amplitude grows a second, in a spherical hollow, pressed by about 1.5 N.
  const auto growth_1_s = [](double rate_hz, double age_s, double radius_m, double& steady_m) {
    StylusLoop loop(image(), slides());
    PlaneHostSettings world = world_of("stylus_floor", rate_hz, age_s);
    world.stiffness_n_m = 1000;
    world.search = [radius_m, m = PlaneMaterial(world)](Vec3 pen_m) {
      const Vec3 out = 1 / plant::length(pen_m) * pen_m;
      return std::pair{Plane{radius_m * out, -1.0 * out}, m};
    };
    loop.touch(world);
    // Pressed slowly, then a step of the hand aside.
    const double led_m = -radius_m - 1.5 / 1000 - 1.5 / hand.stiffness_n_m;
    loop.place({0, 0, -radius_m - 1.5 / 1000});
    loop.lead({0, 0, led_m});
    loop.advance(0.3);
    loop.advance(0.5);
    loop.lead({0.1 * radius_m, 0, led_m});
    loop.advance(1e-3);
    std::vector<double> peaks;  // how wide it swings, in windows longer than a swing
    for (int window = 0; window < 8; ++window) {
      double low_m = 1, high_m = -1;
      for (int ms = 0; ms < 400; ++ms) {
        loop.advance(1e-3);
        low_m = std::min(low_m, loop.pen_m().x);
        high_m = std::max(high_m, loop.pen_m().x);
      }
      peaks.push_back(high_m - low_m);
    }
    steady_m = loop.steady_hollow_m();
    return std::log(peaks[7] / peaks[2]) / (5 * 0.4);
  };
  for (const auto& [rate_hz, age_s] : {std::pair{50.0, 0.02}, std::pair{1000.0, 0.03}}) {
    double steady_m = 0;
    growth_1_s(rate_hz, age_s, 0.05, steady_m);
    double growth[2], unused = 0;
    const double radius_m[2] = {0.85 * steady_m, 1.15 * steady_m};
    for (int n : {0, 1}) growth[n] = growth_1_s(rate_hz, age_s, radius_m[n], unused);
    const double border_m =
        radius_m[0] - growth[0] * (radius_m[1] - radius_m[0]) / (growth[1] - growth[0]);
    INFO(rate_hz << " Hz: " << 1e3 * steady_m << " mm said, " << 1e3 * border_m << " mm found; "
                 << growth[0] << " and " << growth[1] << " 1/s");
    CHECK(growth[0] > 0);
    CHECK(growth[1] < 0);
    CHECK(border_m == Approx(steady_m).epsilon(0.05));
  }
}

}  // namespace feltgate::page
