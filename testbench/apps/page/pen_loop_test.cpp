// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The page's pen: a hand that swings as its closed form, a square that holds it back with the
// computed force, another law under the same pen. Documentation: docs/page.md
#include <algorithm>
#include <cmath>
#include <string>

#include "apps/page/law_loops.hpp"
#include "catch.hpp"
#include "feltgate/design_info.hpp"
#include "law/compile.hpp"
#include "sim/backends/backend.hpp"
#include "studies/shape/rhombus.hpp"
#include "studies/shape/shape_law.hpp"

namespace feltgate::page {
namespace {

const std::string root = FELTGATE_ROOT;

std::string image_of(double centre_x_m) {
  shape::Placing placing;
  placing.centre_m = {centre_x_m, 0.12};
  const auto outline = shape::placed(shape::read_svg(root + "/vectors/shapes/square.svg"), placing);
  const shape::Polygon polygon = shape::sampled(shape::rounded(outline, 2e-3), 40);
  const auto law = law::compile_text(shape::law_text(polygon, {"square"}), "square.law",
                                     law::target_of(design_named("lever")));
  return law::text(law.image);
}

const plant::Impedance hand;

}  // namespace

TEST_CASE("page: outside the shape the pen follows the hand as its closed form") {
  PenLoop loop(image_of(0));
  loop.place({0.04, 0.12});
  loop.lead({0.05, 0.12});
  const double dt = loop.law().period_s();
  CHECK(1 / dt == Approx(1e6 / 13));
  loop.advance(dt);  // the step of the hand, within a run
  const double w0 = std::sqrt(hand.stiffness_n_m / hand.mass_kg);
  const double a = hand.damping_ns_m / hand.mass_kg / 2, w = std::sqrt(w0 * w0 - a * a);
  for (int k = 1; k <= 40; ++k) {
    loop.advance(0.01);
    const double t = loop.time_s();
    // The step goes through the damper too: x = 1 - e^(-at) (cos wt - a/w sin wt).
    const double x = 1 - std::exp(-a * t) * (std::cos(w * t) - a / w * std::sin(w * t));
    INFO("at " << t << " s");
    CHECK(loop.pen_m().x == Approx(0.04 + 0.01 * x).margin(2e-6));
    CHECK(std::fabs(loop.pen_m().y - 0.12) < 1e-9);
    CHECK(std::hypot(loop.force_n().x, loop.force_n().y) == 0);
  }
}

TEST_CASE("page: in a square the hand and the law hold each other") {
  PenLoop loop(image_of(0));
  for (const double stiffness : {30.0, 50.0, 120.0}) {
    loop.set("stiffness", stiffness);
    loop.place({0.04, 0.12});
    loop.advance(0.02);
    // 10 mm behind the face at 30 mm: depth d with K d = K_hand (10 mm - d).
    loop.lead({0.02, 0.12});
    loop.advance(0.01);
    loop.advance(1.5);
    const double depth = 0.01 * hand.stiffness_n_m / (hand.stiffness_n_m + stiffness);
    INFO(stiffness << " N/m");
    // A count is 153 um of the pen, and angles are cut, not rounded.
    CHECK(loop.pen_m().x == Approx(0.03 - depth).margin(160e-6));
    CHECK(loop.force_n().x == Approx(stiffness * depth).margin(stiffness * 160e-6));
    CHECK(std::fabs(loop.force_n().y) < stiffness * 160e-6);
  }
  CHECK_THROWS_AS(loop.set("stiffness", 1000), std::invalid_argument);
  CHECK_THROWS_AS(loop.set("hardness", 10), std::invalid_argument);
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
  PenLoop loop(image_of(0));
  loop.set("damping", 0.15);
  loop.place({0.04, 0.11});
  loop.advance(0.02);
  loop.lead({0.02, 0.11});
  loop.advance(0.01);
  loop.advance(1);
  loop.lead({0.02, 0.13});
  for (int k = 0; k < 10; ++k) {
    loop.advance(0.01);
    INFO(loop.velocity_m_s().y << " m/s");
    CHECK(loop.force_n().y == Approx(-0.15 * loop.velocity_m_s().y).margin(1e-3));
  }
  CHECK(loop.velocity_m_s().y > 0.05);
}

TEST_CASE("page: another law takes the pen where it is, and it stays within reach") {
  const std::string left = image_of(-0.03);
  PenLoop loop(image_of(0));
  loop.place({0.02, 0.12});
  loop.advance(0.1);
  CHECK(loop.force_n().x > 0.1);  // inside, from the start: the nearest face
  loop.load(left);
  loop.advance(0.5);
  CHECK(std::hypot(loop.force_n().x, loop.force_n().y) == 0);
  for (const shape::Point p : {shape::Point{1, 1},
                               {-1, 0.1},
                               {0, 0},
                               {0, -1},
                               {0.001, 0.03},
                               {NAN, 0.1},
                               {0.1, INFINITY}}) {
    loop.lead(p);
    loop.advance(0.3);
    const double r = std::hypot(loop.pen_m().x, loop.pen_m().y);
    CHECK(std::isfinite(r));
    CHECK(r >= PenLoop::nearest_m - 1e-9);
    CHECK(r <= PenLoop::farthest_m + 1e-9);
    CHECK(loop.pen_m().y >= PenLoop::front_m - 1e-9);
  }
  CHECK_THROWS_AS(loop.load("nonsense"), std::invalid_argument);
}

}  // namespace feltgate::page
