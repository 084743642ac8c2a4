// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Three half bridges beside closed forms and a smooth model of their diodes: dead time, ripple,
// coasting, free-wheeling, values that are not numbers. docs/plant.md#three-phases
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "random.hpp"
#include "three_phase_fixture.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

constexpr double kTurn_s = kPwmClocks / kClockHz;

ThreePhasePlant locked(const Parameters& p, const PhaseParameters& m) {
  return ThreePhasePlant(p, m, p.effects, drive_50khz(), held_at(0));
}

/// From the end of the averaged run, `periods` of gates; the means and ranges of the last one.
struct Period {
  Phases mean_a{}, low_a{1e9, 1e9, 1e9}, high_a{-1e9, -1e9, -1e9};
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
      last.low_a[k] = smaller(last.low_a[k], plant.motor().phase_a()[k]);
      last.high_a[k] = larger(last.high_a[k], plant.motor().phase_a()[k]);
    }
  }
  REQUIRE_FALSE(plant.observables().shoot_through);
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
  for (int n = 0; n < 120; ++n) {
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

TEST_CASE("three phases: a current that turns over in its pulse", "[phases]") {
  // One leg in the middle of the two others, its current around 0: it loses nothing while valley
  // and peak of its ripple have opposite signs, and stays at the ripple's half beyond.
  constexpr double bus_v = 24, lost_v = 0.5e-6 * 50e3 * bus_v;
  Parameters p = shaft_on(bus_v);
  p.effects.dead_time = true;
  test::Random random(11);
  double worst = 0, felt = 0;
  for (int n = 0; n < 40; ++n) {
    const int wide = 2 * static_cast<int>(random.between(40, 190));
    const int middle = 500 + 2 * static_cast<int>(random.between(-40, 40));
    const int off = 2 * static_cast<int>(random.between(-12, 12));
    const std::array<int, 3> on{middle + wide, middle + off, middle - wide};
    ThreePhasePlant coarse = locked(p, gimbal_motor());
    for (int step = 0; step < 1600; ++step) coarse.advance(duties(on), 250);
    const Phases mean_a = coarse.motor().phase_a();
    const Period last = switched(coarse, on, 25, 60);
    for (std::size_t k = 0; k < 3; ++k) {
      CAPTURE(on[0], on[1], on[2], k, mean_a[k], last.mean_a[k]);
      const double error = std::abs(mean_a[k] - last.mean_a[k]) * 10 / lost_v;
      CHECK(error < 0.02);
      worst = larger(worst, error);
    }
    felt = larger(felt, std::abs(last.mean_a[1]) * 10 / lost_v);
  }
  CAPTURE(worst, felt);
  CHECK(felt > 0.15);
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

TEST_CASE("three phases: ripple of a star is 2/3 V x max(g, 1 - D)/(L f)", "[phases]") {
  // Leg A at D, B and C at g, centred, x = D - g: twice in a period phase A has 2/3 V for x/2, and
  // nothing while all are high (g) or low (1 - D). With g = 0 it is 2/3 V D (1 - D)/(L f).
  constexpr double bus_v = 24;
  PhaseParameters m = gimbal_motor();
  m.resistance_ohm = 1;
  const Parameters p = shaft_on(bus_v);
  for (const std::array<int, 2>& d :
       {std::array<int, 2>{300, 0}, {700, 0}, {600, 400}, {900, 300}}) {
    const std::array<int, 3> on{d[0], d[1], d[1]};
    ThreePhasePlant plant = locked(p, m);
    for (int n = 0; n < 6000; ++n) plant.advance(duties(on), 250);
    const Period last = switched(plant, on, 0, 20);
    const double x = (d[0] - d[1]) / 1e3, most = std::max(d[1], 1000 - d[0]) / 1e3;
    const double ripple_a = 2.0 / 3 * bus_v * x * most / (2e-3 * 50e3);
    CAPTURE(d[0], d[1]);
    CHECK(last.high_a[0] - last.low_a[0] == Approx(ripple_a).epsilon(0.004));
    CHECK(last.high_a[1] - last.low_a[1] == Approx(ripple_a / 2).epsilon(0.004));
    CHECK(last.mean_a[0] == Approx(2.0 / 3 * bus_v * x).epsilon(1e-4));
    CHECK(last.supply_a == Approx(2.0 / 3 * bus_v * x * x).epsilon(1e-3));
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
  for (const double rad_s : {0.0, 70.0, -110.0, 180.0}) {
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

TEST_CASE("three phases: two gates of a leg at once are reported", "[phases]") {
  const Parameters p = shaft_on(5);
  for (int leg = 0; leg < 3; ++leg) {
    ThreePhasePlant plant = locked(p, gimbal_motor());
    plant.advance(Legs::gates(0.5, 0.5, 0, 1, 1, 0), 25);
    CHECK_FALSE(plant.observables().shoot_through);
    Legs both = Legs::gates(0, 1, 0, 1, 0, 1);
    both.high[static_cast<std::size_t>(leg)] = 0.1;
    plant.advance(both, 25);
    plant.advance(Legs::off(), 25);
    CHECK(plant.observables().shoot_through);
  }
}
