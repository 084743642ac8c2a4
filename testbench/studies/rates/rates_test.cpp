// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Errors of scenes at several rates against closed forms.
#include "studies/rates/rates.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "files/toml/toml_reader.hpp"
#include "mismatch.hpp"
#include "sim/backends/backend.hpp"
#include "sim/plant/plant_file.hpp"

using namespace feltgate;
using namespace feltgate::rates;

namespace {

const std::string root = FELTGATE_ROOT;

design::Elaborated law_core() {
  return design::elaborate(
      design::read_design(root + "/rtl/designs/" + std::string(law_design) + ".toml"),
      design::read_registers(root + "/rtl/registers.toml"));
}

Report measured(const std::string& file, const LawSource& law, const Options& options,
                double duration_s = 0) {
  Scenario scene = read_scenario(root + "/" + file);
  if (duration_s > 0) scene.duration_s = duration_s;
  const auto plant = plant::read_plant_file(root + "/vectors/plants/" + scene.plant + ".toml");
  resolve_effects(scene, plant.effects);
  return measure(scene, law, plant, law_core(), options);
}

LawSource shipped(const std::string& name) { return {root + "/rtl/laws/" + name + ".law", ""}; }

constexpr double count_rad = 2 * 3.14159265358979323846 / 4096;

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
  CHECK(report_text(r).find(" -         -") != std::string::npos);
  CHECK(report_text(r).find("note: where there is a -, nothing was compared") != std::string::npos);
  const std::string json = reports_json({r}), csv = reports_csv({r});
  CHECK(json.find("\"error_rms_nm\": null") != std::string::npos);
  CHECK(json.find("\"ticks_compared\": 0") != std::string::npos);
  CHECK(csv.find(",engine,1000,1000,,,") != std::string::npos);
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
  const auto plant = plant::read_plant_file(root + "/vectors/plants/" + scene.plant + ".toml");
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
