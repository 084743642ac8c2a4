// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The motor with three phases and its half bridges beside closed forms. docs/plant.md#three-phases
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "random.hpp"
#include "three_phase_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

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

namespace {

/// Mean torque over a turn of a second, as a share of what a voltage law without current sensing
/// asks for: v = R I + Ke w on the q axis, with the nominal constants.
double felt_share(const PhaseParameters& m, const Parameters& p, double torque_nm, int open = -1) {
  const PhaseParameters nominal = gimbal_motor();
  const double ke = nominal.back_emf_v_s_rad, rad_s = kTwoPi;
  const double amplitude_v = nominal.resistance_ohm * torque_nm / (1.5 * ke) + ke * rad_s;
  ThreePhasePlant plant(p, m, p.effects, drive_50khz(), turning(rad_s));
  if (open >= 0) plant.open_phase(static_cast<std::size_t>(open));
  const Clock settle = clocks_of(4e-3);
  double sum = 0;
  int steps = 0;
  while (plant.now() < settle + clocks_of(1)) {
    const double e = nominal.pole_pairs * rad_s * (seconds(plant.now()) + 2.5e-6);
    plant.advance(sinusoid(kBus, amplitude_v, e), 250);
    if (plant.now() <= settle) continue;
    sum += plant.observables().motor_torque_mean_nm;
    ++steps;
  }
  return sum / steps / torque_nm;
}

}  // namespace

TEST_CASE("three phases: torque of a voltage law over a turn, as docs/plant.md says", "[phases]") {
  const PhaseParameters m = gimbal_motor();
  PhaseParameters warm = m;
  warm.resistance_ohm *= 1.2;
  const Parameters p = shaft_on(kBus);
  CHECK(felt_share(m, p, 0.01) == Approx(1).margin(1e-3));
  CHECK(felt_share(warm, p, 0.01) == Approx(1 - 0.167).margin(1e-3));
  CHECK(felt_share(m, p, 0.01, 2) == Approx(0.5).margin(5e-3));
  Parameters late = shaft_on(kBus, 0.7);
  late.effects.dead_time = true;
  CHECK(felt_share(m, late, 0.01) == Approx(1 - 0.15).margin(5e-3));
  CHECK(felt_share(m, late, 0.002) == Approx(1 - 0.74).margin(5e-3));
}

// Three half bridges beside closed forms and a smooth model of their diodes: dead time, ripple,
// coasting, free-wheeling, values that are not numbers.

namespace {

ThreePhasePlant locked(const Parameters& p, const PhaseParameters& m) {
  return ThreePhasePlant(p, m, p.effects, drive_50khz(), held_at(0));
}

/// From the end of the averaged run, `periods` of gates; the means of the last one.
struct Period {
  Phases mean_a{};
  double supply_a = 0;
};
Period switched(ThreePhasePlant& plant, const std::array<int, 3>& on, int dead, int periods) {
  CentredGates gates(dead);
  Period last;
  const Clock start = plant.now();
  for (int clock = 0; clock < periods * kPwmClocks; ++clock) {
    plant.advance(gates.clock(plant.now() - start, on), 1);
    if (clock < (periods - 1) * kPwmClocks) continue;
    last.supply_a += plant.observables().supply_current_a / kPwmClocks;
    for (std::size_t k = 0; k < 3; ++k) {
      last.mean_a[k] += plant.motor().phase_mean_a()[k] / kPwmClocks;
    }
  }
  return last;
}

Legs duties(const std::array<int, 3>& on) {
  return Legs::averaged({on[0] / 1e3, on[1] / 1e3, on[2] / 1e3});
}

}  // namespace

TEST_CASE("three phases: dead time takes V t_d f of a leg, and of its diodes", "[phases]") {
  constexpr double bus_v = 24, share = 0.5e-6 * 50e3;
  PhaseParameters m = gimbal_motor();
  for (const double diode_v : {0.0, 0.7}) {
    Parameters p = shaft_on(bus_v, diode_v);
    p.effects.dead_time = true;
    for (const std::array<int, 3>& on : {std::array<int, 3>{700, 400, 350}, {250, 700, 800}}) {
      // Far from 0 each current has one direction: out of a leg it costs, into it, it gives.
      const double mean_on = (on[0] + on[1] + on[2]) / 3.0;
      Phases leg_v{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double sign = on[k] > mean_on ? 1 : -1;
        leg_v[k] = bus_v * on[k] / kPwmClocks - sign * share * (bus_v + 2 * diode_v);
      }
      const double neutral_v = (leg_v[0] + leg_v[1] + leg_v[2]) / 3;
      ThreePhasePlant plant = locked(p, m);
      for (int n = 0; n < 1600; ++n) plant.advance(duties(on), 250);
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(10 * plant.motor().phase_a()[k] == Approx(leg_v[k] - neutral_v).epsilon(1e-9));
      }
      ThreePhasePlant fine = locked(p, m);
      const Period last = switched(fine, on, 25, 150);
      CAPTURE(diode_v, on[0], on[1], on[2]);
      for (std::size_t k = 0; k < 3; ++k) {
        CHECK(10 * last.mean_a[k] == Approx(leg_v[k] - neutral_v).epsilon(1e-5));
      }
    }
  }
}

TEST_CASE("three phases: averaged legs have the means of the gates", "[phases]") {
  constexpr double bus_v = 24;
  const PhaseParameters m = gimbal_motor();
  test::Random random(7);
  double worst = 0, without = 0, supply = 0;
  for (int n = 0; n < 48; ++n) {
    const double diode_v = n % 2 == 0 ? 0.7 : 0, lost_v = 0.5e-6 * 50e3 * (bus_v + 2 * diode_v);
    Parameters p = shaft_on(bus_v, diode_v);
    p.effects.dead_time = true;
    // Wide apart, around the loss, and near one another, around any level.
    const int spread = n % 3 == 0 ? 400 : n % 3 == 1 ? 80 : 20;
    const auto level = random.between(100, 400);
    std::array<int, 3> on{};
    for (int& o : on)
      o = 2 * static_cast<int>(random.between(level - spread / 4, level + spread / 4));
    ThreePhasePlant coarse = locked(p, m);
    const std::size_t open = static_cast<std::size_t>(n / 6 % 6);  // three of six runs
    if (open < 3) coarse.open_phase(open);
    for (int step = 0; step < 1600; ++step) coarse.advance(duties(on), 250);
    const Phases mean_a = coarse.motor().phase_a();
    const double supply_a = coarse.observables().supply_current_a;
    if (diode_v == 0) {
      const double square = mean_a[0] * mean_a[0] + mean_a[1] * mean_a[1] + mean_a[2] * mean_a[2];
      CHECK(bus_v * supply_a == Approx(10 * square).epsilon(1e-9).margin(1e-15));
    }
    const Period last = switched(coarse, on, 25, 60);
    double mean_on = 0;
    for (std::size_t k = 0; k < 3; ++k) mean_on += k == open ? 0 : on[k] / (open < 3 ? 2.0 : 3.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const double ideal_a = k == open ? 0 : bus_v * (on[k] - mean_on) / kPwmClocks / 10;
      CAPTURE(on[0], on[1], on[2], k, open, mean_a[k], last.mean_a[k], ideal_a);
      const double error = std::abs(mean_a[k] - last.mean_a[k]) * 10 / lost_v;
      CHECK(error < 0.05);
      worst = larger(worst, error);
      without = larger(without, std::abs(ideal_a - last.mean_a[k]) * 10 / lost_v);
    }
    supply = larger(supply, std::abs(supply_a - last.supply_a));
  }
  CAPTURE(worst, without, supply);
  CHECK(without > 1);
  CHECK(supply < 1e-4);
}

TEST_CASE(
    "three phases: averaged legs lengthen low pulses to the shortest, and keep short high ones",
    "[phases]") {
  // Dead time 25 clocks, shortest pulse 10: no low pulse below 35; the PWM gives the mean of high
  // pulses of 26 to 34.
  PhaseParameters m = gimbal_motor();
  Parameters p = shaft_on(24);
  p.effects.dead_time = true;
  Drive drive = drive_50khz();
  drive.shortest_s = 10 / kClockHz;
  for (const auto& [asked, given] :
       {std::pair{std::array<int, 3>{990, 500, 30}, std::array<int, 3>{965, 500, 30}},
        {{1000, 500, 20}, {965, 500, 20}},
        {{964, 34, 36}, {964, 34, 36}},
        {{700, 400, 0}, {700, 400, 0}}}) {
    ThreePhasePlant plant(p, m, p.effects, drive, held_at(0));
    ThreePhasePlant other = locked(p, m);
    for (int step = 0; step < 400; ++step) {
      plant.advance(duties(asked), 250);
      other.advance(duties(given), 250);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      CAPTURE(asked[0], asked[1], asked[2], k);
      CHECK(plant.motor().phase_a()[k] == Approx(other.motor().phase_a()[k]).epsilon(1e-9));
    }
  }
}

TEST_CASE("three phases: the ripple between the edges of a leg's own pulse", "[phases]") {
  constexpr double bus_v = 24;
  PhaseParameters m = gimbal_motor();
  m.resistance_ohm = 1;
  Parameters p = shaft_on(bus_v);
  p.effects.dead_time = true;
  test::Random random(3);
  for (int n = 0; n < 24; ++n) {
    std::array<int, 3> on{};
    for (int& o : on) o = 100 + 2 * static_cast<int>(random.below(400));
    std::array<bool, 3> connected{true, true, true};
    ThreePhasePlant plant(p, m, p.effects, drive_50khz(0), held_at(0));
    if (n % 2 == 1) {
      connected[static_cast<std::size_t>(n / 2 % 3)] = false;
      plant.open_phase(static_cast<std::size_t>(n / 2 % 3));
    }
    for (int step = 0; step < 6000; ++step) plant.advance(duties(on), 250);
    LegModel model(drive_50khz(1e-15), p.supply, m, p.effects);
    const auto legs = model.curves(duties(on), bus_v, connected);
    CentredGates gates(0);
    Phases rise_a{}, fall_a{};
    for (int clock = 0; clock < 2 * kPwmClocks; ++clock) {
      for (std::size_t k = 0; k < 3; ++k) {
        const int begin = kPwmClocks + (kPwmClocks - on[k]) / 2;
        if (clock == begin) rise_a[k] = plant.motor().phase_a()[k];
        if (clock == begin + on[k]) fall_a[k] = plant.motor().phase_a()[k];
      }
      plant.advance(gates.clock(clock, on), 1);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      CAPTURE(on[0], on[1], on[2], n, k);
      if (!connected[k]) continue;
      CHECK(legs[k].edge_a == Approx((fall_a[k] - rise_a[k]) / 2).epsilon(0.01).margin(1e-4));
    }
  }
}

TEST_CASE("three phases: coasting, the diodes conduct when a line's back-EMF exceeds the bus",
          "[phases]") {
  constexpr double bus_v = 5, diode_v = 0.7;
  const Parameters p = shaft_on(bus_v, diode_v);
  const double limit_rad_s = (bus_v + 2 * diode_v) / (std::sqrt(3.0) * 0.05);
  for (const double share : {0.5, 0.999, 1.001, 1.5, -0.999, -1.2}) {
    for (const bool inductance : {true, false}) {
      Effects on = p.effects;
      on.inductance = inductance;
      ThreePhasePlant plant(p, gimbal_motor(), on, drive_50khz(), turning(share * limit_rad_s));
      double most_a = 0, work = 0;
      for (int n = 0; n < 20'000; ++n) {
        plant.advance(Legs::off(), 25);
        for (const double i : plant.motor().phase_a()) most_a = larger(most_a, std::abs(i));
        const double nm = plant.observables().motor_torque_mean_nm;
        REQUIRE(nm * share <= 0);  // it brakes
        REQUIRE(plant.observables().supply_current_a <= 0);
        work += nm;
      }
      CAPTURE(share, inductance);
      CHECK((most_a > 0) == (std::abs(share) > 1));
      CHECK((work != 0) == (std::abs(share) > 1));
    }
  }
}

TEST_CASE("three phases: gates off, the currents go back through the diodes", "[phases]") {
  constexpr double bus_v = 5, diode_v = 0.7, tau_s = 2e-4;
  const Parameters p = shaft_on(bus_v, diode_v);
  struct Case {
    Legs legs;
    double against_v;  // of leg A beside both others, of which a third is the neutral's
  };
  // All off: back into the supply. Leg A off, the others low: through its low diode alone.
  for (const Case& c : {Case{Legs::off(), bus_v + 2 * diode_v},
                        Case{Legs::gates(0, 0, 0, 0, 0, 0), bus_v + 2 * diode_v},
                        Case{Legs::gates(0, 0, 0, 1, 0, 1), diode_v}}) {
    for (const Clock step : {1, 7, 250}) {
      ThreePhasePlant plant = locked(p, gimbal_motor());
      for (int n = 0; n < 1000; ++n) plant.advance(sinusoid(bus_v, 2, 0), 250);
      const double begin_a = plant.motor().phase_a()[0];
      CHECK(begin_a == Approx(0.2));
      const double final_a = -2.0 / 3 * c.against_v / 10;
      const double zero_s = tau_s * std::log1p(begin_a / -final_a);
      const Clock from = plant.now();
      double charge = 0;
      while (plant.now() < from + clocks_of(2 * zero_s)) {
        plant.advance(c.legs, step);
        charge += plant.motor().phase_mean_a()[0] * static_cast<double>(step) / kClockHz;
        const double t = static_cast<double>(plant.now() - from) / kClockHz;
        const double exact = t < zero_s ? final_a + (begin_a - final_a) * std::exp(-t / tau_s) : 0;
        const Phases i = plant.motor().phase_a();
        REQUIRE(i[0] == Approx(exact).margin(1e-9));
        REQUIRE(i[1] == Approx(-exact / 2).margin(1e-9));
        REQUIRE(i[2] == Approx(-exact / 2).margin(1e-9));
      }
      CHECK(plant.motor().phase_a()[0] == 0.0);
      CHECK(std::abs(plant.motor().phase_a()[1]) < 1e-15);
      CHECK(charge == Approx(final_a * zero_s + begin_a * tau_s).epsilon(1e-9));
    }
  }
}

TEST_CASE("three phases: diodes beside a smooth curve of theirs", "[phases]") {
  // The judge: each leg's voltage by its current is a steep tanh; Runge-Kutta in small steps.
  constexpr double bus_v = 5, diode_v = 0.7, soft_a = 1e-5, dt_s = 10e-9;
  const Parameters p = shaft_on(bus_v, diode_v);
  for (const double rad_s : {0.0, -110.0, 180.0}) {
    for (const Phases& start_v : {Phases{0, 0, 0}, Phases{1.5, -2, 0.5}}) {
      ThreePhasePlant plant(
          p, gimbal_motor(), p.effects, drive_50khz(),
          moving({segment(Segment::Kind::kHold, 0.01), segment(Segment::Kind::kRamp, 1, rad_s)}));
      while (plant.now() < 500'000) plant.advance(volts(bus_v, start_v), 250);
      Phases i = plant.motor().phase_a();
      const auto rates = [&](const Phases& a, double t) {
        const Phases shape = cosines(11 * rad_s * t);
        Phases v{};
        for (std::size_t k = 0; k < 3; ++k) {
          v[k] = bus_v / 2 - (bus_v / 2 + diode_v) * std::tanh(a[k] / soft_a) -
                 0.05 * rad_s * shape[k];
        }
        const double neutral_v = (v[0] + v[1] + v[2]) / 3;
        for (std::size_t k = 0; k < 3; ++k) v[k] = (v[k] - neutral_v - 10 * a[k]) / 2e-3;
        return v;
      };
      const auto moved = [](const Phases& a, const Phases& rate, double h) {
        return Phases{a[0] + h * rate[0], a[1] + h * rate[1], a[2] + h * rate[2]};
      };
      double worst_a = 0, most_a = 0;
      for (int n = 0; n < 400'000; ++n) {
        const double t = n * dt_s;
        const Phases k1 = rates(i, t), k2 = rates(moved(i, k1, dt_s / 2), t + dt_s / 2);
        const Phases k3 = rates(moved(i, k2, dt_s / 2), t + dt_s / 2);
        const Phases k4 = rates(moved(i, k3, dt_s), t + dt_s);
        for (std::size_t k = 0; k < 3; ++k) {
          i[k] += dt_s / 6 * (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k]);
        }
        if (n % 50 != 49) continue;
        plant.advance(Legs::off(), 25);
        for (std::size_t k = 0; k < 3; ++k) {
          worst_a = larger(worst_a, std::abs(i[k] - plant.motor().phase_a()[k]));
          most_a = larger(most_a, std::abs(i[k]));
        }
      }
      CAPTURE(rad_s, start_v[0], most_a, worst_a);
      CHECK(worst_a < 10 * soft_a);
      CHECK((most_a > 1000 * soft_a) == (std::abs(rad_s) > 100 || start_v[0] > 0));
    }
  }
}

TEST_CASE("three phases: what is not a number ends the run", "[phases]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const PhaseParameters m = gimbal_motor();
  for (const bool inductance : {true, false}) {
    Parameters p = shaft_on(5, 0.7);
    p.effects.dead_time = true;
    p.effects.inductance = inductance;
    std::vector<Legs> bad;
    for (std::size_t k = 0; k < 3; ++k) {
      Legs averaged = Legs::averaged({0.5, 0.4, 0.6}), high = Legs::gates(0, 1, 0, 1, 0, 1);
      Legs low = high;
      averaged.duty[k] = high.high[k] = low.low[k] = nan;
      bad.insert(bad.end(), {averaged, high, low});
    }
    for (const Legs& legs : bad) {
      for (const Hand& hand : {Hand{}, held_at(0.1)}) {
        ThreePhasePlant plant(p, m, p.effects, drive_50khz(), hand);
        plant.advance(sinusoid(5, 1, 0), 25);
        CHECK_THROWS_AS(plant.advance(legs, 25), MotionError);
      }
    }
    PhaseParameters lost = m;
    lost.offset_rad = nan;
    ThreePhasePlant turned(p, lost, p.effects, drive_50khz(), Hand{});
    CHECK_THROWS_AS(turned.advance(Legs::off(), 25), MotionError);
    p.supply.voltage_v = nan;
    ThreePhasePlant dark(p, m, p.effects, drive_50khz(), held_at(0));
    CHECK_THROWS_AS(dark.advance(Legs::off(), 25), MotionError);
  }
  const Parameters p = shaft_on(5);
  const auto refused = [&](const PhaseParameters& wrong, const Drive& drive) {
    CHECK_THROWS_AS(ThreePhasePlant(p, wrong, p.effects, drive, Hand{}), std::invalid_argument);
  };
  for (double PhaseParameters::*value :
       {&PhaseParameters::resistance_ohm, &PhaseParameters::inductance_h,
        &PhaseParameters::back_emf_v_s_rad}) {
    for (const double v : {0.0, -1.0, nan}) {
      PhaseParameters wrong = m;
      wrong.*value = v;
      refused(wrong, drive_50khz());
    }
  }
  PhaseParameters wrong = m;
  wrong.pole_pairs = 0;
  refused(wrong, drive_50khz());
  wrong = m;
  wrong.harmonics = {{0, 0.1}};
  refused(wrong, drive_50khz());
  refused(m, drive_50khz(11e-6));
  Drive shortest = drive_50khz();
  shortest.shortest_s = 9.6e-6;  // with the dead time of 0.5 us more than half a period
  refused(m, shortest);
}
