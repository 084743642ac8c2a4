// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The two calibrations of the paper on a simulated motor with a known dead zone and slope, with a
// gauge that has noise. Documentation: docs/calibration.md
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "bench.hpp"
#include "catch.hpp"
#include "design/text_edit.hpp"
#include "feltgate/random.hpp"
#include "files/toml/toml_reader.hpp"
#include "host/calibrate/gauge.hpp"
#include "host/calibrate/regression.hpp"
#include "host/calibrate/report.hpp"

using namespace feltgate;
using namespace feltgate::host;
using namespace feltgate::test;

namespace {

const design::RegisterMap& registers() {
  static const auto map = design::read_registers(FELTGATE_ROOT "/rtl/registers.toml");
  return map;
}
std::string path_of(const std::string& name) {
  return FELTGATE_ROOT "/rtl/designs/" + name + ".toml";
}
design::Elaborated design_of(const std::string& name) {
  return elaborate(design::read_design(path_of(name)), registers());
}

/// p24 at 50 kHz: 0.34 V of the brushes and 1/40 of 25.4 V that the dead time takes.
constexpr double kSlope = 0.0302 / 0.42, kDead = 0.34 + 0.635;

std::vector<Reading> straight(std::initializer_list<double> volts, double slope, double dead,
                              double noise_nm = 0, std::uint64_t seed = 1, double offset = 0) {
  SplitMix64 random(seed);
  std::vector<Reading> readings;
  for (const double v : volts) {
    const double beyond = std::max(0.0, std::abs(v) - dead);
    readings.push_back(
        {v, offset + slope * std::copysign(beyond, v) + noise_nm * random.gaussian(), {}, 0});
  }
  return readings;
}

std::string refused(const std::vector<Reading>& readings) {
  try {
    (void)fit_open_loop(readings, 0.0302, 0.95);
  } catch (const MeasurementError& e) {
    return e.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("open loop: a simulated motor's dead zone and slope lie in the intervals", "[open]") {
  const plant::Parameters p = shipped("p24");
  constexpr double noise_nm = 2e-3;
  int slopes = 0, deads = 0, both = 0;
  constexpr int sets = 20;
  for (int set = 0; set < sets; ++set) {
    SplitMix64 random(static_cast<std::uint64_t>(set) + 1);
    std::vector<Reading> readings;
    for (const double v : {1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0, 5.5}) {
      readings.push_back({v, gauge_nm(p, v, noise_nm, &random), {}, 0});
    }
    const OpenLoop open = fit_open_loop(readings, 0.0302, 0.99);
    slopes += open.slope_nm_v.contains(kSlope) ? 1 : 0;
    deads += open.dead_voltage_v.contains(kDead) ? 1 : 0;
    both += open.resistance_ohm.contains(0.42) ? 1 : 0;
    CHECK(open.slope_nm_v.half() < 0.05 * kSlope);
    CHECK(open.dead_voltage_v.half() < 0.2);
    CHECK(open.noise_nm == Approx(noise_nm).epsilon(0.7));
    // The ends of R are those of the slope, exchanged.
    CHECK(open.resistance_ohm.low == Approx(0.0302 / open.slope_nm_v.high));
  }
  CHECK(slopes >= sets - 1);  // of 99 %
  CHECK(deads >= sets - 1);
  CHECK(both == slopes);
}

TEST_CASE("open loop: readings within the dead zone do not bend the line", "[open]") {
  for (const auto& volts :
       {std::initializer_list<double>{0, 0.3, 0.6, 1.5, 2.5, 3.5, 4.5, 5.5},
        std::initializer_list<double>{-5.5, -3.5, -1.5, -0.5, 0, 0.5, 1.5, 3.5, 5.5}}) {
    const OpenLoop open = fit_open_loop(straight(volts, 0.072, 0.98, 1e-3), 0.0302, 0.99);
    CHECK(open.slope_nm_v.contains(0.072));
    CHECK(open.dead_voltage_v.contains(0.98));
    CHECK(std::count_if(open.residuals.begin(), open.residuals.end(),
                        [](const Residual& r) { return r.dead; }) == 3);
  }
}

TEST_CASE("open loop: both signs give the gauge's offset away", "[open]") {
  const auto volts = {-5.5, -4.5, -3.5, -2.5, -1.5, 1.5, 2.5, 3.5, 4.5, 5.5};
  const OpenLoop open = fit_open_loop(straight(volts, 0.072, 0.98, 1e-3, 3, 0.02), 0.0302, 0.99);
  REQUIRE(open.gauge_offset_nm);
  CHECK(open.gauge_offset_nm->contains(0.02));
  CHECK(open.dead_voltage_v.contains(0.98));
  // Of one sign alone it looks like another dead voltage.
  const OpenLoop half =
      fit_open_loop(straight({1.5, 2.5, 3.5, 4.5, 5.5}, 0.072, 0.98, 1e-3, 3, 0.02), 0.0302, 0.99);
  CHECK_FALSE(half.gauge_offset_nm);
  CHECK_FALSE(half.dead_voltage_v.contains(0.98));
}

TEST_CASE("open loop: a slip of the pen is pointed at", "[open]") {
  auto readings = straight({1.5, 2.5, 3.5, 4.5, 5.5, 6.5}, 0.072, 0.98, 5e-4, 5);
  std::swap(readings[2].torque_nm, readings[3].torque_nm);
  readings[3].torque_nm += 0.05;
  const OpenLoop open = fit_open_loop(readings, 0.0302, 0.95);
  REQUIRE_FALSE(open.warnings.empty());
  CHECK(open.warnings[0].find("look at it again") != std::string::npos);
}

TEST_CASE("open loop: a gauge that rounds is no slip of the pen", "[open]") {
  // Four of them lie on one line to the last digit, the fifth a digit beside it.
  std::vector<Reading> readings{{1.5, 0.037, {}, 0},
                                {2.5, 0.109, {}, 0},
                                {3.5, 0.182, {}, 0},
                                {4.5, 0.253, {}, 0},
                                {5.5, 0.325, {}, 0}};
  CHECK(rounding_nm(readings) == Approx(1e-3 / std::sqrt(12)));
  CHECK(fit_open_loop(readings, 0.0302, 0.95).warnings.empty());
  readings[2].torque_nm = 0.19;
  CHECK_FALSE(fit_open_loop(readings, 0.0302, 0.95).warnings.empty());
  readings[2].torque_nm = 1.0 / 7;
  CHECK(rounding_nm(readings) == 0);
}

TEST_CASE("open loop: the observer's slope and the paper's ratio", "[open]") {
  auto readings = straight({1.5, 2.5, 3.5, 4.5, 5.5}, 0.072, 0.6);
  for (Reading& r : readings) r.tau_hat_nm = 0.0605 * r.command;
  const OpenLoop open = fit_open_loop(readings, 0.0605, 0.95);
  REQUIRE(open.observer_slope_nm_v);
  CHECK(open.observer_slope_nm_v->value == Approx(0.0605));
  CHECK(slope_ratio(open).value == Approx(0.072 / 0.0605));
  CHECK(report_text(open, design_of("paper")).find("voltage_to_current = 1.19") !=
        std::string::npos);
}

TEST_CASE("open loop: what cannot be judged is refused with the mend", "[open]") {
  CHECK(refused({}).find("0 readings; take at least 3") == 0);
  CHECK(refused(straight({1.5, 5.5}, 0.07, 1)).find("2 readings; take at least 3") == 0);
  CHECK(refused(straight({2, 2, 2, 2}, 0.07, 1)).find("only 1 different voltage,") == 0);
  CHECK(refused(straight({1.5, 2.5, 3.5, 4.5}, -0.07, 1)).find("the torque falls as") == 0);
  CHECK(refused(straight({1.5, 2.5, 3.5, -4.5}, 0.07, 1)).find("one reading alone") == 0);
  CHECK(refused(straight({1.5, 2.5, 3.5, 4.5}, 1e-6, 1, 0.05)).find("no slope stands out") == 0);
  auto infinite = straight({1.5, 2.5, 3.5, 4.5}, 0.07, 1);
  infinite[0].torque_nm = std::numeric_limits<double>::infinity();
  CHECK(refused(infinite).find("a reading is not a finite number") == 0);
}

TEST_CASE("closed loop: the paper's two gains and their border", "[closed]") {
  // docs/calibration.md: Kv = 1 leaves -29.4 % at 0.05 Nm to +13.9 % at 0.5 Nm.
  const std::vector<std::pair<double, double>> errors{
      {0.05, -29.4}, {0.1, -5.3}, {0.15, 2.7}, {0.16, 3.6}, {0.2, 6.7}, {0.3, 10.7}, {0.5, 13.9}};
  std::vector<Reading> readings;
  for (const auto& [torque, percent] : errors) {
    readings.push_back({torque, torque * (1 + percent / 100), {}, 0});
  }
  const auto paper = design_of("paper");
  const ClosedLoop closed = fit_closed_loop(readings, paper, 1, 0.95);
  REQUIRE(closed.regions);
  REQUIRE(closed.regions->border_nm);
  CHECK(closed.regions->border_nm->value == Approx(0.13).margin(0.01));
  CHECK(closed.regions->border_nm->contains(closed.regions->border_nm->value));
  CHECK(closed.regions->low.value == Approx(1.15).margin(0.05));
  CHECK(closed.regions->high.value == Approx(0.93).margin(0.02));
  // The torque falls at the border, and it is said.
  REQUIRE_FALSE(closed.warnings.empty());
  CHECK(closed.warnings[0].find("at the border the torque falls by") == 0);
  // Of one region alone: one gain.
  readings.erase(readings.begin(), readings.begin() + 2);
  const ClosedLoop high = fit_closed_loop(readings, paper, 1, 0.95);
  CHECK_FALSE(high.regions->border_nm);
  CHECK(high.regions->high.value == high.regions->low.value);
}

TEST_CASE("closed loop: a wrong R and dead voltage of a model are put right", "[closed]") {
  const auto lever = design_of("lever");
  const double assumed_v = lever.word("dead_voltage").si, kt = 0.0302;
  for (const auto& [ohm, dead] :
       {std::pair<double, double>{0.42, assumed_v}, {0.5, 1.1}, {0.35, 0.8}}) {
    SplitMix64 random(11);
    std::vector<Reading> readings;
    for (const double torque : {-0.3, -0.1, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5}) {
      const double volts = 0.42 * std::abs(torque) / kt + assumed_v;
      const double size = (volts - dead) * kt / ohm + 1e-3 * random.gaussian();
      readings.push_back({torque, std::copysign(size, torque), {}, 0});
    }
    readings.push_back({0.005, 0.001, {}, 0});
    const ClosedLoop closed = fit_closed_loop(readings, lever, 1, 0.99);
    REQUIRE(closed.model);
    CHECK(closed.model->resistance_ohm.contains(ohm));
    CHECK(closed.model->dead_voltage_v.contains(dead));
    CHECK(closed.warnings[0].find("1 readings below 0.01 Nm were left out") == 0);
  }
  CHECK_THROWS_AS(fit_closed_loop({{0.1, 0.1, {}, 0}, {0.2, 0.2, {}, 0}}, lever, 1, 0.95),
                  MeasurementError);
  CHECK_THROWS_AS(
      fit_closed_loop({{0.1, 0.1, {}, 0}, {0.1, 0.2, {}, 0}, {0.1, 0.15, {}, 0}}, lever, 1, 0.95),
      MeasurementError);
}

TEST_CASE("the design that is written can be built and has the constants", "[write]") {
  const auto lever = design_of("lever");
  const OpenLoop open =
      fit_open_loop(straight({1.5, 2.5, 3.5, 4.5, 5.5}, 0.0755, 1.1, 1e-3), 0.0302, 0.95);
  std::vector<std::string> warnings;
  const auto changes = changes_of(open, lever, 0.0302, false, &warnings);
  const std::string text = changed_design(path_of("lever"), "mine", changes, registers());
  const auto mine = elaborate(design::design_from_text(text, "mine.toml"), registers());
  CHECK(mine.design.resistance_ohm == Approx(open.resistance_ohm.value).epsilon(1e-5));
  CHECK(mine.word("voltage_gain").si == Approx(open.resistance_ohm.value).epsilon(1e-5));
  CHECK(mine.word("dead_voltage").si == Approx(open.dead_voltage_v.value).epsilon(1e-5));
  // All else as before, each change with where it is from.
  CHECK(mine.design.torque_limit_nm == lever.design.torque_limit_nm);
  CHECK(text.find("# measured, 95 % 0.") != std::string::npos);
  CHECK(warnings.empty());

  const OpenLoop small =
      fit_open_loop(straight({1.5, 2.5, 3.5, 4.5, 5.5}, 0.0755, 0.2, 1e-4), 0.0302, 0.95);
  const auto to_zero = changes_of(small, lever, 0.0302, false, &warnings);
  CHECK(to_zero.back().value == 0);
  REQUIRE_FALSE(warnings.empty());
  CHECK(warnings[0].find("the dead time alone should take 0.635 V") == 0);

  const auto paper = design_of("paper");
  CHECK(changes_of(open, paper, 0.0302, false, &warnings).empty());
  ClosedLoop closed;
  closed.regions = Regions{{1.2, 1.1, 1.3}, {0.9, 0.8, 1.0}, Interval{0.13, 0.12, 0.14}, 0.1};
  const std::string two =
      changed_design(path_of("paper"), "ours", changes_of(closed, paper, &warnings), registers());
  const auto ours = design::design_from_text(two, "ours.toml");
  CHECK(ours.kv_low == 1.2);
  CHECK(ours.region_nm == 0.13);

  // A value that no design can have is refused with the generator's own message.
  CHECK_THROWS_AS(changed_design(path_of("lever"), "bad",
                                 {{"motor", "resistance_ohm", -1, "wrong"}}, registers()),
                  config::ConfigError);
}

TEST_CASE("intervals are written with the digits that mean something", "[text]") {
  CHECK(text_of({0.419712, 0.41721, 0.42231}) == "0.4197 (0.4172 to 0.4223)");
  CHECK(text_of({123.456, 100, 150}) == "123 (100 to 150)");
  CHECK(text_of({1.22049e-4, 1.21643e-4, 1.22456e-4}) == "0.00012205 (0.00012164 to 0.00012246)");
  CHECK(text_of({2, 2, 2}) == "2 (2 to 2)");
}

// Least squares and its intervals, against published numbers and against what a confidence means:
// that so many of a thousand intervals hold the truth.
namespace {

Regression line(const std::vector<double>& x, const std::vector<double>& y,
                double confidence = 0.95) {
  Eigen::MatrixXd columns(x.size(), 2);
  Eigen::VectorXd right(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    columns(row, 0) = 1;
    columns(row, 1) = x[k];
    right[row] = y[k];
  }
  return {columns, right, confidence};
}

}  // namespace

TEST_CASE("regression: Anscombe's first set, whose line and errors are in every textbook",
          "[regression]") {
  // Anscombe's first quartet: 3.0001 + 0.5001 x, standard errors 1.1247 and 0.1179.
  const std::vector<double> x{10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
  const std::vector<double> y{8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68};
  const Regression fit = line(x, y);
  CHECK(fit.value(0) == Approx(3.0000909).epsilon(1e-7));
  CHECK(fit.value(1) == Approx(0.5000909).epsilon(1e-7));
  CHECK(std::sqrt(fit.covariance()(0, 0)) == Approx(1.1247).epsilon(1e-4));
  CHECK(std::sqrt(fit.covariance()(1, 1)) == Approx(0.1179).epsilon(1e-3));
  CHECK(fit.sigma() == Approx(1.2366).epsilon(1e-4));
  CHECK(fit.freedom() == 9);
  CHECK(fit.t() == Approx(2.262157).epsilon(1e-6));  // tables: t(0.975, 9)
  CHECK(fit.coefficient(1).low == Approx(0.2333701).epsilon(1e-5));
  CHECK(fit.coefficient(1).high == Approx(0.7668117).epsilon(1e-5));
}

TEST_CASE("regression: Student's t of the tables", "[regression]") {
  CHECK(student_t(0.95, 1) == Approx(12.7062).epsilon(1e-5));
  CHECK(student_t(0.99, 3) == Approx(5.84091).epsilon(1e-5));
  CHECK(student_t(0.90, 30) == Approx(1.69726).epsilon(1e-5));
}

TEST_CASE("regression: intervals hold the truth as often as they say", "[regression]") {
  const double slope = 0.072, dead = 0.98, sigma = 3e-3;
  for (const double confidence : {0.8, 0.95}) {
    SplitMix64 random(7);
    int slopes = 0, quotients = 0;
    constexpr int sets = 4000;
    for (int set = 0; set < sets; ++set) {
      std::vector<double> x, y;
      for (const double v : {1.5, 2.5, 3.5, 4.5, 5.5}) {
        x.push_back(v);
        y.push_back(slope * (v - dead) + sigma * random.gaussian());
      }
      const Regression fit = line(x, y, confidence);
      slopes += fit.coefficient(1).contains(slope) ? 1 : 0;
      const auto zero = fit.quotient({0, -Eigen::Vector2d::Unit(0)}, {0, Eigen::Vector2d::Unit(1)});
      REQUIRE(zero);
      quotients += zero->contains(dead) ? 1 : 0;
    }
    // Four standard deviations of such a count.
    const double margin = 4 * std::sqrt(confidence * (1 - confidence) / sets);
    CHECK(static_cast<double>(slopes) / sets == Approx(confidence).margin(margin));
    CHECK(static_cast<double>(quotients) / sets == Approx(confidence).margin(margin));
  }
}

TEST_CASE("regression: what cannot be told is refused", "[regression]") {
  CHECK_THROWS_AS(line({1, 2}, {1, 2}), MeasurementError);
  CHECK_THROWS_AS(line({3, 3, 3, 3}, {1, 2, 1, 2}), MeasurementError);
  CHECK_THROWS_AS(line({1, 2, 3, NAN}, {1, 2, 3, 4}), MeasurementError);
  // A slope that may be zero has no quotient.
  const Regression flat = line({1, 2, 3, 4}, {1, -1, 1, -1});
  CHECK_FALSE(flat.quotient({0, Eigen::Vector2d::Unit(0)}, {0, Eigen::Vector2d::Unit(1)}));
}

TEST_CASE("columns: every way to write a table, and every way to get it wrong", "[columns]") {
  const auto table = [](const std::string& text) {
    std::istringstream in(text);
    return ColumnTable(in, "t.csv");
  };
  for (const char* text :
       {"# noted on Monday\nvoltage_v,torque_nm\n1.5,0.065\n\n2.5,0.1368 # warm\n",
        "Voltage_V;Torque_Nm\r\n1.5;0.065\r\n2.5;0.1368\r\n",
        "voltage_v torque_nm\n 1.5   0.065\n2.5\t0.1368\n",
        "\"voltage_v\",\"torque_nm\"\n1.5,0.065\n2.5,0.1368"}) {
    const auto readings = open_loop_readings(table(text), 0);
    REQUIRE(readings.size() == 2);
    CHECK(readings[1].command == 2.5);
    CHECK(readings[1].torque_nm == 0.1368);
  }
  const auto forces = open_loop_readings(table("v,force_n\n1.5,10\n"), 0.011);
  CHECK(forces[0].torque_nm == Approx(0.11));
  const auto message = [&table](const std::string& text, double arm) -> std::string {
    try {
      (void)open_loop_readings(table(text), arm);
    } catch (const MeasurementError& e) {
      return e.what();
    }
    return "nothing";
  };
  CHECK(message("", 0).find("t.csv:1: nothing in it") == 0);
  CHECK(message("1.5,0.065\n", 0).find("t.csv:1: numbers where the names") == 0);
  CHECK(message("v,torque\n1,2,3\n", 0).find("t.csv:2: 3 fields under 2 names") == 0);
  CHECK(message("v,torque\n1,x\n", 0).find("t.csv:2: torque = \"x\" is no number") == 0);
  CHECK(message("v,torque\n1,\n", 0).find("t.csv:2: a reading is empty") == 0);
  CHECK(message("v,colour\n1,2\n", 0).find("t.csv:1: no column of the gauge's torque") == 0);
  CHECK(message("v,force_n\n1,2\n", 0).find("t.csv:1: forces need the arm") == 0);
}
