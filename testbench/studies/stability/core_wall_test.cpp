// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A wall on either side of its border in the whole core: RTL and twin in lock-step, from pins to
// pins. Documentation: docs/speed-for-accuracy.md
#include <cmath>

#include "catch.hpp"
#include "sim/loop/loop.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/stability/bit_loop.hpp"

using namespace feltgate;
using namespace feltgate::stability;

namespace {

/// The lever is held off its resting depth until the core has armed, then let swing.
Growth swing_of_core(const design::Elaborated& design, const plant::Parameters& plant,
                     const Wall& wall, double duration_s, std::int64_t* mismatches) {
  const double q = design.design.count_rad();
  const double start = press_nm / wall.stiffness_nm_rad - swing_rad(wall.stiffness_nm_rad);
  Scenario s;
  s.name = "wall";
  s.duration_s = duration_s;
  s.scene = "wall";
  s.effects = plant.effects;
  // The core counts from where the lever is at reset.
  s.parameters = {{"wall_contact", -start / q},
                  {"wall_stiffness", wall.stiffness_nm_rad * q},
                  {"wall_damping", wall.damping_nm_s_rad},
                  {"dead_voltage", 0},
                  {"dead_voltage_slope", 0},
                  {"ramp_step", 1},
                  {"torque_limit", 0.95},
                  {"current_limit", 31.9},
                  {"voltage_window", 24}};
  s.hand.start_rad = start;
  plant::HandPhase held, press;
  held.kind = plant::HandPhase::Kind::kLocked;
  held.duration_s = 2e-3;
  press.kind = plant::HandPhase::Kind::kTorque;
  press.profile = {{plant::Segment::Kind::kStep, 1.0, press_nm}};
  s.hand.phases = {held, press};
  SwingMeter meter(start, 2.5 * q, 14);
  RunOptions o;
  o.design = design.design.name;
  o.row = [&](const Row& r) {
    if (r.time_s < held.duration_s) return;
    if (r.tau_ref_nm > -0.005) meter.leave();
    meter.add(r.time_s, r.theta_rad, r.omega_rad_s);
  };
  const RunResult result = run_scenario(s, plant, o);
  *mismatches = result.mismatches;
  CHECK(result.lock_step);
  CHECK(result.figures.at("faults") == 0);
  return meter.growth();
}

}  // namespace

TEST_CASE("stability: the core itself decays at 0.9 of the border and grows at 1.1") {
  const std::string root = FELTGATE_ROOT;
  const auto design = elaborate(design::read_design(root + "/rtl/designs/lever.toml"),
                                design::read_registers(root + "/rtl/registers.toml"));
  const auto plant = plant::read_plant_file(root + "/vectors/plants/linear.toml");
  const LoopModel m = make_model(design, plant);
  const Border b = border(m, 0.005, 1);
  for (const double share : {0.9, 1.1}) {
    const Wall wall{share * b.stiffness_nm_rad, 0.005, 1};
    std::int64_t mismatches = -1;
    const Growth core = swing_of_core(design, plant, wall, 0.15, &mismatches);
    const double rate = poles(m, wall).front().real();
    CAPTURE(share, rate, core.rate_1_s, core.swings, core.left);
    CHECK(mismatches == 0);
    CHECK(core.swings >= 8);
    CHECK((core.rate_1_s > 0) == (share > 1));
    CHECK(std::abs(core.rate_1_s - rate) < 0.25 * std::abs(rate));
  }
}
