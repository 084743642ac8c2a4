// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/tops/*.sv: an axis between two sockets. tops.hpp has those of the shipped designs.
// clock() is the definition; run() takes ordinary ticks as a whole where both sockets can.
// docs/architecture.md
#pragma once

#include "feltgate/axis/axis.hpp"
#include "feltgate/axis/heartbeat.hpp"

namespace feltgate::axis {

template <class EncoderSocket, class BridgeSocket>
class Top {
 public:
  struct In {
    bool reset = false;
    Pins pins;
    Panel panel;
    Law<std::int64_t> law;
    Peers peers;
    RegisterPort port;
  };
  struct Out : Axis::Out {
    unsigned gates = 0;  ///< bit 0 leg A high, bit 1 leg A low, then B and C
    std::int16_t duty_active = 0;
    unsigned lines = 1;  ///< to an absolute encoder: bit 0 select, low active; 1 clock; 2 command
    bool modulator_clock = false, heartbeat = false;
  };

  explicit Top(const Design& d) : axis(d), encoder(d), bridge(d), heartbeat(d) {}

  Out out(const In& in) const {
    return {axis.out(to_axis(in)), bridge.gates(),           bridge.out().duty_active,
            encoder.lines(),       bridge.modulator_clock(), heartbeat.out()};
  }

  void clock(const In& in) {
    const Axis::In to_axis = this->to_axis(in);
    if (in.reset) {
      axis.reset(to_axis);
      encoder.reset();
      bridge.reset();
      heartbeat.reset();
      return;
    }
    const Axis::Out now = axis.out(to_axis);
    const Rotor rotor = encoder.rotor();
    encoder.clock(in.pins, now.encoder, axis.p());
    bridge.clock(in.pins, now.drive, axis.p(), rotor);
    heartbeat.clock(now.tick, now.safety.first_fault);
    axis.clock(to_axis);
  }

  /// Equals `clocks` calls of clock(); the encoder's pins take the levels of `events`, whose clocks
  /// count from here. One rule: a tick is taken as a whole, and if anything out of the ordinary
  /// happened in it, it is thrown away and goes clock by clock.
  void run(In& in, long clocks, const EncoderEvent* event = nullptr,
           const EncoderEvent* end = nullptr) {
    const int ticks = axis.laws().clocks_per_tick;
    for (long at = 0; at < clocks;) {
      if constexpr (EncoderSocket::whole_ticks && BridgeSocket::whole_ticks) {
        if (clocks - at >= ticks && tick(in, at, event, end)) {
          at += ticks;
          ++whole;
          continue;
        }
      }
      for (long n = std::min<long>(clocks - at, ticks - axis.clock_of_tick()); n > 0; --n, ++at) {
        for (; event != end && event->clock <= at; ++event) in.pins.encoder = event->pins;
        clock(in);
      }
    }
  }

  long whole = 0, thrown = 0;  ///< ticks taken as a whole, and thrown away

  Axis axis;
  EncoderSocket encoder;
  BridgeSocket bridge;
  Heartbeat heartbeat;

 private:
  /// A tick from `at` on, as a whole; false: nothing is changed.
  bool tick(In& in, long at, const EncoderEvent*& event, const EncoderEvent* end) {
    Axis::In to_axis{{}, bridge.out(), in.panel, in.law, in.peers, in.port};
    if (in.reset || !axis.ordinary(to_axis)) return false;
    const EncoderSocket encoder_before = encoder;
    const EncoderEvent* const first = event;
    const EncoderPins pins = in.pins.encoder;
    const int clocks = axis.laws().clocks_per_tick, duty_clock = axis.duty_clock();
    const bool clear = axis.gates_clear(to_axis);
    const Drive before = axis.drive(clear, false);
    if (move(in.pins, at, clocks, event, end, to_axis.position) && axis.tick(to_axis)) {
      Drive drive = axis.drive(clear, false);
      drive.gates_enable = before.gates_enable;  // changes at the tick's end
      const bool samples = bridge.clocks_to_duty() < clocks;
      if (samples) bridge.run(before, duty_clock);
      bridge.run(drive, samples ? clocks - duty_clock : clocks);
      return true;
    }
    ++thrown;
    encoder = encoder_before;
    in.pins.encoder = pins;
    event = first;
    return false;
  }
  /// The encoder's part of a tick; `sampled`: its position in the sample's clock.
  bool move(Pins& pins, long at, int clocks, const EncoderEvent*& event, const EncoderEvent* end,
            Position& sampled) {
    const Encoder e = axis.encoder(axis.tick(), false, false);
    const bool still = (event == end || event->clock >= at + clocks) && encoder.rests(pins, e);
    bool fine = true;
    for (int c = 0; c < clocks && fine; ++c) {
      if (c == TickCounter::sample_clock || still) {
        if (encoder.sample(e.tick_count)) return false;
        sampled = encoder.out();
      }
      if (still) break;
      for (; event != end && event->clock <= at + c; ++event) pins.encoder = event->pins;
      fine = encoder.edge(pins, e);
    }
    return fine;
  }
  Axis::In to_axis(const In& in) const {
    return {encoder.out(), bridge.out(), in.panel, in.law, in.peers, in.port};
  }
};

}  // namespace feltgate::axis
