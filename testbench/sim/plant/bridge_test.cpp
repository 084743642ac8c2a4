// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// H-bridge, dead time, free-wheeling and supply. docs/plant.md
#include "catch.hpp"
#include "feltgate/largest.hpp"
#include "feltgate/pwm.hpp"
#include "plant_fixture.hpp"
#include "sim/plant/plant.hpp"
#include "sim/plant/sigma_delta.hpp"

using namespace feltgate;
using namespace feltgate::plant;

namespace {

// Gate signals of one leg, clock by clock: centre-aligned on-time, each turn-on `dead` clocks late.
class Leg {
 public:
  Leg(Clock period, Clock dead) : period_(period), dead_(dead) {}
  void clock(Clock now, double on_share, double& hi, double& lo) {
    const Clock on = std::llround(on_share * static_cast<double>(period_));
    const Clock at = now % period_;
    const Clock begin = (period_ - on) / 2;
    const bool want = at >= begin && at < begin + on;
    since_ = want == want_ ? since_ + 1 : 0;
    want_ = want;
    hi = want && since_ >= dead_ ? 1.0 : 0.0;
    lo = !want && since_ >= dead_ ? 1.0 : 0.0;
  }

 private:
  Clock period_;
  Clock dead_;
  Clock since_ = 1000000;
  bool want_ = false;
};

struct Means {
  double torque_nm;
  double supply_a;
};

// Locked rotor for 4 ms; means over the last PWM period.
Means switched(const Parameters& p, const Drive& drive, double duty) {
  const Clock period = std::llround(drive.clock_hz / drive.pwm_hz);
  const Clock dead = std::llround(drive.dead_time_s * drive.clock_hz);
  Plant plant(p, p.effects, drive, hand_of(HandPhase::Kind::kLocked));
  Leg a(period, dead);
  Leg b(period, dead);
  PeriodMean torque(period);
  PeriodMean supply(period);
  const bool antiphase = drive.switching == Drive::Switching::kLockedAntiphase;
  const double a_on = antiphase ? 0.5 * (1.0 + duty) : std::max(0.0, duty);
  const double b_on = antiphase ? 1.0 - a_on : std::max(0.0, -duty);
  while (plant.now() < period * 200) {
    Bridge bridge = Bridge::gates(0, 0, 0, 0);
    a.clock(plant.now(), a_on, bridge.a_hi, bridge.a_lo);
    // In antiphase leg B is the complement of leg A, not a second centred pulse.
    double hi = 0.0;
    double lo = 0.0;
    b.clock(plant.now(), antiphase ? a_on : b_on, hi, lo);
    bridge.b_hi = antiphase ? lo : hi;
    bridge.b_lo = antiphase ? hi : lo;
    plant.advance(bridge, 1);
    torque.add(1, plant.observables().motor_torque_mean_nm);
    supply.add(1, plant.observables().supply_current_a);
  }
  return {torque.mean(), supply.mean()};
}

Means averaged(const Parameters& p, const Drive& drive, double duty) {
  Plant plant(p, p.effects, drive, hand_of(HandPhase::Kind::kLocked));
  run(plant, Bridge::averaged(duty), 4e-3);
  return {plant.observables().motor_torque_mean_nm, plant.observables().supply_current_a};
}

}  // namespace

TEST_CASE("an averaged duty is the mean of the pulses that the PWM gives", "[bridge]") {
  constexpr int period = 1000, dead = 25, shortest = 10;
  Parameters p = shipped("p24");
  p.effects.inductance = false;  // without ripple, which would smooth the effect of the dead time
  Drive drive;
  drive.pwm_hz = drive.clock_hz / period;
  drive.shortest_s = shortest / drive.clock_hz;
  for (const bool antiphase : {false, true}) {
    drive.switching =
        antiphase ? Drive::Switching::kLockedAntiphase : Drive::Switching::kSignMagnitude;
    BridgeModel bridge(drive, p.supply, p.motor, p.effects);
    for (int duty = -period; duty <= period; duty += std::abs(duty) > 60 ? 20 : 2) {
      Pwm pwm(period, dead, shortest);
      Pwm::In in;
      in.enable = true;
      in.mode = antiphase;
      in.duty = static_cast<std::int16_t>(duty);  // an odd one is cut in antiphase
      // Pulses of 1 to 9 clocks repeat after 1 to 10 periods; the current flows from A to B, so A
      // is high while its high gate is on, B while its low one is off.
      constexpr int periods = 360;
      std::int64_t high = 0;
      for (int clock = -2 * period; clock < periods * period; ++clock) {
        pwm.clock(in);
        if (clock >= 0) high += pwm.out().gate_a_hi - !pwm.out().gate_b_lo;
      }
      const BridgeVoltage v =
          bridge.voltage(Bridge::averaged(static_cast<double>(duty) / period), 24, 1);
      CAPTURE(antiphase, duty);
      // One whole pulse may lie beyond the last period.
      CHECK(v.share_positive * period ==
            Approx(static_cast<double>(high) / periods).margin(2.0 * shortest / periods));
    }
  }
}

TEST_CASE("averaged and switched bridge agree", "[bridge]") {
  const Parameters p = shipped("p24");
  Parameters ideal = p;
  ideal.effects.dead_time = false;
  // The torque lost by the dead voltage. If ripple reverses the current within each period, it
  // dithers the brushes; the averaged mode does not model this.
  const double brushes_nm =
      p.motor.dead_voltage_v / p.motor.resistance_ohm * p.motor.torque_constant_nm_a;
  double worst_nm = 0.0;
  double without_nm = 0.0;
  for (const auto switching :
       {Drive::Switching::kSignMagnitude, Drive::Switching::kLockedAntiphase}) {
    const bool antiphase = switching == Drive::Switching::kLockedAntiphase;
    for (const double pwm_hz : {20e3, 50e3}) {
      Drive drive;
      drive.pwm_hz = pwm_hz;
      drive.switching = switching;
      for (const double duty : {-0.5, -0.2, -0.05, 0.0, 0.02, 0.1, 0.15, 0.25, 0.4, 0.6, 0.9}) {
        const Means fine = switched(p, drive, duty);
        const Means coarse = averaged(p, drive, duty);
        CAPTURE(pwm_hz, duty, antiphase, fine.torque_nm, coarse.torque_nm);
        const double error_nm = std::abs(fine.torque_nm - coarse.torque_nm);
        const double half_ripple_nm = p.motor.torque_constant_nm_a * p.supply.voltage_v *
                                      (1.0 - duty * duty) / (4.0 * p.motor.inductance_h * pwm_hz);
        CHECK(coarse.supply_a == Approx(fine.supply_a).margin(antiphase ? 0.12 : 0.03));
        if (antiphase && std::abs(fine.torque_nm) < half_ripple_nm) {
          CHECK(error_nm < brushes_nm);
          continue;
        }
        CHECK(error_nm < 1e-3);
        worst_nm = feltgate::larger(worst_nm, error_nm);
        without_nm =
            std::max(without_nm, std::abs(fine.torque_nm - averaged(ideal, drive, duty).torque_nm));
      }
    }
  }
  CAPTURE(worst_nm, without_nm);
  // Without the dead time in the model the error would be far larger.
  CHECK(without_nm > 0.08);
}

TEST_CASE("dead time takes t_dead*f per switching leg", "[bridge]") {
  const Parameters p = shipped("p24");
  Drive drive;
  drive.pwm_hz = 50e3;
  BridgeModel one(drive, p.supply, p.motor, p.effects);
  // At 10 A the current keeps its sign at all edges: the loss is 0.025 of the bus voltage, plus two
  // diode drops for this time.
  CHECK(one.voltage(Bridge::averaged(0.5), 24.0, 10.0).at_positive_v(24.0) ==
        Approx(12.0 - 0.6 - 0.035));
  CHECK(one.voltage(Bridge::averaged(0.5), 24.0, -10.0).at_negative_v(24.0) ==
        Approx(12.0 + 0.6 + 0.035));
  CHECK(one.voltage(Bridge::averaged(0.01), 24.0, 10.0).share_positive == 0.0);
  CHECK(one.voltage(Bridge::averaged(0.0), 24.0, 10.0).at_positive_v(24.0) == 0.0);
  drive.switching = Drive::Switching::kLockedAntiphase;
  BridgeModel both(drive, p.supply, p.motor, p.effects);
  CHECK(both.voltage(Bridge::averaged(0.5), 24.0, 10.0).at_positive_v(24.0) ==
        Approx(12.0 - 1.2 - 0.07));
  // Small currents change sign within every period: nothing is lost.
  CHECK(both.voltage(Bridge::averaged(0.0), 24.0, 0.5).at_positive_v(24.0) == 0.0);
  drive.dead_time_s = 11e-6;
  CHECK_THROWS_AS(BridgeModel(drive, p.supply, p.motor, p.effects), std::invalid_argument);
}

TEST_CASE("the current through zero is exact whatever the step", "[bridge]") {
  for (const double back_v : {-0.1, -2.0}) {  // the current stays at zero; the current continues
    Winding coarse(0.42, 82.3e-6);
    coarse.set_step(100e-6);
    Winding fine(0.42, 82.3e-6);
    fine.set_step(0.01e-6);
    const double dead_v = 0.34;
    const CurrentStep big = coarse.advance(0.5, back_v - dead_v, back_v + dead_v);
    double i = 0.5;
    double charge = 0.0;
    for (int k = 0; k < 10000; ++k) {
      const CurrentStep s = fine.advance(i, back_v - dead_v, back_v + dead_v);
      i = s.end_a;
      charge += s.mean_a * 0.01e-6;
    }
    CHECK(big.end_a == Approx(i).margin(1e-12));
    CHECK(big.mean_a * 100e-6 == Approx(charge).epsilon(1e-9));
    CHECK((big.end_a == 0.0) == (back_v == -0.1));
  }
}

TEST_CASE("supply limit: the bus gives way until the source delivers its limit", "[bridge]") {
  const Parameters p = shipped("p24");
  Effects effects = p.effects;
  effects.supply_limit = true;
  effects.dead_time = false;
  Plant plant(p, effects, Drive{}, hand_of(HandPhase::Kind::kLocked));
  run(plant, Bridge::averaged(1.0), 0.2);
  // Duty 1: motor current is supply current.
  CHECK(plant.observables().supply_current_a == Approx(7.0));
  CHECK(plant.observables().motor_current_a == Approx(7.0).epsilon(1e-4));
  CHECK(plant.observables().bus_v == Approx(7.0 * 0.42 + 0.34).epsilon(1e-4));
  // 0.5 Nm draw 16.6 A of the motor but 4.8 A of the supply: within the limit.
  Plant half(p, effects, Drive{}, hand_of(HandPhase::Kind::kLocked));
  run(half, volts(p, 0.42 * 0.5 / 0.0302 + 0.34), 0.05);
  CHECK(half.observables().motor_torque_nm == Approx(0.5).epsilon(1e-6));
  CHECK(half.observables().supply_current_a == Approx(5.04).epsilon(0.01));
  CHECK(half.observables().bus_v == 24.0);
  // Braking from speed returns current: the clamp holds the bus at its nominal voltage.
  Plant brake(p, effects, Drive{}, Hand{});
  run(brake, Bridge::averaged(0.5), 0.3);
  brake.advance(Bridge::off(), 25);
  run(brake, Bridge::averaged(0.1), 1e-3);
  CHECK(brake.observables().supply_current_a < 0.0);
  CHECK(brake.observables().bus_v == 24.0);
}

// The winding behind gates that switch clock by clock, beside closed forms, and the modulator at
// its shunt. docs/plant.md

namespace {

constexpr double kR = 0.42, kL = 82e-6, kTau = kL / kR, kV = 24, kClock = 20e-9;

/// The motor without brushes.
Parameters motor() {
  Parameters p = shipped("p24");
  p.motor.resistance_ohm = kR;
  p.motor.inductance_h = kL;
  p.effects = kNoEffects;
  p.effects.inductance = true;
  return p;
}

Plant locked(const Parameters& p) {
  Drive drive;
  drive.pwm_hz = 50e3;
  return Plant(p, p.effects, drive, hand_of(HandPhase::Kind::kLocked));
}

const Bridge kForward = Bridge::gates(1, 0, 0, 1);
const Bridge kOff = Bridge::gates(0, 0, 0, 0), kHalfOff = Bridge::gates(0, 0, 0, 1);

double current(const Plant& plant) { return plant.observables().motor_current_a; }

/// Until `current_a` flows, at full voltage.
void drive_to(Plant& plant, double current_a) {
  while (current(plant) < current_a) plant.advance(kForward, 1);
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
      REQUIRE(plant.observables().supply_current_a <= 0.0);
    }
    CHECK(charge == Approx(begin_a * kTau - against_a * zero_s).epsilon(1e-9));
  }
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
