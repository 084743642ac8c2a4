// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Motors, encoders and hand of the gimbal; its file. docs/devices/three-axes.md
#include <algorithm>
#include <fstream>

#include "../../sim/plant/plant_fixture.hpp"
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/plant/gimbal/gimbal.hpp"

using namespace feltgate;
using namespace feltgate::plant;
using Kind = TurnPhase::Kind;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

std::string gimbal_file() {
  return std::string(FELTGATE_SOURCE_DIR) + "/vectors/devices/gimbal.toml";
}
GimbalParameters gimbal() { return read_gimbal_file(gimbal_file()); }

/// Three different moments in every body, so that no terms cancel.
GimbalBodies uneven_bodies() {
  return {{1e-4, 3e-4, 2e-4}, {4e-5, 7e-5, 9e-5}, {5e-5, 8e-5, 1.1e-4}, {3e-5, 5e-5, 2e-5}};
}

TurnPhase spring(Vec3 axis, Profile way) {
  TurnPhase phase;
  phase.kind = Kind::kSpring;
  phase.axis = axis;
  phase.way = std::move(way);
  return phase;
}

double angle_between(const Quaternion& a, const Quaternion& b) {
  const Quaternion q = a * b.inverse();
  return 2.0 * std::atan2(length(q.vector()), std::abs(q.w));
}

}  // namespace

TEST_CASE("gates turn each joint its own way", "[gimbal]") {
  const GimbalParameters p = gimbal();
  Effects on = p.effects;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Gimbal plant(p, on, Drive{});
    std::array<Bridge, 3> bridges{Bridge::gates(0, 1, 0, 1), Bridge::gates(0, 1, 0, 1),
                                  Bridge::gates(0, 1, 0, 1)};
    bridges[axis] = Bridge::gates(0.15, 0.85, 0, 1);
    std::array<std::int64_t, 3> edges{};
    while (plant.now() < clocks_of(0.05)) {
      plant.advance(bridges, 250);
      for (std::size_t i = 0; i < 3; ++i)
        edges[i] += static_cast<std::int64_t>(plant.events(i).size());
    }
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == axis) {
        CHECK(plant.seen().theta_rad[i] > 0.05);
        CHECK(edges[i] == plant.encoder(i).count());
        CHECK(edges[i] > 30);
      } else {
        CHECK(std::abs(plant.seen().theta_rad[i]) < 0.03);
      }
    }
    CHECK(angle_between(plant.seen().handle, gimbal_pose(plant.seen().theta_rad).handle) < 1e-7);
  }
}

TEST_CASE("all work is accounted for", "[gimbal]") {
  const GimbalParameters p = gimbal();
  Effects on = p.effects;
  on.viscous = true;
  TurningHand hand;
  hand.start_rad = {0.2, 0.5, -0.3};
  hand.phases = {spring({0, 1, 0}, {segment(Segment::Kind::kMinimumJerk, 0.3, 1.5)}),
                 spring({0.6, 0, 0.8}, {sine(0.5, 0.8, 4.0, 0.0)}),
                 {}};
  hand.phases[0].duration_s = 0.4;
  hand.phases[1].duration_s = 0.4;
  Gimbal plant(p, on, Drive{}, hand);
  const double begin_j = plant.stored_j();
  double worst_j = 0.0, most_rad = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double d = 0.06 * std::sin(1e-3 * i);
    plant.advance({Bridge::averaged(d), Bridge::averaged(-d), Bridge::averaged(0.05)}, 250);
    const GimbalSeen& s = plant.seen();
    const double in_j = s.hand_work_j + s.motor_work_j - s.dry_j - s.viscous_j - s.stop_j;
    worst_j = feltgate::larger(worst_j, std::abs(plant.stored_j() - begin_j - in_j));
    most_rad = feltgate::larger(most_rad, s.theta_rad[1]);
  }
  CHECK(worst_j < 1e-10);
  CHECK(most_rad > p.stops.most_rad);
  CHECK(plant.seen().stop_j > 1e-6);
  CHECK(plant.seen().dry_j > 1e-4);
  CHECK(plant.seen().viscous_j > 1e-5);
}

TEST_CASE("the hand leads the handle to its orientation; steered too", "[gimbal]") {
  const GimbalParameters p = gimbal();
  Effects none = kNoEffects;
  const Vec3 axis{0.6, 0.0, 0.8};
  TurningHand hand;
  hand.start_rad = {0.4, -0.3, 0.2};
  hand.phases = {spring(axis, {segment(Segment::Kind::kMinimumJerk, 0.3, 0.6)})};
  Gimbal plant(p, none, Drive{}, hand);
  const Quaternion begin = plant.seen().handle;
  while (plant.now() < clocks_of(0.6)) plant.advance(GimbalJoints{}, 250);
  const Quaternion expected = Quaternion::about(axis, 0.6) * begin;
  CHECK(angle_between(plant.seen().handle, expected) < 1e-3);
  CHECK(length(plant.seen().hand_nm) < 2e-3);
  plant.steer(begin, {});
  while (plant.now() < clocks_of(1.2)) plant.advance(GimbalJoints{}, 250);
  CHECK(angle_between(plant.seen().handle, begin) < 1e-3);
  // A torque at rest is held by the spring: stiffness times angle.
  const GimbalPose pose = gimbal_pose(plant.seen().theta_rad);
  const Vec3 nm{0.02, 0.01, -0.03};
  GimbalJoints torque = pose.torque(nm);
  while (plant.now() < clocks_of(2.0)) {
    torque = gimbal_pose(plant.seen().theta_rad).torque(nm);
    plant.advance(torque, 250);
  }
  CHECK(angle_between(plant.seen().handle, begin) ==
        Approx(2.0 * std::asin(length(nm) / 4.0)).epsilon(1e-3));
  CHECK(length(plant.seen().hand_nm + nm) < 1e-4);
}

TEST_CASE("motions that cannot be shown end the run", "[gimbal]") {
  GimbalParameters p = gimbal();
  p.encoder.lines = 1 << 20;
  Gimbal plant(p, p.effects, Drive{});
  const Bridge full = Bridge::averaged(1.0);
  CHECK_THROWS_AS(
      [&] {
        while (plant.now() < clocks_of(0.5)) plant.advance({full, full, full}, 250);
      }(),
      MotionError);
}

TEST_CASE("the file of a gimbal and its errors", "[gimbal_file]") {
  const GimbalParameters p = gimbal();
  CHECK(p.name == "gimbal");
  CHECK(p.joint.ratio() == Approx(2.0));
  CHECK(p.bodies.inner.z == 1.8e-4);
  CHECK(p.bodies.joint_inertia_kg_m2[2] == Approx(1e-5 + 4 * 1.38e-5));
  CHECK(p.stops.most_rad == Approx(75 * kDegree));
  std::ifstream in(gimbal_file());
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const auto error = [&text](const std::string& from, const std::string& to) {
    std::string changed = text;
    const auto at = changed.find(from);
    REQUIRE(at != std::string::npos);
    changed.replace(at, from.size(), to);
    try {
      (void)read_gimbal_text(changed, "x.toml");
    } catch (const config::ConfigError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  CHECK(error("name", "name") == "no error");
  CHECK(error("[9.0e-5, 9.0e-5, 1.8e-4]", "[9.0e-5, 9.0e-5, 1.9e-4]") ==
        "x.toml:11: one moment of \"inner_kg_m2\" is more than the sum of the others; no body is "
        "like that; correct it");
  CHECK(error("[9.0e-5, 9.0e-5, 1.8e-4]", "[9.0e-5]").find("is not three numbers") !=
        std::string::npos);
  CHECK(error("least_deg = -75.0", "least_deg = -95.0").find("out of range") != std::string::npos);
  CHECK(error("most_deg = 75.0", "most_deg = -80.0").find("leave the middle joint a way") !=
        std::string::npos);
  CHECK(error("[bodies]", "[body]").find("\"bodies\" is missing") != std::string::npos);
}

// Turns, mass matrix, energy and momentum of the gimbal. docs/devices/three-axes.md

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
