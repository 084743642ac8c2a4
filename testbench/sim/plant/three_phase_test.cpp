// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The motor with three phases beside closed forms: torque, lag, ripple, an open phase, power and
// convergence. docs/plant.md#three-phases
#include <chrono>
#include <cstdio>

#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "random.hpp"
#include "three_phase_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

const double kSqrt3 = std::sqrt(3.0);

double seconds(Clock clocks) { return static_cast<double>(clocks) / kClockHz; }

}  // namespace

TEST_CASE("three phases: at stall the torque is 3/2 Ke I at every angle", "[phases]") {
  PhaseParameters m = gimbal_motor();
  m.offset_rad = 0.7;
  for (const bool inductance : {true, false}) {
    for (const double amplitude_v : {2.4, -1.1}) {
      for (int n = 0; n < 12; ++n) {
        const double rad = 0.05 * n, e = 11 * rad + 0.7, current_a = amplitude_v / 10;
        Parameters p = shaft_on(kBus);
        p.effects.inductance = inductance;
        ThreePhasePlant plant(p, m, p.effects, drive_50khz(), held_at(rad));
        while (plant.now() < clocks_of(8e-3)) plant.advance(sinusoid(kBus, amplitude_v, e), 250);
        const Observables& o = plant.observables();
        CAPTURE(inductance, amplitude_v, rad);
        CHECK(o.motor_torque_nm == Approx(1.5 * 0.05 * current_a).epsilon(1e-9));
        CHECK(o.motor_torque_mean_nm == Approx(1.5 * 0.05 * current_a).epsilon(1e-9));
        CHECK(o.hand_torque_nm == Approx(-1.5 * 0.05 * current_a).epsilon(1e-9));
        CHECK(o.motor_current_a == Approx(current_a).epsilon(1e-9));
        // Half the bus to each leg carries nothing: the currents sum to 0.
        CHECK(kBus * o.supply_current_a == Approx(1.5 * amplitude_v * current_a).epsilon(1e-9));
        for (std::size_t k = 0; k < 3; ++k) {
          CHECK(plant.motor().phase_a()[k] == Approx(current_a * cosines(e)[k]).margin(1e-9));
        }
      }
    }
  }
}

TEST_CASE("three phases: at speed the current lags by atan(w p L/R)", "[phases]") {
  const PhaseParameters m = gimbal_motor();
  constexpr double amplitude_v = 2.0;
  for (const double turns_s : {50.0, 200.0, -200.0, 1000.0}) {  // electrical
    for (const bool back_emf : {false, true}) {
      Parameters p = shaft_on(kBus);
      p.effects.back_emf = back_emf;
      const double rate = kTwoPi * turns_s, rad_s = rate / 11;
      ThreePhasePlant plant(p, m, p.effects, drive_50khz(), turning(rad_s));
      const Clock turn = std::llround(kClockHz / std::abs(turns_s)), settle = 10 * turn;
      double along = 0, behind = 0, torque = 0, low = 1e9, high = -1e9;
      int steps = 0;
      while (plant.now() < settle + turn) {
        const double e = rate * (seconds(plant.now()) + 0.25e-6);
        plant.advance(sinusoid(kBus, amplitude_v, e), 25);
        if (plant.now() <= settle) continue;
        const double i = plant.motor().phase_mean_a()[0];
        const double t = plant.observables().motor_torque_mean_nm;
        along += 2 * i * std::cos(e), behind += 2 * i * std::sin(e), torque += t, ++steps;
        low = smaller(low, t), high = larger(high, t);
      }
      along /= steps, behind /= steps, torque /= steps;
      const double driving_v = amplitude_v - (back_emf ? 0.05 * rad_s : 0);
      const double reactance_ohm = rate * 2e-3, lag = std::atan(reactance_ohm / 10);
      const double size_a = std::abs(driving_v) / std::hypot(10, reactance_ohm);
      CAPTURE(turns_s, back_emf, lag);
      CHECK(std::hypot(along, behind) == Approx(size_a).epsilon(1e-3));
      const double sign = driving_v > 0 ? 1 : -1;
      CHECK(std::atan2(sign * behind, sign * along) == Approx(lag).epsilon(1e-3));
      CHECK(torque == Approx(1.5 * 0.05 * sign * size_a * std::cos(lag)).epsilon(1e-3));
      // Sinusoidal through and through: no ripple.
      CHECK(high - low < 1e-4 * std::abs(torque));
    }
  }
}

TEST_CASE("three phases: the free shaft is a DC motor of 3/2 Ke and Ke", "[phases]") {
  // Without inductance, on the q axis: J dw/dt = 3/2 Ke (V - Ke w)/R.
  Parameters p = shaft_on(kBus);
  p.effects.inductance = false;
  for (const double amplitude_v : {2.0, -2.0}) {
    ThreePhasePlant plant(p, gimbal_motor(), p.effects, drive_50khz(), Hand{});
    const double final_rad_s = amplitude_v / 0.05;
    const double tau_s = p.lever.inertia_kg_m2 * 10 / (1.5 * 0.05 * 0.05);
    while (plant.now() < clocks_of(0.1)) {
      const Observables& o = plant.observables();
      const double e = 11 * (o.theta_rad + 0.25e-6 * o.omega_rad_s);
      plant.advance(sinusoid(kBus, amplitude_v, e), 25);
    }
    CHECK(plant.observables().omega_rad_s ==
          Approx(final_rad_s * (1 - std::exp(-0.1 / tau_s))).epsilon(1e-5));
    CHECK((plant.encoder().count() > 0) == (amplitude_v > 0));
  }
}

TEST_CASE("three phases: 5th and 7th harmonic make a torque ripple of 6 e", "[phases]") {
  // cos(n x) cos(x) = (cos((n-1) x) + cos((n+1) x))/2; over the phases only multiples of 3 stay:
  // 6 of the 5th, 6 of the 7th. The 3rd finds no current.
  PhaseParameters m = gimbal_motor();
  struct Case {
    std::vector<EmfHarmonic> harmonics;
    double share;
  };
  for (const Case& c : {Case{{{5, 0.06}}, 0.06}, Case{{{7, -0.03}}, -0.03}, Case{{{3, 0.2}}, 0.0},
                        Case{{{3, 0.1}, {5, 0.06}, {7, 0.02}}, 0.08}}) {
    m.harmonics = c.harmonics;
    Parameters p = shaft_on(kBus);
    p.effects.inductance = p.effects.back_emf = false;
    ThreePhasePlant plant(p, m, p.effects, drive_50khz(), turning(100));
    for (int n = 0; n < 12'000; ++n) {  // an electrical turn and more
      const double e = 11 * 100 * (seconds(plant.now()) + 0.25e-6);
      plant.advance(sinusoid(kBus, 2, e), 25);
      const double level_nm = 1.5 * 0.05 * 0.2;
      REQUIRE(plant.observables().motor_torque_mean_nm ==
              Approx(level_nm * (1 + c.share * std::cos(6 * e))).epsilon(1e-9));
    }
  }
}

TEST_CASE("three phases: with one phase open the torque is a square of a cosine", "[phases]") {
  // Phases j and j + 1 in line: i = (v_j - v_j+1)/(2 R), torque Ke i (c_j - c_j+1), and
  // cos x - cos(x - 120 deg) = sqrt 3 cos(x + 30 deg).
  for (std::size_t open = 0; open < 3; ++open) {
    Parameters p = shaft_on(kBus);
    p.effects.inductance = p.effects.back_emf = false;
    ThreePhasePlant plant(p, gimbal_motor(), p.effects, drive_50khz(), turning(100));
    plant.open_phase(open);
    const double lag = kThird * static_cast<double>((open + 1) % 3);
    const int steps = static_cast<int>(std::lround(kTwoPi / 1100 / 0.5e-6));
    double sum = 0, least = 1e9;
    for (int n = 0; n < steps; ++n) {
      const double e = 11 * 100 * (seconds(plant.now()) + 0.25e-6);
      plant.advance(sinusoid(kBus, 2, e), 25);
      const double t = plant.observables().motor_torque_mean_nm;
      const double c = std::cos(e - lag + kTwoPi / 12);
      REQUIRE(t == Approx(1.5 * 0.05 * 0.2 * c * c).margin(1e-12));
      REQUIRE(plant.motor().phase_a()[open] == 0.0);
      sum += t;
      least = smaller(least, t);
    }
    CHECK(sum / steps == Approx(1.5 * 0.05 * 0.2 / 2).epsilon(1e-3));
    CHECK(least < 1e-4 * sum / steps);
  }
  // Opened under current: the loop of the other two keeps its flux, L (i_a - i_b).
  Parameters p = shaft_on(kBus);
  ThreePhasePlant plant(p, gimbal_motor(), p.effects, drive_50khz(), held_at(0));
  for (int n = 0; n < 1000; ++n) plant.advance(volts(kBus, {2, -0.5, -1.5}), 250);
  const Phases before = plant.motor().phase_a();
  CHECK(before[0] == Approx(0.2));
  CHECK(before[1] == Approx(-0.05));
  plant.open_phase(2);
  CHECK(plant.motor().phase_a()[0] == Approx(0.125));
  CHECK(plant.motor().phase_a()[1] == Approx(-0.125));
  for (int n = 0; n < 1000; ++n) plant.advance(volts(kBus, {2, -0.5, -1.5}), 250);
  CHECK(plant.motor().phase_a()[0] == Approx(2.5 / 20).epsilon(1e-9));
  CHECK(plant.motor().phase_a()[2] == 0.0);
  // Alone in the star a phase carries nothing.
  plant.open_phase(1);
  plant.advance(volts(kBus, {2, -0.5, -1.5}), 250);
  CHECK(plant.motor().phase_a() == Phases{});
  CHECK(plant.observables().supply_current_a == 0.0);
}

TEST_CASE("three phases: what the supply gives is copper, work, field and diodes", "[phases]") {
  constexpr double dt_s = 20e-9;
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    test::Random random(seed);
    const double diode_v = seed % 2 == 0 ? 0.7 : 0;
    Parameters p = shaft_on(kBus, diode_v);
    p.effects.dead_time = true;
    PhaseParameters m = gimbal_motor();
    m.harmonics = {{3, 0.1}, {5, 0.06}, {7, 0.02}};
    // Up to 190 rad/s: there the back-EMF of two phases is three times the bus.
    ThreePhasePlant plant(p, m, p.effects, drive_50khz(),
                          moving({sine(1, 3, 10, random.uniform())}));
    if (seed % 4 == 3) plant.open_phase(seed / 4 % 3);
    CentredGates gates(25);
    std::array<int, 3> on{};
    Phases duty{};
    int mode = 0;
    double given = 0, through = 0, copper = 0, work = 0, burnt = 0;
    double rad = plant.observables().theta_rad;
    Phases was{};
    for (int clock = 0; clock < 150'000; ++clock) {
      if (clock % 500 == 0) {
        mode = static_cast<int>(random.uniform() * 3);
        for (std::size_t k = 0; k < 3; ++k) {
          on[k] = static_cast<int>(random.uniform() * (kPwmClocks + 1));
          duty[k] = random.uniform();
        }
        if (diode_v > 0 && mode == 1) mode = 2;  // the test counts the diodes of gates alone
      }
      const Legs legs = mode == 0   ? Legs::off()
                        : mode == 1 ? Legs::averaged(duty)
                                    : gates.clock(clock, on);
      plant.advance(legs, 1);
      const Observables& o = plant.observables();
      given += kBus * o.supply_current_a * dt_s;
      through += kBus * std::abs(o.supply_current_a) * dt_s;
      work += o.motor_torque_mean_nm * (o.theta_rad - rad);
      rad = o.theta_rad;
      const Phases now = plant.motor().phase_a(), mean = plant.motor().phase_mean_a();
      for (std::size_t k = 0; k < 3; ++k) {
        // The square of the parabola with both ends and this mean, in Legendre polynomials.
        const double slope = (now[k] - was[k]) / 2, bow = (now[k] + was[k]) / 2 - mean[k];
        copper += 10 * (mean[k] * mean[k] + slope * slope / 3 + bow * bow / 5) * dt_s;
        if (mode != 1) {
          burnt += diode_v * (1 - legs.high[k] - legs.low[k]) * std::abs(mean[k]) * dt_s;
        }
      }
      REQUIRE(std::abs(now[0] + now[1] + now[2]) < 1e-12);
      was = now;
    }
    double field = 0;
    for (const double i : was) field += 0.5 * 2e-3 * i * i;
    CAPTURE(seed, given, through, copper, work, field, burnt);
    CHECK(std::abs(given - copper - work - field - burnt) < 1e-9 * through);
    worst = larger(worst, std::abs(given - copper - work - field - burnt) / through);
    CHECK(copper > 0.05 * through);
    CHECK(std::abs(work) > 0.01 * through);
  }
  CAPTURE(worst);
  CHECK(worst > 0);
}

TEST_CASE("three phases: halving the step quarters the error", "[phases]") {
  PhaseParameters m = gimbal_motor();
  m.harmonics = {{5, 0.06}};
  struct Case {
    const char* name;
    Legs legs;
    bool free;
  };
  // Held legs: on a moved shaft the back-EMF turns; a free light one swings like a stepper's.
  for (const Case& c :
       {Case{"moved", volts(kBus, {2, -1, 0.3}), false},
        Case{"free", volts(kBus, {2, -1, 0.3}), true}, Case{"coasting", Legs::off(), false}}) {
    Parameters p = shaft_on(kBus, 0.7);
    p.lever.inertia_kg_m2 = 2e-6;
    p.effects.dead_time = true;
    Hand start;
    start.start_rad = 0.05;
    const auto after = [&](Clock step) {
      ThreePhasePlant plant(p, m, p.effects, drive_50khz(),
                            c.free ? start : moving({sine(1, 3, 10, 0.3)}));
      while (plant.now() < 400'000) plant.advance(c.legs, step);
      const Phases i = plant.motor().phase_a();
      return std::array<double, 4>{i[0], i[1], plant.observables().theta_rad,
                                   plant.observables().omega_rad_s / 100};
    };
    const auto exact = after(5);
    const auto error = [&](Clock step) {
      const auto got = after(step);
      double worst = 0;
      for (std::size_t k = 0; k < 4; ++k) worst = larger(worst, std::abs(got[k] - exact[k]));
      return worst;
    };
    const double coarse = error(1000), middle = error(500), fine = error(250);
    CAPTURE(c.name, coarse, middle, fine);
    CHECK(coarse / middle == Approx(4.0).margin(0.6));
    CHECK(middle / fine == Approx(4.0).margin(0.6));
    CHECK(fine < 1e-4);
  }
}

TEST_CASE("three phases: what is off is neither evaluated nor a state", "[phases]") {
  Parameters p = shaft_on(kBus);
  ThreePhasePlant bare(p, gimbal_motor(), kNoEffects, drive_50khz(), Hand{});
  CHECK(bare.state().size() == 2);
  bare.advance(sinusoid(kBus, 1, 0), 25);
  CHECK(bare.evaluations().inductance + bare.evaluations().back_emf +
            bare.evaluations().dead_time ==
        0);
  p.effects.dead_time = p.effects.supply_limit = true;
  ThreePhasePlant full(p, gimbal_motor(), p.effects, drive_50khz(), Hand{});
  CHECK(full.state().size() == 5);
  CHECK(full.state()[2].name == "phase_a_a");
  full.advance(sinusoid(kBus, 1, 0), 25);
  CHECK(full.evaluations().inductance * full.evaluations().back_emf *
            full.evaluations().dead_time ==
        1);
}

// A gimbal motor under a voltage law without current sensing: torque and ripple over a turn,
// checked and, with [phase-table], printed for docs/plant.md#three-phases

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
