// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Motor and lever against closed forms; effects switched off; convergence with the step size.
// docs/plant.md
#include <array>
#include <complex>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "plant_fixture.hpp"
#include "sim/plant/plant.hpp"
#include "sim/plant/stiffness.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

Effects without_dead_time(const Parameters& p) {
  Effects effects = p.effects;
  effects.dead_time = false;
  return effects;
}

double no_load_rad_s(const Parameters& p, Clock step, double seconds) {
  Plant plant(p, without_dead_time(p), Drive{}, Hand{});
  run(plant, volts(p, p.supply.voltage_v), seconds, step);
  return plant.observables().omega_rad_s;
}

// Angle, speed and current at 1 ms of a torque step against a cord, each over its size.
std::array<double, 3> cord_state(const Parameters& p, Clock step) {
  Plant plant(p, without_dead_time(p), Drive{}, hand_of(HandPhase::Kind::kCord));
  run(plant, volts(p, 4.5), 1e-3, step);
  const Observables& o = plant.observables();
  return {o.theta_rad / 0.01, o.omega_rad_s, o.motor_current_a / 10};
}

}  // namespace

TEST_CASE("no-load speed does not depend on the step", "[plant]") {
  const Parameters p = shipped("p24");
  // 778 rad/s: the speed after 0.3 s, 5.3 mechanical time constants.
  const double fine = no_load_rad_s(p, 5, 0.3);
  CHECK(fine == Approx(778.0).epsilon(0.005));
  CHECK(no_load_rad_s(p, 50, 0.3) == Approx(fine).epsilon(1e-6));
  CHECK(no_load_rad_s(p, 250, 0.3) == Approx(fine).epsilon(1e-6));

  // After the transient: V = R*i + Ke*w + Vd with Kt*i = coulomb + sigma2*w.
  const double kt = p.motor.torque_constant_nm_a;
  const double expected =
      (p.supply.voltage_v - p.motor.dead_voltage_v -
       p.motor.resistance_ohm * p.lugre.coulomb_nm / kt) /
      (p.motor.back_emf_constant_v_s_rad + p.motor.resistance_ohm * p.lugre.viscous_nm_s_rad / kt);
  CHECK(no_load_rad_s(p, 25, 1.5) == Approx(expected).epsilon(1e-6));
}

TEST_CASE("a lever swings in its cogging as in a potential", "[plant]") {
  Parameters p = shipped("linear");
  p.end_stops.reset();
  // Rest is where sin(12 angle + 0.4) falls through 0.
  const double stable_rad = (kTwoPi / 2 - 0.4) / 12, amplitude_nm = 0.01;
  p.cogging = {{12, amplitude_nm, 0.4}};
  Hand hand = hand_of(HandPhase::Kind::kFree);
  for (const double out_rad : {0.001, 0.1}) {
    hand.start_rad = stable_rad + out_rad;
    Plant plant(p, kNoEffects, Drive{}, hand);
    double fastest_rad_s = 0, first_s = 0;
    for (int k = 0; first_s == 0 && k < 200'000; ++k) {
      plant.advance(Bridge::averaged(0), 25);
      const Observables& o = plant.observables();
      fastest_rad_s = larger(fastest_rad_s, std::abs(o.omega_rad_s));
      if (o.theta_rad < stable_rad) first_s = static_cast<double>(plant.now()) / kClockHz;
    }
    // Energy: J w^2 / 2 = A / 12 (1 - cos(12 out)).
    const double energy_j = amplitude_nm / 12 * (1 - std::cos(12 * out_rad));
    CHECK(fastest_rad_s == Approx(std::sqrt(2 * energy_j / p.lever.inertia_kg_m2)).epsilon(1e-4));
    // A quarter of a swing, for small ones.
    const double quarter_s = kTwoPi / 4 * std::sqrt(p.lever.inertia_kg_m2 / (12 * amplitude_nm));
    if (out_rad < 0.01) CHECK(first_s == Approx(quarter_s).epsilon(1e-3));
  }
  // Several harmonics add up; a hand that imposes the angle feels them.
  p.cogging = {{12, amplitude_nm, 0.4}, {36, 0.003, -1.0}};
  Plant held(p, kNoEffects, Drive{}, hand_of(HandPhase::Kind::kLocked));
  held.advance(Bridge::averaged(0), 25);
  CHECK(held.observables().hand_torque_nm ==
        Approx(-(amplitude_nm * std::sin(0.4) + 0.003 * std::sin(-1.0))).epsilon(1e-9));
}

TEST_CASE("the whole step converges with second order", "[plant]") {
  const Parameters p = shipped("p24");
  const auto reference = cord_state(p, 1);
  const auto error = [&](Clock step) {
    const auto state = cord_state(p, step);
    double worst = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
      worst = larger(worst, std::abs(state[i] - reference[i]));
    }
    return worst;
  };
  const double coarse = error(200), middle = error(100), fine = error(50);
  CHECK(coarse / middle == Approx(4.0).margin(1.0));
  CHECK(middle / fine == Approx(4.0).margin(1.0));
  CHECK(error(25) < 1e-5);
}

TEST_CASE("locked rotor: current (V - Vd)/R, torque Kt*i", "[plant]") {
  const Parameters p = shipped("p24");
  const double wanted_nm = 0.3;
  const double needed_v =
      p.motor.resistance_ohm * wanted_nm / p.motor.torque_constant_nm_a + p.motor.dead_voltage_v;
  CHECK(needed_v == Approx(4.512).margin(0.001));
  for (const double sign : {1.0, -1.0}) {
    for (const bool inductance : {true, false}) {
      Effects effects = without_dead_time(p);
      effects.inductance = inductance;
      Plant plant(p, effects, Drive{}, hand_of(HandPhase::Kind::kLocked));
      run(plant, volts(p, sign * needed_v), 0.01);
      const Observables& seen = plant.observables();
      CHECK(seen.motor_torque_nm == Approx(sign * wanted_nm).epsilon(1e-9));
      CHECK(seen.hand_torque_nm == Approx(-sign * wanted_nm).epsilon(1e-9));
      CHECK(seen.hand_force_n == Approx(-sign * wanted_nm / 0.1).epsilon(1e-9));
      CHECK(seen.supply_current_a == Approx(needed_v / 24.0 * seen.motor_current_mean_a * sign));
      run(plant, volts(p, sign * 0.33), 0.01);
      CHECK(plant.observables().motor_current_a == 0.0);
      CHECK(plant.encoder().count() == 0);
    }
  }
}

TEST_CASE("speed of the linear plant follows its two poles", "[plant]") {
  const Parameters p = shipped("linear");
  Plant plant(p, p.effects, Drive{}, Hand{});
  // J*L*s^2 + J*R*s + Kt*Ke
  const double jl = p.lever.inertia_kg_m2 * p.motor.inductance_h;
  const double jr = p.lever.inertia_kg_m2 * p.motor.resistance_ohm;
  const double k = p.motor.torque_constant_nm_a * p.motor.back_emf_constant_v_s_rad;
  const double root = std::sqrt(jr * jr - 4.0 * jl * k);
  const double fast = (-jr - root) / (2.0 * jl);
  const double slow = (-jr + root) / (2.0 * jl);
  const double final_rad_s = 12.0 / p.motor.back_emf_constant_v_s_rad;
  for (const double t : {1e-4, 1e-3, 1e-2, 0.1, 0.3}) {
    run(plant, volts(p, 12.0), t - static_cast<double>(plant.now()) / kClockHz);
    const double expected =
        final_rad_s *
        (1.0 + (slow * std::exp(fast * t) - fast * std::exp(slow * t)) / (fast - slow));
    CAPTURE(t);
    CHECK(plant.observables().omega_rad_s == Approx(expected).epsilon(1e-4));
  }
}

TEST_CASE("each effect changes what it should", "[plant]") {
  const Parameters p = shipped("p24");
  const auto speed_with = [&p](Effects effects) {
    Plant plant(p, effects, Drive{}, Hand{});
    run(plant, volts(p, 6.0), 0.05);
    return plant.observables().omega_rad_s;
  };
  Effects effects = kNoEffects;
  const double bare = speed_with(effects);
  CHECK(bare == Approx(6.0 / 0.42 * 0.0302 / 1.22e-4 * 0.05).epsilon(1e-6));
  for (bool Effects::*effect :
       {&Effects::inductance, &Effects::back_emf, &Effects::dead_voltage, &Effects::lugre,
        &Effects::viscous, &Effects::dead_time, &Effects::supply_limit}) {
    effects = kNoEffects;
    effects.*effect = true;
    // 6 V draw 3.6 A from the supply: its limit does nothing here.
    const bool slower = speed_with(effects) < bare * 0.9999;
    CHECK(slower == (effect != &Effects::supply_limit));
  }
}

TEST_CASE("mean over PWM periods of whole clocks", "[plant]") {
  PeriodMean mean(100);
  CHECK(mean.add(99, 1.0) == 0);
  CHECK(mean.add(2, 3.0) == 1);
  CHECK(mean.mean() == Approx((99.0 + 3.0) / 100.0));
  CHECK(mean.add(299, 2.0) == 3);
  CHECK(mean.mean() == Approx(2.0));
  CHECK(mean.periods() == 4);
  PeriodMean shifted(100, 30);
  CHECK(shifted.add(30, 7.0) == 0);
  CHECK(shifted.add(100, 1.0) == 1);
  CHECK(shifted.mean() == Approx(1.0));
  CHECK_THROWS_AS(PeriodMean(0), std::invalid_argument);
}

TEST_CASE("a step is at least one clock, and time is counted in clocks", "[plant]") {
  const Parameters p = shipped("p24");
  Plant plant(p, p.effects, Drive{}, Hand{});
  CHECK_THROWS_AS(plant.advance(Bridge::off(), 0), std::invalid_argument);
  plant.advance(Bridge::off(), 7);
  plant.advance(Bridge::off(), 11);
  CHECK(plant.now() == 18);
  CHECK(plant.observables().motor_current_a == 0.0);
}

// The largest stiffness of a plant for its step, and the errors that end a run that cannot be
// simulated. docs/plant.md

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
