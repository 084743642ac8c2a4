// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The alignment of a motor with three phases in closed loop: readings as a host takes them, and the
// torque with the words that follow from them. Simulation. Documentation: docs/calibration.md
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "host/calibrate/align.hpp"
#include "mismatch.hpp"
#include "sim/loop/loop.hpp"
#include "sim/plant/plant_file.hpp"

using namespace feltgate;
using namespace feltgate::host;

namespace {

constexpr double kTurn = 6.283185307179586, kCounts = 16384;

plant::Parameters motor(int pole_pairs, double offset_rad) {
  plant::Parameters p = plant::read_plant_file(FELTGATE_ROOT "/vectors/plants/gimbal_motor.toml");
  p.phases->pole_pairs = pole_pairs;
  p.phases->offset_rad = offset_rad;
  return p;
}

RunOptions by_twin() {
  RunOptions options;
  options.design = "gimbal_motor";
  options.engine = "twin";
  return options;
}

/// With a gain of 0 and 1 V the voltage turns by a whole turn and back, an eighth every 0.2 s; the
/// host reads the position before each step.
std::vector<AlignReading> taken(const plant::Parameters& p, int open_phase = -1) {
  constexpr double step_s = 0.2;
  std::vector<double> angles;
  take_readings([&](double turns) { return angles.push_back(turns), true; }, [] { return 0.0; });
  CHECK(angles.size() == 17);
  Scenario s;
  s.effects = p.effects;
  s.mode = 2;
  s.parameters = {{"commutation_gain", 0}, {"commutation_offset", 0}, {"voltage_setpoint", 1}};
  for (std::size_t k = 0; k < angles.size(); ++k) {
    Event e;
    e.at_s = static_cast<double>(k) * step_s;
    e.set["commutation_offset"] = angles[k];
    if (k == 0 && open_phase >= 0) e.open_phase = open_phase;
    s.events.push_back(e);
  }
  s.duration_s = static_cast<double>(angles.size()) * step_s;
  std::vector<AlignReading> readings(angles.size());
  RunOptions options = by_twin();
  options.row = [&](const Row& r) {
    const auto k = static_cast<std::size_t>(r.time_s / step_s);
    const std::size_t at = std::min(k, angles.size() - 1);
    readings[at] = {angles[at], r.position_rad / kTurn * kCounts};
  };
  const RunResult run = run_scenario(s, p, options);
  CHECK(run.figures.at("faults") == 0);
  return readings;
}

/// Torque over the one that was asked for, over an electrical turn that a hand turns.
double share_of_torque(const plant::Parameters& p, const Alignment& found) {
  Scenario s;
  s.effects = p.effects;
  s.effects.dead_time = false;
  s.scene = "setpoint";
  s.parameters = {{"setpoint_torque", 0.03},
                  {"dead_voltage", 0},
                  {"commutation_gain", found.whole / kCounts},
                  {"commutation_offset", found.offset_turns.value}};
  plant::HandPhase phase;
  phase.kind = plant::HandPhase::Kind::kPrescribed;
  plant::Segment turning;
  turning.kind = plant::Segment::Kind::kRamp;
  turning.duration_s = 1;
  turning.to = kTurn;
  phase.profile = {turning};
  s.hand.phases = {phase};
  const double settled_s = 0.12;
  s.duration_s = settled_s + 1.0 / found.whole;
  double sum = 0;
  int rows = 0;
  RunOptions options = by_twin();
  options.row = [&](const Row& r) {
    if (r.time_s < settled_s) return;
    sum += r.motor_torque_nm / 0.03, ++rows;
  };
  run_scenario(s, p, options);
  return sum / rows;
}

/// Readings of a rotor without friction, from angles and its place in the torque of each.
std::vector<AlignReading> ideal(double pole_pairs, double offset_turns, int steps) {
  std::vector<AlignReading> readings;
  for (int k = 0; k <= steps; ++k) {
    const double voltage = k / 8.0;
    readings.push_back(
        {std::fmod(voltage, 1.0), (voltage + 0.25 - offset_turns) / pole_pairs * kCounts});
  }
  return readings;
}

}  // namespace

TEST_CASE("alignment: with the words that it gives the torque is the one asked for") {
  struct Motor {
    int pole_pairs;
    double offset_rad;
  };
  for (const Motor& m : {Motor{7, -1.0}, Motor{11, 2.0}}) {
    if (m.pole_pairs == 11 && !test::whole_run()) continue;
    const plant::Parameters p = motor(m.pole_pairs, m.offset_rad);
    const Alignment found = fit_alignment(taken(p), kCounts, 0.95);
    CHECK(found.whole == m.pole_pairs);
    CHECK(found.pole_pairs.contains(m.pole_pairs));
    CHECK_FALSE(found.against());
    const double error = std::remainder(found.offset_turns.value - m.offset_rad / kTurn, 1.0);
    INFO("offset off by " << 360 * error << " degrees, left over " << 360 * found.rest_turns);
    CHECK(std::abs(360 * error) < 2);
    CHECK(share_of_torque(p, found) == Approx(1).epsilon(0.01));
  }
}

TEST_CASE("alignment: an open phase is told from a rotor that follows") {
  CHECK_THROWS_WITH(fit_alignment(taken(motor(11, 0.5), 2), kCounts, 0.95),
                    Catch::Contains("look for a phase that is open"));
}

TEST_CASE("alignment: closed forms, and readings that tell nothing") {
  const Alignment a = fit_alignment(ideal(7, 0.3, 16), kCounts, 0.95);
  CHECK(a.whole == 7);
  CHECK(a.offset_turns.value == Approx(0.3));
  CHECK(a.rest_turns < 1e-9);
  CHECK(a.warnings.empty());
  const Alignment against = fit_alignment(ideal(-7, 0.3, 16), kCounts, 0.95);
  CHECK(against.against());
  CHECK(against.whole == 7);
  CHECK(against.warnings.size() == 1);
  const auto fails = [](const std::vector<AlignReading>& readings, const std::string& why) {
    CHECK_THROWS_WITH(fit_alignment(readings, kCounts, 0.95), Catch::Contains(why));
  };
  fails(ideal(7, 0.3, 3), "4 readings do not tell");
  fails(ideal(7, 0.3, 6), "the voltage turned by 0.75");
  fails(ideal(7.4, 0.3, 16), "7.4 pole pairs are no whole number");
  std::vector<AlignReading> stuck = ideal(7, 0.3, 16);
  for (AlignReading& r : stuck) r.position_counts = 100;
  fails(stuck, "the rotor never moved");
  std::istringstream file("commutation_offset, position\n0, 12\n0.125, nan\n");
  CHECK_THROWS_AS(align_readings(ColumnTable(file, "a.csv")), MeasurementError);
}

TEST_CASE("alignment: what it changes in a design") {
  design::Elaborated e;
  e.design.motor_polarity = 1;
  const auto changes = changes_of(fit_alignment(ideal(7, 0.25, 16), kCounts, 0.95), e);
  REQUIRE(changes.size() == 2);
  CHECK(changes[0].section == "commutation");
  CHECK(changes[0].key == "pole_pairs");
  CHECK(changes[0].value == 7);
  CHECK(changes[1].key == "offset_rad");
  CHECK(changes[1].value == Approx(kTurn / 4));
  const auto turned = changes_of(fit_alignment(ideal(-7, 0.25, 16), kCounts, 0.95), e);
  REQUIRE(turned.size() == 1);
  CHECK(turned[0].key == "polarity");
  CHECK(turned[0].value == 0);
}
