// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A scene of several axes in closed loop: RTL against twin in every clock, the law in real numbers
// beside it, what a hand feels, also of a free pen, and scenes that are refused. docs/devices.md
#include <algorithm>
#include <cmath>

#include "axes_fixture.hpp"
#include "catch.hpp"
#include "feltgate/largest.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

/// A free pen that a hand leads along an axis, 3 mm to both sides of a place, 30 mm/s.
struct FreePen {
  static constexpr double speed_m_s = 0.03, half_m = 3e-3, begin_s = 0.05;
  plant::Vec2 middle_m;
  bool along_x = true;

  /// Force against the motion, N, mean from 2 mm after the start; the law has nothing to push with.
  double drag_n() const {
    AxesScene scene = scene_named("pantograph_floor");
    scene.scenario.parameters = {{"floor", 0.0}, {"stiffness", 0.0}, {"drag", 0.0}};
    scene.scenario.duration_s = begin_s + 2 * half_m / speed_m_s;
    scene.scenario.expectations.clear();
    plant::PenHand& hand = std::get<PantographSetup>(scene.device).hand = {};
    hand.start_m = middle_m - half_m * (along_x ? plant::Vec2{1, 0} : plant::Vec2{0, 1});
    plant::PenPhase& lead = hand.phases.emplace_back();
    lead.kind = plant::PenPhase::Kind::kPrescribed;
    plant::Segment wait, ramp;
    wait.duration_s = begin_s;
    ramp.kind = plant::Segment::Kind::kRamp;
    ramp.duration_s = 2 * half_m / speed_m_s;
    ramp.to = along_x ? middle_m.x + half_m : middle_m.y + half_m;
    (along_x ? lead.x : lead.y) = {wait, ramp};
    const Rows rows(scene, 100);
    double sum_n = 0;
    int count = 0;
    for (std::size_t n = 0; n < rows.size(); ++n) {
      if (rows.of(n, "time_s") < begin_s + 2e-3 / speed_m_s) continue;
      sum_n += rows.of(n, along_x ? "hand_x_n" : "hand_y_n");
      ++count;
    }
    CHECK(rows.result().figures.at("faults") == 0);
    return sum_n / count;
  }

  /// The same of a rhombus in closed form: power of both cranks' friction over the speed, mean of
  /// the places; a motor turns thrice as fast as its crank.
  double expected_n() const {
    const auto p = std::get<PantographSetup>(scene_named("pantograph_floor").device).parameters;
    constexpr double link_m = 0.1, ratio = 3;
    constexpr int places = 100;
    double sum_w = 0;
    for (int n = 0; n < places; ++n) {
      const double way_m = -half_m + 2e-3 + (2 * half_m - 2e-3) * (n + 0.5) / places;
      const double x = middle_m.x + (along_x ? way_m : 0), y = middle_m.y + (along_x ? 0 : way_m);
      // Cranks at the pen's direction less and plus a, cos a = far / 2 links.
      const double far_m = std::hypot(x, y), a = std::acos(far_m / (2 * link_m));
      const double out = speed_m_s * (along_x ? x : y) / far_m;
      const double turn = speed_m_s * (along_x ? -y : x) / (far_m * far_m);
      const double opens = -out / (2 * link_m * std::sin(a));
      for (const double crank : {turn - opens, turn + opens}) {
        const double motor = ratio * std::abs(crank), slow = motor / p.lugre.stribeck_rad_s;
        const double dry_nm =
            p.lugre.coulomb_nm + (p.lugre.static_nm - p.lugre.coulomb_nm) * std::exp(-slow * slow);
        sum_w += motor * (dry_nm + p.lugre.viscous_nm_s_rad * motor) / places;
      }
    }
    return sum_w / speed_m_s;
  }
};

}  // namespace

TEST_CASE("a free pen: its drag is the friction of both motors by the cranks' ways") {
  for (const FreePen& pen : {FreePen{{0.03, 0.12}, true}, FreePen{{0.03, 0.12}, false}}) {
    const double should_n = pen.expected_n(), is_n = pen.drag_n();
    INFO((pen.along_x ? "x " : "y ") << should_n << " N, twin " << is_n << " N");
    CHECK(is_n == Approx(should_n).epsilon(0.01));
  }
}

TEST_CASE("RTL and twin of two axes and their engine: the same outputs in every clock") {
  AxesScene scene = scene_named("pantograph_floor");
  scene.scenario.duration_s = 0.03;
  scene.scenario.arm_s = 0.012;
  scene.scenario.parameters["floor"] = 0.118;  // the pen begins in it: torque from arming on
  scene.scenario.expectations.clear();
  const AxesResult both = run_scene(scene, "all"), twin = run_scene(scene, "twin,double,quad");
  CHECK(both.lock_step);
  INFO(both.first_mismatch);
  CHECK(both.mismatches == 0);
  CHECK(both.broken.empty());
  CHECK(std::abs(both.figures.at("tau_ref_nm.0.end")) > 0.05);
  CHECK(both.axes[0].law_error_nm.count() > 10'000);
  // From event to event the twin gives what it gives clock by clock.
  for (const auto& [name, value] : both.figures) {
    INFO(name);
    CHECK(twin.figures.at(name) == value);
  }
}

TEST_CASE("another shape under the pen: torques ramp, step by step") {
  const AxesScene scene = scene_named("hidden_shapes");
  // The law runs every 16 ticks; in these the ramp of 15 Nm/s allows 240 uNm, and a last place
  // more.
  constexpr double most_nm = 16 * 15e-6 + 1.0 / 65536;
  const Rows rows(scene, 1, "twin,double");
  for (const std::string& line : rows.result().broken) UNSCOPED_INFO(line);
  CHECK(rows.result().broken.empty());
  for (const char* asked : {"tau_ref_nm.0", "tau_ref_nm.1"}) {
    double most = 0;
    int moved = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      // Before the change the hand moves by counts, which are no matter of the ramp.
      if (rows.of(i, "time_s") <= scene.scenario.events.at(0).at_s) continue;
      const double step = std::abs(rows.of(i, asked) - rows.of(i - 1, asked));
      most = feltgate::larger(most, step);
      moved += step > 0 ? 1 : 0;
    }
    INFO(asked << ": " << most << " Nm in a tick");
    CHECK(most <= most_nm);
    CHECK(moved > 1000);
  }
}

TEST_CASE("a texture under the pen: the same outputs in every clock") {
  AxesScene scene = scene_named("texture");
  scene.scenario.duration_s = 0.05;  // down on a slope, and half way along
  scene.scenario.expectations.clear();
  const AxesResult both = run_scene(scene, "all");
  CHECK(both.lock_step);
  INFO(both.first_mismatch);
  CHECK(both.mismatches == 0);
  CHECK(both.broken.empty());
  CHECK(both.figures.at("tau_ref_nm.0.max") > 0.05);
  CHECK(both.axes[0].law_error_nm.max() < both.axes[0].bound_nm);
}

TEST_CASE("what the host sets in the middle reaches engine and law in real numbers alike") {
  AxesScene scene = scene_named("pantograph_floor");
  scene.scenario.expectations.clear();
  for (const double stiffness : {300.0, 300.0, 700.0}) {  // the same once more is a set too
    Event e;
    e.at_s = 0.08;
    e.set["stiffness"] = stiffness;
    scene.scenario.events.push_back(e);
  }
  const AxesResult r = run_scene(scene, "twin,double,quad");
  CHECK(r.broken.empty());
  // 6 mm of 700 N/m instead of 300.
  CHECK(r.figures.at("tau_ref_nm.0.end") == Approx(0.1 * 0.854 * 4.2).margin(0.012));
  CHECK(r.ticks == 100'000);
  CHECK(r.homing_clocks > 600'000);
  for (const AxisFigures& a : r.axes) {
    // Most of the run is compared: it arms at 20 ms, and only arming and the change ramp.
    CHECK(a.law_error_nm.count() > 55'000);
    CHECK(a.law_error_nm.max() > 0);
    CHECK(a.law_error_nm.max() < a.bound_nm);
    CHECK(a.faults.empty());
  }
  // Where the joints are, cores and plant agree to a count: homing has found the pose.
  for (const char* axis : {".0.end", ".1.end"}) {
    CHECK(r.figures.at(std::string("position_rad") + axis) ==
          Approx(r.figures.at(std::string("theta_rad") + axis)).margin(1.6e-3));
  }
}

TEST_CASE("scenes of several axes that cannot be used are refused with their line") {
  const std::string head = scene_head("pantograph", "pantograph");
  CHECK(refusal(head) == "read");
  CHECK(refusal(head, true).find(":4: a device of several axes") == 0);
  CHECK(refusal("plant = \"p24\"\n" + head).find(":1: ") == 0);
  CHECK(refusal(head + "[hand]\nstart_rad = 1\n").find(":9: ") == 0);
  CHECK(refusal(head + "[[event]]\nat_s = 0.01\nstep_nm = 0.1\n").find("step_nm") !=
        std::string::npos);
  AxesScene scene = scene_named("pantograph_floor");
  CHECK_THROWS_AS(run_scene(scene, "twin,float"), std::invalid_argument);
  CHECK_THROWS_AS(run_scene(scene, "double"), std::invalid_argument);
  scene.scenario.law = "detent";
  CHECK_THROWS_AS(run_scene(scene, "twin"), std::invalid_argument);
  scene.scenario.law = "gimbal";
  CHECK_THROWS_AS(run_scene(scene, "twin"), std::invalid_argument);
}
