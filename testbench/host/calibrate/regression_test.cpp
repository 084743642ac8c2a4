// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Least squares and its intervals, against published numbers and against what a confidence means:
// that so many of a thousand intervals hold the truth.
#include <cmath>
#include <sstream>

#include "catch.hpp"
#include "feltgate/random.hpp"
#include "host/calibrate/columns.hpp"
#include "host/calibrate/open_loop.hpp"
#include "host/calibrate/regression.hpp"

using namespace feltgate;
using namespace feltgate::host;

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

TEST_CASE("regression: Student's t and F of the tables", "[regression]") {
  CHECK(student_t(0.95, 1) == Approx(12.7062).epsilon(1e-5));
  CHECK(student_t(0.99, 3) == Approx(5.84091).epsilon(1e-5));
  CHECK(student_t(0.90, 30) == Approx(1.69726).epsilon(1e-5));
  CHECK(f_tail(4.10282, 2, 10) == Approx(0.05).epsilon(1e-4));
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
