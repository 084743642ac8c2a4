// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/three_phase_current.sv, a bridge socket: three legs, with two measured phase
// currents that are controlled in the rotor's frame. FieldOriented is the twin of
// field_oriented.sv, cordic.sv, open_phase.sv, electrical_angle.sv and space_vector.sv.
// docs/blocks/three_phase.md
#pragma once

#include "feltgate/axis/current_command.hpp"
#include "feltgate/axis/current_sensors.hpp"
#include "feltgate/current_check.hpp"
#include "feltgate/field_oriented.hpp"
#include "feltgate/pwm_three_phase.hpp"

namespace feltgate::axis {

class ThreePhaseCurrent {
 public:
  explicit ThreePhaseCurrent(const Design& d)
      : period_(d["PWM_PERIOD"]),
        proportional_(static_cast<std::uint32_t>(d["CURRENT_PROPORTIONAL"])),
        integral_(static_cast<std::uint32_t>(d["CURRENT_INTEGRAL"])),
        resistance_(d["CURRENT_RESISTANCE"]),
        margin_(d["CURRENT_MARGIN"]),
        sensors_(d),
        command_(d),
        field_(period_),
        pwm_(period_, d["DEAD_CLOCKS"], d["SHORTEST_CLOCKS"]) {}

  Bridge out() const {
    return {true, pwm_.out().period_start, q_.active, q_.current, sensors_.why()};
  }
  unsigned gates() const { return pwm_.out().bits(); }
  int on_time(std::size_t leg) const { return pwm_.on_time(leg); }
  bool modulator_clock() const { return sensors_.modulator_clock(); }

  void clock(const Pins& pins, const Drive& drive, const Words<std::int64_t>& p,
             const Rotor& rotor) {
    const FieldOriented::Out now = field_.out();
    const bool sensed = sensors_.valid(), period_start = pwm_.out().period_start;
    FieldOriented::In in;
    in.armed = drive.gates_enable;
    in.valid = sensed;
    in.direct = drive.direct;
    in.reference = command_.reference();
    in.current_a = sensors_.at_shunt(0);
    in.current_b = sensors_.at_shunt(1);
    in.emf = drive.direct
                 ? static_cast<std::int32_t>(Fixed::saturate(command_.part(drive.duty), 18))
                 : command_.feed_forward();
    in.position = rotor.count;
    in.gain = static_cast<std::uint32_t>(p.commutation_gain);
    in.offset = static_cast<std::uint32_t>(p.commutation_offset) + rotor.angle;
    in.polarity = drive.polarity;
    in.proportional = proportional_;
    in.integral = integral_;
    in.limit = static_cast<std::uint32_t>(command_.limit());

    sensors_.clock(pins, drive, period_start, check_.out().missing || now.open);
    command_.clock(drive, p);
    field_.clock(in);
    check_.clock({drive.gates_enable && !drive.direct, sensed, now.resistive, now.across,
                  now.current_q, resistance_, margin_});
    if (drive.sample) q_.current = command_.amperes(q_.mean);
    if (now.valid) q_.mean = static_cast<std::int32_t>(Fixed::saturate(now.current_q, 19));
    // The duty in force is that of leg A, from half a period on.
    if (period_start) q_.active = static_cast<std::int16_t>(now.on_a - period_ / 2);
    if (!drive.gates_enable) q_.active = 0;
    pwm_.clock({drive.gates_clear, drive.gates_enable, now.on_a, now.on_b, now.on_c});
  }
  void reset() {
    sensors_.reset();
    command_.reset();
    field_.reset();
    check_.reset();
    pwm_.reset();
    q_ = {};
  }

 private:
  struct Registers {
    std::int32_t mean = 0;     ///< of the last window, [1,1,17] of full scale
    std::int32_t current = 0;  ///< of the tick, A
    std::int16_t active = 0;
  };
  int period_;
  std::uint32_t proportional_, integral_;
  std::int32_t resistance_, margin_;
  CurrentSensors<2> sensors_;
  CurrentCommand command_;
  FieldOriented field_;
  CurrentCheck check_;
  PwmThreePhase pwm_;
  Registers q_;
};

}  // namespace feltgate::axis
