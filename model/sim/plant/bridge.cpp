// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The H-bridge between supply and motor. Documentation: docs/plant.md
#include "sim/plant/bridge.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace feltgate::plant {

Bridge Bridge::averaged(double duty, bool enabled) {
  Bridge bridge;
  bridge.mode = enabled ? Mode::kAveraged : Mode::kOff;
  bridge.duty = duty;
  return bridge;
}

Bridge Bridge::gates(double a_hi, double a_lo, double b_hi, double b_lo) {
  return {Mode::kSwitched, 0.0, a_hi, a_lo, b_hi, b_lo};
}

BridgeModel::BridgeModel(const Drive& drive, const SupplyParameters& supply,
                         const MotorParameters& motor, const Effects& effects)
    : diode_v_(supply.diode_drop_v),
      dead_time_(effects.dead_time && drive.dead_time_s > 0.0),
      hard_(!effects.inductance),
      dead_fraction_(drive.dead_time_s * drive.pwm_hz),
      least_(drive.shortest_s > 0 ? (drive.dead_time_s + drive.shortest_s) * drive.pwm_hz : 0),
      ripple_a_v_(0.5 / (motor.inductance_h * drive.pwm_hz)),
      antiphase_(drive.switching == Drive::Switching::kLockedAntiphase) {
  if (!(drive.clock_hz > 0.0) || !(drive.pwm_hz > 0.0) || !(drive.dead_time_s >= 0.0) ||
      !(dead_fraction_ < 0.5)) {
    throw std::invalid_argument("bridge: dead time must be shorter than half a PWM period");
  }
}

// Share of the bus that a leg loses when its current flows out of it: the high side is on for
// dead_fraction_ less than commanded, but not less than 0. A leg that does not switch loses
// nothing.
double BridgeModel::dead_share(double on_share, double against_share) const {
  if (on_share <= 0.0 || against_share <= 0.0) return 0.0;
  return std::min(dead_fraction_, on_share);
}

// The mean duty of a PWM that gives whole pulses only (docs/blocks/pwm.md).
double BridgeModel::whole_pulses(double duty) const {
  const double d = std::clamp(duty, -1.0, 1.0);
  if (!dead_time_ || least_ <= 0.0) return d;
  if (antiphase_) return 2.0 * std::clamp(0.5 * (1.0 + d), least_, 1.0 - least_) - 1.0;
  return std::clamp(d, least_ - 1.0, 1.0 - least_);
}

void BridgeModel::hold(double duty, double bus_v) {
  const double d = whole_pulses(duty);
  held_ = {};
  held_.duty = duty;
  held_.bus_v = bus_v;
  held_.d = d;
  if (!dead_time_) return;
  int legs = 1;
  if (antiphase_) {
    const double on = 0.5 * (1.0 + d);
    held_.positive = 2.0 * dead_share(on, 1.0 - on);
    held_.negative = 2.0 * dead_share(1.0 - on, on);
    legs = 2;
  } else {
    const double with = dead_share(std::abs(d), 1.0 - std::abs(d));
    const double against = dead_share(1.0 - std::abs(d), std::abs(d));
    held_.positive = d >= 0.0 ? with : against;
    held_.negative = d >= 0.0 ? against : with;
  }
  const bool switching = held_.positive > 0.0 || held_.negative > 0.0;
  held_.diode_v = switching ? 2.0 * legs * dead_fraction_ * diode_v_ : 0.0;
  if (hard_) return;
  const double on = antiphase_ ? 0.5 * (1.0 + std::abs(d)) : std::abs(d);
  const double swing = antiphase_ ? 2.0 * bus_v : bus_v;
  held_.half_ripple_a = ripple_a_v_ * swing * on * (1.0 - on);
  const auto per_edge = [&](double rise) {
    const double edge = 2.0 * ripple_a_v_ * swing * rise * dead_fraction_;
    return edge > 0.0 ? 1.0 / edge : 0.0;
  };
  held_.with_per_a = per_edge(1.0 - on);
  held_.against_per_a = per_edge(on);
}

BridgeVoltage BridgeModel::unaveraged(const Bridge& bridge) const {
  if (bridge.mode == Bridge::Mode::kOff) return {-1.0, 1.0, 2.0 * diode_v_};
  // In a leg with no gate on, the current's direction decides: it flows out through the low diode,
  // in through the high diode.
  const double a_off = std::max(0.0, 1.0 - bridge.a_hi - bridge.a_lo);
  const double b_off = std::max(0.0, 1.0 - bridge.b_hi - bridge.b_lo);
  return {bridge.a_hi - bridge.b_hi - b_off, bridge.a_hi + a_off - bridge.b_hi,
          (a_off + b_off) * diode_v_};
}

}  // namespace feltgate::plant
