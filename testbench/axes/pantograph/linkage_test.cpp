// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Geometry of the linkage: positions, Jacobian, inverse. docs/devices/pantograph.md
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "pantograph_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

/// Calls `check(theta)` over the whole range of the cranks.
template <class Check>
void everywhere(Check&& check) {
  for (double first = -60.0; first <= 150.0; first += 15.0) {
    for (double between = 20.0; between <= 160.0; between += 10.0) {
      check(Joints{first * kDegree, (first + between) * kDegree});
    }
  }
}

}  // namespace

TEST_CASE("the rhombus at 30 and 150 degrees: place and torques", "[linkage]") {
  const Linkage linkage(pantograph().linkage);
  const LinkagePose p = linkage.pose({30 * kDegree, 150 * kDegree});
  CHECK(p.pen.x == Approx(0.0).margin(1e-16));
  CHECK(p.pen.y == Approx(0.1).epsilon(1e-14));
  const Joints right = p.torque({1.0, 0.0}), up = p.torque({0.0, 1.0});
  CHECK(right[0] == Approx(-0.05).epsilon(1e-13));
  CHECK(right[1] == Approx(-0.05).epsilon(1e-13));
  CHECK(up[0] == Approx(0.1 * std::cos(30 * kDegree)).epsilon(1e-13));
  CHECK(up[1] == Approx(-0.1 * std::cos(30 * kDegree)).epsilon(1e-13));
}

TEST_CASE("a rhombus adds its cranks", "[linkage]") {
  const Linkage linkage(pantograph().linkage);
  everywhere([&](const Joints& t) {
    const LinkagePose p = linkage.pose(t);
    CHECK(p.pen.x == Approx(0.1 * (std::cos(t[0]) + std::cos(t[1]))).margin(1e-15));
    CHECK(p.pen.y == Approx(0.1 * (std::sin(t[0]) + std::sin(t[1]))).margin(1e-15));
    // Opposite links stay parallel.
    CHECK(p.rod_1_by[0] == Approx(0.0).margin(1e-12));
    CHECK(p.rod_1_by[1] == Approx(1.0).epsilon(1e-12));
    CHECK(p.rod_5_by[0] == Approx(1.0).epsilon(1e-12));
    CHECK(p.rods_cross_m2 == Approx(-0.01 * std::sin(t[1] - t[0])).epsilon(1e-12));
  });
}

TEST_CASE("all links keep their lengths, the pen stays beyond the elbows", "[linkage]") {
  for (const LinkageGeometry& g : {pantograph().linkage, uneven()}) {
    const Linkage linkage(g);
    everywhere([&](const Joints& t) {
      const LinkagePose p = linkage.pose(t);
      CHECK(length(p.elbow_1) == Approx(g.crank_1_m).epsilon(1e-14));
      CHECK(length(p.elbow_5 - Vec2{-g.base_m, 0.0}) == Approx(g.crank_5_m).epsilon(1e-14));
      CHECK(length(p.pen - p.elbow_1) == Approx(g.rod_1_m).epsilon(1e-13));
      CHECK(length(p.pen - p.elbow_5) == Approx(g.rod_5_m).epsilon(1e-13));
      CHECK(cross(p.pen - p.elbow_1, p.elbow_5 - p.elbow_1) > 0.0);
    });
  }
}

TEST_CASE("Jacobian and turns of the rods against differences", "[linkage]") {
  constexpr double h = 1e-5;
  for (const LinkageGeometry& g : {pantograph().linkage, uneven()}) {
    const Linkage linkage(g);
    everywhere([&](const Joints& t) {
      const LinkagePose p = linkage.pose(t);
      const auto slope = [&](std::size_t joint, auto&& of) {
        Joints a = t, b = t;
        a[joint] -= h;
        b[joint] += h;
        return (of(linkage.pose(b)) - of(linkage.pose(a))) * (0.5 / h);
      };
      for (std::size_t j = 0; j < 2; ++j) {
        const Vec2 by = j == 0 ? p.pen_by_1 : p.pen_by_5;
        const double near = 1e-6 * (1.0 + length(by));
        CHECK(by.x == Approx(slope(j, [](const LinkagePose& q) { return q.pen.x; })).margin(near));
        CHECK(by.y == Approx(slope(j, [](const LinkagePose& q) { return q.pen.y; })).margin(near));
        const auto turn = [](Vec2 from, Vec2 v) {
          return std::atan2(cross(from, v), dot(from, v));
        };
        CHECK(p.rod_1_by[j] == Approx(slope(j, [&](const LinkagePose& q) {
                                 return turn(p.rod_1, q.rod_1);
                               })).margin(1e-6));
        CHECK(p.rod_5_by[j] == Approx(slope(j, [&](const LinkagePose& q) {
                                 return turn(p.rod_5, q.rod_5);
                               })).margin(1e-6));
      }
    });
  }
}

TEST_CASE("accelerations at constant speeds against second differences", "[linkage]") {
  constexpr double h = 1e-4;
  const Joints omega{1.3, -0.8};
  for (const LinkageGeometry& g : {pantograph().linkage, uneven()}) {
    const Linkage linkage(g);
    everywhere([&](const Joints& t) {
      const LinkagePose p = linkage.pose(t);
      const LinkageSwing s = linkage.swing(p, omega);
      const auto at = [&](double k) {
        return linkage.pose({t[0] + k * omega[0], t[1] + k * omega[1]});
      };
      const LinkagePose before = at(-h), after = at(h);
      const Vec2 pen = 1.0 / (h * h) * (after.pen - 2.0 * p.pen + before.pen);
      CHECK(s.pen.x == Approx(pen.x).margin(2e-5).epsilon(1e-4));
      CHECK(s.pen.y == Approx(pen.y).margin(2e-5).epsilon(1e-4));
      const auto speed = [&](const LinkagePose& q) { return dot(q.rod_1_by, omega); };
      CHECK(s.rod_1 == Approx((speed(after) - speed(before)) / (2 * h)).margin(1e-5).epsilon(1e-4));
      const auto speed_5 = [&](const LinkagePose& q) { return dot(q.rod_5_by, omega); };
      CHECK(s.rod_5 ==
            Approx((speed_5(after) - speed_5(before)) / (2 * h)).margin(1e-5).epsilon(1e-4));
    });
  }
}

TEST_CASE("force, speeds and torques are inverse to each other", "[linkage]") {
  const Linkage linkage(uneven());
  everywhere([&](const Joints& t) {
    const LinkagePose p = linkage.pose(t);
    const Vec2 force{0.3, -1.1}, speed{0.2, 0.5};
    const Vec2 again = p.force(p.torque(force));
    CHECK(again.x == Approx(force.x).epsilon(1e-9));
    CHECK(again.y == Approx(force.y).epsilon(1e-9));
    const Vec2 moved = p.pen_speed(p.omega(speed));
    CHECK(moved.x == Approx(speed.x).epsilon(1e-9));
    CHECK(moved.y == Approx(speed.y).epsilon(1e-9));
    // Power at the pen equals power at the joints.
    CHECK(dot(p.torque(force), p.omega(speed)) == Approx(dot(force, speed)).epsilon(1e-9));
  });
}

TEST_CASE("inverse kinematics finds the angles, turns of them too", "[linkage]") {
  const Linkage linkage(pantograph().linkage);
  for (const double turns : {0.0, 1.0, -2.0}) {
    everywhere([&](Joints t) {
      for (double& a : t) a += turns * 360 * kDegree;
      const auto back = linkage.inverse(linkage.pose(t).pen, t[0] + 0.5);
      REQUIRE(back);
      CHECK((*back)[0] == Approx(t[0]).margin(1e-12));
      CHECK((*back)[1] == Approx(t[1]).margin(1e-12));
    });
  }
  const Linkage other(uneven());
  for (const Vec2 pen : {Vec2{0.0, 0.12}, Vec2{0.05, 0.1}, Vec2{-0.08, 0.09}}) {
    const auto theta = other.inverse(pen);
    REQUIRE(theta);
    const Vec2 back = other.pose(*theta).pen;
    CHECK(back.x == Approx(pen.x).margin(1e-14));
    CHECK(back.y == Approx(pen.y).margin(1e-14));
  }
  CHECK_FALSE(linkage.inverse({0.15, 0.15}));
  CHECK_FALSE(linkage.inverse({0.0, 0.0}));
  CHECK_FALSE(other.inverse({0.0, 0.001}));
}

TEST_CASE("rods that do not reach each other show as NaN", "[linkage]") {
  LinkageGeometry g = pantograph().linkage;
  g.rod_1_m = g.rod_5_m = 0.05;
  CHECK(std::isnan(Linkage(g).pose({0.0, 120 * kDegree}).pen.x));
  CHECK_FALSE(std::isnan(Linkage(g).pose({0.0, 50 * kDegree}).pen.x));
}

// Stops between the cranks: restitution, energy, a hand that leans on them.

namespace {

double between(const LinkageState& s) { return s.theta_rad[1] - s.theta_rad[0]; }

LinkageState closing(const AngleStops& stops, bool low, double rad_s) {
  LinkageState s;
  const double gap = low ? stops.least_rad + 0.02 : stops.most_rad - 0.02;
  // Symmetric about the vertical, so that all the energy goes into the stop.
  s.theta_rad = {90 * kDegree - 0.5 * gap, 90 * kDegree + 0.5 * gap};
  const double w = low ? rad_s : -rad_s;
  s.omega_rad_s = {0.5 * w, -0.5 * w};
  return s;
}

}  // namespace

TEST_CASE("a stop gives back restitution squared of the energy, at both ends", "[stops]") {
  for (const double restitution : {0.1, 0.3, 0.7, 1.0}) {
    for (const bool low : {true, false}) {
      AngleStops stops = pantograph().stops;
      stops.restitution = restitution;
      LinkageMechanics mechanics = frictionless(stops);
      LinkageState s = closing(stops, low, 5.0);
      const double before = mechanics.stored_j(s);
      double deepest = 0.0;
      for (int i = 0; i < 20000; ++i) {
        mechanics.step(s, {}, 1e-6);
        deepest = std::max({deepest, stops.least_rad - between(s), between(s) - stops.most_rad});
      }
      const double after = mechanics.stored_j(s);
      CHECK(after ==
            Approx(restitution * restitution * before).epsilon(1e-4).margin(1e-6 * before));
      CHECK(mechanics.stop_loss_j() == Approx(before - after).epsilon(1e-6).margin(1e-12));
      CHECK(0.5 * stops.stiffness_nm_rad * deepest * deepest == Approx(before).epsilon(1e-4));
      if (restitution > 0.2) CHECK(between(s) > stops.least_rad);
      if (restitution > 0.2) CHECK(between(s) < stops.most_rad);
    }
  }
}

TEST_CASE("steps that end anywhere in a contact keep the energy of an elastic stop", "[stops]") {
  AngleStops stops = pantograph().stops;
  stops.restitution = 1.0;
  for (double dt = 2e-6; dt < 60e-6; dt *= 1.37) {
    LinkageMechanics mechanics = frictionless(stops);
    LinkageState s = closing(stops, true, 5.0);
    const double before = mechanics.stored_j(s);
    for (int i = 0; i < 4000; ++i) mechanics.step(s, {}, dt);
    CHECK(mechanics.stored_j(s) == Approx(before).epsilon(1e-8));
  }
}

TEST_CASE("no contact ever adds energy, whatever the step", "[stops]") {
  for (const double restitution : {0.1, 0.4, 0.95}) {
    for (const double dt : {1e-6, 5e-6, 20e-6}) {
      AngleStops stops = pantograph().stops;
      stops.restitution = restitution;
      LinkageMechanics mechanics = frictionless(stops);
      LinkageState s = closing(stops, false, 20.0);
      s.omega_rad_s[0] += 3.0;
      s.omega_rad_s[1] += 3.0;
      double last = mechanics.stored_j(s), most_gain = 0.0;
      const double begin = last;
      for (int i = 0; i < 20000; ++i) {
        mechanics.step(s, {}, dt);
        const double now = mechanics.stored_j(s);
        most_gain = feltgate::larger(most_gain, now - last);
        last = now;
      }
      CHECK(most_gain < 1e-9 * begin);
      CHECK(last < 0.99 * begin);
    }
  }
}

TEST_CASE("a hand that leans on a stop and trembles gets no energy from it", "[stops]") {
  for (const double restitution : {0.2, 0.7, 1.0}) {
    AngleStops stops = pantograph().stops;
    stops.restitution = restitution;
    LinkageMechanics mechanics = frictionless(stops);
    LinkageState s = closing(stops, true, 0.0);
    LinkageLoad load;
    const double begin = mechanics.stored_j(s);
    double least = 0.0, worst = 0.0;
    bool pressed = false;
    for (int i = 0; i < 100000; ++i) {
      const double t = 5e-6 * i;
      load.force_n = {0.1 * std::sin(900.0 * t), 8.0 + 6.0 * std::sin(2500.0 * t)};
      mechanics.step(s, load, 5e-6);
      least = std::min(least, s.hand_work_j);
      pressed = pressed || between(s) < stops.least_rad;
      // The hand's work equals the stored energy plus the loss in the stop; the stop never adds
      // energy.
      const double there = mechanics.stored_j(s) - begin + mechanics.stop_loss_j();
      worst = feltgate::larger(worst, std::abs(there - s.hand_work_j));
    }
    CHECK(worst < 1e-9);
    CHECK(pressed);
    CHECK(mechanics.stop_loss_j() >= -1e-12);
    CHECK(least > -1e-9);
  }
}

TEST_CASE("a resting stop holds a force at its static depth", "[stops]") {
  AngleStops stops = pantograph().stops;
  LinkageMechanics mechanics = frictionless(stops);
  LinkageState s = closing(stops, true, 0.0);
  LinkageLoad load;
  load.viscous_nm_s_rad = 5e-3;
  load.force_n = {0.0, 5.0};
  for (int i = 0; i < 200000; ++i) mechanics.step(s, load, 5e-6);
  const Joints torque = mechanics.linkage().pose(s.theta_rad).torque(load.force_n);
  // On the way back from a deepest point that was at most twice as deep.
  const double depth = stops.least_rad - between(s), least = torque[0] / stops.stiffness_nm_rad;
  CHECK(depth >= least * (1 - 1e-3));
  CHECK(depth <= least * (2.0 - stops.restitution * stops.restitution) * (1 + 1e-3));
  CHECK(std::abs(s.omega_rad_s[1] - s.omega_rad_s[0]) < 1e-3);
}

// Mass matrix against differentiated places of the links, energy, momentum, convergence.

namespace {

struct Placed {
  Vec2 centre;
  double angle;
};

/// Centres and angles of all links, by the law of cosines at elbow 1.
std::array<Placed, 5> places(const LinkageGeometry& g, const LinkageBodies& b, const Joints& t) {
  const auto along = [](double angle) { return Vec2{std::cos(angle), std::sin(angle)}; };
  const Vec2 elbow_1 = g.crank_1_m * along(t[0]);
  const Vec2 elbow_5 = Vec2{-g.base_m, 0.0} + g.crank_5_m * along(t[1]);
  const Vec2 between = elbow_5 - elbow_1;
  const double d = length(between);
  const double corner =
      std::acos((g.rod_1_m * g.rod_1_m + d * d - g.rod_5_m * g.rod_5_m) / (2.0 * g.rod_1_m * d));
  const double rod_1 = std::atan2(between.y, between.x) - corner;
  const Vec2 pen = elbow_1 + g.rod_1_m * along(rod_1);
  const double rod_5 = std::atan2(pen.y - elbow_5.y, pen.x - elbow_5.x);
  return {Placed{b.crank_1.centre_m * along(t[0]), t[0]},
          Placed{elbow_1 + b.rod_1.centre_m * along(rod_1), rod_1},
          Placed{elbow_5 + b.rod_5.centre_m * along(rod_5), rod_5},
          Placed{Vec2{-g.base_m, 0.0} + b.crank_5.centre_m * along(t[1]), t[1]}, Placed{pen, 0.0}};
}

/// Kinetic energy of links, pen and joints from differences of their places.
double kinetic_by_differences(const LinkageGeometry& g, const LinkageBodies& b, const Joints& t,
                              const Joints& omega) {
  constexpr double h = 1e-5;
  const auto before = places(g, b, {t[0] - h * omega[0], t[1] - h * omega[1]});
  const auto after = places(g, b, {t[0] + h * omega[0], t[1] + h * omega[1]});
  const std::array<LinkBody, 5> bodies{b.crank_1, b.rod_1, b.rod_5, b.crank_5,
                                       LinkBody{b.pen_kg, 0.0, 0.0}};
  double energy = 0.5 * (b.joint_inertia_kg_m2[0] * omega[0] * omega[0] +
                         b.joint_inertia_kg_m2[1] * omega[1] * omega[1]);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Vec2 v = 0.5 / h * (after[i].centre - before[i].centre);
    const double w = std::remainder(after[i].angle - before[i].angle, 360 * kDegree) * 0.5 / h;
    energy += 0.5 * bodies[i].mass_kg * dot(v, v) + 0.5 * bodies[i].inertia_kg_m2 * w * w;
  }
  return energy;
}

LinkageState moving_at(double first_deg, double second_deg, double w1, double w5) {
  LinkageState s;
  s.theta_rad = {first_deg * kDegree, second_deg * kDegree};
  s.omega_rad_s = {w1, w5};
  return s;
}

}  // namespace

TEST_CASE("the mass matrix is the second derivative of the links' energy", "[dynamics]") {
  const PantographParameters p = pantograph();
  const std::pair<LinkageGeometry, LinkageBodies> linkages[] = {{p.linkage, p.bodies},
                                                                {uneven(), uneven_bodies()}};
  for (const auto& [geometry, bodies] : linkages) {
    const LinkageDynamics dynamics(geometry, bodies);
    for (double first = -60; first < 150; first += 25) {
      for (double between = 20; between <= 160; between += 20) {
        const Joints t{first * kDegree, (first + between) * kDegree};
        const auto energy = [&, &g = geometry, &b = bodies](double w1, double w5) {
          return kinetic_by_differences(g, b, t, {w1, w5});
        };
        const LinkagePose pose = dynamics.linkage().pose(t);
        const JointMatrix m = dynamics.mass(pose);
        const double m11 = 2 * energy(1, 0), m55 = 2 * energy(0, 1);
        CHECK(m.m11 == Approx(m11).epsilon(1e-7));
        CHECK(m.m55 == Approx(m55).epsilon(1e-7));
        CHECK(m.m15 == Approx(energy(1, 1) - energy(1, 0) - energy(0, 1)).margin(1e-7 * m11));
        CHECK(m.m11 * m.m55 > m.m15 * m.m15);
        CHECK(dynamics.kinetic_j(pose, {0.7, -1.2}) ==
              Approx(kinetic_by_differences(geometry, bodies, t, {0.7, -1.2})).epsilon(1e-7));
      }
    }
  }
}

TEST_CASE("the rhombus' mass matrix is its closed form", "[dynamics]") {
  // Rods are parallel to the opposite cranks: P3 = P2 + P4, so every centre is a sum of two cranks.
  const PantographParameters p = pantograph();
  const LinkageDynamics dynamics(p.linkage, p.bodies);
  const double l2 = 0.01, link = p.bodies.rod_1.mass_kg, pen = p.bodies.pen_kg;
  const double own = p.joint.inertia_kg_m2() + 2 * p.bodies.rod_1.inertia_kg_m2 +
                     l2 * (0.25 * link + link + 0.25 * link + pen);
  for (double between = 20; between <= 160; between += 5) {
    const JointMatrix m = dynamics.mass(dynamics.linkage().pose({0.3, 0.3 + between * kDegree}));
    CHECK(m.m11 == Approx(own).epsilon(1e-12));
    CHECK(m.m55 == Approx(own).epsilon(1e-12));
    CHECK(m.m15 == Approx(l2 * (link + pen) * std::cos(between * kDegree)).margin(1e-17));
  }
}

TEST_CASE("Coriolis torques are those of Lagrange's equation", "[dynamics]") {
  constexpr double h = 1e-5;
  for (const auto& [geometry, bodies] :
       {std::pair{pantograph().linkage, pantograph().bodies}, {uneven(), uneven_bodies()}}) {
    const LinkageDynamics dynamics(geometry, bodies);
    const Joints w{3.1, -2.4};
    for (double between = 20; between <= 160; between += 20) {
      const Joints t{0.2, 0.2 + between * kDegree};
      const auto mass = [&, &d = dynamics](double d1, double d5) {
        return d.mass(d.linkage().pose({t[0] + d1, t[1] + d5}));
      };
      // d/dt(M w) - dT/dtheta at constant w.
      const Joints after = mass(h * w[0], h * w[1]).times(w);
      const Joints before = mass(-h * w[0], -h * w[1]).times(w);
      const auto energy = [&](double d1, double d5) { return 0.5 * dot(w, mass(d1, d5).times(w)); };
      const Joints c = dynamics.coriolis(dynamics.linkage().pose(t), w);
      CHECK(c[0] ==
            Approx((after[0] - before[0] - energy(h, 0) + energy(-h, 0)) / (2 * h)).margin(1e-9));
      CHECK(c[1] ==
            Approx((after[1] - before[1] - energy(0, h) + energy(0, -h)) / (2 * h)).margin(1e-9));
    }
  }
}

TEST_CASE("without friction the energy is constant over 10 s", "[dynamics]") {
  // Between elastic stops, and with separate motor axes: only the energy is conserved.
  struct Case {
    LinkageMechanics mechanics;
    LinkageState state;
    double turns;
  };
  AngleStops elastic = pantograph().stops;
  elastic.restitution = 1.0;
  AngleStops near{60 * kDegree, 120 * kDegree, 100.0, 1.0};
  for (Case c :
       {Case{frictionless(elastic), moving_at(30, 150, 6.0, -4.0), 1},
        Case{LinkageMechanics(uneven(), uneven_bodies(), near), moving_at(60, 160, 1.0, 2.0), 0}}) {
    const double begin_j = c.mechanics.stored_j(c.state);
    double least = begin_j, most = begin_j;
    int contacts = 0;
    bool touched = false;
    constexpr double dt = 40e-6;
    for (int i = 0; i < 250000; ++i) {
      c.mechanics.step(c.state, {}, dt);
      if (i % 8 != 0) continue;
      const double now = c.mechanics.stored_j(c.state);
      least = std::min(least, now);
      most = feltgate::larger(most, now);
      const double between = c.state.theta_rad[1] - c.state.theta_rad[0];
      const AngleStops& s = c.turns > 0 ? elastic : near;
      const bool touches = between < s.least_rad || between > s.most_rad;
      contacts += touches && !touched ? 1 : 0;
      touched = touches;
    }
    // The figures of the page: linkage_test "[dynamics]" -s
    INFO("energy within " << (most - least) / begin_j << ", contacts " << contacts);
    CHECK(contacts > 5);
    CHECK(std::isfinite(most));
    CHECK((most - least) / begin_j < 1e-6);
    CHECK(c.mechanics.stop_loss_j() == Approx(0.0).margin(1e-9 * begin_j));
  }
}

TEST_CASE("both motors at one point: angular momentum is constant, through stops too",
          "[dynamics]") {
  LinkageMechanics mechanics = frictionless(pantograph().stops);
  LinkageState s = moving_at(30, 120, 8.0, -3.0);
  const auto momentum = [&] {
    const Joints p =
        mechanics.dynamics().mass(mechanics.linkage().pose(s.theta_rad)).times(s.omega_rad_s);
    return p[0] + p[1];
  };
  const double begin = momentum();
  for (int i = 0; i < 50000; ++i) mechanics.step(s, {}, 20e-6);
  CHECK(mechanics.stop_loss_j() > 0.0);
  CHECK(momentum() == Approx(begin).epsilon(1e-9));
}

TEST_CASE("the step of linkage and hand is of fourth order", "[dynamics]") {
  LinkageLoad load;
  load.torque_nm = {0.02, -0.03};
  load.viscous_nm_s_rad = 1e-3;
  load.hand = true;
  load.hand_per_kg = 1.0 / 0.3;
  load.stiffness_n_m = 150.0;
  load.damping_ns_m = 4.0;
  load.grip_stiffness_n_m = 1500.0;
  load.grip_damping_ns_m = 5.0;
  load.target_m = {0.02, 0.12};
  const auto end = [&](int steps) {
    LinkageMechanics mechanics(uneven(), uneven_bodies(), kFarStops);
    LinkageState s = moving_at(40, 130, 5.0, -6.0);
    s.hand_m = mechanics.linkage().pose(s.theta_rad).pen;
    for (int i = 0; i < steps; ++i) mechanics.step(s, load, 0.05 / steps);
    return s;
  };
  const LinkageState exact = end(20000);
  const auto error = [&](const LinkageState& s) {
    return std::abs(s.theta_rad[0] - exact.theta_rad[0]) +
           std::abs(s.theta_rad[1] - exact.theta_rad[1]) +
           std::abs(s.hand_work_j - exact.hand_work_j) + length(s.hand_m - exact.hand_m);
  };
  const double coarse = error(end(50)), fine = error(end(100));
  CHECK(coarse / fine > 12.0);
  CHECK(coarse / fine < 20.0);
  CHECK(fine < 1e-5);
}
