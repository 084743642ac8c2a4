// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A design for a plant: which constants differ, the design that has the plant's, its checks.
// Documentation: docs/designs.md
#include "studies/stability/for_plant.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

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

constexpr double kNominal_a = 5.77;  // of lever

stability::PlantDesign made_for(const plant::Parameters& p, double nominal_a = kNominal_a,
                                const std::string& base = "lever",
                                const std::string& name = "my motor") {
  return stability::design_for_plant(design_path(base), p, nominal_a, name, "mine.toml",
                                     design::read_registers(kRoot + "/rtl/registers.toml"));
}

bool tells(const stability::PlantDesign& made, const std::string& part) {
  return std::any_of(made.notes.begin(), made.notes.end(), [&part](const std::string& note) {
    return note.find(part) != std::string::npos;
  });
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
  CHECK(d.current_limit_a == 16.6);
  CHECK(d.torque_limit_nm == 0.827);
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
  p.motor.resistance_ohm = 0.2;
  p.lever.inertia_kg_m2 = 3e-5;
  p.lugre = {};
  p.effects.lugre = false;
  const design::Design d = made_for(p, 23).design.design;
  CHECK(d.n == 2);
  CHECK(!d.exact_gain);
  CHECK(d.current_limit_a == Approx(23 * 16.6 / 5.77).epsilon(0.01));
  CHECK(std::ldexp(1.0, d.current.integer) > d.current_limit_a);
}

TEST_CASE("the limits follow from the motor's nominal current, as far as the supply gives it") {
  plant::Parameters p = plant_file("p24");
  const design::Design d = made_for(p, 3.5).design.design;
  CHECK(d.nominal_current_a == 3.5);
  CHECK(d.current_limit_a == Approx(3.5 * 16.6 / 5.77).epsilon(0.02));
  CHECK(d.torque_limit_nm <= d.current_limit_a * d.torque_constant_nm_a);
  CHECK(d.i2t_budget_a2_s == Approx(730 * std::pow(3.5 / 5.77, 2)).epsilon(0.03));
  CHECK(d.membrane_nm <= d.torque_limit_nm);
  p.supply.voltage_v = 6;
  const stability::PlantDesign weak = made_for(p, 15);
  CHECK(tells(weak, "the supply gives no more"));
  CHECK(weak.design.design.current_limit_a * 0.42 < 6);
}

TEST_CASE("a motor that cannot move its lever has no design, and a sentence says why") {
  plant::Parameters p = plant_file("p24");
  CHECK_THROWS_WITH(made_for(p, 0.04),
                    Catch::Contains("the friction of 0.0045 Nm holds the lever"));
  p.motor.dead_voltage_v = 22.9;
  CHECK_THROWS_WITH(made_for(p), Catch::Contains("beyond brushes and dead time"));
}

TEST_CASE("48 V is taken, and a million counts: formats fit, scenes that do not are left out") {
  plant::Parameters p = plant_file("p48");
  p.supply.voltage_v = 48;
  const design::Design high = made_for(p, 3.1).design.design;
  CHECK(high.supply_v == 48);
  CHECK(high.voltage.integer == 6);
  p.encoder.lines = 250'000;
  const stability::PlantDesign fine = made_for(p, 3.1);
  CHECK(tells(fine, "without charge_attract, charge_repel"));
  const auto& scenes = fine.design.design.scenes;
  CHECK(std::find(scenes.begin(), scenes.end(), "charge_attract") == scenes.end());
  CHECK(std::find(scenes.begin(), scenes.end(), "wall") != scenes.end());
  CHECK(fine.design.design.fast_edges());
  CHECK(fine.design.design.self_test_drop() == 5);
}

TEST_CASE(
    "a coarse encoder: longer ticks, no self-test that swings the lever, a monitor that sees") {
  plant::Parameters p = plant_file("p24");
  p.encoder.lines = 12;
  const stability::PlantDesign made = made_for(p);
  const design::Design& d = made.design.design;
  CHECK(d.tick_hz == 125'000);
  CHECK(!d.self_test);
  CHECK(made.design.word("self_test_torque").raw == 0);  // a host that writes a pulse gets none
  CHECK(tells(made, "the self-test is off"));
  const double row_s = std::ldexp(Map::edge_units - 1, d.edge_unit_bits()) * d.tick_s();
  CHECK(2 * d.count_rad() / row_s < 8);  // rad/s from which a dead channel is seen
  CHECK(row_s < 0.04);                   // a hand that trembles makes edges farther apart
}

TEST_CASE("an absolute encoder's design: its bits, or the plant's where they are a power of two") {
  plant::Parameters p = plant_file("p24");
  p.encoder.lines = 1000;
  const stability::PlantDesign spi = made_for(p, 3, "lever_absolute");
  CHECK(spi.design.design.absolute_bits == 14);
  CHECK(tells(spi, "absolute_encoder.bits is still 14"));
  const plant::Parameters gimbal = plant_file("gimbal_motor");
  const stability::PlantDesign own = made_for(gimbal, 0.6, "gimbal_motor");
  for (const Constant& c : own.changed) INFO(c.key << " " << c.of_design << " " << c.of_plant);
  CHECK(keys(own.changed) == std::vector<std::string>{});
  CHECK(own.design.design.torque_limit_nm == 0.05);
  plant::Parameters other = gimbal;
  other.encoder.lines = 1 << 16;
  other.phases->pole_pairs = 7;
  other.phases->offset_rad = 0.5;
  const design::Design d = made_for(other, 0.6, "gimbal_motor").design.design;
  CHECK(d.absolute_bits == 18);
  CHECK(d.pole_pairs == 7);
  CHECK(d.commutation_offset_rad == 0.5);
  CHECK_THROWS_WITH(made_for(plant_file("p24"), 3, "gimbal_motor"), Catch::Contains("brushes"));
}

TEST_CASE("a gear: the plant is the motor without one that does the same at the lever") {
  const auto geared = [](const std::string& gear) {
    std::ifstream in(kRoot + "/vectors/plants/p24.toml");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::string path = std::string(FELTGATE_TEST_FOLDER) + "/geared.toml";
    std::ofstream(path) << text << gear;
    return plant::read_plant_file(path);
  };
  const plant::Parameters p =
      geared("\n[gear]\nratio = 4.5\nrotor_inertia_kg_m2 = 1.4e-5\nencoder = \"motor\"\n");
  CHECK(p.motor.torque_constant_nm_a == Approx(4.5 * 0.0302));
  CHECK(p.motor.back_emf_constant_v_s_rad == Approx(4.5 * 0.0302));
  CHECK(p.lever.inertia_kg_m2 == Approx(1.22e-4 + 4.5 * 4.5 * 1.4e-5));
  CHECK(p.encoder.lines == 4608);
  const design::Design d = made_for(p).design.design;
  CHECK(d.torque_limit_nm == Approx(4.5 * 0.5).epsilon(0.01));
  CHECK(d.current_limit_a == Approx(16.6).epsilon(0.01));
  CHECK_THROWS_WITH(geared("\n[gear]\nratio = 4.7\nrotor_inertia_kg_m2 = 0\nencoder = \"motor\"\n"),
                    Catch::Contains("1024 lines of the motor are 4812.8 in a turn of the lever") &&
                        Catch::Contains("4.7001953125"));
  CHECK(geared("\n[gear]\nratio = 4.7001953\nrotor_inertia_kg_m2 = 0\nencoder = \"motor\"\n")
            .encoder.lines == 4813);
}

TEST_CASE("the design for its own plant is the base") {
  const stability::PlantDesign made = made_for(plant_file("p24"));
  CHECK(made.changed.empty());
  CHECK(made.design.design.n == 1);
  CHECK(made.design.design.wall_nm_rad == 4.0);
}

TEST_CASE("a plant's name cannot write into the file") {
  const std::string text =
      made_for(other_plant(), kNominal_a, "lever", "a\"\n[clock]\nclock_hz = 1 # \\").text;
  CHECK(design::design_from_text(text, "mine.toml").clock_hz == 50'000'000);
}

TEST_CASE("what cannot be is refused: another law, a supply beyond the word") {
  CHECK_THROWS_AS(made_for(plant_file("p48"), 3.1, "paper"), config::ConfigError);
  plant::Parameters p = plant_file("p24");
  p.supply.voltage_v = 120;
  // Without a line: that of a file which is not written helps nobody.
  CHECK_THROWS_WITH(made_for(p),
                    "lever with the constants of the plant my motor is no design: "
                    "\"supply_v\" = 120 is out of range; it must be from 1 to 100");
}
