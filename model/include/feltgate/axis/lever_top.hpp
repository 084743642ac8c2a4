// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/tops/lever_top.sv, the default chip: an incremental encoder and an H-bridge by the
// voltage law. docs/architecture.md
#pragma once

#include "feltgate/axis/axis.hpp"
#include "feltgate/axis/h_bridge.hpp"
#include "feltgate/axis/quadrature.hpp"

namespace feltgate::axis {

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

  /// Equals `clocks` calls of clock(); the pins take the levels of `events`, whose clocks count
  /// from here. One rule: a tick is taken as a whole, and if anything out of the ordinary happened
  /// in it, it is thrown away and goes clock by clock.
  void run(In& in, long clocks, const EncoderEvent* event = nullptr,
           const EncoderEvent* end = nullptr) {
    const int ticks = axis.laws().clocks_per_tick;
    for (long at = 0; at < clocks;) {
      if (clocks - at >= ticks && tick(in, at, event, end)) {
        at += ticks;
        ++whole;
        continue;
      }
      for (long n = std::min<long>(clocks - at, ticks - axis.clock_of_tick()); n > 0; --n, ++at) {
        for (; event != end && event->clock <= at; ++event) in.pins = event->pins;
        clock(in);
      }
    }
  }

  long whole = 0, thrown = 0;  ///< ticks taken as a whole, and thrown away

  Axis axis;
  Quadrature quadrature;
  HBridge h_bridge;

 private:
  /// A tick from `at` on, as a whole; false: nothing is changed.
  bool tick(In& in, long at, const EncoderEvent*& event, const EncoderEvent* end) {
    Axis::In to_axis{{}, h_bridge.out(), in.panel, in.law, in.peers, in.port};
    if (in.reset || !axis.ordinary(to_axis)) return false;
    const Quadrature encoder = quadrature;
    const EncoderEvent* const first = event;
    const EncoderPins pins = in.pins;
    const int clocks = axis.laws().clocks_per_tick, duty_clock = axis.duty_clock();
    const bool clear = axis.gates_clear(to_axis);
    const Drive before = axis.drive(clear);
    if (move(in.pins, at, clocks, event, end, to_axis.position) && axis.tick(to_axis)) {
      Drive drive = axis.drive(clear);
      drive.gates_enable = before.gates_enable;  // changes at the tick's end
      const bool samples = h_bridge.clocks_to_duty() < clocks;
      if (samples) h_bridge.run(before, duty_clock);
      h_bridge.run(drive, samples ? clocks - duty_clock : clocks);
      return true;
    }
    ++thrown;
    quadrature = encoder;
    in.pins = pins;
    event = first;
    return false;
  }
  /// The encoder's part of a tick; `sampled`: its position in the sample's clock.
  bool move(EncoderPins& pins, long at, int clocks, const EncoderEvent*& event,
            const EncoderEvent* end, Position& sampled) {
    const Encoder e = axis.encoder(axis.tick(), false, false);
    const bool still = (event == end || event->clock >= at + clocks) && quadrature.rests(pins, e);
    bool fine = true;
    for (int c = 0; c < clocks && fine; ++c) {
      if (c == TickCounter::sample_clock || still) {
        if (quadrature.sample(e.tick_count)) return false;
        sampled = quadrature.out();
      }
      if (still) break;
      for (; event != end && event->clock <= at + c; ++event) pins = event->pins;
      fine = quadrature.edge(pins, e);
    }
    return fine;
  }
  Axis::In to_axis(const In& in) const {
    return {quadrature.out(), h_bridge.out(), in.panel, in.law, in.peers, in.port};
  }
};

}  // namespace feltgate::axis
