// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The shipped law of the pantograph in real numbers, against the linkage's own kinematics (no
// shared code) and in closed loop with the linkage. docs/devices/pantograph.md
#include "catch.hpp"
#include "law_axes.hpp"
#include "pantograph_fixture.hpp"
#include "two_axis_loop.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

constexpr double kFloor = 0.11, kStiffness = 300.0, kDrag = 1.5;

void give(LawAxes& file) {
  file.set("floor", kFloor);
  file.set("stiffness", kStiffness);
  file.set("drag", kDrag);
}

}  // namespace

TEST_CASE("the law file asks what J of the linkage says, everywhere", "[law]") {
  LawAxes file("pantograph");
  give(file);
  const Linkage linkage(pantograph().linkage);
  int inside = 0;
  for (double first = -60; first <= 150; first += 7) {
    for (double between = 20; between <= 160; between += 7) {
      const AxesMotion<2> m{{first * kDegree, (first + between) * kDegree}, {1.1, -2.3}};
      const LinkagePose p = linkage.pose(m.theta_rad);
      Vec2 force = -kDrag * p.pen_speed(m.omega_rad_s);
      if (p.pen.y < kFloor) force.y += kStiffness * (kFloor - p.pen.y);
      inside += p.pen.y < kFloor ? 1 : 0;
      const Joints expected = p.torque(force), asked = file.torque(m);
      CHECK(asked[0] == Approx(expected[0]).margin(1e-12));
      CHECK(asked[1] == Approx(expected[1]).margin(1e-12));
    }
  }
  CHECK(inside > 100);
}

TEST_CASE("the law file in closed loop: a floor and drag, passive", "[law]") {
  const PantographParameters p = pantograph();
  LawAxes file("pantograph");
  give(file);
  PenPhase press;
  press.kind = PenPhase::Kind::kImpedance;
  press.y = {segment(Segment::Kind::kMinimumJerk, 0.3, 0.08), segment(Segment::Kind::kHold, 0.4),
             segment(Segment::Kind::kMinimumJerk, 0.3, 0.13)};
  press.x = {segment(Segment::Kind::kHold, 0.2), segment(Segment::Kind::kMinimumJerk, 0.4, 0.03)};
  Effects on = p.effects;
  on.dead_time = false;
  Pantograph plant(p, on, Drive{}, PenHand{Vec2{0.0, 0.13}, {press}});
  Sampling sampling;
  sampling.rate_hz = 20e3;
  sampling.delay_s = 10e-6;
  sampling.voltage = true;
  TwoAxisLaw device(file.axes(), sampling);
  TwoAxisLoop loop(plant, device);
  double least_j = 0.0, deepest_m = 0.0, held_n = 0.0, held_m = 0.0;
  loop.run(clocks_of(1.2), [&](const Pantograph& now) {
    least_j = std::min(least_j, now.seen().hand_work_j);
    deepest_m = std::max(deepest_m, kFloor - now.seen().pen_m.y);
    if (now.seconds() > 0.69) return;
    held_n = now.seen().hand_n.y;
    held_m = kFloor - now.seen().pen_m.y;
  });
  CHECK(deepest_m > 3e-3);
  CHECK(held_n < -1.0);
  CHECK(held_n == Approx(-kStiffness * held_m).margin(0.25));  // dry friction
  CHECK(least_j > -1e-6);
  CHECK(plant.seen().hand_work_j > 1e-3);
}
