// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/options/quadrature_hall.sv, an encoder socket: an incremental encoder with index, and
// three Hall lines of the motor. HallSensor is the twin of hall_sensor.sv.
// docs/blocks/three_phase.md
#pragma once

#include "feltgate/axis/quadrature.hpp"
#include "feltgate/hall_sensor.hpp"

namespace feltgate::axis {

class QuadratureHall {
 public:
  explicit QuadratureHall(const Design& d) : quadrature_(d) {}

  Position out() const {  // why: as of an absolute encoder jump, check, missing
    const HallSensor::Out& h = hall_.out();
    Position s = quadrature_.out();
    s.why = unsigned{h.waits} << 5 | (h.faults & 4U) << 1 | (h.faults & 3U);
    return s;
  }
  Rotor rotor() const { return {0, hall_.out().angle}; }
  unsigned lines() const { return quadrature_.lines(); }
  void clock(const Pins& pins, const Encoder& e, const Words<std::int64_t>& p) {
    hall_.clock({static_cast<std::uint8_t>(pins.hall),
                 static_cast<std::uint8_t>(quadrature_.out().count & 3),
                 static_cast<std::uint32_t>(p.commutation_gain), e.gates_enable, e.clear});
    quadrature_.clock(pins, e, p);
  }
  void reset() {
    quadrature_.reset();
    hall_.reset();
  }

 private:
  Quadrature quadrature_;
  HallSensor hall_;
};

}  // namespace feltgate::axis
