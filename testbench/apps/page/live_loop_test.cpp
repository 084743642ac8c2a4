// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The loop behind the page: a hand that is led, a host's wall, broken wires, recorded inputs, and
// laws of users. Documentation: docs/page.md
#include "apps/page/live_loop.hpp"

#include <cmath>
#include <fstream>
#include <sstream>

#include "apps/page/image_law.hpp"
#include "apps/page/recorded_inputs.hpp"
#include "apps/page/user_law.hpp"
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate::page {
namespace {

const std::string root = FELTGATE_ROOT;

plant::Parameters plant_named(const std::string& name) {
  return plant::read_plant_file(root + "/vectors/plants/" + name + ".toml");
}

std::string law_text(const std::string& name) {
  std::ifstream file(root + "/rtl/laws/" + name + ".law");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A hand leads a lever to an angle within `lead_s` and stays there for `stay_s`.
void lead_to(LiveLoop& loop, double theta_rad, double lead_s, double stay_s) {
  const double from = loop.samples().empty() ? 0.0 : loop.samples().back().hand_rad;
  const int frames = static_cast<int>(std::lround(lead_s * 60));
  for (int k = 1; k <= frames + static_cast<int>(std::lround(stay_s * 60)); ++k) {
    loop.lead(from + (theta_rad - from) * std::min(1.0, k / static_cast<double>(frames)));
    loop.advance(16667, 100);
  }
}

LiveLoop armed_wall(const std::string& design = "lever") {
  LiveLoop loop(design, plant_named("p24"));
  loop.select("wall");
  loop.arm(true);
  loop.hold(Grip::strong);
  return loop;
}

TEST_CASE("a wall holds the handle back, and the hand feels what the wall does") {
  LiveLoop loop = armed_wall();
  lead_to(loop, 0.8, 0.6, 0.6);
  const Sample& s = loop.samples().back();
  // At rest wall and hand balance: 4 Nm/rad from 0.5 rad on against 135 N/m at 0.1 m.
  const double hand = 135 * 0.1 * 0.1, rest = (hand * 0.8 + 4 * 0.5) / (hand + 4);
  CHECK(s.angle_rad == Approx(rest).margin(0.005));  // friction holds it a little aside
  CHECK(s.tau_ref_nm == Approx(-4 * (s.position_rad - 0.5)).margin(0.01));
  CHECK(s.torque_nm == Approx(s.tau_ref_nm).margin(0.006));
  CHECK(std::abs(s.hand_nm + s.torque_nm) < 0.008);
  CHECK(loop.snapshot().faults == 0);
  CHECK(std::abs(s.tau_hat_nm - s.float_nm) < 1e-4);

  loop.hold(Grip::none);  // the wall pushes the lever out
  loop.advance(100'000, 100);
  CHECK(loop.observables().theta_rad < 0.45);
  loop.hold(Grip::hand);  // where it is now
  CHECK(std::abs(loop.observables().hand_torque_nm) < 1e-9);
}

TEST_CASE("a hand gives way where the motor would get too hot, and a warm motor gives less") {
  const auto after = [](Grip grip, double seconds) {
    LiveLoop loop("lever", plant_named("p24"));
    loop.select("wall");
    loop.arm(true);
    loop.hold(grip);
    lead_to(loop, 1.4, 0.5, seconds);
    REQUIRE(loop.snapshot().armed);
    CHECK(loop.snapshot().faults == 0);
    return std::pair{loop.samples().back(), loop.torque_limit_nm()};
  };
  const auto [gentle, whole_nm] = after(Grip::hand, 1.5);
  CHECK(gentle.angle_rad < 0.55);
  CHECK(gentle.torque_nm == Approx(-0.0863).margin(0.008));
  CHECK(whole_nm == Approx(0.5).margin(1e-4));
  const auto [strong, lowered_nm] = after(Grip::strong, 3);  // the fault was after 2.8 s
  CHECK(lowered_nm < 0.2);
  CHECK(std::abs(strong.torque_nm) < 0.2);
}

TEST_CASE("while a hand stands still, a tick moves nothing by leaps") {
  LiveLoop loop = armed_wall();
  lead_to(loop, 0.8, 0.3, 0.0);
  loop.lead(loop.hand_rad());
  const double before = loop.observables().theta_rad;
  loop.advance(1, 1);
  CHECK(loop.hand_rad() == Approx(0.8).margin(1e-12));
  CHECK(std::abs(loop.observables().theta_rad - before) < 20e-6);  // 20 rad/s
}

TEST_CASE("a constant torque acts while the lever is held") {
  LiveLoop loop("lever", plant_named("p24"));
  loop.select("setpoint");
  loop.set("setpoint_torque", 0.1);
  loop.arm(true);
  loop.advance(1'000'000, 100);
  CHECK(loop.snapshot().faults == 0);
  CHECK(loop.observables().theta_rad == 0);
  loop.hold(Grip::hand);
  loop.advance(200'000, 100);
  CHECK(loop.samples().back().torque_nm == Approx(0.1).margin(0.006));
}

TEST_CASE("a wall computed by a slow host shakes where the core's own does not") {
  const auto swing = [](int ticks) {
    LiveLoop loop("lever", plant_named("linear"));
    loop.select("wall");
    loop.set("wall_stiffness", 12 * loop.design().count_rad);
    loop.host_wall(ticks, 0.5, 12, 0.005);
    loop.arm(true);
    loop.hold(Grip::fingertip);
    lead_to(loop, 0.7, 0.5, 1.0);
    double low = 10, high = -10;
    loop.advance(200'000, 50);
    for (const Sample& s : loop.samples()) {
      low = std::min(low, s.angle_rad);
      high = std::max(high, s.angle_rad);
    }
    return high - low;
  };
  CHECK(swing(1) < 0.01);     // the border is at 17 Nm/rad
  CHECK(swing(2040) > 0.05);  // and at 3.4
}

void check_break(Break broken) {
  LiveLoop loop = armed_wall();
  lead_to(loop, 0.55, 0.5, 0.2);
  REQUIRE(loop.snapshot().armed);
  loop.break_it(broken);
  if (broken == Break::channel_dead) {
    lead_to(loop, 0.0, 0.1, 0.5);
  } else {
    loop.hold(Grip::none);  // the wall now pulls
    loop.advance(500'000, 100);
  }
  CHECK(loop.snapshot().faults != 0);
  CHECK_FALSE(loop.snapshot().armed);
  loop.break_it(Break::none);
  loop.advance(1000, 100);
  CHECK_FALSE(loop.snapshot().armed);
  loop.clear_faults();
  loop.advance(1000, 100);
  CHECK(loop.snapshot().faults == 0);
  loop.arm(true);
  loop.advance(1000, 100);
  CHECK(loop.snapshot().armed);
  loop.stop(true);
  loop.advance(1000, 100);
  CHECK_FALSE(loop.snapshot().armed);
  CHECK(((loop.snapshot().faults >> static_cast<int>(Fault::stop)) & 1) == 1);
}

TEST_CASE("broken wires are noticed, and nothing arms again by itself") {
  SECTION("dead") { check_break(Break::channel_dead); }
  SECTION("encoder swapped") { check_break(Break::encoder_swapped); }
  SECTION("motor swapped") { check_break(Break::motor_swapped); }
}

TEST_CASE("recorded inputs survive as text, and every bit of them counts in the hash") {
  RunInputs inputs;
  inputs.clocks = 400'000;
  inputs.pins = {true, false, false};
  const ParameterInfo* torque = design_named("lever").find("torque_limit");
  inputs.writes = {{100, torque->address, 20000, 0}, {5000, 0x200, 3 | 5u << 2, 0}};
  for (int k = 0; k < 60; ++k) {
    const int phase = k % 4;
    inputs.edges.push_back(
        {20'000 + 5'000 * k, {phase == 2 || phase == 3, phase < 1 || phase > 2, false}});
  }
  const std::string text = text_of(inputs);
  const RunInputs again = inputs_from_text(text);
  CHECK(text_of(again) == text);
  const std::uint64_t hash = hash_of("lever", inputs);
  CHECK(hash == hash_of("lever", again));
  CHECK(hex(0xabcu) == "0000000000000abc");

  RunInputs other = inputs;
  ++other.edges[40].clock;
  CHECK(hash_of("lever", other) == hash);  // a clock within a tick is not seen
  other.edges[40].clock += 50;
  CHECK(hash_of("lever", other) != hash);
  other = inputs;
  other.writes[0].data ^= 1;
  CHECK(hash_of("lever", other) == hash);  // a limit that does not act
  other.writes[1].data = 3 | 6u << 2;
  CHECK(hash_of("lever", other) != hash);
  CHECK_THROWS_AS(inputs_from_text("c 5 0\nx"), std::invalid_argument);
}

TEST_CASE("page: a law is felt as it says, and its parameters are turned while it runs") {
  UserLaw law(law_text("detent"), design_named("lever_law"));
  LiveLoop loop("lever_law", plant_named("p24"));
  loop.run_law(law.scene());
  loop.select("law");
  loop.arm(true);
  loop.hold(Grip::hand);
  for (const double rad : {0.3, 0.07, -0.4}) {
    lead_to(loop, rad, 1.0 / 3, 1.0 / 6);
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
  CHECK_THROWS_WITH(loop.set("amplitude", 0.7), Catch::Contains("0.5"));
}

TEST_CASE("page: torque over a turn, parameters and table of a law") {
  UserLaw law(law_text("detent"), design_named("lever_law"));
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
  const UserLaw law(law_text("turn_switch"), design_named("lever_law"));
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

TEST_CASE("page: a law of two axes is refused, and an empty one") {
  const auto refused = [](const std::string& text) {
    try {
      UserLaw law(text, design_named("lever_law"));
    } catch (const law::LawError& error) {
      return error.diagnostics();
    }
    return std::vector<law::Diagnostic>{};
  };
  const auto axes = refused("out torque[1] = 0.1 Nm * sin(position)\n");
  REQUIRE(axes.size() == 1);
  CHECK(axes[0].what.find("axis 1") != std::string::npos);
  CHECK(refused("").size() == 1);
}

}  // namespace
}  // namespace feltgate::page
