// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Walls and ceilings with a sensor of the host: how quietly a lever rests on them with an encoder,
// with a tracker, filtered and fused. Simulation. Documentation: docs/devices/strings-and-drums.md
#include <cmath>

#include "catch.hpp"
#include "files/toml/toml_reader.hpp"
#include "loop_fixture.hpp"
#include "sim/law_loop/scene_law.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/tracker.hpp"

namespace {

using namespace feltgate;

/// The sensor from which the host knows the lever's angle.
struct Sensor {
  double rate_hz, noise_rad, resolution_rad, alpha;
  bool fused;  ///< with the core's encoder between two samples
};

constexpr double kTurn = 6.283185307179586, kDegree = kTurn / 360;
constexpr double kStep = kTurn / 16384;
constexpr double kNoise = 0.001745;  // as in the scenes
constexpr Sensor kEncoder{490, 0, kStep, 1, false};
constexpr Sensor kRaw{144, kNoise, 0, 1, false};
constexpr Sensor kFiltered{144, kNoise, 0, 0.5, false};
constexpr Sensor kFused{144, kNoise, 0, 0.5, true};

/// How a scene rests on a wall or ceiling of this stiffness.
struct Rest {
  double theta_rad, torque_nm;
  /// Our criterion: it moves, rms, by less than a step of the encoder of 14 bits, 38 um at the
  /// hand.
  bool quiet() const { return theta_rad < kStep; }
};

Rest rest(const std::string& scene, const Sensor& sensor, double stiffness) {
  Scenario s = shipped_scene(scene);
  s.tracker->rate_hz = sensor.rate_hz;
  s.tracker->noise_rad = sensor.noise_rad;
  s.tracker->resolution_rad = sensor.resolution_rad;
  s.tracker->alpha = sensor.alpha;
  s.parameters["fusion"] = sensor.fused ? 1 : 0;
  s.parameters["stiffness"] = stiffness;
  s.expectations.clear();
  const auto law = make_scene_law(std::string(FELTGATE_ROOT) + "/rtl/laws/" + s.law + ".law",
                                  design_named("lever_law"));
  RunOptions options;
  options.design = "lever_law";
  options.engine = "twin";
  options.law = law.get();
  const auto figures = run_on_p24(s, options).figures;
  return {figures.at("rest_theta_rms_rad"), figures.at("rest_tau_ref_rms_nm")};
}

}  // namespace

TEST_CASE("wall: 2 Nm/deg is quiet on the encoder at 490 Hz, 0.2 Nm/deg jitters on the tracker") {
  const Rest encoder = rest("wall_tracked", kEncoder, 2 / kDegree);
  const Rest raw = rest("wall_tracked", kRaw, 0.2 / kDegree);
  const Rest filtered = rest("wall_tracked", kFiltered, 0.2 / kDegree);
  CHECK(encoder.quiet());
  CHECK(!raw.quiet());
  // White noise of this filter: sqrt(alpha / (2 - alpha)) = 0.577 of it; the loop adds its own.
  CHECK(filtered.torque_nm < 0.8 * raw.torque_nm);
  CHECK(filtered.theta_rad < 0.9 * raw.theta_rad);
}

TEST_CASE("ceiling: the filter raises the border; with the encoder the lever moves less near it") {
  CHECK(!rest("ceiling_tracked", kRaw, 2200).quiet());
  const Rest filtered = rest("ceiling_tracked", kFiltered, 2900);
  const Rest fused = rest("ceiling_tracked", kFused, 2900);
  CHECK(filtered.quiet());
  CHECK(fused.theta_rad < 0.97 * filtered.theta_rad);
}

TEST_CASE("a tracker's mailbox is one of the law") {
  for (const char* name : {"nowhere", "stiffness"}) {  // the latter is a parameter
    Scenario s = shipped_scene("wall_tracked");
    s.tracker->mailbox = name;
    const auto law = make_scene_law(std::string(FELTGATE_ROOT) + "/rtl/laws/wall_tracked.law",
                                    design_named("lever_law"));
    RunOptions options;
    options.design = "lever_law";
    options.engine = "twin";
    options.law = law.get();
    CHECK_THROWS_WITH(run_on_p24(s, options),
                      Catch::Contains("wall_tracked.toml:19: law wall_tracked has no mailbox \"" +
                                      std::string(name) + "\"; name one that it has"));
  }
}

TEST_CASE("what a law requires of its parameters holds at the start and after each event") {
  const auto told = [](auto change) {
    Scenario s = shipped_scene("material_stone");
    change(s);
    const auto law = make_scene_law(std::string(FELTGATE_ROOT) + "/rtl/laws/material.law",
                                    design_named("lever_law"));
    RunOptions options;
    options.design = "lever_law";
    options.engine = "twin";
    options.law = law.get();
    try {
      (void)run_on_p24(s, options);
    } catch (const config::ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  Event e;
  e.at_s = 0.05;
  e.line = 40;
  CHECK_THAT(told([](Scenario& s) { s.parameters["dynamic"] = 0.4; }),
             Catch::Contains("material_stone.toml:19: law material requires dynamic <= static, "
                             "which are 0.4 and 0.3"));
  e.set = {{"static", 0.1}};
  CHECK_THAT(told([&](Scenario& s) { s.events.push_back(e); }),
             Catch::Contains("material_stone.toml:40: law material requires"));
  CHECK_THAT(told([&](Scenario& s) { s.parameters["damping"] = -1; }),
             Catch::Contains("damping = -1 mNm*s/rad is out of its range"));
  e.set = {{"static", 0.1}, {"dynamic", 0.1}};
  CHECK(told([&](Scenario& s) { s.events.push_back(e); }) == "");
  CHECK_THAT(told([](Scenario& s) {
               s.feed_hz = 100;
               s.feed_line = 30;
             }),
             Catch::Contains("material_stone.toml:30: [feed] needs a law with a mailbox"));
}

TEST_CASE("a tracker: rate, filter, step, latency, and no noise where none is asked for") {
  TrackerSettings settings;
  settings.rate_hz = 100;
  settings.alpha = 0.5;
  settings.latency_s = 0.015;
  settings.resolution_rad = 0.25;
  Tracker tracker(settings, 1000);  // a sample every 10 clocks, with the host 15 later
  double smooth = 0;
  for (Clock now = 0; now < 100; ++now) {
    CHECK(tracker.next() >= now);
    const double angle = 0.01 * static_cast<double>(now);
    if (now % 10 == 0) {
      const double x = 0.25 * std::floor(angle / 0.25);
      smooth = now == 0 ? x : 0.5 * x + 0.5 * smooth;
    }
    tracker.sample(now, angle, -angle);
    const auto seen = tracker.take(now);
    CHECK(seen.has_value() == (now >= 15 && now % 10 == 5));
    if (!seen) continue;
    CHECK(seen->encoder_rad == Approx(-0.01 * static_cast<double>(now - 15)));
    if (now == 15) CHECK(seen->angle_rad == 0);
    if (now == 45) CHECK(seen->angle_rad == Approx(0.125));  // 0, 0, 0, 0.25
  }
  CHECK(smooth > 0.5);
  // The same seed, the same noise; of 2000 samples its deviation within 5 %.
  settings = {};
  settings.rate_hz = 1000;
  settings.noise_rad = 0.01;
  Tracker one(settings, 1000), two(settings, 1000);
  double squares = 0;
  for (Clock now = 0; now < 2000; ++now) {
    one.sample(now, 1, 0);
    two.sample(now, 1, 0);
    const double seen = one.take(now)->angle_rad;
    CHECK(seen == two.take(now)->angle_rad);
    squares += (seen - 1) * (seen - 1);
  }
  CHECK(std::sqrt(squares / 2000) == Approx(0.01).epsilon(0.05));
}

TEST_CASE("hits as lines for Pure Data") {
  CHECK(event_lines({}, 50e-6).empty());
  const std::vector<RunEvent> events{{0.15, "hit2", 1.2},      {0.15001, "place2", 0.5},
                                     {0.15002, "hit3", 0.6},   {0.4, "hit2", 2},
                                     {0.4001, "place2", 0.25}, {0.5, "click", 3}};
  CHECK(event_lines(events, 50e-6) ==
        "150.000 hit 2 1.2 0.5;\n0.020 hit 3 0.6;\n249.980 hit 2 2;\n0.100 place 2 0.25;\n"
        "99.900 click 3;\n");
}
