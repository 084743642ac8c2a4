// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The ends of the plant's steps; long steps do not change the results. Documentation: docs/plant.md
#include "sim/loop/step_plan.hpp"

#include <cmath>

#include "catch.hpp"
#include "loop_fixture.hpp"
#include "sim/plant/plant.hpp"

namespace {

using namespace feltgate;

constexpr Clock never = Clock{1} << 62;

struct Run {
  RunResult result;
  RunInputs inputs;
  std::vector<Clock> steps;
  Clock first_current = -1;  ///< begin of the first step with a current in the motor
};

/// `step` 0: from event to event.
Run run(Scenario scene, int step) {
  scene.step_given = step > 0;
  if (step > 0) scene.step_clocks = step;
  Run r;
  RunOptions options;
  options.engine = "twin";
  options.inputs = &r.inputs;
  Clock now = 0;
  options.plant_step = [&](Clock clocks, const plant::Observables& o) {
    r.steps.push_back(clocks);
    if (o.motor_current_a != 0.0 && r.first_current < 0) r.first_current = now;
    now += clocks;
  };
  r.result = run_on_p24(scene, options);
  return r;
}

}  // namespace

TEST_CASE("steps end where a duty takes effect, and are equal in between", "[step_plan]") {
  for (const Clock period : {1000, 2500, 1003, 40, 4}) {
    StepPlan plan(25, 250, period);
    const Clock phase = std::min<Clock>(25, period);
    CHECK(plan.phase() == phase);
    Clock now = 0, longest = 0, shortest = 250;
    for (Clock n = 0; n < 30; ++n) {
      const Clock duty = n * period + phase;
      while (now < duty) {
        const Clock end = plan.end_of_step(now, never, never);
        REQUIRE(end > now);
        if (n > 0) longest = std::max(longest, end - now);
        if (n > 0) shortest = std::min(shortest, end - now);
        now = end;
      }
      REQUIRE(now == duty);
    }
    CHECK(longest <= 250);
    CHECK(longest - shortest <= 1);
  }
}

TEST_CASE("a corner has fine steps before and after, and a stir has them all along",
          "[step_plan]") {
  for (const Clock corner : {500, 501, 524, 525, 526, 1025, 1026, 3333}) {
    StepPlan plan(25, 250, 1000);
    const Clock acts = (corner + 24) / 25 * 25;
    bool met = false;
    for (Clock now = 0; now < 5000;) {
      const Clock end = plan.end_of_step(now, now < corner ? corner : never, never);
      REQUIRE(end > now);
      if (now < acts && end >= acts) REQUIRE((now == acts - 25 && end == acts));
      if (now == acts) REQUIRE(end == acts + 25);
      met = met || end == acts;
      now = end;
    }
    CHECK(met);
  }
  StepPlan plan(25, 250, 1000);
  plan.stir(300, 100);
  for (Clock now = 300; now < 400; now += 25)
    REQUIRE(plan.end_of_step(now, never, never) == now + 25);
  CHECK(plan.end_of_step(400, never, never) == 525);
  CHECK(plan.end_of_step(525, never, 600) == 600);
}

TEST_CASE("what is stiff has shorter steps", "[step_plan]") {
  const plant::Parameters plant = p24();
  const auto longest = [&plant](double damping_nm_s_rad) {
    Scenario s;
    s.effects = plant.effects;
    plant::HandPhase cord;
    cord.kind = plant::HandPhase::Kind::kCord;
    cord.cord.damping_nm_s_rad = damping_nm_s_rad;
    s.hand.phases = {cord};
    return longest_step_clocks(s, plant, 50e6);
  };
  CHECK(longest(0.1) == 250);
  CHECK(longest(10.0) < 250);
  CHECK(longest(10.0) > 25);
  CHECK(longest(300.0) == 25);
}

TEST_CASE("long steps, the same run", "[step_plan]") {
  for (const char* name : {"torque_step_cord", "damper", "hold_and_release"}) {
    CAPTURE(name);
    const Scenario scene = shipped_scene(name);
    const Run fine = run(scene, 5), usual = run(scene, 25), free = run(scene, 0);
    CHECK(6 * free.steps.size() < usual.steps.size());
    CHECK(free.result.felt.limits.at("gates_closed").seconds ==
          usual.result.felt.limits.at("gates_closed").seconds);
    // A gate that opens by what the scene says acts as soon as with short steps.
    CHECK(free.first_current == usual.first_current);
    CAPTURE(fine.result.position.steps);
    CHECK(free.result.position.steps == usual.result.position.steps);
    for (const auto& [figure, value] : fine.result.figures) {
      if (figure.rfind("overshoot", 0) == 0 || figure.rfind("final_error_pct", 0) == 0) continue;
      CAPTURE(figure, value, usual.result.figures.at(figure));
      // A permille, or what one tick, one microsecond and one step of the velocity make of it.
      const double least = figure.find("_ms") != std::string::npos     ? 2e-3
                           : figure.find("rad_s") != std::string::npos ? 2e-2
                                                                       : 1e-5;
      CHECK(std::abs(free.result.figures.at(figure) - value) <= 1e-3 * std::abs(value) + least);
    }
  }
}
