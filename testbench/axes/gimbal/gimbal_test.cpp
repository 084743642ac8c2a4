// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Motors, encoders, hand and loop of the gimbal; its file. docs/devices/three-axes.md
#include <algorithm>
#include <fstream>

#include "../pantograph/sampled_law.hpp"
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "files/toml/toml_reader.hpp"
#include "gimbal_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;
using Kind = TurnPhase::Kind;

namespace {

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

/// A spring between the device's handle and `to`, as a law of the joints.
AxesLaw<3> coupled(double stiffness, double damping, Quaternion to) {
  return [=](const AxesMotion<3>& m) {
    const GimbalPose p = gimbal_pose(m.theta_rad);
    return p.torque(coupling_nm(stiffness, to, p.handle) - damping * p.turning(m.omega_rad_s));
  };
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

TEST_CASE("a coupling in closed loop: no flip from 181 to 359 degrees, passive", "[gimbal]") {
  const GimbalParameters p = gimbal();
  Effects on = p.effects;
  on.dead_time = false;
  for (const double degrees : {181.0, 270.0, 359.0}) {
    // Turned by so much about the outer axis, the handle comes back the shorter way: forward.
    TurningHand hand;
    hand.start_rad = {degrees * kDegree, 0.3, 0.1};
    Gimbal plant(p, on, Drive{}, hand);
    Sampling sampling;
    sampling.rate_hz = 20e3;
    sampling.delay_s = 20e-6;
    sampling.voltage = true;
    const Quaternion home = gimbal_pose({0.0, 0.3, 0.1}).handle;
    SampledLaw<Gimbal> device(coupled(0.4, 0.01, home), sampling);
    AxesLoop<Gimbal> loop(plant, device);
    double least_rad = hand.start_rad[0];
    loop.run(clocks_of(1.5),
             [&](const Gimbal& now) { least_rad = std::min(least_rad, now.seen().theta_rad[0]); });
    CHECK(least_rad > (degrees - 1.0) * kDegree);
    // Dry friction of 7 mNm at a joint leaves a small error.
    CHECK(angle_between(plant.seen().handle, home) < 0.05);
    CHECK(plant.seen().theta_rad[0] == Approx(360 * kDegree).margin(0.05));
  }
  TurningHand hand;
  hand.phases = {spring({0.6, 0.0, 0.8}, {sine(2.0, 0.7, 3.0, 0.0)})};
  Gimbal plant(p, on, Drive{}, hand);
  Sampling sampling;
  sampling.rate_hz = 20e3;
  sampling.voltage = true;
  SampledLaw<Gimbal> device(coupled(0.4, 0.01, {}), sampling);
  AxesLoop<Gimbal> loop(plant, device);
  double least_j = 0.0;
  loop.run(clocks_of(1.0),
           [&](const Gimbal& now) { least_j = std::min(least_j, now.seen().hand_work_j); });
  CHECK(least_j > -1e-6);
  CHECK(plant.seen().hand_work_j > 0.01);
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
