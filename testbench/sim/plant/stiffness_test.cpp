// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The largest stiffness of a plant for its step, and the errors that end a run that cannot be
// simulated. docs/plant.md
#include "sim/plant/stiffness.hpp"
#include "feltgate/largest.hpp"

#include <complex>

#include "plant_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;
using Kind = HandPhase::Kind;

namespace {

constexpr double kStepS = 25 / kClockHz;

HandPhase cord(double damping_nm_s_rad, double stiffness_nm_rad = 0.0) {
  HandPhase phase;
  phase.kind = Kind::kCord;
  phase.cord = {stiffness_nm_rad, damping_nm_s_rad};
  return phase;
}

/// Largest speed in 200 steps after a jolt of 100 steps; infinite if the plant stopped with an
/// error.
double largest_speed(const Parameters& p, const Effects& on, const HandPhase& phase) {
  Plant plant(p, on, Drive{}, hand_of(phase));
  double largest = 0.0;
  try {
    for (int i = 0; i < 4000; ++i) {
      plant.advance(volts(p, i < 100 ? 5.0 : 0.0), 25);
      if (i >= 3000) largest = feltgate::larger(largest, std::abs(plant.observables().omega_rad_s));
    }
  } catch (const MotionError&) {
    return INFINITY;
  }
  return largest;
}

std::string message_of(Plant& plant, double seconds) {
  try {
    run(plant, Bridge::off(), seconds);
  } catch (const MotionError& error) {
    return error.what();
  }
  return "no error";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("the Runge-Kutta step damps every pole up to the bound", "[stiffness]") {
  const auto growth = [](std::complex<double> z) {
    return std::abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))));
  };
  const double pi = 3.14159265358979323846;
  for (int i = 0; i <= 900; ++i) {
    const double angle = pi / 2 + pi * i / 900;
    for (int part = 1; part <= 100; ++part) {
      CHECK(growth(std::polar(most_pole_steps * part / 100, angle)) <= 1.0 + 1e-12);
    }
  }
  CHECK(growth(-2.8) > 1.0);
}

TEST_CASE("mechanical poles have their closed forms", "[stiffness]") {
  Parameters p = shipped("p24");
  const double j = p.lever.inertia_kg_m2, radius = p.lever.radius_m;
  Effects on = kNoEffects;
  CHECK(mechanical_pole_1_s(p, on, HandPhase{}, radius) < 1e-6);
  on.viscous = true;
  CHECK(mechanical_pole_1_s(p, on, HandPhase{}, radius) ==
        Approx(p.lever.viscous_nm_s_rad / j).epsilon(1e-6));
  on.viscous = false;
  CHECK(mechanical_pole_1_s(p, on, cord(0.01, 30.0), radius) ==
        Approx(std::sqrt(30.0 / j)).epsilon(1e-6));
  const double b = 1.0 / j, k = 30.0 / j;
  CHECK(mechanical_pole_1_s(p, on, cord(1.0, 30.0), radius) ==
        Approx(b / 2 + std::sqrt(b * b / 4 - k)).epsilon(1e-6));
  // A light hand on a stiff grip swings against the lever like against a wall.
  HandPhase light;
  light.kind = Kind::kImpedance;
  light.impedance.mass_kg = 1e-6;
  light.impedance.grip_damping_ns_m = 10.0;
  CHECK(mechanical_pole_1_s(p, on, light, radius) == Approx(16.45e6).epsilon(0.001));
  on.hand_dynamics = false;  // the hand imposes its motion
  CHECK(mechanical_pole_1_s(p, on, light, radius) == 0.0);
}

TEST_CASE("within the bound a plant is damped, beyond it grows", "[stiffness]") {
  const Parameters p = shipped("linear");
  const double j = p.lever.inertia_kg_m2;
  const double most = most_pole_steps * j / kStepS;
  CHECK(largest_speed(p, kNoEffects, cord(0.99 * most)) < 1e-6);
  CHECK(std::isinf(largest_speed(p, kNoEffects, cord(1.3 * most))));
  // The damping of friction is computed outside the Runge-Kutta step: its bound is 1.
  Parameters sticky = shipped("p24");
  Effects on = kNoEffects;
  on.lugre = true;
  const auto swing = [&](double share) {
    sticky.lugre.damping_nm_s_rad = share * j / kStepS;
    CHECK((outer_pole_1_s(sticky, on, kStepS) * kStepS <= 1.0) == (share <= 1.0));
    return largest_speed(sticky, on, HandPhase{});
  };
  CHECK(swing(0.9) < 1e-6);
  CHECK(swing(1.5) > 1e-3);
}

TEST_CASE("shipped plants are far from the bounds, at the longest step too", "[stiffness]") {
  for (const char* name : {"p24", "p48", "linear"}) {
    const Parameters p = shipped(name);
    CHECK(outer_pole_1_s(p, p.effects, 10 * kStepS) * 10 * kStepS < 0.1);
    CHECK(mechanical_pole_1_s(p, p.effects, HandPhase{}, p.lever.radius_m) * 10 * kStepS < 0.1);
  }
}

TEST_CASE("a motion that no encoder can show ends the run", "[stiffness]") {
  const Parameters p = shipped("p24");
  Plant fast(p, kNoEffects, Drive{}, moving({segment(Segment::Kind::kRamp, 0.005, 1e6)}));
  const std::string message = message_of(fast, 0.01);
  INFO(message);
  CHECK(has(message, "after 0 s the lever turns at 2e+08 rad/s"));
  CHECK(has(message, "2.61e+03 states of the encoder in a clock"));
  CHECK(has(message, "slow the motion"));
  // Just below: one state per clock is 2 pi/4096 rad in 20 ns.
  Plant slower(p, kNoEffects, Drive{}, moving({segment(Segment::Kind::kRamp, 0.01, 760.0)}));
  CHECK(message_of(slower, 0.01) == "no error");
  Plant lost(p, kNoEffects, Drive{}, moving({segment(Segment::Kind::kRamp, 1e-300, 0.1)}));
  CHECK(has(message_of(lost, 0.01), "after 0 s the"));
}
