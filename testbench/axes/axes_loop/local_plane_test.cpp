// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The local plane: normals and force steps of a circle against closed forms, and how stiff a floor
// may be, by its plane and by sent forces. Documentation: docs/devices/pantograph.md
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "axes_fixture.hpp"
#include "catch.hpp"

using namespace feltgate;
using namespace feltgate::test;

namespace {

constexpr double kRadius_m = 0.03, kPath_m = 0.028, kTurn_rad_s = 7.14, kMoves_s = 0.03;
/// Half a count of both cranks, seen from the middle of the disc.
constexpr double kCount_rad = 0.006;

plant::Vec2 asked_force(const Rows& rows, std::size_t row, const plant::Linkage& linkage) {
  const plant::LinkagePose pose =
      linkage.pose({rows.of(row, "theta_rad.0"), rows.of(row, "theta_rad.1")});
  return pose.force({rows.of(row, "tau_ref_nm.0"), rows.of(row, "tau_ref_nm.1")});
}

/// Growth of the pen's swing on a flat floor after the force has grown by a fifth, to 0.6 N or 4 mm
/// deep, 1/s: half that of its energy. Less is in the bend of the voltage law.
double growth_1_s(bool force, double rate_hz, double stiffness_n_m) {
  const double pressed_n = std::max(0.6, 4e-3 * stiffness_n_m);
  AxesScene scene = scene_named("plane_floor");
  scene.scenario.expectations.clear();
  scene.scenario.duration_s = 1.4;
  scene.scenario.law = force ? "sent_force" : "local_plane";
  scene.plane->sends_force = force;
  scene.plane->rate_hz = rate_hz;
  scene.plane->latency_s = scene.plane->jitter_s = 1e-3;
  scene.plane->stiffness_n_m = stiffness_n_m;
  auto& push = std::get<PantographSetup>(scene.device).hand.phases.at(0).y;
  push.at(1).duration_s = 0.3;
  push.at(1).to = -pressed_n / 1.2;
  push.at(2).duration_s = 0.1;
  push.at(3).to = -pressed_n;
  constexpr double mass_kg = 0.045;  // of all that moves, at the pen
  const double rest_m = 0.11 - pressed_n / stiffness_n_m;
  const Rows rows(scene, 200);
  // Energy over the logarithm's straight line, by least squares.
  double n = 0, sum_t = 0, sum_e = 0, sum_tt = 0, sum_te = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double t = rows.of(i, "time_s"), dt = t - rows.of(i - 1, "time_s");
    if (t < 0.43) continue;
    const double y = rows.of(i, "pen_y_m"), before = rows.of(i - 1, "pen_y_m");
    const double v = (y - before) / dt, x = 0.5 * (y + before) - rest_m;
    const double e = std::log(0.5 * mass_kg * v * v + 0.5 * stiffness_n_m * x * x);
    n += 1, sum_t += t, sum_e += e, sum_tt += t * t, sum_te += t * e;
  }
  return 0.5 * (n * sum_te - sum_t * sum_e) / (n * sum_tt - sum_t * sum_t);
}

}  // namespace

TEST_CASE("local plane: a circle at 1 kHz, RTL and twin in every clock", "[lockstep]") {
  AxesScene scene = scene_named("plane_circle");
  scene.scenario.duration_s = 0.04;
  scene.scenario.expectations.clear();
  const AxesResult r = run_scene(scene, "all");
  CHECK(r.mismatches == 0);
  CHECK(r.broken.empty());
  CHECK(r.figures.at("planes_arrived") > 30);
}

TEST_CASE("local plane: normals and force steps of a circle are those of the pose's age") {
  for (const char* name : {"plane_circle", "plane_circle_slow"}) {
    INFO(name);
    AxesScene scene = scene_named(name);
    const Rows rows(scene, 1);
    const double k = scene.plane->stiffness_n_m;
    const plant::Linkage linkage(std::get<PantographSetup>(scene.device).parameters.linkage);
    int steps = 0, bad_tilts = 0, bad_steps = 0, bad_jumps = 0;
    double oldest_s = 0, tilt_before = 0;
    for (std::size_t i = 1; i + 70 < rows.size(); ++i) {
      const double tilt = rows.of(i, "plane_tilt_rad"), age_s = rows.of(i, "plane_age_s");
      if (rows.of(i, "time_s") < kMoves_s + 0.025) {
        tilt_before = tilt;
        continue;
      }
      oldest_s = std::max(oldest_s, age_s);
      bad_tilts += std::abs(tilt - kTurn_rad_s * age_s) > kCount_rad ? 1 : 0;
      const double step_n = rows.of(i, "plane_step_n");
      if (step_n > 0) {
        // The spring of a tangent turned by a: depth r - path cos a, along the normal.
        const auto force = [&](double a) {
          const double depth = std::max(0.0, kRadius_m - kPath_m * std::cos(a));
          return plant::Vec2{k * depth * std::cos(a), k * depth * std::sin(a)};
        };
        const double closed_n = plant::length(force(tilt) - force(tilt_before));
        bad_steps += std::abs(step_n - closed_n) > 1e-4 + 0.01 * closed_n ? 1 : 0;
        // What the engine asks for, from before the update to when its nine words are written and
        // run, to what a count (0.13 mm) changes.
        const double jump_n =
            plant::length(asked_force(rows, i + 60, linkage) - asked_force(rows, i - 2, linkage));
        bad_jumps += std::abs(jump_n - step_n) > k * 0.2e-3 ? 1 : 0;
        ++steps;
      }
      tilt_before = tilt;
    }
    CHECK(steps > (scene.plane->rate_hz > 100 ? 20 : 5));
    CHECK(oldest_s > 1.9 / scene.plane->rate_hz);  // some were lost
    CHECK(bad_tilts == 0);
    CHECK(bad_steps == 0);
    CHECK(bad_jumps == 0);
    CHECK(rows.result().broken.empty());
  }
}

TEST_CASE("local plane: on a floor it is ten times as stiff as forces sent at 1 kHz") {
  // A force that is half a run and 1.5 ms late takes K times that off the pen's 0.067 Ns/m.
  const double border = 0.067 / (0.5e-3 + 1.5e-3);
  CHECK(growth_1_s(true, 1000, 0.5 * border) < -0.03);
  CHECK(growth_1_s(true, 1000, 1.3 * border) > 0.05);
  CHECK(growth_1_s(false, 50, 13 * border) < -0.05);
}

TEST_CASE("local plane: what a scene cannot ask for") {
  AxesScene scene = scene_named("plane_floor");
  scene.plane->sends_force = true;
  const auto law = make_axes_law(std::string(FELTGATE_ROOT) + "/rtl/laws/local_plane.law",
                                 design_named("pantograph_law"), 2);
  CHECK_THROWS_WITH(PlaneHost::check(*scene.plane, "a.toml", *law),
                    "a.toml:18: law local_plane has no mailbox \"force_x\", which [plane] sends; "
                    "take the law sent_force");
  scene.plane->sends_force = false;
  CHECK_NOTHROW(PlaneHost::check(*scene.plane, "a.toml", *law));
}

TEST_CASE("local plane: a world that cannot be is refused with its line") {
  const auto told = [](const std::string& plane) {
    return refusal(scene_head("pantograph", "local_plane") + "[plane]\n" + plane);
  };
  const std::string rest = "rate_hz = 50\nstiffness_n_m = 100\n";
  CHECK(told("floor_m = [0.1]\n" + rest) == "read");
  CHECK(told("circle_m = [0, 0.1]\n" + rest).find(":9: not what a world") == 0);
  CHECK(told("circle_m = [0, 0.1, 0]\n" + rest).find("radius above 0") != std::string::npos);
  CHECK(told("floor_m = [0.1]\ndamping_ns_m = -1\n" + rest).find(":10: \"damping_ns_m\" = -1") ==
        0);
  CHECK(told("floor_m = [0.1]\nfriction = 0.5\nsends = \"force\"\n" + rest)
            .find("the spring alone") != std::string::npos);
  CHECK(told(rest).find("floor_m") != std::string::npos);
}
