// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The numbers that must come out of the closed loop (simulation) beside what the scenes expect: the
// paper's error pattern, the lever with another resistance, no wind-up. The twin runs them; that it
// is the RTL is shown elsewhere. Documentation: docs/testing.md
#include <cmath>
#include <string>

#include "catch.hpp"
#include "sim/loop/loop.hpp"
#include "sim/plant/plant_file.hpp"

namespace {

using namespace feltgate;

const std::string kRoot = FELTGATE_ROOT;

Scenario scenario(const std::string& name) {
  return read_scenario(kRoot + "/vectors/scenes/" + name + ".toml");
}

plant::Parameters p24() { return plant::read_plant_file(kRoot + "/vectors/plants/p24.toml"); }

RunResult run(Scenario scene, const plant::Parameters& plant, const std::string& design) {
  resolve_effects(scene, plant.effects);
  RunOptions options;
  options.design = design;
  options.engine = "twin";
  return run_scenario(scene, plant, options);
}

const std::vector<StepFigures>& steps(const RunResult& r) { return r.engines.front().steps; }

}  // namespace

TEST_CASE("paper: error pattern of the motor torque, with one voltage gain and with two") {
  Scenario one = scenario("torque_step");
  one.parameters = {{"voltage_gain", 1.0}, {"voltage_gain_high", 1.0}};
  const RunResult single = run(one, p24(), "paper");
  // Closed form at stall: torque = Kt*(Kv*tau_ref/Ktn - Vd)/R; the dead time is given back.
  for (const StepFigures& s : steps(single)) {
    const double expected = 0.0302 * (s.tau_ref_nm / 0.0605 - 0.34) / 0.42;
    CAPTURE(s.tau_ref_nm, expected, s.torque.final_value_nm);
    CHECK(std::abs(s.torque.final_value_nm - expected) < 0.002);
  }
  CHECK(steps(single)[0].torque.final_error_pct < -3.0);
  CHECK(steps(single)[1].torque.final_error_pct > 3.0);
  CHECK(steps(single)[2].torque.final_error_pct > 7.0);
  const RunResult two = run(scenario("torque_step"), p24(), "paper");
  CHECK(std::abs(steps(two)[0].torque.final_error_pct - 24.0) < 2.0);
  CHECK(std::abs(steps(two)[1].torque.final_error_pct - 0.6) < 2.0);
  CHECK(std::abs(steps(two)[2].torque.final_error_pct - 4.8) < 2.0);
}

TEST_CASE("paper: at 0.15 Nm the voltage falls although the reference rises") {
  const RunResult r = run(scenario("calibration_closed_loop"), p24(), "paper");
  // References 0.05 0.1 0.15 0.16 ...: 3.10 V at the border, 2.51 V just beyond.
  REQUIRE(steps(r).size() == 9);
  CHECK(steps(r)[3].torque.final_value_nm < steps(r)[2].torque.final_value_nm - 0.03);
  const RunResult lever = run(scenario("calibration_closed_loop"), p24(), "lever");
  for (std::size_t i = 1; i < 9; ++i) {
    CHECK(steps(lever)[i].torque.final_value_nm > steps(lever)[i - 1].torque.final_value_nm);
  }
}

TEST_CASE("lever: motor torque within 1 ms, and off by 1/R when the resistance is wrong") {
  for (const double factor : {0.8, 1.2}) {
    plant::Parameters plant = p24();
    plant.motor.resistance_ohm *= factor;
    const RunResult r = run(scenario("torque_step"), plant, "lever");
    for (const StepFigures& s : steps(r)) {
      // The resistive part of the voltage meets another resistance; the rest cancels.
      const double expected_pct = 100.0 * (1.0 / factor - 1.0);
      CAPTURE(factor, s.tau_ref_nm, s.torque.final_error_pct);
      CHECK(s.torque.settling_ms <= 1.0);
      CHECK(std::abs(s.torque.final_error_pct - expected_pct) <= 1.5);
    }
  }
}

TEST_CASE("single counts spike tau_hat in paper, and only there they reach the torque") {
  const RunResult paper = run(scenario("torque_step_cord"), p24(), "paper");
  CHECK(paper.position.steps > 0);
  CHECK(paper.figures.at("tau_hat_min_nm") < -0.05);  // spikes of up to 0.156 Nm
  const RunResult lever = run(scenario("torque_step_cord"), p24(), "lever");
  for (const StepFigures& s : steps(lever)) CHECK(s.torque.overshoot_pct < 10.0);
}

TEST_CASE("a stalled lever winds nothing up") {
  Scenario s = scenario("hold_and_release");
  for (const char* design : {"lever", "paper"}) {
    const RunResult r = run(s, p24(), design);
    CAPTURE(design);
    // After a second at 0.3 Nm the second step is as quick as the first.
    CHECK(steps(r)[1].torque.settling_ms < 1.2 * steps(r)[0].torque.settling_ms + 0.5);
    CHECK(r.figures.at("faults") == 0);
  }
}

TEST_CASE("switched and averaged bridge agree in the mean") {
  Scenario switched = scenario("torque_step");
  switched.switched = true;
  switched.step_clocks = 5;
  const RunResult a = run(scenario("torque_step"), p24(), "lever");
  const RunResult b = run(switched, p24(), "lever");
  for (std::size_t i = 0; i < 3; ++i) {
    CAPTURE(i, steps(a)[i].torque.final_value_nm, steps(b)[i].torque.final_value_nm);
    CHECK(std::abs(steps(a)[i].torque.final_value_nm - steps(b)[i].torque.final_value_nm) < 0.003);
  }
}
