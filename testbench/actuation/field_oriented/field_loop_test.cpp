// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// field_oriented around the plant of the gimbal motor, whose torque the plant computes from its
// back-EMF's shape: steps, torque and ripple over a turn beside the voltage mode, and a phase that
// opens. Figures of docs/blocks/three_phase.md
#include <fmt/format.h>

#include <cmath>
#include <type_traits>

#include "../../sim/plant/three_phase_fixture.hpp"
#include "feltgate/commutation.hpp"
#include "feltgate/field_oriented.hpp"
#include "feltgate/largest.hpp"
#include "figures_record.hpp"

using namespace feltgate;
using namespace feltgate::plant;
using namespace feltgate::test;

namespace {

constexpr double kFullScaleA = 2, kBandwidthHz = 2000, kPeriodS = kPwmClocks / kClockHz;
constexpr int kCounts = 16384;  // of the encoder, per turn

/// The motor as the control knows it, and the plant, whose resistance may be another.
struct Rig {
  Parameters p = shipped("gimbal_motor");
  PhaseParameters known = *p.phases;
  PhaseParameters m = known;
  Rig() {
    p.effects.lugre = false;
    p.end_stops.reset();
  }
  double supply_v() const { return p.supply.voltage_v; }
  double full_v() const { return supply_v() / std::sqrt(3.0); }
  double nm_a() const { return 1.5 * known.back_emf_v_s_rad; }
  Drive drive() const { return drive_50khz(0.5e-6); }
  /// What the dead time takes on average, given back as in the voltage law, V.
  double lost_v(double torque_nm) const {
    const double sign = torque_nm > 0 ? 1 : torque_nm < 0 ? -1 : 0;
    return sign * 4 / M_PI * drive().dead_time_s * drive().pwm_hz *
           (supply_v() + 2 * p.supply.diode_drop_v);
  }
  int count(double theta_rad) const {
    return static_cast<int>(std::floor(theta_rad / kTwoPi * kCounts));
  }
};

std::int32_t word(double part) {
  return static_cast<std::int32_t>(std::lround(std::ldexp(part, kCurrentControlBits)));
}

Legs legs(int a, int b, int c) {
  constexpr double period = kPwmClocks;
  return Legs::averaged({a / period, b / period, c / period});
}

/// The block: currents of the begin of a period give the on-times of the next one.
class FieldLaw {
 public:
  explicit FieldLaw(const Rig& rig) : rig_(rig) {
    const PhaseParameters& k = rig.known;
    const CurrentGains gains = current_gains(k.resistance_ohm, k.inductance_h, kBandwidthHz,
                                             kPeriodS, kFullScaleA, rig.full_v());
    CHECK(gains.in_range);
    in_.armed = true;
    in_.proportional = static_cast<std::uint32_t>(gains.proportional);
    in_.integral = static_cast<std::uint32_t>(gains.integral);
    in_.limit = static_cast<std::uint32_t>(word(0.95));
    in_.gain = commutation_gain(k.pole_pairs, kCounts);
  }
  Legs operator()(const ThreePhasePlant& plant, double torque_nm) {
    const Observables& seen = plant.observables();
    in_.reference = word(torque_nm / rig_.nm_a() / kFullScaleA);
    in_.current_a = word(plant.motor().phase_a()[0] / kFullScaleA);
    in_.current_b = word(plant.motor().phase_a()[1] / kFullScaleA);
    const double emf_v = rig_.known.back_emf_v_s_rad * seen.omega_rad_s;
    in_.emf = word((emf_v + rig_.lost_v(torque_nm)) / rig_.full_v());
    in_.position = rig_.count(seen.theta_rad);
    for (int clock = 0; clock < FieldOriented::kBusyClocks; ++clock) {
      in_.valid = clock == 0;
      block.clock(in_);
    }
    return legs(block.out().on_a, block.out().on_b, block.out().on_c);
  }
  FieldOriented block{kPwmClocks};

 private:
  const Rig& rig_;
  FieldOriented::In in_;
};

/// The voltage mode of gimbal_motor.
class VoltageLaw {
 public:
  explicit VoltageLaw(const Rig& rig) : rig_(rig) {}
  Legs operator()(const ThreePhasePlant& plant, double torque_nm) {
    const Observables& seen = plant.observables();
    const double volts = rig_.known.resistance_ohm * torque_nm / rig_.nm_a() +
                         rig_.known.back_emf_v_s_rad * seen.omega_rad_s + rig_.lost_v(torque_nm);
    Commutation::In in;
    in.position = rig_.count(seen.theta_rad);
    in.gain = commutation_gain(rig_.known.pole_pairs, kCounts);
    in.amplitude = static_cast<std::int16_t>(std::lround(kPwmClocks * volts / rig_.full_v()));
    const auto on = Commutation(kPwmClocks).on_times(in);
    return legs(on[0], on[1], on[2]);
  }

 private:
  const Rig& rig_;
};

/// Advances by PWM periods; the law's legs act from the next period on.
template <class Law>
class Loop {
 public:
  Loop(const Rig& rig, const Hand& hand)
      : plant(rig.p, rig.m, rig.p.effects, rig.drive(), hand), law(rig) {}
  /// A period; the mean of the torque over it, Nm.
  double period(double torque_nm) {
    const Legs next = law(plant, torque_nm);
    double sum = 0;
    for (int quarter = 0; quarter < 4; ++quarter) {
      plant.advance(applied_, kPwmClocks / 4);
      sum += plant.observables().motor_torque_mean_nm / 4;
    }
    applied_ = next;
    return sum;
  }
  ThreePhasePlant plant;
  Law law;

 private:
  Legs applied_ = legs(kPwmClocks / 2, kPwmClocks / 2, kPwmClocks / 2);
};

struct Felt {
  double error, ripple;  // percent of what is asked for: of the mean, and peak to peak
};

/// Three electrical turns at this speed, after 20 ms. No phase is open, and the block says so.
template <class Law>
Felt turn(const Rig& rig, double torque_nm, double rad_s) {
  Loop<Law> loop(rig, turning(rad_s));
  const auto periods = static_cast<int>(3 * kTwoPi / 11 / std::fabs(rad_s) / kPeriodS);
  double sum = 0, low = 1e9, high = -1e9;
  for (int n = -1000; n < periods; ++n) {
    const double nm = loop.period(torque_nm);
    if (n < 0) continue;
    sum += nm, low = smaller(low, nm), high = larger(high, nm);
  }
  if constexpr (std::is_same_v<Law, FieldLaw>) CHECK_FALSE(loop.law.block.out().open);
  return {100 * (sum / periods / torque_nm - 1), 100 * (high - low) / std::fabs(torque_nm)};
}

struct Step {
  double settled_ms = 0, overshoot = 0;  // 2 %, part of the step
};
Step step(const Rig& rig, double torque_nm, double rad) {
  Loop<FieldLaw> loop(rig, held_at(rad));
  for (int n = 0; n < 20; ++n) loop.period(0);
  Step found;
  double nm = 0;
  for (int n = 0; n < 400; ++n) {
    nm = loop.period(torque_nm);
    if (std::fabs(nm - torque_nm) > 0.02 * torque_nm) found.settled_ms = 1e3 * kPeriodS * (n + 1);
    found.overshoot = larger(found.overshoot, nm / torque_nm - 1);
  }
  CHECK(std::fabs(nm / torque_nm - 1) < 0.002);
  return found;
}

Rig with_resistance(double part) {
  Rig rig;
  rig.m.resistance_ohm *= part;
  return rig;
}

Rig with_harmonics() {
  Rig rig;
  rig.m.harmonics = {{5, 0.06}, {7, 0.02}};
  return rig;
}

}  // namespace

TEST_CASE("field_oriented: steps and a turn of the gimbal motor") {
  std::string figures =
      "| step at stall | 5 mNm: 2 %, ms | overshoot | 15 mNm | | 30 mNm | |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const auto& [name, part] : {std::pair("R as the gains have it", 1.0),
                                   std::pair("R +20 %", 1.2), std::pair("R -20 %", 0.8)}) {
    const Rig rig = with_resistance(part);
    figures += fmt::format("| {} ", name);
    for (const double nm : {0.005, 0.015, 0.03}) {
      Step most;
      for (int n = 0; n < 7; ++n) {  // of a few angles, the slowest
        const Step one = step(rig, nm, 0.09 * n);
        most.settled_ms = larger(most.settled_ms, one.settled_ms);
        most.overshoot = larger(most.overshoot, one.overshoot);
      }
      if (part == 1) CHECK(most.settled_ms <= 0.5);
      CHECK(most.overshoot < 0.1);
      figures += fmt::format("| {:.2f} | {:.1f} % ", most.settled_ms, 100 * most.overshoot);
    }
    figures += "|\n";
  }
  figures +=
      "\n| over a turn, torque and speed | mean error, % | ripple p-p, % | voltage mode: error, % "
      "| "
      "ripple, % |\n|---|---|---|---|---|\n";
  const auto row = [&figures](const char* name, const Rig& rig, double nm, double rad_s) {
    const Felt here = turn<FieldLaw>(rig, nm, rad_s), volts = turn<VoltageLaw>(rig, nm, rad_s);
    figures +=
        fmt::format("| {}, {:.0f} mNm, {:.0f} rad/s | {:+.2f} | {:.2f} | {:+.1f} | {:.1f} |\n",
                    name, 1e3 * nm, rad_s, here.error, here.ripple, volts.error, volts.ripple);
    return here;
  };
  const Felt plain = row("as it is", Rig(), 0.03, kTwoPi);
  CHECK(std::fabs(plain.error) < 0.05);
  CHECK(plain.ripple < 0.5);
  CHECK(std::fabs(row("R +20 %", with_resistance(1.2), 0.03, kTwoPi).error) < 0.1);
  CHECK(std::fabs(row("R -20 %", with_resistance(0.8), 0.03, kTwoPi).error) < 0.1);
  CHECK(std::fabs(row("as it is", Rig(), -0.03, kTwoPi).error) < 0.1);
  row("as it is", Rig(), 0.03, -20);
  row("as it is", Rig(), 0.005, kTwoPi);
  row("as it is", Rig(), 0.005, 50);
  // Sines of the current meet the harmonics: 2 (6 + 2) % less the loop's own answer.
  row("5th 6 %, 7th 2 % in the back-EMF", with_harmonics(), 0.03, kTwoPi);
  check_figures("field_loop", figures);
}

TEST_CASE(
    "field_oriented: an open phase in motion is seen within a quarter of an electrical turn") {
  double most = 0;
  const Rig rig;
  for (const double rad_s : {2.0, -10.0, 40.0}) {
    Loop<FieldLaw> sound(rig, turning(rad_s));
    for (int n = 0; n < 24; ++n) {
      const double begin = (24 + n) * kTwoPi / 24 / 11;  // of the shaft
      while (std::fabs(sound.plant.observables().theta_rad) < begin) sound.period(0.03);
      REQUIRE_FALSE(sound.law.block.out().open);
      for (std::size_t phase = 0; phase < 3; ++phase) {
        Loop<FieldLaw> loop = sound;
        const double cut = loop.plant.observables().theta_rad;
        loop.plant.open_phase(phase);
        double electrical = 0;
        while (!loop.law.block.out().open && electrical < kTwoPi) {
          loop.period(0.03);
          electrical = 11 * std::fabs(loop.plant.observables().theta_rad - cut);
        }
        most = larger(most, electrical);
      }
    }
  }
  INFO("most " << most / kTwoPi << " of an electrical turn");
  CHECK(most <= kTwoPi / 4);
  CHECK(most > kTwoPi / 20);
}

TEST_CASE("field_oriented: no phase is open where the torque changes, reverses or cannot be had") {
  for (const double part : {0.8, 1.2}) {
    for (const double rad_s : {0.3, 9.0, -45.0, 70.0}) {
      const Rig rig = with_resistance(part);
      Loop<FieldLaw> loop(rig, turning(rad_s));
      for (int n = 0; n < 10'000; ++n) {
        // Steps of both signs and of none, a sine, and more than the supply gives.
        const double steps = std::sin(0.0137 * n * n * 1e-3) > 0.3 ? 0.045 : -0.02;
        loop.period(n % 2000 < 1000 ? steps : 0.06 * std::sin(0.01 * n));
        REQUIRE_FALSE(loop.law.block.out().open);
      }
    }
  }
}
