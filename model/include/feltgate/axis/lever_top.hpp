// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/tops/lever_top.sv, the default chip: an incremental encoder and an H-bridge by the
// voltage law. docs/architecture.md
#pragma once

#include "feltgate/axis/axis.hpp"
#include "feltgate/axis/h_bridge.hpp"
#include "feltgate/axis/quadrature.hpp"

namespace feltgate {

class LeverTop {
 public:
  struct In {
    bool reset = false;
    EncoderPins pins;
    Panel panel;
    Law<std::int64_t> law;
    Peers peers;
    RegisterPort port;
  };

  explicit LeverTop(const Design& d) : axis(d), quadrature(d), h_bridge(d) {}

  Axis::Out out(const In& in) const { return axis.out(to_axis(in)); }
  const Pwm::Out& gates() const { return h_bridge.gates(); }

  void clock(const In& in) {
    const Axis::In to_axis = this->to_axis(in);
    if (in.reset) {
      axis.reset(to_axis);
      quadrature.reset();
      h_bridge.reset();
      return;
    }
    const Axis::Out now = axis.out(to_axis);
    axis.clock(to_axis);
    quadrature.clock(in.pins, now.encoder);
    h_bridge.clock(now.drive);
  }

  Axis axis;
  Quadrature quadrature;
  HBridge h_bridge;

 private:
  Axis::In to_axis(const In& in) const {
    return {quadrature.out(), h_bridge.out(), in.panel, in.law, in.peers, in.port};
  }
};

}  // namespace feltgate
