// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core of gimbal_motor in closed loop with a motor of three phases: its torque over a turn, a
// wrong offset, an open phase. Simulation. Documentation: docs/plant.md#three-phases
#include <algorithm>
#include <cmath>
#include <string>

#include "catch.hpp"
#include "files/toml/toml_reader.hpp"
#include "loop_fixture.hpp"
#include "sim/loop/scenario_check.hpp"
#include "sim/plant/plant.hpp"

namespace {

using namespace feltgate;
using Kind = plant::HandPhase::Kind;

constexpr double kTurn = 6.283185307179586;
constexpr int kPolePairs = 11;

plant::Parameters gimbal_motor() {
  return plant::read_plant_file(std::string(FELTGATE_ROOT) + "/vectors/plants/gimbal_motor.toml");
}

/// Bridge and law lose nothing in dead times, so what is left is the commutation.
void without_dead_time(Scenario& s) {
  s.effects.dead_time = false;
  s.parameters["dead_voltage"] = 0;
}

plant::Hand hand_of(Kind kind) {
  plant::HandPhase phase;
  phase.kind = kind;
  plant::Hand hand;
  hand.phases = {phase};
  return hand;
}

plant::Hand turning(double turns_s) {
  plant::Hand hand = hand_of(Kind::kPrescribed);
  plant::Segment s;
  s.kind = plant::Segment::Kind::kRamp;
  s.duration_s = 10;
  s.to = 10 * kTurn * turns_s;
  hand.phases[0].profile = {s};
  return hand;
}

/// The shaft is held where the motor's electrical angle is this.
plant::Hand held_at(double electrical_rad) {
  plant::Hand hand = hand_of(Kind::kLocked);
  hand.start_rad = electrical_rad / kPolePairs;
  return hand;
}

/// A set-point from the start.
Scenario asked(double torque_nm, const plant::Parameters& p) {
  Scenario s;
  s.name = "asked";
  s.effects = p.effects;
  s.scene = "setpoint";
  s.parameters["setpoint_torque"] = torque_nm;
  return s;
}

RunOptions by_twin() {
  RunOptions options;
  options.design = "gimbal_motor";
  options.engine = "twin";
  return options;
}

/// Torque at the shaft over the one that was asked for, less 1, in percent.
struct Errors {
  double mean = 0, low = 1e9, high = -1e9;
  double most() const { return std::max(high, -low); }
};

Errors over(double torque_nm, double turns, double turns_s, Scenario s) {
  constexpr double settled_s = 0.04;
  s.hand = turning(turns_s);
  s.parameters["ramp_step"] = 5 * design_named("gimbal_motor").find("ramp_step")->si;
  s.duration_s = settled_s + turns / std::abs(turns_s);
  Errors e;
  int rows = 0;
  RunOptions options = by_twin();
  options.row = [&](const Row& r) {
    if (r.time_s < settled_s) return;
    const double percent = 100 * (r.motor_torque_nm / r.tau_ref_nm - 1);
    e.mean += percent, ++rows;
    e.low = std::min(e.low, percent);
    e.high = std::max(e.high, percent);
  };
  const RunResult run = run_scenario(s, gimbal_motor(), options);
  CHECK(run.figures.at("faults") == 0);
  CHECK(run.figures.at("tau_ref_end_nm") == Approx(torque_nm).epsilon(0.003));  // an LSB: 2^-16 Nm
  e.mean /= rows;
  return e;
}

/// What became of an arming with the self-test on.
struct Start {
  double fault_s = -1;  ///< of the fault self_test; -1: none
  bool begun = false;   ///< the scene gave its torque
  double end_rad_s = 0;
};

/// The self-test is the one that the design ships, but for `arm_when_held`.
Start start_of(const plant::Parameters& p, const plant::Hand& hand, int open,
               bool arm_when_held = false) {
  const DesignInfo& design = design_named("gimbal_motor");
  Scenario s = asked(0.03, p);
  for (const char* name : {"self_test_pulse", "self_test_arms"}) {
    s.parameters[name] = design.find(name)->si;
  }
  if (arm_when_held) s.parameters["self_test_arms"] = 3;
  s.hand = hand;
  s.duration_s = 0.13;
  if (open >= 0) {
    Event e;
    e.open_phase = open;
    s.events = {e};
  }
  Start start;
  RunOptions options = by_twin();
  options.row = [&](const Row& r) {
    if (r.tau_ref_nm > 0.02) start.begun = true;
    start.end_rad_s = r.omega_rad_s;
  };
  const RunResult run = run_scenario(s, p, options);
  for (const auto& [name, acted] : run.felt.faults) {
    CHECK(name == "self_test");
    start.fault_s = acted.first_s;
  }
  return start;
}

std::string told(const Scenario& s, const plant::Parameters& p, const RunOptions& options) {
  try {
    (void)run_scenario(s, p, options);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("three phases: the torque over a turn is the one asked for", "[phases]") {
  constexpr double kTurns = 3.0 / kPolePairs;  // three electrical ones
  const plant::Parameters p = gimbal_motor();
  for (const auto& [nm, turns_s] : {std::pair{0.005, 2.0}, {0.03, -2.0}}) {
    Scenario s = asked(nm, p);
    without_dead_time(s);
    const Errors e = over(nm, kTurns, turns_s, s);
    CHECK(std::abs(e.mean) < 0.5);
    CHECK(e.most() < 1);
  }
  // What the law gives back is right for a whole turn of a large current, not at each angle.
  for (const auto& [nm, turns_s] : {std::pair{0.002, 2.0}, {0.01, 2.0}, {-0.03, 2.0}}) {
    const Errors e = over(nm, kTurns, turns_s, asked(nm, p));
    CHECK(std::abs(e.mean) < (std::abs(nm) < 0.01 ? 10 : 1));
    CHECK(e.most() < (std::abs(nm) < 0.01 ? 25 : 5));
    if (std::abs(nm) < 0.03) continue;
    // A leg loses this; three lose, along the current, 2/sqrt 3 of it to 4/3, and 4/pi come back.
    const double lost_v = (5 + 2 * 0.7) * 0.5e-6 * 50e3,
                 asked_v = 2.9 * std::abs(nm) / (1.5 * 0.039);
    const double most = 100 * lost_v / asked_v * (8 / kTurn - 2 / std::sqrt(3.0));
    CHECK(e.high - e.mean == Approx(most).epsilon(0.15));
  }
}

TEST_CASE("three phases: the self-test sees an offset that is wrong by a quarter or more",
          "[phases]") {
  for (const int degrees : {0, 45, 90, 180, 270, 315}) {
    plant::Parameters p = gimbal_motor();
    p.phases->offset_rad = degrees / 360.0 * kTurn;
    const Start start = start_of(p, {}, -1);
    INFO(degrees);
    const bool wrong = degrees >= 90 && degrees <= 270;
    CHECK((start.fault_s > 0) == wrong);
    CHECK(start.begun == !wrong);
    // 20 ms of rest, and 2.2 of the pulse, or both pulses of 5 ms where nothing moves.
    const bool quarter = degrees % 180 == 90;
    if (wrong) CHECK(start.fault_s < (quarter ? 0.0305 : 0.0225));
    // A quarter: no torque at all, which is a shaft that somebody holds.
    if (!quarter) continue;
    CHECK(std::abs(start.end_rad_s) < 0.1);
    CHECK(start_of(p, {}, -1, true).begun);  // armed, and dead
  }
}

TEST_CASE("three phases: half a turn off runs away unseen without the self-test", "[phases]") {
  // Against the command, until two back-EMFs, the motor's and the law's, have taken up its voltage:
  // at torque * R/(2 Kt Ke), less what friction takes.
  constexpr double nm = 0.05;
  plant::Parameters p = gimbal_motor();
  p.phases->offset_rad = kTurn / 2;
  Scenario s = asked(nm, p);
  s.duration_s = 0.5;
  double rad_s = 0;
  RunOptions options = by_twin();
  options.row = [&](const Row& r) { rad_s = r.omega_rad_s; };
  const RunResult run = run_scenario(s, p, options);
  CHECK(rad_s == Approx(-nm * 2.9 / (2 * 0.0585 * 0.039)).epsilon(0.06));
  CHECK(run.felt.faults.empty());
}

TEST_CASE("three phases: an open phase takes the torque's part and trips nothing", "[phases]") {
  // With phase a open, b and c carry V sqrt(3) sin(e)/(2 R), which gives sin(e)^2 of the torque.
  const plant::Parameters p = gimbal_motor();
  for (const int degrees : {0, 45, 150}) {
    const double e = degrees / 360.0 * kTurn;
    Scenario s = asked(0.03, p);
    without_dead_time(s);
    s.hand = held_at(e);
    s.duration_s = 0.12;
    Event open;
    open.at_s = 0.1;
    open.open_phase = 0;
    s.events = {open};
    double before_nm = 0, after_nm = 0;
    RunOptions options = by_twin();
    options.row = [&](const Row& r) {
      (r.time_s < open.at_s ? before_nm : after_nm) = r.motor_torque_nm;
    };
    const RunResult run = run_scenario(s, p, options);
    INFO(degrees);
    CHECK(before_nm == Approx(0.03).epsilon(0.01));
    CHECK(after_nm == Approx(0.03 * std::sin(e) * std::sin(e)).margin(0.0003));
    CHECK(run.felt.faults.empty());
  }
  Scenario free = asked(0.05, p);
  free.duration_s = 0.3;
  Event late;
  late.at_s = 0.15;
  late.open_phase = 1;
  free.events = {late};
  CHECK(run_scenario(free, p, by_twin()).felt.faults.empty());
  CHECK(start_of(p, {}, 0, true).begun);  // at e = 0, where it has no torque at all
  int seen = 0, angles = 0;
  for (int degrees = 0; degrees < 180; degrees += 30, ++angles) {
    plant::Hand hand;
    hand.start_rad = degrees / 360.0 * kTurn / kPolePairs;
    const Start start = start_of(p, hand, 0);
    CHECK(start.begun == (start.fault_s < 0));
    if (start.fault_s > 0) ++seen;
  }
  CHECK(seen > 0);
  CHECK(seen < angles / 2);
}

TEST_CASE("three phases: a sensor that fails, and an angle that freezes", "[phases]") {
  struct Case {
    const char* defect;
    double rad_s;
    double fault_ms;  ///< gates off at the latest; 0: nothing sees it
  };
  for (const Case& c : {Case{"magnet_lost", 20, 2},
                        {"cut", 0, 2},
                        {"wrong_bit", 20, 2},
                        {"half_a_turn_off", 20, 2},
                        {"held", 5, 0},
                        {"held", -20, 4}}) {
    Scenario s = asked(0.03, gimbal_motor());
    s.hand = turning(c.rad_s / kTurn);
    s.duration_s = 0.2;
    Event broken;
    broken.at_s = 0.1;
    broken.encoder = c.defect;
    s.events = {broken};
    RunOptions options = by_twin();
    double least_nm = 0, most_nm = 0;
    options.row = [&](const Row& r) {
      if (r.time_s < broken.at_s) return;
      least_nm = std::min(least_nm, r.motor_torque_nm);
      most_nm = std::max(most_nm, r.motor_torque_nm);
    };
    const RunResult run = run_scenario(s, gimbal_motor(), options);
    const auto fault = run.felt.faults.find("encoder");
    const bool seen = fault != run.felt.faults.end();
    const double after_ms = seen ? 1e3 * (fault->second.first_s - broken.at_s) : -1;
    INFO(c.defect << " at " << c.rad_s);
    CHECK(seen == (c.fault_ms > 0));
    CHECK(after_ms < (seen ? c.fault_ms : 0));
    // At most the asked current and that of the back-EMF, in any direction: the angle is wrong.
    const double bound_nm = 0.031 + 1.5 * 0.039 * 0.039 / 2.9 * std::abs(c.rad_s);
    CHECK(most_nm < bound_nm);
    CHECK(least_nm > -bound_nm);
  }
}

TEST_CASE("three phases: a knob that is held at the limit is off before it is hot", "[phases]") {
  const DesignInfo& design = design_named("gimbal_motor");
  Scenario s = asked(0.05, gimbal_motor());
  s.hand = held_at(0);
  s.duration_s = 0.6;
  // Half of the budget is spent at power-up; of the rest this leaves 1 % of the whole.
  s.parameters["i2t_budget"] = 0.51 * design.find("i2t_budget")->si;
  double most_nm = 0;
  RunOptions options = by_twin();
  options.row = [&](const Row& r) { most_nm = std::max(most_nm, r.motor_torque_nm); };
  const RunResult run = run_scenario(s, gimbal_motor(), options);
  REQUIRE(run.felt.faults.count("i2t") == 1);
  const double off_s = run.felt.faults.at("i2t").first_s;
  // 7.4 A^2 s; 0.05 Nm are 0.855 A, and what the dead time takes counts as current too. 0.6 A heat
  // nobody. The ramp takes 0.1 s.
  const double squared = std::pow(0.855 + 8 / kTurn * 0.025 * (5 + 2 * 0.7) / 2.9, 2);
  const double heat = 0.074 + 0.036 - squared * 0.1 / 3;
  CHECK(off_s == Approx(0.1 + heat / (squared - 0.36)).epsilon(0.02));
  CHECK(most_nm < 0.0525);
}

TEST_CASE("three phases: what does not fit is refused", "[phases]") {
  const plant::Parameters p = gimbal_motor();
  Scenario s = asked(0.01, p);
  s.duration_s = 0.001;
  CHECK(told(s, p, by_twin()) == "no error");
  RunOptions options = by_twin();
  options.design = "lever";
  CHECK(told(s, p, options) ==
        "plant gimbal_motor has a motor with three phases, and design lever drives one with "
        "brushes; choose another plant or design");
  CHECK(told(s, p24(), by_twin()) ==
        "plant p24 has a motor with brushes, and design gimbal_motor drives one with three phases; "
        "choose another plant or design");
  options = by_twin();
  options.engine = "double";
  CHECK(told(s, p, options).find("choose the back-ends rtl,twin") != std::string::npos);
  Event open;
  open.line = 7;
  open.open_phase = 2;
  s.events = {open};
  s.path = "s.toml";
  options.design = "lever";
  options.engine = "twin";
  CHECK(told(s, p24(), options) ==
        "s.toml:7: the motor of plant p24 has no phase that could be open; choose a plant that "
        "has, gimbal_motor say");
  CHECK_THROWS_AS(plant::Plant(p, p.effects, {}, {}), std::invalid_argument);

  Scenario free;
  free.plant = "p24";
  choose_plant(free, design_named("lever"));
  CHECK(free.plant == "p24");
  choose_plant(free, design_named("gimbal_motor"));
  CHECK(free.plant == "gimbal_motor");
  free.plant = "p48";
  free.plant_given = true;
  choose_plant(free, design_named("gimbal_motor"));
  CHECK(free.plant == "p48");
}
