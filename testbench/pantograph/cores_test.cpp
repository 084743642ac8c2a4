// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two cores, bit by bit, around the pantograph: the shipped law's torque through limits, ramp,
// voltage law, PWM and supervisors of both axes. docs/pantograph.md
#include <algorithm>

#include "catch.hpp"
#include "feltgate/generated/lever_law.hpp"
#include "law_axes.hpp"
#include "loop/axes_twin.hpp"
#include "pantograph_fixture.hpp"
#include "plant/drive.hpp"
#include "plant/pantograph/two_axis_loop.hpp"

using namespace feltgate;
using namespace feltgate::plant;
using Cores = AxesTwin<LeverLaw, Pantograph>;

namespace {

/// The motors that the design is made for, without a capstan between.
PantographParameters direct() {
  PantographParameters p = pantograph();
  p.joint.drum_radius_m = p.joint.pulley_radius_m;
  p.bodies.joint_inertia_kg_m2 = {p.joint.inertia_kg_m2(), p.joint.inertia_kg_m2()};
  return p;
}

/// Where the joints are at the start of the cores, to the middle of a count: what homing finds.
Joints home(const Pantograph& plant) {
  Joints h;
  for (std::size_t i = 0; i < 2; ++i) {
    h[i] = (static_cast<double>(plant.encoder(i).count()) + 0.5) * plant.encoder(i).count_rad();
  }
  return h;
}

}  // namespace

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
  Cores cores(law.axes(), home(plant));
  const std::array<std::int64_t, 2> first{plant.encoder(0).count(), plant.encoder(1).count()};
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
  Cores cores([](const AxesMotion<2>&) { return Joints{10.0, -0.05}; }, home(plant));
  TwoAxisLoop loop(plant, cores);
  double most_step_nm = 0.0, last_nm = 0.0;
  loop.run(clocks_of(0.12), [&](const Pantograph&) {
    const double nm = std::ldexp(cores.out(0).tau_ref, -design_info<LeverLaw>().torque.fraction);
    most_step_nm = std::max(most_step_nm, nm - last_nm);
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
