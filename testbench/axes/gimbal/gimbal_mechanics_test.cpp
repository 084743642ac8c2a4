// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Turns, mass matrix, energy and momentum of the gimbal. docs/devices/three-axes.md
#include <algorithm>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "gimbal_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix m{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) m[i][j] += a[i][k] * b[k][j];
    }
  }
  return m;
}

/// Rotation matrices from the textbook; the plant uses none.
Matrix turn(int axis, double rad) {
  const double c = std::cos(rad), s = std::sin(rad);
  if (axis == 2) return {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
  if (axis == 1) return {{{c, 0, s}, {0, 1, 0}, {-s, 0, c}}};
  return {{{1, 0, 0}, {0, c, -s}, {0, s, c}}};
}

/// Outer ring, inner ring, handle.
std::array<Matrix, 3> frames(const GimbalJoints& t) {
  const Matrix outer = turn(2, t[0]), inner = product(outer, turn(1, t[1]));
  return {outer, inner, product(inner, turn(0, t[2]))};
}

/// Energy of a body whose frame goes from `a` to `b`: half the second moments times the square of
/// how fast its points move, no angular velocity in between.
double body_j(const Matrix& a, const Matrix& b, Vec3 moments, double per_s) {
  // Principal second moments of mass: I_x = m_y + m_z and so on.
  const double sum = 0.5 * (moments.x + moments.y + moments.z);
  const double second[] = {sum - moments.x, sum - moments.y, sum - moments.z};
  double energy = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double v = (b[i][axis] - a[i][axis]) * per_s;
      energy += 0.5 * second[axis] * v * v;
    }
  }
  return energy;
}

double energy_by_differences(const GimbalBodies& b, const GimbalJoints& t, const GimbalJoints& w) {
  constexpr double h = 1e-5;
  GimbalJoints before = t, after = t;
  double energy = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    before[i] -= h * w[i];
    after[i] += h * w[i];
    energy += 0.5 * b.joint_inertia_kg_m2[i] * w[i] * w[i];
  }
  const auto f0 = frames(before), f1 = frames(after);
  return energy + body_j(f0[0], f1[0], b.outer, 0.5 / h) + body_j(f0[1], f1[1], b.inner, 0.5 / h) +
         body_j(f0[2], f1[2], b.handle, 0.5 / h);
}

template <class Check>
void everywhere(Check&& check) {
  for (double outer = -150; outer <= 150; outer += 75) {
    for (double middle = -75; middle <= 75; middle += 25) {
      for (double inner = -120; inner <= 120; inner += 40) {
        check(GimbalJoints{outer * kDegree, middle * kDegree, inner * kDegree});
      }
    }
  }
}

}  // namespace

TEST_CASE("the handle's orientation is Rz Ry Rx", "[gimbal]") {
  everywhere([](const GimbalJoints& t) {
    const GimbalPose p = gimbal_pose(t);
    const Matrix m = frames(t)[2];
    const Vec3 columns[] = {p.handle.turn({1, 0, 0}), p.handle.turn({0, 1, 0}),
                            p.handle.turn({0, 0, 1})};
    for (std::size_t j = 0; j < 3; ++j) {
      CHECK(columns[j].x == Approx(m[0][j]).margin(1e-14));
      CHECK(columns[j].y == Approx(m[1][j]).margin(1e-14));
      CHECK(columns[j].z == Approx(m[2][j]).margin(1e-14));
    }
  });
}

TEST_CASE("joint speeds turn the handle as its differences say", "[gimbal]") {
  constexpr double h = 1e-6;
  everywhere([](const GimbalJoints& t) {
    const GimbalPose p = gimbal_pose(t);
    for (std::size_t j = 0; j < 3; ++j) {
      GimbalJoints before = t, after = t, one{};
      before[j] -= h;
      after[j] += h;
      one[j] = 1.0;
      const Quaternion d = gimbal_pose(after).handle * gimbal_pose(before).handle.inverse();
      const Vec3 turning = p.turning(one), expected = 1.0 / h * d.vector();
      CHECK(length(turning - expected) < 1e-8);
      // The same in the handle's own frame.
      CHECK(length(p.handle.turn(p.handle_by[j]) - turning) < 1e-14);
      // Power at the handle equals power at the joints.
      const Vec3 nm{0.3, -0.2, 0.7};
      CHECK(p.torque(nm)[j] == Approx(dot(nm, turning)).margin(1e-15));
    }
  });
}

TEST_CASE("the mass matrix is the second derivative of the bodies' energy", "[gimbal]") {
  for (const GimbalBodies& bodies : {gimbal().bodies, uneven_bodies()}) {
    const GimbalMechanics mechanics(bodies, gimbal().stops);
    everywhere([&](const GimbalJoints& t) {
      const GimbalMatrix m = mechanics.mass(gimbal_pose(t));
      const auto energy = [&](double a, double b, double c) {
        return energy_by_differences(bodies, t, {a, b, c});
      };
      const double x = energy(1, 0, 0), y = energy(0, 1, 0), z = energy(0, 0, 1);
      const double near = 1e-8 * (x + y + z);
      CHECK(m.rows[0].x == Approx(2 * x).margin(near));
      CHECK(m.rows[1].y == Approx(2 * y).margin(near));
      CHECK(m.rows[2].z == Approx(2 * z).margin(near));
      CHECK(m.rows[0].y == Approx(energy(1, 1, 0) - x - y).margin(near));
      CHECK(m.rows[0].z == Approx(energy(1, 0, 1) - x - z).margin(near));
      CHECK(m.rows[1].z == Approx(energy(0, 1, 1) - y - z).margin(near));
      CHECK(m.rows[1].x == Approx(m.rows[0].y).margin(1e-18));
      CHECK(m.rows[2].x == Approx(m.rows[0].z).margin(1e-18));
      CHECK(m.rows[2].y == Approx(m.rows[1].z).margin(1e-18));
    });
  }
}

TEST_CASE("Coriolis torques are those of Lagrange's equation", "[gimbal]") {
  constexpr double h = 1e-5;
  const GimbalMechanics mechanics(uneven_bodies(), gimbal().stops);
  const GimbalJoints w{2.1, -3.3, 1.7};
  everywhere([&](const GimbalJoints& t) {
    const auto momentum = [&](double k) {
      return mechanics.mass(gimbal_pose({t[0] + k * w[0], t[1] + k * w[1], t[2] + k * w[2]}))
          .times(w);
    };
    const GimbalJoints after = momentum(h), before = momentum(-h);
    const GimbalJoints c = mechanics.coriolis(gimbal_pose(t), w);
    for (std::size_t j = 0; j < 3; ++j) {
      GimbalState low, high;
      low.theta_rad = high.theta_rad = t;
      low.theta_rad[j] -= h;
      high.theta_rad[j] += h;
      low.omega_rad_s = high.omega_rad_s = w;
      const double slope = (mechanics.kinetic_j(high) - mechanics.kinetic_j(low)) / (2 * h);
      CHECK(c[j] == Approx((after[j] - before[j]) / (2 * h) - slope).margin(1e-9));
    }
  });
}

TEST_CASE("without friction energy and outer momentum are constant over 10 s", "[gimbal]") {
  AngleStops elastic = gimbal().stops;
  elastic.restitution = 1.0;
  GimbalMechanics mechanics(uneven_bodies(), elastic);
  GimbalState s;
  s.theta_rad = {0.3, 0.4, -0.2};
  s.omega_rad_s = {4.0, -3.0, 5.0};
  const auto momentum = [&] {
    return mechanics.mass(gimbal_pose(s.theta_rad)).times(s.omega_rad_s)[0];
  };
  const double begin_j = mechanics.stored_j(s), begin = momentum();
  double worst_j = 0.0, worst = 0.0, most_rad = 0.0;
  for (int i = 0; i < 250000; ++i) {
    mechanics.step(s, {}, 40e-6);
    if (i % 8 != 0) continue;
    worst_j = feltgate::larger(worst_j, std::abs(mechanics.stored_j(s) - begin_j));
    worst = feltgate::larger(worst, std::abs(momentum() - begin));
    most_rad = feltgate::larger(most_rad, std::abs(s.theta_rad[1]));
  }
  INFO("energy within " << worst_j / begin_j << ", momentum within " << worst / begin);
  CHECK(worst_j / begin_j < 1e-6);
  CHECK(worst < 1e-6 * std::abs(begin));
  CHECK(most_rad > elastic.most_rad);
}

TEST_CASE("a free handle without rings keeps its angular momentum in space", "[gimbal]") {
  // Rings and motors of almost nothing: Euler's free body, its momentum constant as a vector.
  GimbalBodies bodies = uneven_bodies();
  bodies.outer = bodies.inner = {1e-12, 1e-12, 1e-12};
  bodies.joint_inertia_kg_m2 = {1e-12, 1e-12, 1e-12};
  GimbalMechanics mechanics(bodies, {-1.5, 1.5, 100.0, 1.0});
  GimbalState s;
  s.theta_rad = {0.0, 0.2, 0.0};
  s.omega_rad_s = {0.3, 0.2, 6.0};
  const auto momentum = [&] {
    const GimbalPose p = gimbal_pose(s.theta_rad);
    const Vec3 own = p.handle.inverse().turn(p.turning(s.omega_rad_s));
    return p.handle.turn(scaled(bodies.handle, own));
  };
  const Vec3 begin = momentum();
  for (int i = 0; i < 50000; ++i) {
    mechanics.step(s, {}, 20e-6);
    REQUIRE(std::abs(s.theta_rad[1]) < 1.5);
  }
  CHECK(length(momentum() - begin) < 1e-6 * length(begin));
}

TEST_CASE("the coupling goes the shorter way and comes from a potential", "[gimbal]") {
  const Vec3 axis{2.0 / 7, 3.0 / 7, 6.0 / 7};
  for (double degrees = 1; degrees < 360; degrees += 1) {
    const Vec3 nm = coupling_nm(0.1, Quaternion::about(axis, degrees * kDegree), {});
    const double sine = std::sin(0.5 * degrees * kDegree);
    if (std::abs(degrees - 180) < 0.5) continue;
    const double way = degrees < 180 ? 1.0 : -1.0;
    CHECK(dot(nm, axis) == Approx(way * 0.2 * sine).margin(1e-15));
    CHECK(length(nm - dot(nm, axis) * axis) < 1e-15);
    const auto energy = [&](double d) {
      return coupling_j(0.1, Quaternion::about(axis, d * kDegree), {});
    };
    CHECK((energy(degrees + 1e-4) - energy(degrees - 1e-4)) / (2e-4 * kDegree) ==
          Approx(dot(nm, axis)).margin(1e-7));
  }
  // 90 degrees about z against 90 about x: the turn between them is (0.5, -0.5, -0.5, 0.5).
  const Quaternion z = Quaternion::about({0, 0, 1}, 90 * kDegree);
  const Quaternion x = Quaternion::about({1, 0, 0}, 90 * kDegree);
  const Quaternion between = z * x.inverse();
  CHECK(between.w == Approx(0.5));
  CHECK(between.x == Approx(-0.5));
  CHECK(between.y == Approx(-0.5));
  CHECK(between.z == Approx(0.5));
  // -q is the same orientation.
  const Quaternion other{-z.w, -z.x, -z.y, -z.z};
  CHECK(length(coupling_nm(0.1, other, x) - coupling_nm(0.1, z, x)) < 1e-16);
}
