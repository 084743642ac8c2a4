// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two cores, bit by bit, around the pantograph: the shipped law's torque through limits, ramp,
// voltage law, PWM and supervisors of both axes. docs/devices/pantograph.md
#include <algorithm>
#include <string>
#include <vector>

#include "axes_twin.hpp"
#include "catch.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "feltgate/largest.hpp"
#include "image_axes.hpp"
#include "law/evaluate.hpp"
#include "law/read_law.hpp"
#include "pantograph_fixture.hpp"
#include "sampled_law.hpp"
#include "sim/plant/drive.hpp"
#include "two_axis_loop.hpp"

// A law file in real numbers as a law of joints. docs/devices/pantograph.md

namespace feltgate::plant {

class LawAxes {
 public:
  explicit LawAxes(const std::string& name)
      : law_(law::read_law(std::string(FELTGATE_SOURCE_DIR) + "/rtl/laws/" + name + ".law")),
        evaluation_(law_) {}
  LawAxes(const LawAxes&) = delete;  // the evaluation refers to the law in this object
  LawAxes& operator=(const LawAxes&) = delete;

  void set(const std::string& name, double si) {
    for (std::size_t i = 0; i < law_.parameters.size(); ++i) {
      if (law_.parameters[i].name == name) return evaluation_.set_parameter(i, si);
    }
    FAIL("the law has no parameter " << name);
  }
  std::array<double, 2> torque(const AxesMotion<2>& m) {
    inputs_.clear();
    for (const law::Input& input : law_.inputs) {
      const auto axis = static_cast<std::size_t>(input.axis);
      inputs_.push_back(input.source == law::Source::position ? m.theta_rad[axis]
                                                              : m.omega_rad_s[axis]);
    }
    evaluation_.run(inputs_);
    std::array<double, 2> torque{};
    for (std::size_t i = 0; i < law_.outputs.size(); ++i) {
      torque[static_cast<std::size_t>(law_.outputs[i].axis)] = evaluation_.outputs()[i];
    }
    return torque;
  }
  AxesLaw<2> axes() {
    return [this](const AxesMotion<2>& m) { return torque(m); };
  }

 private:
  law::Law law_;
  law::Evaluation<double> evaluation_;
  std::vector<double> inputs_;
};

}  // namespace feltgate::plant

using namespace feltgate;
using namespace feltgate::plant;
using Cores = AxesTwin<LeverLaw, Pantograph>;

namespace {

/// The motors of the design, without a capstan.
PantographParameters direct() {
  PantographParameters p = pantograph();
  p.joint.drum_radius_m = p.joint.pulley_radius_m;
  p.bodies.joint_inertia_kg_m2 = {p.joint.inertia_kg_m2(), p.joint.inertia_kg_m2()};
  return p;
}

/// The joints' counts at the start of the cores, as homing finds them.
std::array<std::int64_t, 2> home(const Pantograph& plant) {
  return {plant.encoder(0).count(), plant.encoder(1).count()};
}

/// A device that only reads the encoders.
struct Pins {
  static constexpr std::size_t axes = 2;
  struct Levels {
    EncoderPins levels;
    EncoderPins pins() const { return levels; }
  };
  const Levels& encoder(std::size_t axis) const { return now[axis]; }
  std::array<Levels, 2> now;
};

}  // namespace

TEST_CASE("an edge in the first stretch of clocks counts", "[cores]") {
  AxesTwin<LeverLaw, Pins> cores([](const AxesWords<2>&) { return std::array<std::int32_t, 2>{}; },
                                 {0, 0});
  Pins plant;
  std::array<std::vector<EncoderEvent>, 2> events;
  cores.act({0, events, plant});
  plant.now[1].levels = {true, false, false};
  events[1] = {{100, plant.now[1].levels}};
  cores.act({250, events, plant});
  events[1].clear();
  cores.act({500, events, plant});
  CHECK(cores.out(0).position == 0);
  CHECK(std::abs(cores.out(1).position) == 1);
}

TEST_CASE("two cores in closed loop: a floor and drag felt by a hand, passive", "[cores]") {
  const PantographParameters p = direct();
  PenPhase press;
  press.kind = PenPhase::Kind::kImpedance;
  press.y = {segment(Segment::Kind::kMinimumJerk, 0.1, 0.09), segment(Segment::Kind::kHold, 0.1),
             segment(Segment::Kind::kMinimumJerk, 0.1, 0.125)};
  Pantograph plant(p, p.effects, drive_of(design_info<LeverLaw>()),
                   PenHand{Vec2{0.0, 0.115}, {press}});
  constexpr double floor_m = 0.11, stiffness = 300.0;
  LawAxes law("pantograph");
  law.set("floor", floor_m);
  law.set("stiffness", stiffness);
  law.set("drag", 1.0);
  Cores cores(program_of<2>(law.axes(), design_info<LeverLaw>()), home(plant));
  const auto first = home(plant);
  TwoAxisLoop loop(plant, cores);
  double least_j = 0.0, deepest_m = 0.0, held_n = 0.0, held_m = 0.0;
  loop.run(clocks_of(0.35), [&](const Pantograph& now) {
    least_j = std::min(least_j, now.seen().hand_work_j);
    deepest_m = std::max(deepest_m, floor_m - now.seen().pen_m.y);
    if (now.seconds() > 0.199) return;
    held_n = now.seen().hand_n.y;
    held_m = floor_m - now.seen().pen_m.y;
  });
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(cores.out(i).armed);
    CHECK(cores.out(i).faults == 0);
    CHECK(cores.out(i).position + first[i] == plant.encoder(i).count());
    CHECK(std::abs(plant.encoder(i).count() - first[i]) > 20);
  }
  CHECK(cores.runs() > 349'990);
  CHECK(deepest_m > 2e-3);
  CHECK(held_n < -0.5);
  CHECK(held_n == Approx(-stiffness * held_m).margin(0.15));
  CHECK(least_j > -1e-6);
}

TEST_CASE("a program can only ask: ramp, limit and stop are the cores'", "[cores]") {
  const PantographParameters p = direct();
  PenPhase hold;
  hold.kind = PenPhase::Kind::kPrescribed;
  hold.x = hold.y = {segment(Segment::Kind::kHold, 1.0)};
  Pantograph plant(p, p.effects, drive_of(design_info<LeverLaw>()), PenHand{{}, {hold}});
  const AxesLaw<2> pushing = [](const AxesMotion<2>&) { return Joints{10.0, -0.05}; };
  Cores cores(program_of<2>(pushing, design_info<LeverLaw>()), home(plant));
  TwoAxisLoop loop(plant, cores);
  double most_step_nm = 0.0, last_nm = 0.0;
  loop.run(clocks_of(0.12), [&](const Pantograph&) {
    const double nm = std::ldexp(cores.out(0).tau_ref, -design_info<LeverLaw>().torque.fraction);
    most_step_nm = feltgate::larger(most_step_nm, nm - last_nm);
    last_nm = nm;
  });
  CHECK(most_step_nm < 5.0 * 5e-6 + 0x1p-16);  // 5 Nm/s, seen every 5 us
  CHECK(last_nm == Approx(0.5).epsilon(1e-4));
  CHECK(plant.seen().motor_nm[0] == Approx(0.5).epsilon(0.03));
  CHECK(plant.seen().motor_nm[1] == Approx(-0.05).epsilon(0.03));
  const Vec2 pushed = plant.seen().hand_n;
  CHECK(length(pushed) > 4.0);
  cores.stop(true);
  loop.run(clocks_of(0.125));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK_FALSE(cores.out(i).gates_enable);
    CHECK_FALSE(cores.out(i).armed);
    CHECK(cores.out(i).faults != 0);
    CHECK(plant.seen().current_a[i] == 0.0);
  }
  CHECK(length(plant.seen().hand_n) < 0.2);
}

TEST_CASE("the compiled law: its force at the pen is the linkage's, its place within 5 um",
          "[cores]") {
  const DesignInfo design = design_info<LeverLaw>();
  test::ImageAxes<2> image("pantograph", design);
  constexpr double stiffness = 1000.0, depth_m = 2e-3;
  image.set("stiffness", stiffness);
  image.set("drag", 0.0);
  const Linkage linkage(pantograph().linkage);
  double worst_m = 0.0, worst_nm = 0.0;
  for (int first = -300; first < 1700; first += 23) {
    for (int between = 228; between < 1820; between += 29) {
      AxesWords<2> words;
      words.position = {first, first + between};
      const LinkagePose p =
          linkage.pose({first * design.count_rad, (first + between) * design.count_rad});
      if (p.pen.y > 0.195) continue;
      image.set("floor", p.pen.y + depth_m);
      const auto raw = image.run(words);
      const Joints nm{std::ldexp(raw[0], -design.torque.fraction),
                      std::ldexp(raw[1], -design.torque.fraction)};
      const Joints asked = p.torque({0.0, stiffness * depth_m});
      for (std::size_t i = 0; i < 2; ++i) {
        worst_nm = feltgate::larger(worst_nm, std::abs(nm[i] - asked[i]));
      }
      // The depth that corresponds to the commanded force along y.
      worst_m = feltgate::larger(worst_m, std::abs(depth_m - p.force(nm).y / stiffness));
    }
  }
  INFO("height within " << 1e6 * worst_m << " um (a count is 153 um), torque within "
                        << 1e3 * worst_nm << " mNm of 2 N");
  CHECK(worst_m < 5e-6);
  CHECK(worst_nm < 0.1e-3);
  CHECK(image.compiled().rate_hz >= 250e3);
}

TEST_CASE("law file to bridge, bit by bit: two cores, the engine's words, a hand; passive",
          "[cores]") {
  const PantographParameters p = direct();
  PenPhase press;
  press.kind = PenPhase::Kind::kImpedance;
  press.y = {segment(Segment::Kind::kMinimumJerk, 0.1, 0.09), segment(Segment::Kind::kHold, 0.1),
             segment(Segment::Kind::kMinimumJerk, 0.1, 0.125)};
  Pantograph plant(p, p.effects, drive_of(design_info<LeverLaw>()),
                   PenHand{Vec2{0.0, 0.115}, {press}});
  constexpr double floor_m = 0.11, stiffness = 300.0;
  test::ImageAxes<2> image("pantograph", design_info<LeverLaw>());
  image.set("floor", floor_m);
  image.set("stiffness", stiffness);
  image.set("drag", 1.0);
  Cores cores(image.program(), home(plant), 2 * image.compiled().divider);
  TwoAxisLoop loop(plant, cores);
  double least_j = 0.0, deepest_m = 0.0, held_n = 0.0, held_m = 0.0;
  loop.run(clocks_of(0.35), [&](const Pantograph& now) {
    least_j = std::min(least_j, now.seen().hand_work_j);
    deepest_m = std::max(deepest_m, floor_m - now.seen().pen_m.y);
    if (now.seconds() > 0.199) return;
    held_n = now.seen().hand_n.y;
    held_m = floor_m - now.seen().pen_m.y;
  });
  CHECK(cores.out(0).armed);
  CHECK(cores.out(0).faults == 0);
  CHECK(cores.out(1).faults == 0);
  CHECK(deepest_m > 2e-3);
  CHECK(held_n < -0.5);
  CHECK(held_n == Approx(-stiffness * held_m).margin(0.15));
  CHECK(least_j > -1e-6);
}

// The shipped law of the pantograph in real numbers, against the linkage's own kinematics (no
// shared code) and in closed loop with the linkage. docs/devices/pantograph.md

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
