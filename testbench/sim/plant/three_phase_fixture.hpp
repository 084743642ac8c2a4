// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Shared by the tests of the motor with three phases: a gimbal motor, shafts, legs and gates.
// docs/plant.md#three-phases
#pragma once

#include <array>
#include <cmath>

#include "plant_fixture.hpp"
#include "sim/plant/three_phase.hpp"

namespace feltgate::plant {

inline constexpr double kThird = kTwoPi / 3;
inline constexpr int kPwmClocks = 1000;  // 50 kHz
inline constexpr double kBus = 5;        // V

/// A gimbal motor of the 5 V class. Assumed values of that class, not a product's.
inline PhaseParameters gimbal_motor() {
  PhaseParameters p;
  p.resistance_ohm = 10;
  p.inductance_h = 2e-3;
  p.pole_pairs = 11;
  p.back_emf_v_s_rad = 0.05;
  return p;
}

/// A lever on this bus, whose motor has inductance and back-EMF, and nothing else an effect.
inline Parameters shaft_on(double bus_v, double diode_v = 0) {
  Parameters p = shipped("linear");
  p.end_stops.reset();
  p.supply.voltage_v = bus_v;
  p.supply.diode_drop_v = diode_v;
  p.effects = kNoEffects;
  p.effects.inductance = p.effects.back_emf = true;
  return p;
}

inline Drive drive_50khz(double dead_time_s = 0.5e-6) {
  Drive drive;
  drive.pwm_hz = drive.clock_hz / kPwmClocks;
  drive.dead_time_s = dead_time_s;
  return drive;
}

inline Hand held_at(double rad) {
  Hand hand = hand_of(HandPhase::Kind::kLocked);
  hand.start_rad = rad;
  return hand;
}

inline Hand turning(double rad_s) {
  return moving({segment(Segment::Kind::kRamp, 1000, 1000 * rad_s)});
}

/// cos(angle), a third and two thirds of a turn behind it.
inline Phases cosines(double angle_rad) {
  return {std::cos(angle_rad), std::cos(angle_rad - kThird), std::cos(angle_rad - 2 * kThird)};
}

/// Averaged legs around half the bus with these voltages.
inline Legs volts(double bus_v, const Phases& v) {
  return Legs::averaged({0.5 + v[0] / bus_v, 0.5 + v[1] / bus_v, 0.5 + v[2] / bus_v});
}

inline Legs sinusoid(double bus_v, double amplitude_v, double angle_rad) {
  const Phases c = cosines(angle_rad);
  return volts(bus_v, {amplitude_v * c[0], amplitude_v * c[1], amplitude_v * c[2]});
}

/// Gates clock by clock: centred pulses of `on` clocks of the period, each turn-on `dead` late.
class CentredGates {
 public:
  explicit CentredGates(int dead) : dead_(dead) {}
  Legs clock(Clock now, const std::array<int, 3>& on) {
    Legs legs = Legs::gates(0, 0, 0, 0, 0, 0);
    const int at = static_cast<int>(now % kPwmClocks);
    for (std::size_t k = 0; k < 3; ++k) {
      const int begin = (kPwmClocks - on[k]) / 2;
      const bool want = at >= begin && at < begin + on[k];
      since_[k] = want == want_[k] ? since_[k] + 1 : 0;
      want_[k] = want;
      if (since_[k] >= dead_) (want ? legs.high : legs.low)[k] = 1;
    }
    return legs;
  }

 private:
  int dead_;
  std::array<int, 3> since_{1 << 20, 1 << 20, 1 << 20};
  std::array<bool, 3> want_{};
};

}  // namespace feltgate::plant
