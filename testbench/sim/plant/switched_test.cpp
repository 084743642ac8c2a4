// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The winding behind gates that switch clock by clock, beside closed forms, and the modulator at
// its shunt. docs/plant.md
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/pwm.hpp"
#include "plant_fixture.hpp"
#include "sim/plant/sigma_delta.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

constexpr double kR = 0.42, kL = 82e-6, kTau = kL / kR, kV = 24, kClock = 20e-9;
constexpr int kPeriod = 1000;  // clocks, 50 kHz

/// The motor without brushes, whose diodes have this voltage.
Parameters motor(double diode_v = 0.7) {
  Parameters p = shipped("p24");
  p.motor.resistance_ohm = kR;
  p.motor.inductance_h = kL;
  p.supply.diode_drop_v = diode_v;
  p.effects = kNoEffects;
  p.effects.inductance = true;
  return p;
}

Plant locked(const Parameters& p) {
  Drive drive;
  drive.pwm_hz = 50e3;
  return Plant(p, p.effects, drive, hand_of(HandPhase::Kind::kLocked));
}

Bridge gates(const Pwm::Out& out) {
  const auto on = [](bool gate) { return gate ? 1.0 : 0.0; };
  return Bridge::gates(on(out.gate_a_hi), on(out.gate_a_lo), on(out.gate_b_hi), on(out.gate_b_lo));
}
const Bridge kForward = Bridge::gates(1, 0, 0, 1), kLow = Bridge::gates(0, 1, 0, 1);
const Bridge kOff = Bridge::gates(0, 0, 0, 0), kHalfOff = Bridge::gates(0, 0, 0, 1);

double current(const Plant& plant) { return plant.observables().motor_current_a; }

/// Until `current_a` flows, at full voltage.
void drive_to(Plant& plant, double current_a) {
  while (current(plant) < current_a) plant.advance(kForward, 1);
}

/// Mean over the last of 200 periods of a PWM with this duty.
double mean_a(const Parameters& p, const Pwm& model, bool antiphase, int duty) {
  Plant plant = locked(p);
  Pwm pwm = model;
  Pwm::In in;
  in.enable = true;
  in.mode = antiphase;
  in.duty = static_cast<std::int16_t>(duty);
  double sum = 0;
  for (int clock = 0; clock < 200 * kPeriod; ++clock) {
    pwm.clock(in);
    plant.advance(gates(pwm.out()), 1);
    if (clock >= 199 * kPeriod) sum += plant.observables().motor_current_mean_a;
  }
  REQUIRE_FALSE(plant.observables().shoot_through);
  return sum / kPeriod;
}

}  // namespace

TEST_CASE("switched: a voltage step is the winding's exponential, in steps of any length",
          "[switched]") {
  for (const double speed_rad_s : {0.0, 100.0}) {
    Parameters p = motor();
    p.effects.back_emf = true;
    for (const Clock step : {1, 7, 250}) {
      Plant plant(p, p.effects, Drive{}, moving({segment(Segment::Kind::kRamp, 1, speed_rad_s)}));
      const double final_a = (kV - 0.0302 * speed_rad_s) / kR;
      for (int k = 0; k < 14'000 / step; ++k) {
        plant.advance(kForward, step);
        const double t = static_cast<double>(plant.now()) * kClock;
        REQUIRE(current(plant) == Approx(final_a * (1 - std::exp(-t / kTau))).epsilon(1e-9));
      }
      CHECK(current(plant) > 0.7 * final_a);
    }
  }
}

TEST_CASE("switched: ripple is V D (1 - D)/(L f), and its mean that of the duty", "[switched]") {
  const Parameters p = motor();
  constexpr double t_s = kPeriod * kClock;
  for (const int on : {100, 290, 500, 900}) {
    const double d = static_cast<double>(on) / kPeriod;
    Plant plant = locked(p);
    double low = 1e9, high = -1e9, sum = 0;
    for (int clock = 0; clock < 150 * kPeriod; ++clock) {
      plant.advance(clock % kPeriod < on ? kForward : kLow, 1);
      if (clock < 149 * kPeriod) continue;
      low = std::min(low, current(plant));
      high = std::max(high, current(plant));
      sum += plant.observables().motor_current_mean_a;
    }
    // The winding's two exponentials, which meet at both ends of the pulse.
    const double exact = kV / kR * (1 - std::exp(-d * t_s / kTau)) *
                         (1 - std::exp(-(1 - d) * t_s / kTau)) / (1 - std::exp(-t_s / kTau));
    CAPTURE(on);
    CHECK(high - low == Approx(exact).epsilon(1e-6));
    CHECK(high - low == Approx(kV * d * (1 - d) / (kL * 50e3)).epsilon(0.002));
    CHECK(sum / kPeriod == Approx(kV * d / kR).epsilon(1e-6));
  }
}

TEST_CASE("switched: dead time takes V t_d f of each leg that switches, and of the diodes",
          "[switched]") {
  constexpr int dead = 25;
  constexpr double share = static_cast<double>(dead) / kPeriod;
  const Pwm pwm(kPeriod, dead, 1);
  for (const double diode_v : {0.0, 0.7}) {
    for (const bool antiphase : {false, true}) {
      for (const int duty : {400, -400}) {
        const double legs = antiphase ? 2 : 1, sign = duty > 0 ? 1 : -1;
        // Two dead times in a period: in one the leg is low by a diode instead of high, in the
        // other instead of by its gate.
        const double lost = legs * share * (kV + 2 * diode_v);
        const double mean = mean_a(motor(diode_v), pwm, antiphase, duty);
        CAPTURE(diode_v, antiphase, duty);
        CHECK(kR * mean - kV * duty / kPeriod == Approx(-sign * lost).epsilon(1e-5));
      }
    }
  }
  CHECK(kV * 2 * share == Approx(kV * 2 * 0.5e-6 * 50e3));
}

TEST_CASE("switched: a current through diodes ends at zero, at its time, and stays there",
          "[switched]") {
  struct Case {
    Bridge bridge;
    double against_v;
  };
  // Both legs off: back into the supply. One leg off: through its low diode and the other's gate.
  for (const Case& c : {Case{kOff, kV + 1.4}, Case{kHalfOff, 0.7}}) {
    Plant plant = locked(motor());
    drive_to(plant, 5);
    const double begin_a = current(plant), against_a = c.against_v / kR;
    const double zero_s = kTau * std::log1p(begin_a / against_a);
    CAPTURE(c.against_v, zero_s);
    double charge = 0;
    const int last = static_cast<int>(zero_s / kClock) + 100;
    for (int clock = 1; clock <= last; ++clock) {
      const double t = clock * kClock;
      plant.advance(c.bridge, 1);
      charge += plant.observables().motor_current_mean_a * kClock;
      const double exact =
          t < zero_s ? (begin_a + against_a) * std::exp(-t / kTau) - against_a : 0.0;
      REQUIRE(current(plant) == Approx(exact).margin(1e-9));
    }
    CHECK(charge == Approx(begin_a * kTau - against_a * zero_s).epsilon(1e-9));
  }
}

TEST_CASE("switched: without the low gates the current is cut off in every period", "[switched]") {
  // A leg with its high gate alone: up from 0 for the pulse, down by the diode to 0, then none.
  constexpr int on = 50;
  Plant plant = locked(motor());
  double sum = 0;
  for (int clock = 0; clock < 3 * kPeriod; ++clock) {
    plant.advance(clock % kPeriod < on ? kForward : kOff, 1);
    if (clock % kPeriod == kPeriod - 1) REQUIRE(current(plant) == 0.0);
    if (clock >= 2 * kPeriod) sum += plant.observables().motor_current_mean_a;
  }
  constexpr double on_s = on * kClock, up_a = kV / kR, down_a = (kV + 1.4) / kR;
  const double peak_a = up_a * (1 - std::exp(-on_s / kTau));
  const double fall_s = kTau * std::log1p(peak_a / down_a);
  // L di = (u - R i) dt: the charge of a part is (u t - L di)/R.
  const double charge = up_a * on_s - kTau * peak_a + kTau * peak_a - down_a * fall_s;
  CHECK(sum * kClock == Approx(charge).epsilon(1e-6));
}

TEST_CASE("switched: a short leaves the wiring alone", "[switched]") {
  constexpr double ohm = 0.1, henry = 1e-6;
  Parameters p = motor();
  p.effects.dead_voltage = p.effects.back_emf = true;
  Plant plant = locked(p);
  drive_to(plant, 5);
  const double begin_a = current(plant);
  const Clock from = plant.now();
  plant.short_motor(ohm, henry);
  for (int k = 0; k < 500; ++k) {
    plant.advance(kForward, 1);
    const double t = static_cast<double>(plant.now() - from) * kClock;
    const double exact = kV / ohm + (begin_a - kV / ohm) * std::exp(-t * ohm / henry);
    REQUIRE(current(plant) == Approx(exact).epsilon(1e-9));
  }
}

TEST_CASE("sigma-delta: the bits' sum is the current's, to a few bits", "[switched]") {
  constexpr double full_scale_a = 32;
  for (const double level_a : {-25.0, -3.3, 0.0, 0.1, 16.6, 25.0}) {
    SigmaDelta modulator(full_scale_a);
    double sum = 0, worst = 0, largest = 0;
    for (int n = 0; n < 20'000; ++n) {
      sum += (modulator.next(level_a) ? 1 : -1) - level_a / full_scale_a;
      worst = feltgate::larger(worst, std::fabs(sum));
      largest = feltgate::larger(largest, std::fabs(modulator.error()));
    }
    CAPTURE(level_a);
    // y - x is the second difference of the error e: its sum is a first difference of e.
    CHECK(worst <= 2 * largest + 2);
    CHECK(worst < 8);
    CHECK(worst > 0.5);
  }
  // Beyond full scale it gives one value.
  SigmaDelta modulator(full_scale_a);
  int ones = 0;
  for (int n = 0; n < 1000; ++n) ones += modulator.next(40);
  CHECK(ones > 990);
}
