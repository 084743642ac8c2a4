// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Errors of scenes at several rates against closed forms.
#include <cmath>
#include <random>

#include "catch.hpp"

#include "files/toml/toml_reader.hpp"
#include "law/evaluate.hpp"
#include "mismatch.hpp"
#include "rates_case.hpp"
#include "sim/backends/backend.hpp"
#include "studies/rates/margin.hpp"
#include "studies/rates/rates.hpp"
#include "studies/rates/slow_law.hpp"
#include "studies/stability/law_loop.hpp"

using namespace feltgate;
using namespace feltgate::rates;

namespace {

design::Elaborated law_core() { return elaborated(law_design); }

Report measured(const std::string& file, const LawSource& law, const Options& options,
                double duration_s = 0) {
  Scenario scene = read_scenario(root + "/" + file);
  if (duration_s > 0) scene.duration_s = duration_s;
  const auto plant = plant_named(scene.plant);
  resolve_effects(scene, plant.effects);
  return measure(scene, law, plant, law_core(), options);
}

}  // namespace

TEST_CASE("a torque that is held lags by half a period in the mean") {
  constexpr double k = 20.0 / 65536 / count_rad, v = 4, tick_s = 1e-6;
  Options options;
  options.rates_hz = {144, 490, 1e3, 10e3};
  const Report r =
      measured("testbench/studies/rates/turned_spring.toml", shipped("spring"), options);
  REQUIRE(r.rows.size() == 6);  // four, the law's fastest, the block
  for (std::size_t i = 0; i < 4; ++i) {
    const RateRow& row = r.rows[i];
    // The lever runs towards more pull, so what is held is too weak: T/2 and the tick of the run.
    const double mean = k * v * (row.ticks + 1) / 2 * tick_s;
    CAPTURE(row.rate_hz, row.mean_error_nm, mean);
    CHECK(std::fabs(row.mean_error_nm - mean) < 0.01 * mean + 2e-6);
    // From 0 to a period, and a count's angle evenly spread.
    const double held = k * v * row.ticks * tick_s, counts = k * count_rad;
    const double rms = std::sqrt(held * held / 3 + counts * counts / 12);
    CHECK(std::fabs(row.error.rms() - rms) < 0.02 * rms);
    CHECK(row.error.max() == Approx(held + counts / 2).epsilon(0.05));
    CHECK(row.error.count() > 350000);
  }
  // What remains without holding: half a count to either side.
  CHECK(r.floor.rms() == Approx(k * count_rad / std::sqrt(12)).epsilon(0.01));
  CHECK(r.rows[4].error.rms() == Approx(r.floor.rms()).epsilon(0.02));
  CHECK(r.rows[5].error.rms() == Approx(r.floor.rms()).epsilon(0.02));
  CHECK(r.slope.stiffness_nm_rad == Approx(k).epsilon(1e-3));
  CHECK(r.slope.damping_nm_s_rad == 0);
  CHECK(r.slope.jump_nm == 0);
  CHECK(r.rows[5].block);
}

TEST_CASE("a faster torque is never worse, in error and in margin") {
  const Report r = measured("vectors/scenes/wall.toml", shipped("wall"), Options{}, 0.7);
  REQUIRE(r.rows.size() == 8);
  for (std::size_t i = 1; i < r.rows.size(); ++i) {
    CAPTURE(r.rows[i].rate_hz);
    CHECK(r.rows[i].rate_hz >= r.rows[i - 1].rate_hz);
    CHECK(r.rows[i].error.rms() <= 1.02 * r.rows[i - 1].error.rms());
    CHECK(r.rows[i].margin.ratio >= r.rows[i - 1].margin.ratio);
  }
  CHECK(r.rows[0].error.rms() > 3 * r.rows[7].error.rms());
  // The scene's own numbers, found from the law along the motion.
  CHECK(r.slope.stiffness_nm_rad == Approx(4).epsilon(1e-3));
  CHECK(r.slope.damping_nm_s_rad == Approx(0.005).epsilon(1e-3));
  // 6 instructions: 48 clocks of 50.
  CHECK(r.rows[6].clocks_used == 48);
  CHECK(r.rows[6].clocks_available == 50);
}

TEST_CASE("a membrane has a jump and no stiffness") {
  const Report r =
      measured("vectors/scenes/membrane.toml", shipped("membrane"), Options{{1e3}, false, {}});
  CHECK(r.slope.jump_nm == Approx(0.5).epsilon(1e-6));
  CHECK(r.slope.stiffness_nm_rad == Approx(0).margin(1e-9));
  CHECK(r.rows.front().margin.of == Margin::Of::none);
  CHECK(r.rows.front().error.max() == Approx(0.5).epsilon(1e-3));  // late at a face, by all of it
}

TEST_CASE("scenes of the core become laws with the same numbers") {
  const DesignInfo lever = design_named(block_design);
  const auto parameters = [&](const std::string& name) {
    const Scenario s = read_scenario(root + "/vectors/scenes/" + name + ".toml");
    return as_law(s, *block_law(s.scene), lever).parameters;
  };
  const auto wall = parameters("wall");
  CHECK(wall.at("contact") == Approx(0.5));
  CHECK(wall.at("stiffness") == Approx(4));
  CHECK(wall.at("damping") == Approx(0.005));
  const auto charge = parameters("charge_repel");
  CHECK(charge.at("peak") == Approx(-0.5));
  CHECK(charge.at("core") == Approx(0.2));
  CHECK(parameters("spring_compression").at("stiffness") == Approx(1));
  const Scenario step = read_scenario(root + "/vectors/scenes/torque_step.toml");
  const Scenario law = as_law(step, *block_law(step.scene), lever);
  CHECK(law.scene == "law");
  CHECK(law.events.front().set.at("setpoint_torque") == 0.1);
}

TEST_CASE("what a tracker sends is in the continuous law") {
  if (!test::case_tried(1, 3)) return;  // 16 s
  // Its samples are 20 mNm apart, and the law is the same at its own rate: what is left is the
  // encoder's count and what the wall goes on between two runs.
  const Report r = measured("vectors/scenes/wall_tracked.toml", shipped("wall_tracked"),
                            Options{{144}, false, {}}, 0.4);
  REQUIRE(r.rows.size() == 2);
  CHECK(r.largest_nm > 0.1);
  CHECK(r.rows[1].error.rms() < 0.1 * r.largest_nm);
  CHECK(r.rows[1].error.rms() < r.rows[0].error.rms());
  CHECK(r.rows[1].margin.of == Margin::Of::torque);
}

TEST_CASE("where the torque ramps all the time nothing is compared") {
  // 0.2 Nm at 5 Nm/s take 40 ms.
  const Report r = measured("testbench/studies/rates/turned_spring.toml", shipped("spring"),
                            Options{{1e3}, false, {}}, 0.0025);
  REQUIRE(r.rows.size() == 3);
  CHECK(r.rows[0].error.count() == 0);
  CHECK(report_text(r).find(" -           - ") != std::string::npos);
  CHECK(report_text(r).find("note: where there is a -, nothing was compared") != std::string::npos);
  const std::string json = reports_json({r});
  CHECK(json.find("\"error_rms_nm\": null") != std::string::npos);
  CHECK(json.find("\"ticks_compared\": 0") != std::string::npos);
}

TEST_CASE("ticks of a mailbox that is too old are not compared, and told") {
  const LawSource stale{"stale.law",
                        "mailbox pull = 0.1 Nm in -1 .. 1 Nm max_age 5 ms\nout torque = pull\n"};
  Scenario scene = read_scenario(root + "/vectors/scenes/wall_tracked.toml");
  scene.tracker.reset();
  scene.parameters.clear();
  scene.parameter_lines.clear();
  scene.rest_from_s.reset();
  scene.duration_s = 0.2;
  const auto plant = plant_named(scene.plant);
  resolve_effects(scene, plant.effects);
  const Report r = measure(scene, stale, plant, law_core(), Options{{}, false, {}});
  REQUIRE(r.rows.size() == 1);
  CHECK(r.rows[0].error.max() < 1e-3);
  CHECK(report_text(r).find("a mailbox of the law is stale for") != std::string::npos);
}

TEST_CASE("what has no single law is refused") {
  const auto refused = [](const std::string& path) {
    const Scenario s = read_scenario(root + "/vectors/scenes/" + path);
    CHECK_THROWS_AS(require_one_law(s), config::ConfigError);
  };
  refused("calibration_open_loop.toml");
  refused("free_lever.toml");
  Scenario s = read_scenario(root + "/vectors/scenes/wall.toml");
  CHECK_NOTHROW(require_one_law(s));
  Event e;
  e.at_s = 0.5;
  e.scene = "damper";
  s.events.push_back(e);
  CHECK_THROWS_AS(require_one_law(s), config::ConfigError);
  CHECK_THROWS_AS(measured("vectors/scenes/detent.toml", shipped("pantograph"), Options{}),
                  std::invalid_argument);
}

// Laws at other rates: by the divider, and held for several runs.

TEST_CASE("a held law changes in every n-th run and is the law there") {
  const law::Law plain = read(shipped("membrane"), 1e6);
  const law::Law slow = held(plain, 5, law::Target{});
  law::Evaluation<double> a(plain), b(slow);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> position(0.3, 0.9);
  int pushes = 0;
  double before = 0;
  for (int run = 0; run < 5000; ++run) {
    const std::vector<double> in{position(random)};
    b.run(in);
    if (run % 5 == 0) {
      a.run(in);
      REQUIRE(b.outputs().front() == a.outputs().front());
      pushes += a.outputs().front() != 0 ? 1 : 0;
    } else {
      REQUIRE(b.outputs().front() == before);
    }
    before = b.outputs().front();
  }
  CHECK(pushes > 200);
  CHECK(pushes < 800);
}

TEST_CASE("a rate is the engine's divider, and more than its most is held") {
  const law::Target target;
  const LawSource membrane = shipped("membrane");
  const law::Compiled fast = fastest(membrane, target);
  CHECK(fast.divider == 2);
  const law::Compiled one = at_rate(membrane, target, 1000);
  CHECK(one.divider == 1000);
  CHECK(one.rate_hz == 1000);
  CHECK(one.law.states.size() == fast.law.states.size());
  const law::Compiled two = at_rate(membrane, target, 6940);
  CHECK(two.divider == 3470);
  CHECK(two.law.states.size() == fast.law.states.size() + 2);
  CHECK(at_rate(membrane, target, 10000).divider == 2500);  // three does not divide it, four does
}

TEST_CASE("every shipped law of one axis can be held") {
  for (const char* name :
       {"wall", "ceiling", "charge", "charge_far", "damper", "detent", "spring"}) {
    CAPTURE(name);
    CHECK(at_rate(shipped(name), law::Target{}, 6940).divider == 3470);
    CHECK(at_rate(shipped(name), law::Target{}, 20000).divider == 4000);
  }
}

TEST_CASE("filters follow the rate; a law that counts runs is refused") {
  const LawSource filtered{"filtered", "out torque = 0.1 Nm * lowpass(position, 100 Hz)\n"};
  CHECK(at_rate(filtered, law::Target{}, 1000).rate_hz == 1000);
  const LawSource echo{"echo",
                       "rate = 10 kHz\nline past[20] in -1 .. 1\nnext past = sin(position)\n"
                       "out torque = 0.1 Nm * past[20]\n"};
  CHECK_THROWS_WITH(at_rate(echo, law::Target{}, 1000),
                    Catch::Contains("echo:2") && Catch::Contains("counts runs"));
}

// Margins against the borders of the stability study and against 2 b / T.

namespace {

stability::LoopModel model() {
  return stability::make_model(elaborated("lever"), plant_named("linear"));
}

Slope slope(double stiffness_nm_rad, double damping_nm_s_rad, double jump_nm = 0) {
  Slope s;
  s.stiffness_nm_rad = stiffness_nm_rad;
  s.damping_nm_s_rad = damping_nm_s_rad;
  s.jump_nm = jump_nm;
  return s;
}

}  // namespace

TEST_CASE("a margin is the border of the stability study over the stiffness") {
  const stability::LoopModel m = model();
  const Slope wall = slope(4, 0.005);
  for (const int ticks : {1000, 100, 1}) {
    const int delay = ticks > 1 ? stability::host_ticks : 0;
    const Margin found = margin(m, wall, ticks, delay);
    const double border = stability::border(m, 0.005, ticks).stiffness_nm_rad;
    CAPTURE(ticks);
    CHECK(found.of == Margin::Of::stiffness);
    CHECK(found.border == Approx(border).epsilon(0.003));
    CHECK(found.ratio == Approx(border / 4).epsilon(0.003));
  }
  // A run of the engine costs a tick of delay beside the block's none: a little.
  CHECK(margin(m, wall, 1, 1).border < margin(m, wall, 1, 0).border);
  CHECK(margin(m, wall, 1, 1).border > 0.98 * margin(m, wall, 1, 0).border);
}

TEST_CASE("damping has a margin where nothing is stiff, and nothing has none") {
  const stability::LoopModel m = model();
  const Margin slow = margin(m, slope(0, 0.03), 7000, 1), fast = margin(m, slope(0, 0.03), 1, 0);
  CHECK(slow.of == Margin::Of::damping);
  CHECK(slow.ratio < fast.ratio);
  CHECK(fast.border == Approx(0.03 * fast.ratio));
  CHECK(margin(m, slope(0, 0, 0.5), 1000, 1).of == Margin::Of::none);
}
