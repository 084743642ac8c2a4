// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/h_bridge_current.sv, a bridge socket: two legs, with a loop of the measured
// current. CurrentControl and CurrentCheck are the twins of the files of their names.
// docs/blocks/current.md
#pragma once

#include "feltgate/axis/current_command.hpp"
#include "feltgate/axis/current_sensors.hpp"
#include "feltgate/axis/h_bridge.hpp"
#include "feltgate/current_check.hpp"
#include "feltgate/current_control.hpp"

namespace feltgate::axis {

class HBridgeCurrent {
 public:
  explicit HBridgeCurrent(const Design& d)
      : sensors_(d),
        command_(d),
        h_bridge_(d),
        proportional_(d["CURRENT_PROPORTIONAL"]),
        integral_(d["CURRENT_INTEGRAL"]),
        resistance_(d["CURRENT_RESISTANCE"]),
        margin_(d["CURRENT_MARGIN"]),
        period_(d["PWM_PERIOD"]) {}

  Bridge out() const {
    Bridge b = h_bridge_.out();
    b.measured = true;
    b.current = q_.current;
    b.why = sensors_.why();
    return b;
  }
  unsigned gates() const { return h_bridge_.gates(); }
  int on_time(std::size_t) const { return 0; }  ///< only of three legs
  bool modulator_clock() const { return sensors_.modulator_clock(); }

  void clock(const Pins& pins, const Drive& drive, const Words<std::int64_t>& p, const Rotor& r) {
    const bool measured = sensors_.valid(), controls = drive.gates_enable && !drive.direct;
    const std::int32_t at_shunt = sensors_.at_shunt(0);
    CurrentControl::In control;
    control.armed = controls;
    control.valid = measured;
    control.reference = command_.reference();
    control.current = drive.polarity ? -at_shunt : at_shunt;  // which makes tau_ref positive
    control.emf = command_.feed_forward();
    control.proportional = proportional_;
    control.integral = integral_;
    control.limit = command_.limit();
    const std::int64_t voltage = control_.out().voltage;
    const CurrentCheck::In check{
        controls, measured, control_.out().resistive, 0, control.current, resistance_, margin_};
    Drive bridge = drive;
    if (!drive.direct) bridge.duty = q_.duty;

    const bool period_start = h_bridge_.out().period_start;
    h_bridge_.clock(pins, bridge, p, r);
    sensors_.clock(pins, drive, period_start, check_.out().missing);
    if (drive.sample) q_.current = command_.amperes(q_.mean);
    if (measured) q_.mean = control.current;
    // The duty, rounded half up.
    q_.duty = static_cast<std::int16_t>((voltage * period_ + CurrentControl::kSupply / 2) >>
                                        kCurrentControlBits);
    command_.clock(drive, p);
    control_.clock(control);
    check_.clock(check);
  }
  void reset() {
    sensors_.reset();
    command_.reset();
    control_.reset();
    check_.reset();
    h_bridge_.reset();
    q_ = {};
  }

 private:
  struct Registers {
    std::int32_t mean = 0;     ///< of the last window, [1,1,17] of full scale
    std::int32_t current = 0;  ///< of the tick, A
    std::int16_t duty = 0;     ///< clocks
  };
  CurrentSensors<1> sensors_;
  CurrentCommand command_;
  CurrentControl control_;
  CurrentCheck check_;
  HBridge h_bridge_;
  std::int32_t proportional_, integral_, resistance_, margin_, period_;
  Registers q_;
};

}  // namespace feltgate::axis
