// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/three_phase.sv, a bridge socket: three legs by the voltage law, whose
// voltages turn with the motor. PwmThreePhase is the twin of pwm_three_phase.sv.
// docs/blocks/three_phase.md
#pragma once

#include "feltgate/axis/commutation.hpp"
#include "feltgate/axis/signals.hpp"
#include "feltgate/axis/words.hpp"
#include "feltgate/pwm_three_phase.hpp"

namespace feltgate::axis {

class ThreePhase {
 public:
  static constexpr int lead = 85;  ///< clocks from the sample of angle and duty to the PWM's

  explicit ThreePhase(const Design& d)
      : period_(d["PWM_PERIOD"]),
        commutation_(period_),
        pwm_(period_, d["DEAD_CLOCKS"], d["SHORTEST_CLOCKS"]) {}

  Bridge out() const {
    Bridge b;
    b.period_start = pwm_.out().period_start;
    b.duty_active = q_.active;
    return b;
  }
  unsigned gates() const { return pwm_.out().bits(); }
  int on_time(std::size_t leg) const { return pwm_.on_time(leg); }
  bool modulator_clock() const { return false; }

  void clock(const Pins&, const Drive& drive, const Words<std::int64_t>& p, const Rotor& rotor) {
    const bool samples = q_.since == period_ - 1 - lead, takes = q_.since == period_ - 1;
    // The gates open with the first sample of an arming, so no on-times of the last one reach them.
    const bool opens = drive.gates_enable && q_.fresh;
    Commutation::In in;
    in.sample = samples;
    in.position = rotor.count;
    in.gain = static_cast<std::uint32_t>(p.commutation_gain);
    in.offset = static_cast<std::uint32_t>(p.commutation_offset) + rotor.angle;
    in.amplitude = drive.duty;
    in.polarity = drive.polarity;

    q_.since = pwm_.out().period_start ? 1 : (q_.since + 1) & 0xfff;
    q_.fresh = drive.gates_enable && (q_.fresh || samples);
    if (takes) q_.active = q_.amplitude;
    if (!opens) q_.active = 0;
    if (samples) q_.amplitude = drive.duty;
    const Commutation::Out& legs = commutation_.out();
    pwm_.clock({drive.gates_clear, opens, legs.on_a, legs.on_b, legs.on_c});
    commutation_.clock(in);
  }
  void reset() {
    commutation_.reset();
    pwm_.reset();
    q_ = {};
  }

 private:
  struct Registers {
    int since = 0;  ///< clocks since a period began
    bool fresh = false;
    std::int16_t amplitude = 0, active = 0;  ///< of the sample; in force
  };
  int period_;
  Commutation commutation_;
  PwmThreePhase pwm_;
  Registers q_;
};

}  // namespace feltgate::axis
