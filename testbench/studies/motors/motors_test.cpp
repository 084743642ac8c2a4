// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Designs that `feltgate design --for-plant` makes, each on its motor in simulation: it arms, holds
// a torque and trips.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "catch.hpp"
#include "kinds.hpp"
#include "moves.hpp"
#include "sim/backends/backend.hpp"
#include "sim/loop/loop.hpp"
#include "sim/loop/replay.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/traces/open.hpp"

namespace {

using namespace feltgate;
using HandKind = plant::HandPhase::Kind;

/// One motor with its design.
class Bench {
 public:
  explicit Bench(const test::Kind& kind)
      : kind_(kind), plant_(test::plant_of(kind)), design_(design_named(kind.name)) {}

  double si(const char* word) const { return design_.find(word)->si; }
  const DesignInfo& design() const { return design_; }
  const plant::Parameters& plant() const { return plant_; }
  bool tested() const { return si("self_test_pulse") > 0; }
  double slower() const { return 1e6 / static_cast<double>(design_.tick_hz); }
  /// The motor's leads are exchanged.
  void swap_leads() {
    plant_.motor.torque_constant_nm_a *= -1;
    plant_.motor.back_emf_constant_v_s_rad *= -1;
    if (plant_.phases) plant_.phases->offset_rad += plant::kTwoPi / 2;
  }

  Scenario asked(double torque_nm) const {
    Scenario s;
    s.name = kind_.name;
    s.effects = plant_.effects;
    s.scene = "setpoint";
    s.arm_s = 0.002;
    s.parameters["setpoint_torque"] = torque_nm;
    s.parameters["hold_time"] = 8192;
    return s;
  }
  static void hand(Scenario& s, HandKind kind, double rad_s = 0) {
    plant::HandPhase phase;
    phase.kind = kind;
    if (kind == HandKind::kPrescribed) {
      plant::Segment ramp;
      ramp.kind = plant::Segment::Kind::kRamp;
      ramp.duration_s = 10;
      ramp.to = 10 * rad_s;
      phase.profile = {ramp};
    }
    s.hand.phases = {phase};
  }
  void with_test(Scenario& s) const {
    for (const char* name : {"self_test_pulse", "self_test_arms"}) s.parameters[name] = si(name);
  }
  RunResult run(const Scenario& s, std::function<void(const Row&)> row = {}) const {
    RunOptions options;
    options.design = kind_.name;
    options.engine = "twin";
    options.row = std::move(row);
    return run_scenario(s, plant_, options);
  }

 private:
  const test::Kind& kind_;
  plant::Parameters plant_;
  DesignInfo design_;
};

double at(const RunResult& r, const std::string& fault) {
  const auto it = r.felt.faults.find(fault);
  return it == r.felt.faults.end() ? -1 : it->second.first_s;
}
std::string first_of(const RunResult& r) {
  std::string name = "-";
  double first = 1e9;
  for (const auto& [fault, acted] : r.felt.faults) {
    if (acted.first_s < first) first = acted.first_s, name = fault;
  }
  return name;
}

/// A free lever, the self-test as the design has it.
Scenario tested_lever(const Bench& b, double torque_nm) {
  Scenario s = b.asked(torque_nm);
  b.with_test(s);
  s.duration_s = 0.01 + b.si("self_test_quiet") * 128e-6 * b.slower() +
                 2 * b.si("self_test_pulse") * 128e-6 * b.slower() + 0.01;
  return s;
}

void arms(const Bench& b) {
  const RunResult r = b.run(tested_lever(b, 0));
  CHECK(first_of(r) == "-");
  CHECK(r.felt.limits.count("gates_closed") == 1);
  CHECK(r.felt.limits.at("gates_closed").seconds < 0.01);
}

/// A lever that is held: the torque after the ramp.
void holds(const Bench& b) {
  const double wanted = 0.9 * b.si("torque_limit");
  Scenario s = b.asked(wanted);
  Bench::hand(s, HandKind::kLocked);
  s.duration_s = 0.2;
  double last = 0;
  const RunResult r = b.run(s, [&](const Row& row) { last = row.motor_torque_nm; });
  CHECK(std::abs(last / wanted - 1) < 0.03);
  CHECK(first_of(r) == "-");
  CHECK(r.felt.tau_hat_void.seconds == 0);
}

/// The heat of the largest torque from half the budget on, as after power-up, with a budget that is
/// a tenth larger than that; and none of four fifths of what brushes and dead time, which count as
/// current, leave of the nominal one.
void heats(const Bench& b, double nominal_a) {
  const double kt = b.si("torque_constant");
  Scenario s = b.asked(b.si("torque_limit"));
  Bench::hand(s, HandKind::kLocked);
  s.parameters["i2t_budget"] = 0.55 * b.si("i2t_budget");
  const double dead_a = b.si("dead_voltage") * b.si("inverse_resistance");
  const double most_a = b.si("torque_limit") / kt + dead_a;
  const double over = most_a * most_a - b.si("nominal_current_squared");
  const double cold_s = b.si("i2t_budget") / over / static_cast<double>(b.design().tick_hz);
  s.duration_s = 0.2 + 0.1 * cold_s;
  const RunResult r = b.run(s);
  CHECK(first_of(r) == "i2t");
  CHECK(at(r, "i2t") > 0.04 * cold_s);
  const double lasting_a = std::sqrt(b.si("nominal_current_squared")) - dead_a;
  CHECK(lasting_a > 0.25 * nominal_a);
  Scenario cool = b.asked(0.8 * kt * lasting_a);
  Bench::hand(cool, HandKind::kLocked);
  cool.parameters["i2t_budget"] = 0.501 * b.si("i2t_budget");
  cool.duration_s = 0.25;
  CHECK(first_of(b.run(cool)) == "-");
}

/// Swapped leads, a free lever, the largest torque behind the ramp: the self-test finds them.
void swapped(const test::Kind& kind) {
  Bench b(kind);
  if (!b.tested()) return;
  b.swap_leads();
  CHECK(first_of(b.run(tested_lever(b, b.si("torque_limit")))) == "self_test");
}

/// Faster than the limit, and a little slower.
void speeds(const Bench& b) {
  for (const double share : {0.9, 1.15}) {
    Scenario s = b.asked(0);
    s.scene = "free";
    Bench::hand(s, HandKind::kPrescribed, share * b.si("overspeed"));
    s.duration_s = 0.06 * b.slower();
    INFO(share << " of " << b.si("overspeed") << " rad/s");
    CHECK(first_of(b.run(s)) == (share < 1 ? "-" : "speed"));
  }
}

/// Channel B stands while a hand turns the lever: one live channel changes every second count.
double dead_channel(const std::string& design, double count_rad, double rad_s) {
  const auto wait = static_cast<Clock>(2 * count_rad / rad_s * 50e6);
  test::Moves source;
  for (int k = 0; k < 30; ++k) source.move(wait, k % 2 == 0 ? 1 : -1);
  ReplayOptions options;
  options.design = design;
  options.engine = "twin";
  const RunResult r = run_replay(source, "dead", options);
  CHECK(first_of(r) == "channel");
  return at(r, "channel") * rad_s;
}

}  // namespace

TEST_CASE("motors: a design for each arms, holds and trips") {
  for (const test::Kind& kind : test::kinds) {
    INFO(kind.name);
    const Bench b(kind);
    arms(b);
    holds(b);
    heats(b, kind.nominal_a);
    swapped(kind);
    speeds(b);
    if (std::string(kind.base) != "lever") continue;
    const double hand_rad_s = kind.lines < 32 ? 10 : 4, count_rad = b.design().count_rad;
    CHECK(dead_channel(kind.name, count_rad, hand_rad_s) < 52 * count_rad);
  }
}

namespace {
const std::string kHere = std::string(FELTGATE_ROOT) + "/testbench/studies/motors/";
const test::Kind& kind_named(const std::string& name) {
  return *std::find_if(test::kinds.begin(), test::kinds.end(),
                       [&](const test::Kind& k) { return k.name == name; });
}
}  // namespace

TEST_CASE("motors: channel B is dead in a recording of 48 counts in a turn at 10 rad/s") {
  const auto source = traces::open(kHere + "dead_b_48cpr_10rad.vec", {});
  ReplayOptions options;
  options.design = "hobby_48";
  options.engine = "twin";
  const RunResult r = run_replay(*source, "dead", options);
  CHECK(first_of(r) == "channel");
  CHECK(at(r, "channel") * 10 < 52 * plant::kTwoPi / 48);
}

TEST_CASE("motors: a pulse that the host asks for does not swing a free lever") {
  for (const char* name : {"coin_64", "hobby_48", "maxon_25", "fine_1e6"}) {
    INFO(name);
    const Bench b(kind_named(name));
    Scenario s = read_scenario(kHere + "self_test_free.toml");
    s.effects = b.plant().effects;
    double most_rad = 0, most_rad_s = 0;
    const RunResult r = b.run(s, [&](const Row& row) {
      most_rad = std::max(most_rad, std::abs(row.theta_rad));
      most_rad_s = std::max(most_rad_s, std::abs(row.omega_rad_s));
    });
    CHECK(most_rad < (b.tested() ? 0.13 : 1e-3));  // 19 ms each way, where the test is on
    CHECK(most_rad_s < (b.tested() ? 7.5 : 0.1));
    CHECK(first_of(r) == "-");
  }
}

TEST_CASE("motors: at the voltage's limit the observed torque is void") {
  const Bench b(kind_named("wheel_hub"));
  Scenario s = b.asked(b.si("torque_limit"));
  Bench::hand(s, HandKind::kPrescribed, 0.97 * b.si("overspeed"));
  s.duration_s = 0.3;
  Row last;
  const RunResult r = b.run(s, [&](const Row& row) { last = row; });
  CHECK(first_of(r) == "-");
  CHECK(last.motor_torque_nm < 0.95 * b.si("torque_limit"));
  CHECK(r.felt.tau_hat_void.seconds > 0.1);
}
