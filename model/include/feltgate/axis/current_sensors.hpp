// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/current_sensors.sv: the modulators of one motor, the fault line of its
// bridge's driver, and what is wrong with them. CurrentSense is the twin of current_sense.sv and
// overcurrent.sv. docs/blocks/current.md
#pragma once

#include "feltgate/axis/design.hpp"
#include "feltgate/axis/signals.hpp"
#include "feltgate/current_sense.hpp"

namespace feltgate::axis {

template <std::size_t sensors>
class CurrentSensors {
 public:
  explicit CurrentSensors(const Design& d)
      : strobe_(d["CURRENT_STROBE"]), threshold_(d["CURRENT_OVERCURRENT"]) {}

  /// [1,1,17] of full scale.
  std::int32_t at_shunt(std::size_t n) const {
    return static_cast<std::int32_t>(q_.sense[n].out().current);
  }
  /// One clock: at_shunt is of a period's window.
  bool valid() const { return q_.sense[0].out().aligned; }
  bool modulator_clock() const { return q_.sense[0].out().modulator_clock; }
  /// From the top bit: missing, driver, starts, offset, saturated, stuck, over-current.
  unsigned why() const {
    unsigned bits = unsigned{q_.missing} << 6 | unsigned{q_.driver2 || q_.driver_seen} << 5;
    for (const CurrentSense& sense : q_.sense) {
      const CurrentSense::Out& s = sense.out();
      bits |= unsigned{!s.calibrated} << 4 | unsigned{s.offset_fault} << 3 |
              unsigned{s.saturated} << 2 | unsigned{s.stuck} << 1 | unsigned{s.overcurrent};
    }
    return bits;
  }
  /// `missing`: the current does not follow the voltage.
  void clock(const Pins& pins, const Drive& drive, bool period_start, bool missing) {
    CurrentSense::In in;
    in.strobe = q_.since == strobe_;
    in.armed = drive.gates_enable;
    in.clear = drive.clear;
    in.threshold = threshold_;
    for (std::size_t n = 0; n < sensors; ++n) {
      in.data = (pins.current_data >> n & 1) != 0;
      q_.sense[n].clock(in);
    }
    q_.since = period_start ? 1 : (q_.since + 1) & 0xfff;
    // Kept until the faults are cleared; of the driver's only what comes with the gates enabled.
    q_.missing = missing || (q_.missing && !drive.clear);
    q_.driver_seen = (q_.driver2 && drive.gates_enable) || (q_.driver_seen && !drive.clear);
    q_.driver2 = q_.driver;
    q_.driver = pins.driver_fault;
  }
  void reset() { q_ = {}; }

 private:
  struct Registers {
    std::array<CurrentSense, sensors> sense;
    int since = 0;  ///< clocks since a period began
    bool driver = false, driver2 = false, driver_seen = false, missing = false;
  };
  int strobe_, threshold_;
  Registers q_;
};

}  // namespace feltgate::axis
