// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A law in closed loop with the pantograph, with sampling and delay: a wall and drag act on a hand.
// docs/devices/pantograph.md
#include "two_axis_loop.hpp"
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "pantograph_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

constexpr double kEdge = 0.11;

/// A hand that starts above the wall, presses 30 mm into it, slides to the side and comes back.
PenHand presser(double press_m = 0.08) {
  PenPhase phase;
  phase.kind = PenPhase::Kind::kImpedance;
  phase.y = {segment(Segment::Kind::kMinimumJerk, 0.4, press_m), segment(Segment::Kind::kHold, 0.6),
             segment(Segment::Kind::kMinimumJerk, 0.4, 0.13)};
  phase.x = {segment(Segment::Kind::kHold, 0.5), segment(Segment::Kind::kMinimumJerk, 0.4, 0.03)};
  PenHand hand;
  hand.start_m = Vec2{0.0, 0.13};
  hand.phases = {phase};
  return hand;
}

struct Felt {
  double deepest_m = 0.0, least_work_j = 0.0, work_j = 0.0;
  double held_n = 0.0, held_m = 0.0;  ///< force and depth after the slide
};

Felt feel(Pantograph& plant, const AxesLaw<2>& law, const Sampling& sampling, double seconds) {
  TwoAxisLaw device(law, sampling);
  TwoAxisLoop loop(plant, device);
  Felt felt;
  loop.run(clocks_of(seconds), [&](const Pantograph& p) {
    felt.deepest_m = std::max(felt.deepest_m, kEdge - p.seen().pen_m.y);
    felt.least_work_j = std::min(felt.least_work_j, p.seen().hand_work_j);
    if (p.seconds() < 0.99) {
      felt.held_n = p.seen().hand_n.y;
      felt.held_m = kEdge - p.seen().pen_m.y;
    }
  });
  felt.work_j = plant.seen().hand_work_j;
  return felt;
}

}  // namespace

TEST_CASE("the wall pushes and never pulls, drag is everywhere", "[loop]") {
  const WallAndDrag wall{kEdge, 300.0, 20.0, 2.0};
  const Vec2 in = wall.force_n({0.0, kEdge - 0.01}, {0.1, -0.05});
  CHECK(in.x == Approx(-0.2));
  CHECK(in.y == Approx(3.0 + 1.0 + 0.1));
  // Without a limit, the wall's damping would pull back a pen that leaves this fast.
  CHECK(wall.force_n({0.0, kEdge - 0.01}, {0.0, 0.5}).y == Approx(-1.0));
  CHECK(wall.force_n({0.0, kEdge + 0.01}, {0.0, -0.5}).y == Approx(1.0));
}

TEST_CASE("samples and delays lie on their clocks", "[loop]") {
  const PantographParameters p = pantograph();
  Pantograph plant(p, kNoEffects, Drive{});
  std::vector<Clock> asked, changed;
  Sampling sampling;
  sampling.rate_hz = 3e3;
  sampling.delay_s = 100e-6;
  double last = 0.0;
  TwoAxisLaw device(
      [&](const AxesMotion<2>&) {
        asked.push_back(plant.now());
        return Joints{1e-4 * static_cast<double>(asked.size()), 0.0};
      },
      sampling);
  TwoAxisLoop loop(plant, device);
  loop.run(clocks_of(2e-3), [&](const Pantograph& now) {
    if (now.seen().motor_nm[0] == last) return;
    last = now.seen().motor_nm[0];
    changed.push_back(now.now());
  });
  REQUIRE(asked.size() == 6);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    CHECK(asked[i] == std::llround(static_cast<double>(i) * 50e6 / 3e3));
  }
  REQUIRE(changed.size() == 6);
  // Seen at the end of the step that began with it, at most 250 clocks.
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(changed[i] > asked[i] + 5000);
    CHECK(changed[i] <= asked[i] + 5250);
  }
  CHECK(plant.now() == clocks_of(2e-3));
}

TEST_CASE("a device sees every edge between two calls once", "[loop]") {
  // Takes the place of a core's twin: it counts the pins and is called every 7000 clocks.
  struct Counter : TwoAxisDevice {
    std::array<std::size_t, 2> edges{};
    Clock asked = -1;
    AxesCommand<2> act(const AxesSense<Pantograph>& sense) override {
      for (std::size_t axis = 0; axis < 2; ++axis) {
        for (const EncoderEvent& e : sense.events[axis]) {
          CHECK(e.clock > asked);
          CHECK(e.clock <= sense.now);
          ++edges[axis];
        }
      }
      asked = sense.now;
      AxesCommand<2> c;
      c.bridges = {Bridge::averaged(0.15), Bridge::averaged(-0.12)};
      return c;
    }
    Clock next(Clock now) const override { return now + 7000; }
  } device;
  const PantographParameters p = pantograph();
  Pantograph plant(p, p.effects, Drive{});
  TwoAxisLoop loop(plant, device);
  const std::array<std::int64_t, 2> begin{plant.encoder(0).count(), plant.encoder(1).count()};
  loop.run(7000 * 300 + 1);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(device.edges[i] ==
          static_cast<std::size_t>(std::abs(plant.encoder(i).count() - begin[i])));
    CHECK(device.edges[i] > 20);
  }
}

TEST_CASE("wall: what the hand feels is stiffness times depth, and it is passive", "[loop]") {
  const PantographParameters p = pantograph();
  Effects on = p.effects;
  on.dead_time = false;  // the law's voltage does not compensate it: 0.6 N at this pose
  for (const bool voltage : {false, true}) {
    Pantograph plant(p, on, Drive{}, presser());
    WallAndDrag wall{kEdge, 300.0, 1.0, 0.0};
    Sampling sampling;
    sampling.rate_hz = 20e3;
    sampling.delay_s = 20e-6;
    sampling.voltage = voltage;
    const Felt felt = feel(plant, wall.law(plant.linkage()), sampling, 1.5);
    CHECK(felt.deepest_m > 3e-3);
    CHECK(felt.deepest_m < 0.03);
    // Dry friction of both joints may carry up to 0.16 N of it.
    CHECK(felt.held_n == Approx(-300.0 * felt.held_m).margin(0.25));
    CHECK(felt.held_n < -1.0);
    // Forth and back: the hand got no more energy than it gave, and lost some to friction.
    CHECK(felt.least_work_j > -1e-6);
    CHECK(felt.work_j > 1e-3);
    CHECK(plant.seen().pen_m.y > kEdge);
  }
}

TEST_CASE("drag: the force against the motion is drag times speed", "[loop]") {
  const PantographParameters p = pantograph();
  Effects on = kNoEffects;
  PenHand hand;
  hand.start_m = Vec2{-0.03, 0.12};
  PenPhase lead;
  lead.kind = PenPhase::Kind::kPrescribed;
  lead.x = {segment(Segment::Kind::kRamp, 1.0, 0.03)};
  lead.y = {segment(Segment::Kind::kRamp, 1.0, 0.14)};
  hand.phases = {lead};
  Pantograph plant(p, on, Drive{}, hand);
  Sampling sampling;
  sampling.encoder = false;
  TwoAxisLaw device(WallAndDrag{0.0, 0.0, 0.0, 20.0}.law(plant.linkage()), sampling);
  TwoAxisLoop loop(plant, device);
  double worst = 0.0;
  loop.run(clocks_of(0.9), [&](const Pantograph& now) {
    if (now.seconds() < 0.1) return;
    // The law's force only, without the force that bends the cranks' motion into a straight line.
    const LinkagePose pose = now.linkage().pose(now.seen().theta_rad);
    const Vec2 law = pose.force(now.seen().motor_nm);
    worst = feltgate::larger(worst, length(law + 20.0 * Vec2{0.06, 0.02}));
  });
  CHECK(worst < 5e-3);
  CHECK(plant.seen().hand_n.x == Approx(20.0 * 0.06).epsilon(0.02));
  CHECK(plant.seen().hand_n.y == Approx(20.0 * 0.02).epsilon(0.02));
  CHECK(plant.seen().hand_work_j == Approx(20.0 * (0.06 * 0.06 + 0.02 * 0.02) * 0.9).epsilon(0.02));
}

TEST_CASE("drag and wall together only take energy from a shaking hand", "[loop]") {
  const PantographParameters p = pantograph();
  PenPhase shake;
  shake.kind = PenPhase::Kind::kImpedance;
  shake.x = {sine(5.0, 0.03, 2.3, 0.0)};
  shake.y = {sine(5.0, 0.05, 3.1, 0.0)};
  Pantograph plant(p, p.effects, Drive{}, PenHand{Vec2{0.0, 0.12}, {shake}});
  Sampling sampling;
  sampling.rate_hz = 20e3;
  sampling.voltage = true;
  const Felt felt =
      feel(plant, WallAndDrag{kEdge, 300.0, 1.0, 3.0}.law(plant.linkage()), sampling, 1.5);
  CHECK(felt.deepest_m > 2e-3);
  CHECK(felt.least_work_j > -1e-6);
  CHECK(felt.work_j > 0.01);
}

TEST_CASE("a wall that is sampled too slowly gives energy, and the count shows it", "[loop]") {
  const PantographParameters p = pantograph();
  Effects on = kNoEffects;
  on.hand_dynamics = true;
  PenHand light = presser();
  light.phases[0].impedance.damping_ns_m = 0.0;
  light.phases[0].impedance.grip_damping_ns_m = 0.0;
  Sampling sampling;
  sampling.encoder = false;
  sampling.rate_hz = 144.0;
  sampling.delay_s = 2e-3;
  // The energy that a spring sampled every T gives is known to grow with its stiffness times T.
  double before = 0.0;
  for (const double stiffness : {150.0, 400.0}) {
    Pantograph plant(p, on, Drive{}, light);
    const Felt felt =
        feel(plant, WallAndDrag{kEdge, stiffness, 0.0, 0.0}.law(plant.linkage()), sampling, 1.5);
    CHECK(felt.least_work_j < before - 1e-4);
    before = felt.least_work_j;
  }
  // At 20 kHz the same spring gives back less than a hundredth of that.
  sampling.rate_hz = 20e3;
  sampling.delay_s = 0.0;
  Pantograph plant(p, on, Drive{}, light);
  const Felt felt =
      feel(plant, WallAndDrag{kEdge, 400.0, 0.0, 0.0}.law(plant.linkage()), sampling, 1.5);
  CHECK(felt.least_work_j > 0.01 * before);
}
