// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Stability of walls: eigenvalues two ways, closed forms, swings in the chain's own bits and in the
// core; and what a study refuses: not a number would never end. Documentation:
// docs/speed-for-accuracy.md
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "catch.hpp"
#include "sim/loop/loop.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/stability/bit_loop.hpp"
#include "studies/stability/linear_loop.hpp"
#include "studies/stability/study.hpp"

using namespace feltgate;
using namespace feltgate::stability;

namespace {

const std::string kRoot = FELTGATE_ROOT;

design::Elaborated lever() {
  return elaborate(design::read_design(kRoot + "/rtl/designs/lever.toml"),
                   design::read_registers(kRoot + "/rtl/registers.toml"));
}

plant::Parameters plant_named(const std::string& name) {
  return plant::read_plant_file(kRoot + "/vectors/plants/" + name + ".toml");
}

void within(double value, double of, double share) {
  INFO(value << " against " << of);
  CHECK(std::abs(value / of - 1) < share);
}

}  // namespace

TEST_CASE("stability: eigenvalues and exponential of matrices that have a closed form") {
  // z^3 - 6 z^2 + 13 z - 20 = (z - 4)(z - 1 - 2i)(z - 1 + 2i), as a companion matrix.
  const Eigen::MatrixXd companion{{6, -13, 20}, {1, 0, 0}, {0, 1, 0}};
  std::vector<Pole> found;
  for (const Pole& z : eigenvalues(companion)) found.push_back(z);
  REQUIRE(found.size() == 3);
  for (const Pole& root : {Pole{4, 0}, Pole{1, 2}, Pole{1, -2}}) {
    CHECK(std::any_of(found.begin(), found.end(),
                      [&](const Pole& z) { return std::abs(z - root) < 1e-12; }));
  }
  // A spiral: a turn by w*t that grows by exp(g*t); from less than a millionth to many turns.
  const double g = -0.3, w = 2.0;
  const Eigen::MatrixXd spiral{{g, -w}, {w, g}};
  for (const double t : {0.0, 1e-7, 0.01, 1.0, 30.0}) {
    const Eigen::MatrixXd is = matrix_exp_minus_one(spiral, t);
    const std::complex<double> exact = std::exp(std::complex<double>(g, w) * t) - 1.0;
    INFO(t);
    CHECK(std::abs(is(0, 0) - exact.real()) < 1e-12);
    CHECK(std::abs(is(1, 0) - exact.imag()) < 1e-12);
    CHECK(is(0, 0) == is(1, 1));
    CHECK(is(0, 1) == -is(1, 0));
  }
  // Small results keep their digits: where a is -1, expm1.
  const Eigen::MatrixXd decay{{-1.0}};
  const double small = matrix_exp_minus_one(decay, 1e-9)(0, 0);
  CHECK(std::abs(small / std::expm1(-1e-9) - 1) < 1e-14);
}

TEST_CASE("stability: Arnoldi finds the largest eigenvalues of the whole monodromy matrix") {
  LoopModel m = make_model(lever(), plant_named("linear"));
  m.raw_rad_s_rad *= static_cast<double>(m.m1) / 40;  // a short window keeps the matrix small
  m.m1 = 40;
  for (const Wall& wall : {Wall{10, 0.005, 1}, Wall{5, 0.005, 1000}, Wall{8, 0.01, 25}}) {
    int ticks = 0;
    const Eigen::VectorXcd dense = eigenvalues(monodromy(m, wall, &ticks));
    CHECK(ticks == (wall.scene_ticks == 1 ? 20 : wall.scene_ticks == 25 ? 100 : 1000));
    double radius = 0;
    for (const Pole& z : dense) radius = std::max(radius, std::abs(z));
    const double growth = std::log(radius) / (ticks * m.tick_s);
    INFO(wall.scene_ticks);
    CHECK(std::abs(poles(m, wall).front().real() - growth) < 1e-5 * std::abs(growth));
  }
}

TEST_CASE("stability: the closed form holds where theory says so") {
  const LoopModel m = make_model(lever(), plant_named("linear"));
  // Damping that replaces just what the back-EMF compensation takes: the estimator sees no net
  // damping and its lag drops out. BT/J is at most 0.018.
  const double b = m.motor_damping_nm_s_rad * m.compensated;
  for (const int ticks : {1, 25, 1000}) {
    within(closed_form(m, b, ticks), border(m, b, ticks).stiffness_nm_rad, 0.05);
  }
  within(closed_form(m, b, 1), border(m, b, 1).stiffness_nm_rad, 0.001);
  // Off that point the lag counts: the plain form misses by 20 to 40 %, the longer one does not.
  const double exact = border(m, 0.001, 1).stiffness_nm_rad;
  CHECK(closed_form(m, 0.001, 1) < 0.85 * exact);
  within(closed_form_with_estimator(m, 0.001, 1), exact, 0.03);
  CHECK(closed_form(m, 0.005, 1) > 1.3 * border(m, 0.005, 1).stiffness_nm_rad);
  // Without damping of its own the compensated motor holds no wall at all.
  CHECK(border(m, 0, 1).stiffness_nm_rad == 0);
  // A motor left its own damping, no estimator in the loop: the plain form again.
  LoopModel bare = m;
  bare.emf_constant = bare.compensated = 0;
  for (const int ticks : {1, 25}) {
    within(closed_form(bare, 0, ticks), border(bare, 0, ticks).stiffness_nm_rad, 0.05);
  }
}

TEST_CASE("stability: 0.95 of the border decays and 1.05 grows, in bits as in double") {
  const auto design = lever();
  const auto plant = plant_named("linear");
  const LoopModel m = make_model(design, plant);
  struct Place {
    double damping;
    int ticks;
  };
  for (const Place& p : {Place{0.005, 1}, Place{0.002, 25}, Place{0.005, 1000}}) {
    const Border b = border(m, p.damping, p.ticks);
    for (const double share : {0.95, 1.05}) {
      const Wall wall{share * b.stiffness_nm_rad, p.damping, p.ticks};
      const Pole s = poles(m, wall).front();
      const Growth bits = swing(design, plant, wall, "fixed", b.rad_s);
      const Growth real = swing(design, plant, wall, "double", b.rad_s);
      CAPTURE(p.damping, p.ticks, share, s.real(), bits.rate_1_s, real.rate_1_s, bits.swings);
      CHECK(bits.swings > 8);
      CHECK((bits.rate_1_s > 0) == (share > 1));
      CHECK(std::abs(bits.rate_1_s - s.real()) < 0.2 * std::abs(s.real()));
      CHECK(std::abs(bits.rate_1_s - real.rate_1_s) < 0.2 * std::abs(s.real()));
      within(bits.rad_s, std::abs(s.imag()), 0.01);
    }
  }
}

TEST_CASE("rates and dampings of a study are numbers of their range") {
  const auto design = lever();
  const auto plant = plant_named("linear");
  StudyOptions options;
  options.bits = false;
  options.rates_hz = {1000};
  for (const double damping : {std::nan(""), HUGE_VAL, -0.1, 1.1}) {
    options.damping_nm_s_rad = {0.001, damping};
    CHECK_THROWS_AS(run_study(design, plant, plant, options), std::invalid_argument);
  }
  options.damping_nm_s_rad = {0.001};
  for (const double rate : {std::nan(""), HUGE_VAL, 0.0, 2e6}) {
    options.rates_hz = {rate};
    CHECK_THROWS_AS(run_study(design, plant, plant, options), std::invalid_argument);
  }
}

// A wall on either side of its border in the whole core: RTL and twin in lock-step, from pins to
// pins.

namespace {

/// The lever is held off its resting depth until the core has armed, then let swing.
Growth swing_of_core(const design::Elaborated& design, const plant::Parameters& plant,
                     const Wall& wall, const std::string& engine) {
  const double q = design.design.count_rad();
  const double start = press_nm / wall.stiffness_nm_rad - swing_rad(wall.stiffness_nm_rad);
  Scenario s;
  s.name = "wall";
  s.duration_s = 0.15;
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
  o.engine = engine;
  o.row = [&](const Row& r) {
    if (r.time_s < held.duration_s) return;
    if (r.tau_ref_nm > -0.005) meter.leave();
    meter.add(r.time_s, r.theta_rad, r.omega_rad_s);
  };
  const RunResult result = run_scenario(s, plant, o);
  CHECK(result.mismatches == 0);
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
    const Growth core = swing_of_core(design, plant, wall, share > 1 ? "rtl,twin" : "twin");
    const double rate = poles(m, wall).front().real();
    CAPTURE(share, rate, core.rate_1_s, core.swings, core.left);
    CHECK(core.swings >= 8);
    CHECK((core.rate_1_s > 0) == (share > 1));
    CHECK(std::abs(core.rate_1_s - rate) < 0.25 * std::abs(rate));
  }
}
