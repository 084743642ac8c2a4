// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Files of linkages: their values and their error messages. docs/devices/pantograph.md
#include "catch.hpp"
#include "files/toml/toml_reader.hpp"
#include "pantograph_fixture.hpp"
#include "sim/plant/plant_table.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

std::string shipped_text() {
  std::ifstream in(linkage_file("pantograph"));
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The error of the shipped file with `from` changed, as "line N: text".
std::string error_of(const std::string& from, const std::string& to) {
  std::string text = shipped_text();
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
  text.replace(at, from.size(), to);
  try {
    (void)read_pantograph_text(text, "x.toml");
  } catch (const config::ConfigError& error) {
    const std::string place = "x.toml:" + std::to_string(line) + ": ";
    const std::string what = error.what();
    return what.rfind(place, 0) == 0 ? "here: " + what.substr(place.size()) : what;
  }
  return "no error";
}

}  // namespace

TEST_CASE("the shipped pantograph is read", "[pantograph_file]") {
  const PantographParameters p = pantograph();
  CHECK(p.name == "pantograph");
  CHECK(p.linkage.base_m == 0.0);
  CHECK(p.linkage.rod_5_m == 0.1);
  CHECK(p.bodies.crank_5.mass_kg == 0.0114);
  CHECK(p.bodies.pen_kg == 0.02);
  CHECK(p.joint.ratio() == Approx(3.0));
  CHECK(p.bodies.joint_inertia_kg_m2[1] == Approx(1e-5 + 9 * 1.38e-5));
  CHECK_FALSE(p.joint.encoder_on_motor);
  Effects on = p.effects;
  CHECK(p.smooth_nm_s_rad(on) == Approx(9 * 1.5e-6));
  on.viscous = true;
  CHECK(p.smooth_nm_s_rad(on) == Approx(9 * 1.5e-6 + 1e-3));
  CHECK(p.stops.least_rad == Approx(20 * kDegree));
  CHECK(p.stops.most_rad == Approx(160 * kDegree));
  CHECK(p.motor.torque_constant_nm_a == shipped("p24").motor.torque_constant_nm_a);
  CHECK(p.motor.resistance_ohm == shipped("p24").motor.resistance_ohm);
  CHECK(p.lugre.coulomb_nm == shipped("p24").lugre.coulomb_nm);
  CHECK(p.encoder.lines == 1024);
  CHECK(p.effects.lugre);
  CHECK_FALSE(p.effects.viscous);
  // The links of the file: 1270 kg/m^3, 100 x 15 x 6 mm.
  const double kg = 1270 * 0.1 * 0.015 * 0.006;
  CHECK(p.bodies.rod_1.mass_kg == Approx(kg).epsilon(5e-3));
  CHECK(p.bodies.rod_1.inertia_kg_m2 ==
        Approx(kg * (0.1 * 0.1 + 0.015 * 0.015) / 12).epsilon(5e-3));
}

TEST_CASE("errors of a linkage say file, line, what and mend", "[pantograph_file]") {
  CHECK(error_of("name = ", "name = ") == "no error");
  CHECK(error_of("crank_5_m = 0.1", "crank_5_m = -0.1") ==
        "here: \"crank_5_m\" = -0.1 is out of range; it must be greater than 0");
  CHECK(error_of("least_deg = 20.0", "least_deg = 170.0").find("\"most_deg\" is not above") !=
        std::string::npos);
  CHECK(error_of("most_deg = 160.0", "most_deg = 180.0") ==
        "here: the rods do not meet at 180 degrees; stop the cranks before the linkage is "
        "straight, or make the rods longer");
  CHECK(error_of("least_deg = 20.0", "least_deg = 0.0").find("do not meet at 0 degrees") !=
        std::string::npos);
  CHECK(error_of("start_m = [0.0, 0.1]", "start_m = [0.0, 0.3]") ==
        "here: the pen cannot be there; choose a place within the links' reach");
  CHECK(error_of("start_m = [0.0, 0.1]", "start_m = [0.0, 0.199]") ==
        "here: the cranks are 11.46 degrees apart there, beyond a stop; choose a place between "
        "the stops");
  CHECK(error_of("start_m = [0.0, 0.1]", "start_m = [0.1]") ==
        "here: \"start_m\" is not two numbers; write x and y, m");
  CHECK(error_of("encoder = \"joint\"", "encoder = \"pen\"") ==
        "here: \"encoder\" = \"pen\" is not known; it must be one of joint, motor");
  CHECK(error_of("restitution = 0.7", "restitution = 0.05").find("out of range") !=
        std::string::npos);
  CHECK(error_of("drum_radius_m", "drum_radius").find("\"drum_radius_m\" is missing") !=
        std::string::npos);
  CHECK(error_of("[rod_5]", "[rod_3]").find("\"rod_5\" is missing") != std::string::npos);
  CHECK(error_of("torque_constant_nm_a = 0.0302", "torque_constant_nm_a = 0").find("here:") == 0);
  CHECK(error_of("lugre = true", "lugre = 1").find("here:") == 0);
  CHECK_THROWS_AS(read_pantograph_file("/nonexistent/linkage.toml"), config::ConfigError);
}

TEST_CASE("the hand of a scene with a pen, and its errors", "[pantograph_file]") {
  const auto read = [](const std::string& text) {
    const toml::table table = toml::parse(text);
    return read_pen_hand(config::TomlReader(table, "s.toml", "the file").section("hand"));
  };
  const PenHand hand = read(R"([hand]
start_m = [0.01, 0.13]
[[hand.phase]]
kind = "impedance"
x = [{kind = "sine", amplitude_m = 0.02, frequency_hz = 2, duration_s = 0.5}]
y = [{kind = "step", to_m = 0.08, duration_s = 0.2}, {kind = "hold", duration_s = 0.6}]
stiffness_n_m = 200
[[hand.phase]]
kind = "force"
y = [{kind = "ramp", to_n = -1.5, duration_s = 0.3}]
[[hand.phase]]
kind = "prescribed"
x = [{kind = "minimum_jerk", to_m = 0.03, duration_s = 0.4}]
duration_s = 1
[[hand.phase]]
kind = "free"
)");
  REQUIRE(hand.phases.size() == 4);
  CHECK(hand.start_m->y == 0.13);
  CHECK(hand.phases[0].duration_s == Approx(0.8));
  CHECK(hand.phases[0].impedance.stiffness_n_m == 200.0);
  CHECK(hand.phases[0].impedance.mass_kg == 0.554);
  CHECK(hand.phases[0].x[0].amplitude == 0.02);
  CHECK(hand.phases[1].kind == PenPhase::Kind::kForce);
  CHECK(hand.phases[1].x.empty());
  CHECK(hand.phases[1].y[0].to == -1.5);
  CHECK(hand.phases[2].duration_s == 1.0);
  CHECK(std::isinf(hand.phases[3].duration_s));
  const auto error = [&read](const std::string& phase) {
    try {
      (void)read("[hand]\n[[hand.phase]]\n" + phase);
    } catch (const config::ConfigError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  CHECK(error("kind = \"cord\"") ==
        "s.toml:3: \"kind\" = \"cord\" is not known; it must be one of free, prescribed, "
        "impedance, force");
  CHECK(error("kind = \"force\"") ==
        "s.toml:3: neither \"x\" nor \"y\" is there; write the motion of one at least");
  CHECK(error("kind = \"prescribed\"\nx = [{kind = \"step\", to_m = 1, duration_s = 1}]") ==
        "s.toml:4: an imposed place cannot step; use ramp or minimum_jerk");
  CHECK(error("kind = \"force\"\nx = [{kind = \"step\", to_m = 1, duration_s = 1}]")
            .find("\"to_n\" is missing") != std::string::npos);
  CHECK(error("kind = \"free\"\nz = 1").find("\"z\" is unknown") != std::string::npos);
}
