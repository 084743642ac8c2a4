// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two levers coupled: what the second meets and the hand feels, drag, and the border of stability,
// position to position against the observer's torque. docs/devices/pantograph.md
#include <algorithm>
#include <string>
#include <vector>

#include "axes_fixture.hpp"
#include "catch.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

AxesScene scene_with(const std::string& name, double stiffness, double damping, double share) {
  AxesScene scene = scene_named(name);
  scene.scenario.parameters["stiffness"] = stiffness;
  scene.scenario.parameters["damping"] = damping;
  scene.scenario.parameters["share"] = share;
  scene.scenario.expectations.clear();
  return scene;
}

/// How far the levers swing against each other early and late after a push, rad.
struct Swing {
  double early_rad = 0, late_rad = 0;
};
Swing pushed(double stiffness, double damping, double share) {
  const AxesScene scene = scene_with("coupled_levers_free", stiffness, damping, share);
  const std::vector<std::string> columns = axes_columns(scene);
  const auto at = [&](const char* name) {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) -
                                    columns.begin());
  };
  const std::size_t first = at("theta_rad.0"), second = at("theta_rad.1");
  double low[2] = {1e9, 1e9}, high[2] = {-1e9, -1e9};
  (void)run_scene(
      scene, "twin",
      [&](const std::vector<double>& row) {
        const double s = row[0], apart = row[first] - row[second];
        const int part = s >= 0.05 && s < 0.1 ? 0 : s >= 0.25 ? 1 : -1;
        if (part < 0) return;
        low[part] = std::min(low[part], apart);
        high[part] = std::max(high[part], apart);
      },
      50);
  return {high[0] - low[0], high[1] - low[1]};
}

}  // namespace

TEST_CASE("a jump of the speed that a lever's hand imposes is told") {
  AxesScene scene = scene_named("coupled_levers");
  scene.scenario.duration_s = 0.03;
  scene.scenario.expectations.clear();
  CHECK(run_scene(scene, "twin").speed_jumps.empty());
  std::get<TwoLeversSetup>(scene.device).hand[0].phases[0].profile[1].kind =
      plant::Segment::Kind::kRamp;
  const std::vector<std::string> told = run_scene(scene, "twin").speed_jumps;
  REQUIRE(told.size() == 1);
  CHECK(told[0].find("coupled_levers.toml:25: the hand's speed jumps by 2 rad/s at 0.02 s") !=
        std::string::npos);
}

// By the observer's torque the scenes coupled_levers and coupled_levers_drag say both.
TEST_CASE("coupled levers: position to position the law's spring is in series, and both drag") {
  const AxesResult spring = run_scene(scene_with("coupled_levers", 4, 0.005, 0), "twin");
  // 4.5 mNm of dry friction at 0.3 Nm are 1.5 %.
  CHECK(-spring.figures.at("tau_ref_nm.0.end") / spring.figures.at("theta_rad.0.end") ==
        Approx(4.0 / 5.0).epsilon(0.03));
  // 2 rad of way against 3.5 mNm of each motor.
  const AxesResult drag = run_scene(scene_with("coupled_levers_drag", 4, 0.005, 0), "twin");
  CHECK(drag.figures.at("hand_energy_j") == Approx(14e-3).epsilon(0.07));
}

TEST_CASE("coupled levers: the border position to position is between 10 and 14 Nm/rad") {
  // 5 % by position alone would need 19 Nm/rad.
  const Swing below = pushed(10, 0.005, 0), above = pushed(14, 0.005, 0);
  CHECK(below.late_rad < 0.85 * below.early_rad);
  CHECK(above.late_rad > 1.3 * above.early_rad);
}

TEST_CASE("coupled levers: the observer's torque costs some of that border") {
  CHECK(pushed(4, 0.005, 1).late_rad < 6e-3);
  CHECK(pushed(8, 0.005, 1).late_rad > 50e-3);
  CHECK(pushed(8, 0.005, 0).late_rad < 6e-3);
}

TEST_CASE("coupled levers: RTL and twin in every clock, the law within its bound") {
  AxesScene scene = scene_with("coupled_levers_free", 4, 0.005, 0.5);
  scene.scenario.duration_s = 0.045;  // the push begins at 0.03 s
  const AxesResult r = run_scene(scene, "all");
  INFO(r.first_mismatch);
  CHECK(r.mismatches == 0);
  CHECK(r.broken.empty());
  CHECK(r.axes[0].law_error_nm.count() > 15'000);
  CHECK(r.figures.at("tau_ref_nm.0.swing") > 0.02);
  CHECK(r.figures.at("tau_ref_nm.1.swing") > 0.02);
}
