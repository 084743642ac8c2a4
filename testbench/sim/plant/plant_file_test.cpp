// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Plant files and [hand] tables: their values and their error messages. docs/plant.md
#include <cstdio>
#include <fstream>

#include "catch.hpp"
#include "plant_fixture.hpp"
#include "sim/plant/plant_table.hpp"
#include "sim/plant/profile.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

std::string p24_text() {
  std::ifstream in(std::string(FELTGATE_SOURCE_DIR) + "/vectors/plants/p24.toml");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

int line_of(const std::string& text, const std::string& what) {
  int line = 1;
  const auto at = text.find(what);
  REQUIRE(at != std::string::npos);
  for (std::size_t i = 0; i < at; ++i) line += text[i] == '\n' ? 1 : 0;
  return line;
}

std::string plant_error(const std::string& text) {
  const toml::table table = toml::parse(text);
  try {
    (void)read_plant(table, "x.toml");
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return "no error";
}

std::string hand_error(const std::string& text) {
  const toml::table table = toml::parse(text);
  try {
    (void)read_hand(config::TomlReader(table, "s.toml", "the file").section("hand"));
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return "no error";
}

Hand hand_from(const std::string& text) {
  const toml::table table = toml::parse(text);
  return read_hand(config::TomlReader(table, "s.toml", "the file").section("hand"));
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("shipped plants are read", "[plant_file]") {
  const Parameters p24 = shipped("p24");
  CHECK(p24.name == "p24");
  CHECK(p24.motor.resistance_ohm == 0.42);
  CHECK(p24.motor.inductance_h == 82.3e-6);
  CHECK(p24.lever.inertia_kg_m2 == 1.22e-4);
  CHECK(p24.encoder.edge_offset_counts[3] == -0.07);
  CHECK(p24.effects.lugre);
  CHECK_FALSE(p24.effects.supply_limit);
  CHECK(shipped("p48").motor.torque_constant_nm_a == 0.0603);
  const Parameters linear = shipped("linear");
  CHECK_FALSE(linear.effects.lugre);
  CHECK_FALSE(linear.effects.dead_voltage);
  CHECK_FALSE(linear.effects.dead_time);
  // 0.5 Nm: 16.6 A and 6.95 V + dead voltage; the winding's 0.211 Nm at 7 A.
  CHECK(0.5 / p24.motor.torque_constant_nm_a == Approx(16.6).epsilon(0.01));
  CHECK(7.0 * p24.motor.torque_constant_nm_a == Approx(0.211).epsilon(0.01));
  CHECK(7.0 * shipped("p48").motor.torque_constant_nm_a == Approx(0.42).epsilon(0.01));
}

TEST_CASE("errors of a plant file say file, line, what and mend", "[plant_file]") {
  const std::string good = p24_text();
  CHECK(plant_error(good) == "no error");
  const std::string stops =
      good +
      "\n[end_stops]\nlow_rad = -1.0\nhigh_rad = 1.0\nstiffness_nm_rad = 100.0\n"
      "restitution = 0.5\n";
  CHECK(plant_error(stops) == "no error");
  CHECK(contains(plant_error(replaced(stops, "high_rad = 1.0", "high_rad = -1.0")),
                 "\"high_rad\" is not above \"low_rad\"; leave the lever a way: raise it"));
  CHECK(contains(plant_error(replaced(stops, "restitution = 0.5", "restitution = 1.5")),
                 "out of range"));
  const std::string cogging =
      good + "\n[[cogging]]\nper_turn = 12\namplitude_nm = 0.01\nphase_rad = 0\n";
  CHECK(plant_error(cogging) == "no error");
  CHECK(contains(plant_error(replaced(cogging, "per_turn = 12", "per_turn = 0")), "per_turn"));
  CHECK(contains(plant_error(replaced(good, "[0.0, 0.10, 0.05, -0.07]", "[0.0, 0.1]")), "four"));
  CHECK(contains(plant_error(replaced(good, "0.10,", "0.60,")), "from -0.25 to 0.25"));
  CHECK(contains(plant_error(replaced(good, "static_nm = 4.5e-3", "static_nm = 1e-3")), "raise"));
  CHECK(contains(plant_error(replaced(good, "[supply]", "[suply]")), "\"supply\" is missing"));
  CHECK(contains(plant_error(replaced(good, "name = \"p24\"", "name = \"p24\"\nx = 1")),
                 "\"x\" is unknown in the file"));
  CHECK_THROWS_AS(read_plant_file("/nonexistent/plant.toml"), config::ConfigError);
}

TEST_CASE("a motor with three phases", "[plant_file]") {
  std::string good = p24_text();
  const auto from = good.find("[motor]"), to = good.find("[lever]");
  good.replace(from, to - from, R"([motor]
phases = 3
pole_pairs = 11
offset_rad = -0.5
back_emf_v_s_rad = 0.05
resistance_ohm = 10
inductance_h = 2e-3

[[emf_harmonic]]
order = 5
share = -0.06

)");
  good = replaced(good, "dead_voltage = true", "dead_voltage = false");
  REQUIRE(plant_error(good) == "no error");
  const Parameters p = read_plant(toml::parse(good), "x.toml");
  REQUIRE(p.phases);
  CHECK(p.phases->pole_pairs == 11);
  CHECK(p.phases->offset_rad == -0.5);
  CHECK(p.phases->back_emf_v_s_rad == 0.05);
  REQUIRE(p.phases->harmonics.size() == 1);
  CHECK(p.phases->harmonics[0].order == 5);
  CHECK(p.phases->harmonics[0].share == -0.06);
  // Its stall torque and power are those of the motor itself, at the peak of its currents.
  CHECK(p.motor.torque_constant_nm_a == Approx(0.075));
  CHECK(p.motor.back_emf_constant_v_s_rad == 0.05);
  CHECK(p.motor.resistance_ohm == 10);
  CHECK(p.motor.inductance_h == 2e-3);
  CHECK(p.motor.dead_voltage_v == 0);
  CHECK_FALSE(read_plant(toml::parse(p24_text()), "x.toml").phases);

  const auto line = [](const std::string& text, const std::string& what) {
    return "x.toml:" + std::to_string(line_of(text, what)) + ": ";
  };
  const std::string four = replaced(good, "phases = 3", "phases = 4");
  CHECK(contains(plant_error(four), line(four, "phases = 4")));
  CHECK(contains(plant_error(four), "from 2 to 3"));
  for (const auto& [was, is] :
       {std::pair<std::string, std::string>{"pole_pairs = 11", "pole_pairs = 0"},
        {"pole_pairs = 11", "pole_pairs = 1.5"},
        {"offset_rad = -0.5", "offset_rad = 40"},
        {"back_emf_v_s_rad = 0.05", "back_emf_v_s_rad = 0"},
        {"resistance_ohm = 10", "resistance_ohm = 0"},
        {"inductance_h = 2e-3", "inductance_h = -2e-3"},
        {"order = 5", "order = 1"},
        {"share = -0.06", "share = 1.5"}}) {
    const std::string bad = replaced(good, was, is);
    CHECK(contains(plant_error(bad), line(bad, is)));
  }
  const std::string brushes = replaced(good, "dead_voltage = false", "dead_voltage = true");
  CHECK(plant_error(brushes) == line(brushes, "dead_voltage = true") +
                                    "a motor with three phases has no brushes; write "
                                    "dead_voltage = false");
  // The keys of one motor are none of the other.
  const std::string both = replaced(good, "phases = 3", "phases = 3\ndead_voltage_v = 0.3");
  CHECK(contains(plant_error(both), line(both, "dead_voltage_v") + "key \"dead_voltage_v\""));
  const std::string two = replaced(p24_text(), "[motor]", "[motor]\nphases = 2\npole_pairs = 11");
  CHECK(contains(plant_error(two), line(two, "pole_pairs") + "key \"pole_pairs\""));
}

TEST_CASE("a scene overrides single effects", "[plant_file]") {
  const toml::table table = toml::parse("[effects]\nsupply_limit = true\nlugre = false\n");
  const Effects effects = read_effects(
      config::TomlReader(table, "s.toml", "the file").section("effects"), shipped("p24").effects);
  CHECK(effects.supply_limit);
  CHECK_FALSE(effects.lugre);
  CHECK(effects.inductance);
}

TEST_CASE("the hand of a scene", "[plant_file]") {
  const Hand hand = hand_from(R"([hand]
start_rad = 0.3
radius_m = 0.2
[[hand.phase]]
kind = "locked"
duration_s = 1
[[hand.phase]]
kind = "prescribed"
motion = [
  {kind = "minimum_jerk", to_rad = 0.7, duration_s = 0.4},
  {kind = "sine", amplitude_rad = 0.1, frequency_hz = 2, phase_rad = 1.57, duration_s = 1.0},
]
[[hand.phase]]
kind = "torque"
torque = [{kind = "step", to_nm = 0.2, duration_s = 0.1}]
duration_s = 0.3
[[hand.phase]]
kind = "impedance"
mass_kg = 0.4
motion = [{kind = "hold", duration_s = 2}]
[[hand.phase]]
kind = "cord"
stiffness_nm_rad = 0.4
)");
  REQUIRE(hand.phases.size() == 5);
  CHECK(hand.initial_rad() == 0.3);
  CHECK(*hand.radius_m == 0.2);
  CHECK(hand.phases[0].kind == HandPhase::Kind::kLocked);
  CHECK(hand.phases[1].duration_s == Approx(1.4));
  CHECK(hand.phases[1].profile[1].frequency_hz == 2.0);
  CHECK(hand.phases[2].duration_s == 0.3);
  CHECK(hand.phases[3].impedance.mass_kg == 0.4);
  CHECK(hand.phases[3].impedance.grip_stiffness_n_m == 3000.0);
  CHECK(hand.phases[4].cord.stiffness_nm_rad == 0.4);
  CHECK(hand.phases[4].cord.damping_nm_s_rad == 0.1);
  CHECK(std::isinf(hand.phases[4].duration_s));
  const Hand traced = hand_from(
      "[hand]\n[[hand.phase]]\nkind = \"trace\"\ntime_s = [0, 1]\ntheta_rad = [0.5, 0.6]\n");
  CHECK(traced.initial_rad() == 0.5);
}

TEST_CASE("errors of a hand say file, line, what and mend", "[plant_file]") {
  const auto error = [](const std::string& phase) {
    return hand_error("[hand]\n[[hand.phase]]\n" + phase);
  };
  CHECK(error("kind = \"glued\"") ==
        "s.toml:3: \"kind\" = \"glued\" is not known; it must be one of free, locked, prescribed, "
        "trace, impedance, cord, torque");
  CHECK(contains(error("kind = \"prescribed\""), "\"motion\" is missing or empty"));
  CHECK(contains(error("kind = \"prescribed\"\n"
                       "motion = [{kind = \"step\", to_rad = 1, duration_s = 1}]"),
                 "s.toml:4: an imposed angle cannot step; use ramp or minimum_jerk"));
  CHECK(contains(error("kind = \"torque\"\ntorque = [{kind = \"ramp\", to_rad = 1, "
                       "duration_s = 1}]"),
                 "\"to_nm\" is missing"));
  CHECK(contains(error("kind = \"free\"\n[[hand.phase]]\nkind = \"locked\""),
                 "\"duration_s\" is missing"));
  CHECK(contains(error("kind = \"free\"\nstifness = 1"), "\"stifness\" is unknown"));
  CHECK(contains(error("kind = \"trace\"\ntime_s = [0, 1, 1]\ntheta_rad = [0, 0, 0]"),
                 "time does not increase at sample 2"));
  CHECK(contains(error("kind = \"trace\"\ntime_s = [0, 1]\ntheta_rad = [0]"), "2 times and 1"));
  CHECK(
      contains(error("kind = \"trace\"\nfile = \"nowhere.csv\""), "nowhere.csv: cannot be opened"));
  CHECK(contains(hand_error("[hand]\nstart_rad = 1\n[[hand.phase]]\nkind = \"trace\"\n"
                            "time_s = [0, 1]\ntheta_rad = [0, 1]"),
                 "start_rad"));
}

TEST_CASE("a recorded motion is read from CSV", "[plant_file]") {
  const std::string path = std::string(FELTGATE_BUILD_DIR) + "/plant_trace_test.csv";
  const auto read = [&path](const std::string& text) {
    std::ofstream(path) << text;
    return read_trace_file(path);
  };
  const Trace trace = read("time_s,theta_rad\n0,0.5\r\n0.25,-1e-3\n");
  CHECK(trace.time_s == std::vector<double>{0.0, 0.25});
  CHECK(trace.theta_rad == std::vector<double>{0.5, -1e-3});
  for (const char* bad : {"", "t,x\n0,0\n", "time_s,theta_rad\n0\n", "time_s,theta_rad\n0,a\n",
                          "time_s,theta_rad\n0,nan\n", "time_s,theta_rad\n0,1,2\n"}) {
    CHECK_THROWS_AS(read(bad), config::ConfigError);
  }
  std::remove(path.c_str());
}
