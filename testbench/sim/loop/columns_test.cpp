// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Columns of a run: fixed beside float and double, nothing where there is none, and the table of
// the documentation. Documentation: docs/json.md
#include "sim/loop/columns.hpp"
#include "feltgate/largest.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "catch.hpp"
#include "loop_fixture.hpp"

namespace {

using namespace feltgate;

using Table = std::map<std::string, std::vector<double>>;

Table table_of(const std::string& engines, int every) {
  Scenario scene = shipped_scene("wall");
  scene.duration_s = 0.6;
  scene.expectations.clear();
  RunOptions options;
  options.engine = engines;
  options.row_every = every;
  Table table;
  const std::vector<Column> columns = row_columns(true, choose_backends(engines).names());
  options.row = [&](const Row& r) {
    for (const Column& c : columns) table[c.name].push_back(c.value(r));
  };
  run_on_p24(scene, options);
  return table;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = feltgate::larger(worst, std::abs(a[i] - b[i]));
  return worst;
}

}  // namespace

TEST_CASE("twin, double and float side by side: each as it computes") {
  const Table t = table_of("twin,double,float", 100);
  REQUIRE(t.at("time_s").size() == 6000);
  CHECK(t.at("time_s")[1] == 1e-4);
  CHECK(t.count("quad_velocity_rad_s") == 0);
  CHECK(t.count("rtl_velocity_rad_s") == 0);
  CHECK(t.at("velocity_rad_s") == t.at("twin_velocity_rad_s"));
  for (const char* signal : {"velocity_rad_s", "tau_ref_nm", "tau_hat_nm", "torque_nm", "current_a",
                             "voltage_v", "duty"}) {
    CAPTURE(signal);
    const auto& twin = t.at(std::string("twin_") + signal);
    const auto& exact = t.at(std::string("double_") + signal);
    const auto& single = t.at(std::string("float_") + signal);
    const double peak = largest_difference(exact, std::vector<double>(exact.size(), 0.0));
    CHECK(peak > 0.01);
    // Fixed point is off by units of its last place, binary32 by less than 2^-11 of the signal.
    CHECK(largest_difference(twin, exact) > 0);
    CHECK(largest_difference(twin, exact) < 0.02 * peak);
    CHECK(largest_difference(single, exact) > 0);
    CHECK(largest_difference(single, exact) < std::ldexp(peak, -11));
  }
  const auto is_binary32 = [](double v) { return static_cast<double>(static_cast<float>(v)) == v; };
  const auto all_binary32 = [&](const std::vector<double>& v) {
    return std::all_of(v.begin(), v.end(), is_binary32);
  };
  CHECK(all_binary32(t.at("float_velocity_rad_s")));
  CHECK(!all_binary32(t.at("double_velocity_rad_s")));
}

TEST_CASE("every n-th row is one of all rows") {
  const Table all = table_of("twin", 1), some = table_of("twin", 7);
  REQUIRE(some.at("theta_rad").size() == (all.at("theta_rad").size() + 6) / 7);
  for (std::size_t i = 0; i < some.at("theta_rad").size(); ++i) {
    REQUIRE(some.at("theta_rad")[i] == all.at("theta_rad")[7 * i]);
    REQUIRE(some.at("hand_torque_nm")[i] == all.at("hand_torque_nm")[7 * i]);
  }
}

TEST_CASE("names are unique, and a replay has no plant") {
  std::set<std::string> names;
  for (const Column& c : row_columns(true, choose_backends("all").names())) {
    CHECK(names.insert(c.name).second);
    CHECK(!c.meaning.empty());
  }
  CHECK(names.count("motor_torque_nm") == 1);
  for (const Column& c : row_columns(false, {"twin"})) {
    CHECK(c.name.find("theta") == std::string::npos);
    CHECK(c.name.find("motor") == std::string::npos);
  }
}

TEST_CASE("docs/json.md has the table of columns; `feltgate run --columns` prints it") {
  std::ifstream file(std::string(FELTGATE_ROOT) + "/docs/json.md");
  const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  CHECK(page.find("\n\n" + columns_markdown() + "\n") != std::string::npos);
}
