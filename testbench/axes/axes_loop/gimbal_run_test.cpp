// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A handle turned once around against a spring between orientations: RTL and twin of three axes and
// their engine, the torques against the plant's own arithmetic. Documentation:
// docs/devices/three-axes.md
#include <cmath>
#include <string>

#include "axes_fixture.hpp"
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "sim/plant/gimbal/gimbal_mechanics.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr double kPi = 3.14159265358979323846;

/// What this in place of the scene's [hand] is refused with.
std::string refused(const std::string& hand) {
  return refusal(scene_head("gimbal", "gimbal") + "[hand]\n" + hand);
}

}  // namespace

TEST_CASE("gimbal: RTL and twin of three axes around the plant, the same outputs in every clock") {
  AxesScene scene = scene_named("gimbal");
  // From 165 degrees by some 37: over the half turn, where the torque turns round.
  std::get<GimbalSetup>(scene.device).hand.start_rad[0] = 165.0 * kPi / 180.0;
  scene.scenario.parameters["ramp_step"] = 1e-3;  // Nm a tick: all of it at once
  scene.scenario.duration_s = 0.08;
  scene.scenario.expectations.clear();
  const AxesResult r = run_scene(scene, "rtl,twin,double");
  INFO(r.first_mismatch);
  CHECK(r.lock_step);
  CHECK(r.mismatches == 0);
  CHECK(r.broken.empty());
  CHECK(r.figures.at("tau_ref_nm.0.min") < -0.39);
  CHECK(r.figures.at("tau_ref_nm.0.max") > 0.39);
  CHECK(r.figures.at("faults") == 0);
}

TEST_CASE("gimbal: a turn of 359 degrees is felt as the shorter way, by all three motors") {
  const AxesScene scene = scene_named("gimbal");
  const auto& set = scene.scenario.parameters;
  const plant::Quaternion to{set.at("dw"), 0.0, set.at("dy"), 0.0};
  const Rows rows(scene, 25);
  CHECK(rows.result().broken.empty());
  double worst_nm = 0.0, largest_rad = 0.0;
  int compared = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double time_s = 25e-6 * static_cast<double>(k);
    if (time_s < 0.02) continue;  // armed, and the ramp is over
    plant::GimbalJoints at{};
    for (std::size_t n = 0; n < 3; ++n) {
      at[n] = rows.of(k, "position_rad." + std::to_string(n));
    }
    const plant::GimbalPose pose = plant::gimbal_pose(at);
    largest_rad = feltgate::larger(largest_rad, at[0]);
    // Where both ways are as short, a count decides.
    if (std::abs((to * pose.handle.inverse()).w) < 0.01) continue;
    const plant::GimbalJoints asked =
        pose.torque(plant::coupling_nm(set.at("stiffness"), to, pose.handle));
    for (std::size_t n = 0; n < 3; ++n) {
      const double nm = rows.of(k, "tau_ref_nm." + std::to_string(n));
      worst_nm = feltgate::larger(worst_nm, std::abs(nm - asked[n]));
    }
    ++compared;
  }
  INFO("torque within " << 1e3 * worst_nm << " mNm of 0.4 Nm");
  CHECK(compared > 10000);
  CHECK(largest_rad > 359.0 * kPi / 180.0);
  // 49 rad/s for the 30 us from sample to torque, 0.2 Nm/rad, and what the bits cost.
  CHECK(worst_nm < 0.5e-3);
}

TEST_CASE("gimbal: a handle that stands where it begins is not moved by a law without torque") {
  AxesScene scene = scene_named("gimbal");
  auto& hand = std::get<GimbalSetup>(scene.device).hand;
  hand = {};
  hand.start_rad = {-1.0, 0.5, 1.5};
  scene.scenario.parameters["stiffness"] = 0.0;
  scene.scenario.arm_s = 0.001;
  scene.scenario.duration_s = 0.03;
  scene.scenario.expectations.clear();
  const AxesResult r = run_scene(scene, "twin,double");
  for (const std::string axis : {"0", "1", "2"}) {
    CHECK(std::abs(r.figures.at("velocity_rad_s." + axis + ".max")) < 0.1);
    CHECK(std::abs(r.figures.at("velocity_rad_s." + axis + ".min")) < 0.1);
    CHECK(std::abs(r.figures.at("motor_torque_nm." + axis + ".max")) < 2e-3);
    CHECK(std::abs(r.figures.at("motor_torque_nm." + axis + ".min")) < 2e-3);
    CHECK(r.figures.at("position_rad." + axis + ".swing") == 0);
  }
}

TEST_CASE("gimbal: a host that feeds too rarely is told, with the time without torque") {
  AxesScene scene = scene_named("gimbal");
  scene.scenario.duration_s = 0.1;
  scene.scenario.expectations.clear();
  CHECK(run_scene(scene, "twin,double").figures.at("law_stale_s") == 0);
  scene.scenario.feed_hz = 20;  // 50 ms, and 20 are the most
  const AxesResult r = run_scene(scene, "twin,double");
  CHECK(r.law_stale.seconds == Approx(0.06).margin(0.002));
  CHECK(r.law_stale.first_s == Approx(0.02).margin(0.002));
  CHECK(r.figures.at("law_stale_s") == r.law_stale.seconds);
}

TEST_CASE("gimbal: hands that cannot be used are refused with their line") {
  const std::string phase = "[[hand.phase]]\nkind = \"torque\"\n";
  const std::string torque = "torque = [{ kind = \"hold\", duration_s = 1 }]\n";
  CHECK(refused("") == "read");
  CHECK(refused(phase + "axis = [0, 3, 0]\n" + torque) == "read");
  CHECK(refused("start_deg = [0, 0]\n").find(":9: \"start_deg\" is not three numbers") !=
        std::string::npos);
  CHECK(refused("start_deg = [0, 90, 0]\n")
            .find(":9: the middle joint begins at 90 degrees, beyond "
                  "its stops; begin from -75 to 75") != std::string::npos);
  CHECK(refused(phase + "axis = [0, 0, 0]\n" + torque).find(":11: \"axis\" has no direction") !=
        std::string::npos);
  CHECK(refused(phase).find("\"torque\"") != std::string::npos);
  CHECK(refused("[[hand.phase]]\nkind = \"prescribed\"\n").find(":10: ") != std::string::npos);
  CHECK(refused("[plane]\nsphere_m = [0, 0, 0, 0.1]\n").find("a plane without a pen") !=
        std::string::npos);
}
