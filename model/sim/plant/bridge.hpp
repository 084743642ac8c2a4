// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The H-bridge between supply and motor: from duty or gate signals to the voltage at the terminals,
// with free-wheeling diodes and dead time. Documentation: docs/plant.md
#pragma once

#include <algorithm>
#include <cmath>

#include "parameters.hpp"

namespace feltgate::plant {

/// State of the bridge during one step.
struct Bridge {
  enum class Mode {
    kOff,       ///< no gate on: diodes return the current to the supply
    kAveraged,  ///< mean over PWM periods, with the mean effect of dead time
    kSwitched,  ///< gate signals
  };
  Mode mode = Mode::kOff;
  double duty = 0.0;  ///< averaged: commanded duty in [-1, 1], before dead time
  /// Switched: share of the step for which each gate is on, in [0, 1]; a_hi + a_lo <= 1, the
  /// same for b.
  double a_hi = 0.0;
  double a_lo = 0.0;
  double b_hi = 0.0;
  double b_lo = 0.0;

  static Bridge off() { return {}; }
  /// `enabled` = false gives off() for any duty.
  static Bridge averaged(double duty, bool enabled = true);
  static Bridge gates(double a_hi, double a_lo, double b_hi, double b_lo);
};

/// Properties of the drive electronics that the averaged mode needs.
struct Drive {
  enum class Switching {
    kSignMagnitude,    ///< one leg switches, the other holds its low side on
    kLockedAntiphase,  ///< both legs switch against each other
  };
  double clock_hz = 50e6;
  double pwm_hz = 20e3;
  double dead_time_s = 0.5e-6;  ///< delays each gate's turn-on, not its turn-off
  double shortest_s = 0;        ///< shortest pulse that the PWM gives a gate; 0: no minimum
  Switching switching = Switching::kSignMagnitude;
};

/// Terminal voltage, which depends on the direction of the current i:
/// i > 0: share_positive*bus - diode_v; i < 0: share_negative*bus + diode_v. The supply delivers
/// the same share of the motor current.
struct BridgeVoltage {
  double share_positive = 0.0;
  double share_negative = 0.0;
  double diode_v = 0.0;
  double at_positive_v(double bus_v) const { return share_positive * bus_v - diode_v; }
  double at_negative_v(double bus_v) const { return share_negative * bus_v + diode_v; }
};

/// Computes the terminal voltage from the bridge's state.
class BridgeModel {
 public:
  /// Errors: std::invalid_argument if the dead time is half a PWM period or more.
  BridgeModel(const Drive& drive, const SupplyParameters& supply, const MotorParameters& motor,
              const Effects& effects);

  /// `current_a` at the start of the step decides how much of the dead time takes effect.
  BridgeVoltage voltage(const Bridge& bridge, double bus_v, double current_a) {
    if (bridge.mode != Bridge::Mode::kAveraged) return unaveraged(bridge);
    if (bridge.duty != held_.duty || bus_v != held_.bus_v) hold(bridge.duty, bus_v);
    if (!dead_time_) return {held_.d, held_.d, 0.0};
    const double share = felt(current_a);
    return {held_.d - share * held_.positive, held_.d + share * held_.negative,
            share * held_.diode_v};
  }

 private:
  /// Values that depend only on duty and bus; they stay for a PWM period.
  struct Held {
    double duty = 0.0, bus_v = -1.0;               ///< bus_v -1: nothing held yet
    double d = 0.0;                                ///< duty within [-1, 1]
    double positive = 0.0, negative = 0.0;         ///< shares lost for a current of that direction
    double diode_v = 0.0;                          ///< lost in the diodes during dead times
    double half_ripple_a = 0.0;                    ///< of the current
    double with_per_a = 0.0, against_per_a = 0.0;  ///< 1/(current change in one dead time)
  };

  double dead_share(double on_share, double against_share) const;
  double whole_pulses(double duty) const;
  void hold(double duty, double bus_v);
  BridgeVoltage unaveraged(const Bridge& bridge) const;
  // Share of the loss that takes effect. With valley and peak current of opposite sign, the current
  // already flows the right way at each edge and nothing is lost. From there to the full loss, the
  // current must grow by what one dead time changes.
  double felt(double current_a) const {
    const double per_a = held_.d * current_a >= 0.0 ? held_.with_per_a : held_.against_per_a;
    if (per_a <= 0.0) return 1.0;
    const double share = (std::abs(current_a) - held_.half_ripple_a) * per_a + 1.0;
    return std::min(std::max(share, 0.0), 1.0);
  }

  double diode_v_;
  bool dead_time_;
  bool hard_;             ///< no inductance, hence no ripple that softens the dead time
  double dead_fraction_;  ///< dead time over PWM period
  double least_;          ///< (dead time + shortest pulse) / PWM period; 0: no minimum
  double ripple_a_v_;     ///< half peak-to-peak ripple per volt of bus and unit of D*(1-D)
  bool antiphase_;
  Held held_;
};

}  // namespace feltgate::plant
