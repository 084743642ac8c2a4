// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The core of gimbal_motor in closed loop with a motor of three phases. Simulation.
// Documentation: docs/plant.md#three-phases
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "catch.hpp"
#include "loop_fixture.hpp"

namespace {

using namespace feltgate;

constexpr double kTurn = 6.283185307179586;

plant::Parameters gimbal_motor() {
  return plant::read_plant_file(std::string(FELTGATE_ROOT) + "/vectors/plants/gimbal_motor.toml");
}

/// Torque over a turn of the motor, over the one that was asked for.
struct Share {
  double mean = 0, low = 1e9, high = -1e9;
};

/// A hand turns the shaft at this speed.
plant::Hand turning(double turns_s) {
  plant::HandPhase phase;
  phase.kind = plant::HandPhase::Kind::kPrescribed;
  plant::Segment s;
  s.kind = plant::Segment::Kind::kRamp;
  s.duration_s = 10;
  s.to = 10 * kTurn * turns_s;
  phase.profile = {s};
  plant::Hand hand;
  hand.phases = {phase};
  return hand;
}

Scenario asked(double torque_nm, const plant::Parameters& p) {
  Scenario s;
  s.name = "turn";
  s.plant = "gimbal_motor";
  s.effects = p.effects;
  s.scene = "setpoint";
  s.parameters["setpoint_torque"] = torque_nm;
  return s;
}

Share over_a_turn(double torque_nm, double turns_s, const plant::Parameters& p, bool gates = false) {
  Scenario s = asked(torque_nm, p);
  s.switched = gates;
  s.hand = turning(turns_s);
  const double settled_s = 0.15;
  s.duration_s = settled_s + 1 / std::abs(turns_s);
  RunOptions options;
  options.design = "gimbal_motor";
  options.engine = "twin";
  Share felt;
  double sum = 0;
  int rows = 0;
  options.row = [&](const Row& r) {
    if (r.time_s < settled_s) return;
    const double share = r.motor_torque_nm / torque_nm;
    sum += share, ++rows;
    felt.low = std::min(felt.low, share);
    felt.high = std::max(felt.high, share);
  };
  const RunResult run = run_scenario(s, p, options);
  CHECK(run.figures.at("faults") == 0);
  felt.mean = sum / rows;
  return felt;
}

}  // namespace

TEST_CASE("offsets") {
  for (int e = 0; e < 360; e += 15) {
    std::string line = fmt::format("offset {:3d}: ", e);
    for (const int arms : {3, 2}) {
      plant::Parameters p = gimbal_motor();
      p.phases->offset_rad = e / 360.0 * kTurn;
      Scenario s = asked(0.03, p);
      s.parameters["self_test_pulse"] = 39;
      s.parameters["self_test_arms"] = arms;
      s.duration_s = 0.4;
      RunOptions options;
      options.design = "gimbal_motor";
      options.engine = "twin";
      double top = 0, begins = 0;
      options.row = [&](const Row& r) {
        if (begins == 0 && r.time_s > 0.03 && std::abs(r.tau_ref_nm) > 0.0085) begins = r.time_s;
        top = std::max(top, std::abs(r.omega_rad_s));
      };
      const RunResult run = run_scenario(s, p, options);
      line += fmt::format(" arms {}: begins {:.4f} top {:.1f} rad/s end {:.2f} rad;", arms, begins, top,
                          run.figures.at("theta_end_rad"));
      for (const auto& [name, at] : run.felt.faults) line += fmt::format(" {} at {:.4f}", name, at.first_s);
    }
    fmt::print("{}\n", line);
  }
}

TEST_CASE("three phases: the torque over a turn is the one asked for", "[phases]") {
  plant::Parameters p = gimbal_motor();
  for (const bool dead : {false, true}) {
    p.effects.dead_time = dead;
    for (const double turns_s : {1.0, -1.0}) {
      for (const double nm : {0.002, 0.01, 0.03, -0.03}) {
        const Share f = over_a_turn(nm, turns_s, p);
        fmt::print("dead {} {:+.0f} turn/s {:+.0f} mNm: mean {:+.3f} % ({:+.3f} .. {:+.3f})\n", dead, turns_s,
                   1e3 * nm, 100 * (f.mean - 1), 100 * (f.low - 1), 100 * (f.high - 1));
      }
    }
  }
}
