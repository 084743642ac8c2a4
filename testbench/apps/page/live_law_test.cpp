// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Laws that someone writes on the page: errors at their places, the loop around the engine that
// runs them, parameters that are turned, the torque over a turn. Documentation: docs/page.md
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "apps/page/live_loop.hpp"
#include "apps/page/user_law.hpp"
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate::page {
namespace {

const std::string root = FELTGATE_ROOT;

DesignInfo design() { return design_named("lever_law"); }

std::string shipped(const std::string& name) {
  std::ifstream file(root + "/rtl/laws/" + name + ".law");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

LiveLoop armed(const UserLaw& law) {
  LiveLoop loop("lever_law", plant::read_plant_file(root + "/vectors/plants/p24.toml"));
  loop.run_law(law.scene());
  loop.select("law");
  loop.arm(true);
  loop.hold(Grip::hand);
  return loop;
}

void lead_to(LiveLoop& loop, double theta_rad) {
  const double from = loop.samples().empty() ? 0.0 : loop.samples().back().hand_rad;
  for (int k = 1; k <= 30; ++k) {
    loop.lead(from + (theta_rad - from) * std::min(1.0, k / 20.0));
    loop.advance(10'000, 100);
  }
}

}  // namespace

TEST_CASE("page: a law is felt as it says, and its parameters are turned while it runs") {
  UserLaw law(shipped("detent"), design());
  LiveLoop loop = armed(law);
  for (const double rad : {0.3, 0.07, -0.4}) {
    lead_to(loop, rad);
    REQUIRE(loop.snapshot().armed);
    const double at = loop.samples().back().position_rad;
    CHECK(std::abs(loop.samples().back().tau_ref_nm + 0.05 * std::sin(24 * at)) < 1e-4);
  }
  loop.set("amplitude", 0.02);
  loop.set("clicks", 12);
  loop.advance(50'000, 100);
  const double at = loop.samples().back().position_rad;
  CHECK(std::abs(loop.samples().back().tau_ref_nm + 0.02 * std::sin(12 * at)) < 1e-4);
  CHECK(loop.snapshot().faults == 0);
  CHECK(loop.take_difference() < 1e-3);
  CHECK_THROWS_WITH(loop.set("amplitude", 0.7), Catch::Contains("0.5"));
}

TEST_CASE("page: torque over a turn, parameters and table of a law") {
  UserLaw law(shipped("detent"), design());
  const auto parameters = law.parameters();
  REQUIRE(parameters.size() == 2);
  CHECK(parameters[0].name == "amplitude");
  CHECK(parameters[0].unit == "Nm");
  CHECK(parameters[0].value == Approx(0.05).margin(1e-4));
  CHECK(parameters[0].high == Approx(0.5).margin(1e-4));
  CHECK(law.report(100).find("instructions") != std::string::npos);
  const auto off = [&](double amplitude, double clicks) {
    double most = 0;
    const auto curve = law.curve(4097);
    REQUIRE(curve.size() == 2 * 4097);
    for (std::size_t n = 0; n < 4097; ++n) {
      const double rad = 2 * M_PI * (static_cast<double>(n) / 4096 - 0.5);
      most = larger(most, std::abs(curve[n] + amplitude * std::sin(clicks * rad)));
      most = larger(most, std::abs(curve[n] - curve[2 * 4097 - 1 - n]));
    }
    return most;
  };
  CHECK(off(0.05, 24) < 1e-4);
  law.set("amplitude", 0.1);
  law.set("clicks", 7);
  CHECK(off(0.1, 7) < 1e-4);
}

TEST_CASE("page: a law that remembers has a torque for each way over the turn") {
  // A stalk that latches beyond 0.3 rad and springs back within 0.2 rad.
  const UserLaw law(shipped("turn_switch"), design());
  const int points = 1441;
  const auto curve = law.curve(points);
  const auto at = [&](double rad, bool up) {
    const int n = static_cast<int>(std::lround((rad / (2 * M_PI) + 0.5) * (points - 1)));
    return curve[static_cast<std::size_t>(up ? n : 2 * points - 1 - n)];
  };
  CHECK(std::abs(at(0.25, true) + 0.25) < 0.005);  // to the middle
  CHECK(std::abs(at(0.25, false) - 0.1) < 0.005);  // to its place, 0.35 rad
  CHECK(std::abs(at(-0.25, true) + 0.1) < 0.005);  // came from -pi: latched
  CHECK(std::abs(at(-0.25, false) - 0.25) < 0.005);
  for (const double rad : {-1.0, -0.1, 0.1, 1.0}) {
    CHECK(std::abs(at(rad, true) - at(rad, false)) < 1e-4);
  }
}

TEST_CASE("page: what is wrong with a law has its place") {
  const auto refused = [](const std::string& text) {
    try {
      UserLaw law(text, design());
    } catch (const law::LawError& error) {
      return error.diagnostics();
    }
    return std::vector<law::Diagnostic>{};
  };
  const auto unknown = refused("# a knob\nout torque = -0.1 Nm * sin(postion)\n");
  REQUIRE(unknown.size() == 1);
  CHECK(unknown[0].place.line == 2);
  CHECK(unknown[0].place.column == 28);
  CHECK(unknown[0].mend.find("position") != std::string::npos);
  const auto axes = refused("out torque[1] = 0.1 Nm * sin(position)\n");
  REQUIRE(axes.size() == 1);
  CHECK(axes[0].what.find("axis 1") != std::string::npos);
  CHECK(refused("").size() == 1);
  CHECK(refused(shipped("wall")).empty());
}

}  // namespace feltgate::page
