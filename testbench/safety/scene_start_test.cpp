// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A shipped scene with the self-test on: the expectations of the scene still hold.
// FELTGATE_SCENE names it. RTL and twin are in lock-step in `wall`, and with FELTGATE_WHOLE in
// all. Documentation: docs/blocks/safety.md
#include <algorithm>
#include <cstdlib>
#include <string>

#include "catch.hpp"
#include "mismatch.hpp"
#include "sim/loop/loop.hpp"
#include "sim/plant/plant_file.hpp"

using namespace feltgate;

namespace {

constexpr double kTest_s = 0.035;  // quiet, two pulses and what rounding to units adds

/// What follows soon after arming comes later by the test; until then the hand holds the lever.
void make_room(Scenario& scene) {
  if (scene.arm_s >= 0.05) return;
  scene.duration_s += kTest_s;
  for (Event& e : scene.events) e.at_s += kTest_s;
  if (scene.drag_from_s) *scene.drag_from_s += kTest_s;
  plant::HandPhase before;
  before.kind = plant::HandPhase::Kind::kLocked;
  before.duration_s = kTest_s;
  scene.hand.phases.insert(scene.hand.phases.begin(), before);
}

}  // namespace

TEST_CASE("self_test: a scene after the test is the scene") {
  const char* name = std::getenv("FELTGATE_SCENE");
  const char* design = std::getenv("FELTGATE_DESIGN");
  const std::string root = FELTGATE_ROOT;
  Scenario scene =
      read_scenario(root + "/vectors/scenes/" + (name != nullptr ? name : "damper") + ".toml");
  const plant::Parameters motor =
      plant::read_plant_file(root + "/vectors/plants/" + scene.plant + ".toml");
  resolve_effects(scene, motor.effects);
  make_room(scene);
  scene.parameters["self_test_pulse"] = 39;
  // The pulses are torques too.
  constexpr double pulse_nm = 0.0501;
  for (Expectation& x : scene.expectations) {
    if (x.figure == "tau_ref_min_nm") x.low = std::min(x.low, -pulse_nm);
    if (x.figure == "tau_ref_max_nm") x.high = std::max(x.high, pulse_nm);
  }
  RunOptions options;
  options.design = design != nullptr ? design : "lever";
  const bool whole = feltgate::test::whole_run();
  const bool beside_rtl = whole || name == nullptr || std::string(name) == "wall";
  options.engine = beside_rtl ? "rtl,twin" : "twin,double";
  bool too_soon = false;  // a torque before the lever was at rest for long enough
  const double quiet_s = 0.019;
  options.row = [&](const Row& r) {
    if (r.time_s < scene.arm_s + quiet_s && r.tau_ref_nm != 0) too_soon = true;
  };
  const RunResult r = run_scenario(scene, motor, options);
  CHECK(r.mismatches == 0);
  CHECK(r.first_mismatch.empty());
  for (const std::string& line : r.broken) FAIL_CHECK(line);
  CHECK_FALSE(too_soon);
  CHECK(r.figures.at("faults") == 0);
}
