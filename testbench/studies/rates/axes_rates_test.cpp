// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Two levers at several rates against closed forms.
#include <catch2/catch.hpp>
#include <cmath>

#include "studies/rates/rates.hpp"

using namespace feltgate;
using namespace feltgate::rates;

namespace {

const std::string root = FELTGATE_ROOT;

AxesScene read(const std::string& path) {
  return read_axes_scene(root + "/" + path, [](const std::string& name) {
    return root + "/vectors/devices/" + name + ".toml";
  });
}

Report measured(const AxesScene& scene, const LawSource& law, const Options& options) {
  const auto e =
      design::elaborate(design::read_design(root + "/rtl/designs/" + own_design(scene) + ".toml"),
                        design::read_registers(root + "/rtl/registers.toml"));
  return measure(scene, law, e, options);
}

LawSource shipped(const std::string& name) { return {root + "/rtl/laws/" + name + ".law", ""}; }

constexpr double count_rad = 2 * 3.14159265358979323846 / 4096;

}  // namespace

TEST_CASE("two levers turned apart: each axis lags by half a period in the mean") {
  constexpr double k = 50.0 / 131072 / count_rad, v = 3.3, tick_s = 1e-6;
  Options options;
  options.rates_hz = {144, 490, 1e3, 10e3};
  const Report r = measured(read("testbench/studies/rates/turned_levers.toml"),
                            shipped("coupled_levers"), options);
  REQUIRE(r.axes == 2);
  REQUIRE(r.rows.size() == 5);  // four, the law's fastest
  // The levers part at v: from 0 to a period, and of each lever a count's angle evenly spread.
  const double count = k * count_rad, counts = count / std::sqrt(6);
  for (std::size_t i = 0; i < 4; ++i) {
    const RateRow& row = r.rows[i];
    const double mean = k * v * (row.ticks + 1) / 2 * tick_s;
    CAPTURE(row.rate_hz, row.mean_error_nm, mean);
    CHECK(std::fabs(row.mean_error_nm - mean) < 0.01 * mean + 2e-6);
    const double held = k * v * row.ticks * tick_s;
    const double rms = std::sqrt(held * held / 3 + counts * counts);
    REQUIRE(row.of_axes.size() == 2);
    for (const ErrorFigure& axis : row.of_axes) {
      CHECK(std::fabs(axis.rms() - rms) < 0.02 * rms);
      CHECK(axis.max() < 1.02 * (held + count));
      CHECK(axis.max() > 0.95 * (held + count));
      CHECK(axis.count() > 350000);
    }
    CHECK(row.error.count() == row.of_axes[0].count() + row.of_axes[1].count());
    CHECK(row.expected == 1);
  }
  // The scene's bound on the torque at its end is between the lags of 490 Hz and of 1 kHz.
  CHECK(r.rows[0].broken.size() == 1);
  CHECK(r.rows[1].broken.size() == 1);
  CHECK(r.rows[2].broken.empty());
  // They feel twice of it against each other.
  CHECK(r.slope.stiffness_nm_rad == Approx(2 * k).epsilon(1e-6));
  CHECK(r.slope.damping_nm_s_rad == Approx(0).margin(1e-9));
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(r.rows[i].margin.of == Margin::Of::stiffness);
    CHECK(r.rows[i].margin.border == Approx(r.rows[i].margin.ratio * 2 * k));
    if (i > 0) CHECK(r.rows[i].margin.ratio > r.rows[i - 1].margin.ratio);
  }
  CHECK(r.floor.rms() == Approx(counts).epsilon(0.01));
  CHECK(r.rows[4].error.rms() == Approx(r.floor.rms()).epsilon(0.02));
}

TEST_CASE("what the host sends a device is in the continuous law") {
  // A plane that comes 1000 times a second: without it the law would be off by all of its force.
  AxesScene scene = read("vectors/scenes/stylus_floor.toml");
  scene.scenario.duration_s = 0.08;
  scene.scenario.expectations.clear();
  const Report r = measured(scene, shipped("local_space"), Options{{1e3}, false, {}});
  REQUIRE(r.axes == 3);
  CHECK(r.largest_nm > 1e-3);
  CHECK(r.rows.back().error.rms() < 0.1 * r.largest_nm);
}

TEST_CASE("what has no margin, or one of another kind, is told") {
  AxesScene scene = read("testbench/studies/rates/turned_levers.toml");
  scene.scenario.duration_s = 0.03;
  scene.scenario.expectations.clear();
  scene.scenario.parameters.clear();
  const auto notes = [&](const std::string& text) {
    const Report r = measured(scene, {"inline.law", text}, Options{{10e3}, false, {}});
    CHECK(r.slope.coupled == (text.find("position") != std::string::npos));
    std::string all;
    for (const std::string& note : r.notes) all += note + "\n";
    return all;
  };
  // Each lever is driven by the other's angle, and by none of its own.
  CHECK_THAT(notes("param k = 0.2 Nm/rad in 0 .. 1 Nm/rad\n"
                   "out torque[0] = clamp(k * position[1], -0.1 Nm, 0.1 Nm)\n"
                   "out torque[1] = clamp(-k * position[0], -0.1 Nm, 0.1 Nm)\n"),
             Catch::Contains("drive each other") && Catch::Contains("nowhere stiff or damped"));
  CHECK_THAT(notes("param b = 0.01 Nm s/rad in 0 .. 0.02 Nm s/rad\n"
                   "out torque[0] = clamp(-b * velocity[0], -0.1 Nm, 0.1 Nm)\n"
                   "out torque[1] = clamp(-b * velocity[1], -0.1 Nm, 0.1 Nm)\n"),
             Catch::Contains("that of the law's damping"));
}

TEST_CASE("a design that is not in the program is told") {
  const AxesScene scene = read("vectors/scenes/pantograph_floor.toml");
  CHECK_THROWS_WITH(measured(scene, shipped("pantograph"), Options{}),
                    Catch::Contains("pantograph_floor.toml: design pantograph_law is not in"));
}
