// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Mass matrix against differentiated places of the links, energy, momentum, convergence.
// docs/devices/pantograph.md
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "pantograph_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;

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
