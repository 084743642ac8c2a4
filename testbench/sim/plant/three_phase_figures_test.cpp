// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A gimbal motor under a voltage law without current sensing: torque and ripple over a turn,
// checked and, with [phase-table], printed for docs/plant.md#three-phases
#include <chrono>
#include <cstdio>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "three_phase_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

/// The law: v = R I + Ke w on the q axis, I = torque/(3/2 Ke), with the nominal constants.
struct Law {
  double torque_nm = 0.01;
  double turns_s = 1.0;
  bool third = false;  ///< a sixth of the amplitude, as third harmonic of each leg
};

/// Torque over one mechanical turn, in percent of the law's.
struct Felt {
  double mean, low, high;
  double ripple() const { return high - low; }
  double error() const { return mean - 100; }
};

Felt turn(const PhaseParameters& m, const Parameters& p, const Law& law, int open = -1) {
  const PhaseParameters nominal = gimbal_motor();
  const double rad_s = kTwoPi * law.turns_s;
  const double amplitude_v = nominal.resistance_ohm * law.torque_nm / (1.5 * 0.05) + 0.05 * rad_s;
  ThreePhasePlant plant(p, m, p.effects, drive_50khz(), turning(rad_s));
  if (open >= 0) plant.open_phase(static_cast<std::size_t>(open));
  const Clock settle = clocks_of(4e-3), end = settle + clocks_of(1 / law.turns_s);
  double sum = 0, low = 1e9, high = -1e9;
  Clock steps = 0;
  while (plant.now() < end) {
    const double e = 11 * rad_s * (static_cast<double>(plant.now()) / kClockHz + 2.5e-6);
    Phases v = cosines(e);
    for (double& leg_v : v) leg_v = amplitude_v * (leg_v - (law.third ? std::cos(3 * e) / 6 : 0));
    plant.advance(volts(kBus, v), 250);
    if (plant.now() <= settle) continue;
    const double share = 100 * plant.observables().motor_torque_mean_nm / law.torque_nm;
    sum += share, low = smaller(low, share), high = larger(high, share), ++steps;
  }
  return {sum / static_cast<double>(steps), low, high};
}

/// The torque whose amplitude is this voltage, at the speed of the law.
Law at_limit(double amplitude_v, bool third) {
  Law law;
  law.turns_s = 0.5;
  law.third = third;
  law.torque_nm = 1.5 * 0.05 * (amplitude_v - 0.05 * kTwoPi * law.turns_s) / 10;
  return law;
}

PhaseParameters with_harmonics() {
  PhaseParameters m = gimbal_motor();
  m.harmonics = {{5, 0.06}, {7, 0.02}};
  return m;
}

PhaseParameters warm() {
  PhaseParameters m = gimbal_motor();
  m.resistance_ohm *= 1.2;
  return m;
}

Parameters with_dead_time() {
  Parameters p = shaft_on(kBus, 0.7);
  p.effects.dead_time = true;
  return p;
}

const double kHalf_v = kBus / 2, kLong_v = kBus / std::sqrt(3.0);

}  // namespace

TEST_CASE("three phases: torque of a voltage law over a turn", "[phases]") {
  const Parameters p = shaft_on(kBus);
  const PhaseParameters m = gimbal_motor();
  const Felt plain = turn(m, p, {});
  CHECK(std::abs(plain.error()) < 0.1);
  CHECK(plain.ripple() < 0.1);
  // The lag of L/R: torque T cos^2 of it.
  Law fast;
  fast.turns_s = 3;
  const double lag = std::atan(kTwoPi * 3 * 11 * 2e-4), cosine = std::cos(lag);
  CHECK(turn(m, p, fast).mean == Approx(100 * cosine * cosine).epsilon(1e-4));
  // The back-EMF's harmonics h meet the current of the law and make currents of their own: with
  // E = Ke w, torque R/Ke = (V - E) sum c^2 + (V - 2 E) sum c h - E sum h^2, of 6 e the middle
  // part.
  Law slow;
  slow.turns_s = 0.2;
  for (const Law& law : {slow, Law{}}) {
    const double current_v = 10 * law.torque_nm / (1.5 * 0.05), emf_v = 0.05 * kTwoPi * law.turns_s;
    const double ripple = 2 * (6 + 2) * (current_v - emf_v) / current_v;
    CHECK(turn(with_harmonics(), p, law).ripple() == Approx(ripple).epsilon(0.005));
  }
  CHECK(turn(warm(), p, slow).error() == Approx(100 / 1.2 - 100).epsilon(0.001));
  // One phase open: the half, from 0 to all of it.
  const Felt open = turn(m, p, slow, 2);
  CHECK(open.mean == Approx(50).epsilon(0.01));
  CHECK(open.low == Approx(0).margin(0.5));
  CHECK(open.high == Approx(100).epsilon(0.01));
  // The supply's limit: with the third harmonic 2/sqrt 3 of the amplitude without.
  CHECK(kLong_v / kHalf_v == Approx(1.1547).epsilon(1e-4));
  for (const Law& law : {at_limit(kHalf_v, false), at_limit(kLong_v, true)}) {
    const Felt felt = turn(m, p, law);
    CHECK(std::abs(felt.error()) < 0.1);
    CHECK(felt.ripple() < 0.1);
  }
  const Felt cut = turn(m, p, at_limit(kLong_v, false)), over = turn(m, p, at_limit(3, true));
  CHECK(cut.error() < -3);
  CHECK(cut.ripple() > 3);
  CHECK(over.ripple() > 3);
}

TEST_CASE("table of torque for docs/plant.md", "[.][phase-table]") {
  const Parameters p = shaft_on(kBus);
  const PhaseParameters m = gimbal_motor();
  const auto row = [](const char* name, const Law& law, const Felt& felt) {
    std::printf("| %s | %.1f | %.2f | %+.2f | %.2f |\n", name, law.turns_s, 1e3 * law.torque_nm,
                felt.error(), felt.ripple());
  };
  const Law one{}, fast{0.01, 3, false}, soft{0.002, 1, false};
  std::printf("| case | turns/s | asked, mNm | mean error, %% | ripple p-p, %% |\n");
  std::printf("|---|---|---|---|---|\n");
  row("sinusoidal back-EMF", one, turn(m, p, one));
  row("the same", fast, turn(m, p, fast));
  row("5th 6 %, 7th 2 % in the back-EMF", one, turn(with_harmonics(), p, one));
  row("the same", fast, turn(with_harmonics(), p, fast));
  row("R 20 % above the law's", one, turn(warm(), p, one));
  row("dead time 0.5 us at 50 kHz, diodes 0.7 V", one, turn(m, with_dead_time(), one));
  row("the same", soft, turn(m, with_dead_time(), soft));
  row("one phase open", one, turn(m, p, one, 2));
  const Law half = at_limit(kHalf_v, false), cut = at_limit(kLong_v, false);
  const Law whole = at_limit(kLong_v, true), over = at_limit(3, true);
  row("amplitude Vdc/2", half, turn(m, p, half));
  row("amplitude Vdc/sqrt 3", cut, turn(m, p, cut));
  row("amplitude Vdc/sqrt 3, with third harmonic", whole, turn(m, p, whole));
  row("amplitude 0.6 Vdc, with third harmonic", over, turn(m, p, over));
}

TEST_CASE("speed of three phases for docs/plant.md", "[.][phase-speed]") {
  const auto report = [](const char* name, const PhaseParameters& m, const Parameters& p,
                         Clock step, const auto& legs) {
    ThreePhasePlant plant(p, m, p.effects, drive_50khz(), turning(20));
    const auto begin = std::chrono::steady_clock::now();
    for (int n = 0; n < 2'000'000; ++n) plant.advance(legs(plant.now()), step);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    std::printf("| %s | %.0f |\n", name, spent.count() / 2e6 * 1e9);
  };
  std::printf("| step | ns |\n|---|---|\n");
  CentredGates gates(25);
  const auto switched = [&gates](Clock now) { return gates.clock(now, {600, 450, 400}); };
  const auto averaged = [](Clock now) {
    return sinusoid(kBus, 1, 1e-6 * static_cast<double>(now));
  };
  report("averaged", gimbal_motor(), shaft_on(kBus), 25, averaged);
  report("averaged, dead time, two harmonics", with_harmonics(), with_dead_time(), 25, averaged);
  report("gates clock by clock", gimbal_motor(), shaft_on(kBus, 0.7), 1, switched);
}
