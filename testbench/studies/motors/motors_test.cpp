// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Designs that `feltgate design --for-plant` makes, each on its motor in simulation: it arms, holds
// a torque and trips. FELTGATE_SHOW=1 prints the table of docs/designs.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
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

/// The file of the design that was made for a motor.
std::string design_of(const std::string& motor) { return FELTGATE_MOTORS + motor + ".toml"; }

/// One motor with its design.
class Bench {
 public:
  explicit Bench(const test::Kind& kind)
      : kind_(kind), plant_(test::plant_of(kind)), design_(design_named(design_of(kind.name))) {}

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
    options.design = design_of(kind_.name);
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

struct Found {
  double way_rad = 0, error_pct = 0, heat_s = 0, cold_s = 0, lasting_a = 0, swapped_s = -1,
         swapped_rad_s = 0;
  double dead_rad = 0;
  std::string swapped;
};

/// A free lever, the self-test as the design has it: the way of the pulses.
void arms(const Bench& b, Found& f) {
  Scenario s = b.asked(0);
  b.with_test(s);
  s.duration_s = 0.01 + b.si("self_test_quiet") * 128e-6 * b.slower() +
                 2 * b.si("self_test_pulse") * 128e-6 * b.slower() + 0.01;
  double low = 0, high = 0;
  const RunResult r = b.run(s, [&](const Row& row) {
    low = std::min(low, row.theta_rad), high = std::max(high, row.theta_rad);
  });
  f.way_rad = high - low;
  CHECK(first_of(r) == "-");
  CHECK(r.felt.limits.count("gates_closed") == 1);
  CHECK(r.felt.limits.at("gates_closed").seconds < 0.01);
}

/// A lever that is held: the torque after the ramp.
void holds(const Bench& b, Found& f) {
  const double wanted = 0.9 * b.si("torque_limit");
  Scenario s = b.asked(wanted);
  Bench::hand(s, HandKind::kLocked);
  s.duration_s = 0.2;
  double last = 0;
  const RunResult r = b.run(s, [&](const Row& row) { last = row.motor_torque_nm; });
  f.error_pct = 100 * (last / wanted - 1);
  CHECK(first_of(r) == "-");
  CHECK(r.felt.tau_hat_void.seconds == 0);
}

/// The heat of the largest torque from half the budget on, as after power-up, with a budget that is
/// a tenth larger than that; and none of four fifths of what brushes and dead time, which count as
/// current, leave of the nominal one.
void heats(const Bench& b, Found& f, double nominal_a) {
  const double kt = b.si("torque_constant");
  Scenario s = b.asked(b.si("torque_limit"));
  Bench::hand(s, HandKind::kLocked);
  s.parameters["i2t_budget"] = 0.55 * b.si("i2t_budget");
  const double dead_a = b.si("dead_voltage") * b.si("inverse_resistance");
  const double most_a = b.si("torque_limit") / kt + dead_a;
  const double over = most_a * most_a - b.si("nominal_current_squared");
  f.cold_s = b.si("i2t_budget") / over / static_cast<double>(b.design().tick_hz);
  s.duration_s = 0.2 + 0.1 * f.cold_s;
  const RunResult r = b.run(s);
  f.heat_s = at(r, "i2t");
  CHECK(first_of(r) == "i2t");
  CHECK(f.heat_s > 0.04 * f.cold_s);
  f.lasting_a = std::sqrt(b.si("nominal_current_squared")) - dead_a;
  CHECK(f.lasting_a > 0.25 * nominal_a);
  Scenario cool = b.asked(0.8 * kt * f.lasting_a);
  Bench::hand(cool, HandKind::kLocked);
  cool.parameters["i2t_budget"] = 0.501 * b.si("i2t_budget");
  cool.duration_s = 0.4;
  CHECK(first_of(b.run(cool)) == "-");
}

/// Swapped leads, a free lever, the largest torque behind the ramp.
void swapped(const test::Kind& kind, Found& f) {
  Bench b(kind);
  b.swap_leads();
  Scenario s = b.asked(b.si("torque_limit"));
  b.with_test(s);
  s.duration_s = 0.5;
  const RunResult r = b.run(s, [&](const Row& row) {
    f.swapped_rad_s = std::max(f.swapped_rad_s, std::abs(row.omega_rad_s));
  });
  f.swapped = first_of(r);
  f.swapped_s = at(r, f.swapped) - s.arm_s;
  if (b.tested()) CHECK(f.swapped == "self_test");
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
  for (int k = 0; k < 60; ++k) source.move(wait, k % 2 == 0 ? 1 : -1);
  ReplayOptions options;
  options.design = design_of(design);
  options.engine = "twin";
  const RunResult r = run_replay(source, "dead", options);
  CHECK(first_of(r) == "channel");
  return at(r, "channel") * rad_s;
}

}  // namespace

TEST_CASE("motors: a design for each arms, holds and trips") {
  const bool show = std::getenv("FELTGATE_SHOW") != nullptr;
  if (show) {
    fmt::print(
        "| motor | counts | V | A | limit Nm | tick kHz | self-test rad | held, error % | without "
        "limit in "
        "time A | i2t at the limit, from cold s | swapped leads: fault, after ms, rad/s | dead "
        "channel at rad/s: after "
        "rad | too fast rad/s |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  }
  for (const test::Kind& kind : test::kinds) {
    INFO(kind.name);
    const Bench b(kind);
    Found f;
    arms(b, f);
    holds(b, f);
    heats(b, f, kind.nominal_a);
    swapped(kind, f);
    speeds(b);
    CHECK(std::abs(f.error_pct) < 3);
    const bool absolute = std::string(kind.base) != "lever";
    const double hand_rad_s = kind.lines < 32 ? 10 : 4;
    if (!absolute) {
      f.dead_rad = dead_channel(kind.name, b.design().count_rad, hand_rad_s);
      CHECK(f.dead_rad < 52 * b.design().count_rad);
    }
    if (!show) continue;
    fmt::print(
        "| {} | {:.0f} | {:g} | {:g} | {:.3g} | {:g} | {} | {:.2f} | {:.2g} | {:.2g} | {} {:.0f}, "
        "{:.0f} | "
        "{} | {:g} |\n",
        kind.name, plant::kTwoPi / b.design().count_rad, kind.supply_v, kind.nominal_a,
        b.si("torque_limit"), 1e-3 * static_cast<double>(b.design().tick_hz),
        b.tested() ? fmt::format("{:.3f}", f.way_rad) : "off", f.error_pct, f.lasting_a, f.cold_s,
        f.swapped, 1e3 * f.swapped_s, f.swapped_rad_s,
        absolute ? "-" : fmt::format("{:g}: {:.2g}", hand_rad_s, f.dead_rad), b.si("overspeed"));
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
  options.design = design_of("hobby_48");
  options.engine = "twin";
  const RunResult r = run_replay(*source, "dead", options);
  CHECK(first_of(r) == "channel");
  CHECK(at(r, "channel") * 10 < 52 * plant::kTwoPi / 48);
}

TEST_CASE("motors: a pulse that the host asks for does not swing a free lever") {
  for (const char* name : {"coin_64", "hobby_48", "maxon_25", "maxon_40", "fine_1e6"}) {
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
