// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The hand at the pen: closed forms, phases, balance of all energies. docs/devices/pantograph.md
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "pantograph_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;
using Kind = PenPhase::Kind;

namespace {

PenHand hand_at_rest(Vec2 pen) {
  PenHand hand;
  hand.start_m = pen;
  PenPhase phase;
  phase.kind = Kind::kImpedance;
  hand.phases = {phase};
  return hand;
}

PenPhase towards(Kind kind, Segment::Kind segment_kind, double seconds, Vec2 to) {
  PenPhase phase;
  phase.kind = kind;
  phase.x = {segment(segment_kind, seconds, to.x)};
  phase.y = {segment(segment_kind, seconds, to.y)};
  return phase;
}

void run(Pantograph& plant, const Joints& torque, double seconds, Clock step = 250) {
  const Clock end = plant.now() + clocks_of(seconds);
  while (plant.now() < end) plant.advance(torque, step);
}

double out_of_balance_j(const Pantograph& plant, double begin_j) {
  const PantographSeen& s = plant.seen();
  return plant.stored_j() - begin_j -
         (s.hand_work_j + s.motor_work_j - s.dry_j - s.viscous_j - s.stop_j);
}

}  // namespace

TEST_CASE("pen hand: static displacement is force over stiffness, in both directions", "[pen]") {
  const PantographParameters p = pantograph();
  const Vec2 start{0.02, 0.11}, force{0.4, -0.3};
  Pantograph plant(p, kNoEffects, Drive{}, hand_at_rest(start));
  Effects dynamic = kNoEffects;
  dynamic.hand_dynamics = true;
  plant = Pantograph(p, dynamic, Drive{}, hand_at_rest(start));
  // The torques follow the position, so that the force at the pen is constant.
  for (int i = 0; i < 250000; ++i) {
    plant.advance(plant.linkage().pose(plant.seen().theta_rad).torque(force), 500);
  }
  const double per_n = 1.0 / 135.0 + 1.0 / 3000.0;
  CHECK(plant.seen().pen_m.x - start.x == Approx(force.x * per_n).epsilon(1e-5));
  CHECK(plant.seen().pen_m.y - start.y == Approx(force.y * per_n).epsilon(1e-5));
  CHECK(plant.seen().hand_m.x - start.x == Approx(force.x / 135.0).epsilon(1e-5));
  CHECK(plant.seen().hand_n.x == Approx(-force.x).epsilon(1e-4));
  CHECK(plant.seen().hand_n.y == Approx(-force.y).epsilon(1e-4));
}

TEST_CASE("pen hand: a rigid grip swings with the closed form's frequency", "[pen]") {
  // A hand of 0.554 kg on 135 N/m; the linkage adds little beside it and its pen mass is known.
  PantographParameters p = pantograph();
  Effects on = kNoEffects;
  on.hand_dynamics = true;
  PenHand hand = hand_at_rest({0.0, 0.1});
  hand.phases[0].impedance.damping_ns_m = 0.0;
  hand.phases[0].impedance.grip_stiffness_n_m = 3e4;
  hand.phases[0].x = {segment(Segment::Kind::kStep, 1.0, 1e-4)};
  Pantograph plant(p, on, Drive{}, hand);
  // Mass at the pen along x: 1/(J M^-1 J') there.
  const LinkagePose pose = plant.linkage().pose(plant.seen().theta_rad);
  const Joints moved = plant.dynamics().mass(pose).solve(pose.torque({1.0, 0.0}));
  const double mass = 1.0 / pose.pen_speed(moved).x;
  CHECK(mass > 0.05);
  const double rad_s = std::sqrt(135.0 / (0.554 + mass));
  // Crossings of the middle, upwards.
  double first = 0.0, last = 0.0, before = 0.0;
  int swings = -1;
  while (plant.seconds() < 2.5) {
    plant.advance(Joints{}, 250);
    const double now = plant.seen().hand_m.x - 1e-4;
    if (before < 0.0 && now >= 0.0) {
      last = plant.seconds() - 5e-6 * now / (now - before);
      if (++swings == 0) first = last;
    }
    before = now;
  }
  REQUIRE(swings > 3);
  CHECK(6.283185307 * swings / (last - first) == Approx(rad_s).epsilon(3e-4));
}

TEST_CASE("pen hand: along an even motion it does not lag, for its damper moves too", "[pen]") {
  const PantographParameters p = pantograph();
  Effects on = kNoEffects;
  on.hand_dynamics = true;
  PenHand hand = hand_at_rest({-0.04, 0.12});
  hand.phases[0].x = {segment(Segment::Kind::kRamp, 2.0, 0.06)};
  Pantograph plant(p, on, Drive{}, hand);
  run(plant, {}, 1.5);
  // A damper to the ground would hold it back by 6.45*0.05/135 = 2.4 mm.
  CHECK(plant.seen().hand_m.x == Approx(-0.04 + 0.05 * 1.5).margin(2e-4));
}

TEST_CASE("all work is accounted for: hand, motors, friction, stops", "[pen]") {
  const PantographParameters p = pantograph();
  Effects on = p.effects;
  on.viscous = true;
  PenHand hand = hand_at_rest({0.0, 0.1});
  hand.phases[0].duration_s = 0.5;
  hand.phases[0].x = {sine(0.5, 0.03, 3.0, 0.3)};
  hand.phases[0].y = {segment(Segment::Kind::kMinimumJerk, 0.3, 0.16)};
  // Against the stop at 20 degrees, where the pen is 0.197 m away.
  hand.phases.push_back(towards(Kind::kImpedance, Segment::Kind::kMinimumJerk, 0.3, {0.0, 0.25}));
  hand.phases[1].duration_s = 0.5;
  hand.phases.push_back(towards(Kind::kForce, Segment::Kind::kRamp, 0.1, {0.5, -2.0}));
  hand.phases[2].duration_s = 0.1;
  hand.phases.push_back({});
  Pantograph plant(p, on, Drive{}, hand);
  const double begin_j = plant.stored_j();
  double least_between = 10.0, worst_j = 0.0;
  for (int i = 0; i < 240000; ++i) {
    plant.advance({Bridge::averaged(0.05 * std::sin(1e-3 * i)), Bridge::averaged(-0.04)}, 250);
    least_between = std::min(least_between, plant.seen().theta_rad[1] - plant.seen().theta_rad[0]);
    worst_j = feltgate::larger(worst_j, std::abs(out_of_balance_j(plant, begin_j)));
  }
  const PantographSeen& s = plant.seen();
  CHECK(worst_j < 1e-10);
  CHECK(least_between < p.stops.least_rad);
  CHECK(s.stop_j > 1e-6);
  CHECK(s.dry_j > 1e-3);
  CHECK(s.viscous_j > 1e-5);
  CHECK(std::abs(s.motor_work_j) > 1e-4);
  CHECK(s.hand_work_j > 1e-3);
}

TEST_CASE("pen hand: whatever it does, linkage and friction only take energy", "[pen]") {
  const PantographParameters p = pantograph();
  for (const double hz : {1.0, 7.0, 40.0}) {
    PenHand hand = hand_at_rest({0.01, 0.12});
    hand.phases[0].x = {sine(5.0, 0.06, hz, 0.0)};
    hand.phases[0].y = {sine(5.0, 0.05, 1.7 * hz, 1.0)};
    Pantograph plant(p, p.effects, Drive{}, hand);
    double least = 0.0;
    for (int i = 0; i < 100000; ++i) {
      plant.advance({Bridge::off(), Bridge::off()}, 250);
      least = std::min(least, plant.seen().hand_work_j);
    }
    CHECK(least > -1e-9);
    CHECK(plant.seen().hand_work_j > 1e-4);
    CHECK(plant.seen().dry_j > 0.0);
  }
}

TEST_CASE("an imposed motion: places, Newton's force, the work of a cycle", "[pen]") {
  const PantographParameters p = pantograph();
  PenHand hand;
  hand.start_m = Vec2{0.0, 0.1};
  hand.phases = {towards(Kind::kPrescribed, Segment::Kind::kMinimumJerk, 0.2, {0.05, 0.14})};
  Pantograph plant(p, kNoEffects, Drive{}, hand);
  run(plant, {}, 0.1, 25);
  CHECK(plant.seen().pen_m.x == Approx(0.025).epsilon(1e-12));
  CHECK(plant.seen().pen_m.y == Approx(0.12).epsilon(1e-12));
  CHECK(plant.seen().pen_m_s.x == Approx(1.875 * 0.05 / 0.2).epsilon(1e-9));
  // At rest at both ends: all the work was returned.
  run(plant, {}, 0.2, 25);
  CHECK(plant.seen().pen_m.x == Approx(0.05).epsilon(1e-12));
  CHECK(plant.seen().hand_work_j == Approx(0.0).margin(1e-8));
  CHECK(length(plant.seen().hand_n) == Approx(0.0).margin(1e-9));

  // The force that moves the free linkage along the same way.
  const Vec2 again{0.0, 0.1};
  Pantograph led(p, kNoEffects, Drive{}, hand);
  Pantograph pushed(p, kNoEffects, Drive{}, PenHand{again, {}});
  for (int i = 0; i < 200000; ++i) {
    led.advance(Joints{}, 25);
    const LinkagePose pose = pushed.linkage().pose(pushed.seen().theta_rad);
    pushed.advance(pose.torque(led.seen().hand_n), 25);
  }
  CHECK(pushed.seen().pen_m.x == Approx(led.seen().pen_m.x).margin(2e-6));
  CHECK(pushed.seen().pen_m.y == Approx(led.seen().pen_m.y).margin(2e-6));
}

TEST_CASE("pen hand: steered, taken over, without dynamics", "[pen]") {
  const PantographParameters p = pantograph();
  Pantograph plant(p, p.effects, Drive{}, PenHand{});
  run(plant, {}, 0.01);
  CHECK(plant.seen().pen_m.y == Approx(0.1).epsilon(1e-9));
  PenPhase hold;
  hold.kind = Kind::kImpedance;
  plant.take(hold);
  run(plant, {}, 0.01);
  plant.steer({0.03, 0.13}, {});
  run(plant, {}, 2.0);
  CHECK(plant.seen().hand_m.x == Approx(0.03).margin(3e-3));
  CHECK(plant.seen().hand_m.y == Approx(0.13).margin(3e-3));
  plant.take({});
  run(plant, {}, 0.2);
  CHECK(length(plant.seen().hand_n) == 0.0);
  CHECK(plant.next_corner() > clocks_of(1e6));

  Effects stiff = p.effects;
  stiff.hand_dynamics = false;
  PenHand imposed = hand_at_rest({0.0, 0.12});
  imposed.phases[0].x = {segment(Segment::Kind::kRamp, 0.1, 0.02)};
  Pantograph led(p, stiff, Drive{}, imposed);
  CHECK(led.next_corner() == 1);
  run(led, {}, 0.05);
  CHECK(led.next_corner() == clocks_of(0.1));
  CHECK(led.seen().pen_m.x == Approx(0.01).epsilon(1e-9));
}

TEST_CASE("a hand that leads the pen out of reach ends the run with its time", "[pen]") {
  const PantographParameters p = pantograph();
  PenHand hand;
  hand.phases = {towards(Kind::kPrescribed, Segment::Kind::kRamp, 1.0, {0.0, 0.3})};
  Pantograph straight(p, p.effects, Drive{}, hand);
  CHECK_THROWS_AS(run(straight, {}, 1.0), MotionError);
  CHECK(straight.seconds() == Approx(0.5).epsilon(1e-3));
  hand.phases = {towards(Kind::kPrescribed, Segment::Kind::kHold, 0.5, {}),
                 towards(Kind::kPrescribed, Segment::Kind::kStep, 1.0, {0.0, 0.3})};
  hand.phases[0].duration_s = 0.5;
  Pantograph plant(p, p.effects, Drive{}, hand);
  CHECK_THROWS_WITH(run(plant, {}, 1.0),
                    Catch::Matchers::Contains("after 0.5") &&
                        Catch::Matchers::Contains("the hand puts the pen where it cannot be"));
  CHECK_THROWS_AS(Pantograph(p, p.effects, Drive{}, PenHand{Vec2{0.3, 0.0}, {}}),
                  std::invalid_argument);
}
