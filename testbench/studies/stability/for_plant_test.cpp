// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A design for a plant: which constants differ, the design that has the plant's, its checks.
// Documentation: docs/designs.md
#include "studies/stability/for_plant.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "files/toml/toml_reader.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/stability/loop_poles.hpp"

namespace {

using namespace feltgate;
using stability::closed_loop;
using stability::Constant;
using stability::differing_constants;

const std::string kRoot = FELTGATE_ROOT;

std::string design_path(const std::string& name) {
  return kRoot + "/rtl/designs/" + name + ".toml";
}

plant::Parameters plant_file(const std::string& name) {
  return plant::read_plant_file(kRoot + "/vectors/plants/" + name + ".toml");
}

stability::PlantDesign made_for(const plant::Parameters& p, const std::string& name = "my motor",
                                const std::string& base = "lever") {
  return stability::design_for_plant(design_path(base), p, name, "mine.toml",
                                     design::read_registers(kRoot + "/rtl/registers.toml"));
}

/// A plant in which everything is another: encoder without a power of two, more friction.
plant::Parameters other_plant() {
  plant::Parameters p = plant_file("p24");
  p.motor.torque_constant_nm_a = 0.05;
  p.motor.back_emf_constant_v_s_rad = 0.0499;
  p.motor.resistance_ohm = 0.8;
  p.motor.dead_voltage_v = 0.2;
  p.lever.inertia_kg_m2 = 2e-4;
  p.supply.voltage_v = 18;
  p.supply.diode_drop_v = 0.5;
  p.encoder.lines = 500;
  return p;
}

std::vector<std::string> keys(const std::vector<Constant>& constants) {
  std::vector<std::string> all;
  for (const Constant& c : constants) all.push_back(c.key);
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

TEST_CASE("lever is for p24, and on p48 it is told which constants are others") {
  const design::Design lever = design::read_design(design_path("lever"));
  const plant::Parameters p24 = plant_file("p24"), p48 = plant_file("p48");
  CHECK(differing_constants(lever, p24, p24.effects).empty());
  const auto found = differing_constants(lever, p48, p48.effects);
  CHECK(keys(found) == std::vector<std::string>{"motor.emf_constant_v_s_rad",
                                                "motor.resistance_ohm",
                                                "observer.torque_constant_nm_a"});
  for (const Constant& c : found) {
    if (c.key != "motor.resistance_ohm") continue;
    CHECK(c.of_design == 0.42);
    CHECK(c.of_plant == 1.25);
    CHECK(std::abs(c.excess() - (1.25 / 0.42 - 1)) < 1e-12);
  }
  // What a design adds for an effect that the plant has not is torque too much.
  const plant::Parameters linear = plant_file("linear");
  CHECK(keys(differing_constants(lever, linear, linear.effects)) ==
        std::vector<std::string>{"pwm.diode_drop_v", "voltage.dead_voltage_v"});
}

TEST_CASE("a design for a plant has its constants, and the checker and the poles pass it") {
  const plant::Parameters p = other_plant();
  const stability::PlantDesign made = made_for(p);
  const design::Design& d = made.design.design;
  CHECK(d.torque_constant_nm_a == p.motor.torque_constant_nm_a);
  CHECK(d.emf_constant_v_s_rad == p.motor.back_emf_constant_v_s_rad);
  CHECK(d.resistance_ohm == p.motor.resistance_ohm);
  CHECK(d.dead_voltage_v == p.motor.dead_voltage_v);
  CHECK(d.inertia_kg_m2 == p.lever.inertia_kg_m2);
  CHECK(d.supply_v == p.supply.voltage_v);
  CHECK(d.diode_drop_v == p.supply.diode_drop_v);
  CHECK(d.lines == p.encoder.lines);
  CHECK(differing_constants(d, p, p.effects).empty());
  CHECK(made.changed.size() == 8);
  // What follows from them.
  CHECK(d.current_limit_a == 10.0);
  CHECK(d.exact_gain);
  CHECK(std::abs(d.kp_1_kg_m2 * d.inertia_kg_m2 - 1) < 1e-12);
  CHECK(d.wall_nm_rad <= 2 * p.lugre.coulomb_nm / d.count_rad());
  CHECK(closed_loop(made.design, p).stable());
  CHECK(!made.notes.empty());
  // As a file it reads the same, under the name that it will have.
  CHECK(design::design_from_text(made.text, "mine.toml").name == "mine");
  CHECK(made.text.find("0.0302") == std::string::npos);
}

TEST_CASE("twice the lines move the binary point, four times the current widens its word") {
  plant::Parameters p = plant_file("p24");
  p.encoder.lines = 512;
  p.motor.torque_constant_nm_a = p.motor.back_emf_constant_v_s_rad = 0.0075;
  const design::Design d = made_for(p).design.design;
  CHECK(d.n == 2);
  CHECK(!d.exact_gain);
  CHECK(d.current_limit_a >= 0.5 / 0.0075);
  CHECK(std::ldexp(1.0, d.current.integer) > d.current_limit_a);
}

TEST_CASE("the design for its own plant is the base") {
  const stability::PlantDesign made = made_for(plant_file("p24"));
  CHECK(made.changed.empty());
  CHECK(made.design.design.n == 1);
  CHECK(made.design.design.wall_nm_rad == 4.0);
}

TEST_CASE("a plant's name cannot write into the file") {
  const std::string text = made_for(other_plant(), "a\"\n[clock]\nclock_hz = 1 # \\").text;
  CHECK(design::design_from_text(text, "mine.toml").clock_hz == 50'000'000);
}

TEST_CASE("what cannot be is refused: another law, a supply beyond the word") {
  CHECK_THROWS_AS(made_for(plant_file("p48"), "p48", "paper"), config::ConfigError);
  plant::Parameters p = plant_file("p24");
  p.supply.voltage_v = 48;
  // Without a line: that of a file which is not written helps nobody.
  CHECK_THROWS_WITH(made_for(p),
                    "lever with the constants of the plant my motor is no design: "
                    "\"supply_v\" = 48 is out of range; it must be from 1 to 31.9");
}
