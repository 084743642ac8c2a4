// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/safety/safety.sv: all causes of fault, the latch that keeps them, and arming, which
// alone enables the gates. docs/blocks/safety.md
#pragma once

#include "feltgate/axis/clocked.hpp"
#include "feltgate/axis/encoder_errors.hpp"
#include "feltgate/axis/fault_latch.hpp"
#include "feltgate/axis/laws.hpp"
#include "feltgate/axis/self_test.hpp"
#include "feltgate/axis/signals.hpp"
#include "feltgate/axis/stop_latch.hpp"
#include "feltgate/axis/watchdog.hpp"
#include "feltgate/generated/causes.hpp"

namespace feltgate::axis {

struct Safety {
  using P = Words<std::int64_t>;
  struct In {
    const Tick& tick;
    Commands commands;
    const Position& position;
    const Bridge& bridge;
    const Pins& pins;
    bool word, engine;  ///< trips of the host's words and of a law
    std::int64_t velocity, tau_ref, current, voltage;
  };

  EncoderErrors errors;
  Clocked<Overspeed<Fixed>> overspeed;
  Clocked<MotorHeat<Fixed>> heat;
  std::int64_t heat_sum = 0;  ///< a reset does not clear it
  Polarity<Fixed>::State polarity;
  HoldTimer<Fixed> hold;
  SelfTest self_test;
  Watchdog watchdog;
  TickMonitor ticks;
  StopLatch stop;
  FaultLatch latch;
  Arming arming;
  bool after_scene = false, after_duty = false;  ///< the clock after tick.scene, tick.duty

  std::uint16_t trips(const Laws& laws, const P& p, const In& in) const {
    const bool open = arming.open();
    std::uint32_t t = 0;
    const auto trip = [&t](Fault cause, bool on) { t |= on ? fault_bit(cause) : 0U; };
    trip(Fault::encoder, errors.trip(in.position.illegal) || (open && in.position.why != 0));
    trip(Fault::speed, overspeed.at(0) && overspeed.state.too_fast);
    trip(Fault::polarity, after_scene && judged(laws, p, in).trip);
    trip(Fault::i2t, heat.at(laws.heat.summed) && heat_sum >= p.i2t_budget);
    trip(Fault::watchdog, after_duty && watchdog.trip(open));
    trip(Fault::stop, stop.trip(open) || in.commands.host_stop);
    trip(Fault::self_test, after_duty && self_test.failed());
    trip(Fault::channel, in.position.trip_channel);
    trip(Fault::tick, ticks.trip(in.bridge.period_start, laws.most_periods));
    trip(Fault::index, in.position.trip_index);
    trip(Fault::word, in.word || in.position.trip_flip);
    trip(Fault::jump, overspeed.at(0) && overspeed.state.jumped);
    trip(Fault::engine, in.engine && open);
    trip(Fault::axis, in.pins.axis_fault && open);
    trip(Fault::current, open && in.bridge.why != 0);
    return static_cast<std::uint16_t>(t);
  }
  /// The top bit of a sensor's reasons, no first reading yet, lets a request wait; every other
  /// refuses it.
  Arming::In request(const Laws& laws, const In& in) const {
    Arming::In a;
    a.host = in.commands.host;
    a.host_arm = in.commands.host_arm;
    a.panel_arm = in.pins.arm;
    a.disarm = in.commands.disarm;
    a.fault = latch.first != 0;
    a.stopped = stop.stopped();
    a.kick_missing = laws.require_watchdog && !watchdog.awake();
    a.wait = in.pins.axis_silent || starts(in);
    a.refuse = in.pins.axis_blocked || unfit(in);
    return a;
  }
  static bool starts(const In& in) {
    return ((in.position.why >> 5 | in.bridge.why >> 4) & 1) != 0;
  }
  static bool unfit(const In& in) {
    return (in.position.why & 0x1f) != 0 || (in.bridge.why & 0x6f) != 0;
  }

  /// What the registers say, whatever the inputs.
  [[gnu::always_inline]] Safe levels(const Laws& laws) const {
    Safe s;
    s.armed = arming.armed();
    s.gates_enable = arming.open();
    s.unkicked = laws.require_watchdog && !watchdog.awake();
    s.derated = hold.derated;
    s.testing = self_test.busy(s.armed);
    s.test_torque = pulse(laws);
    s.test_result = self_test.result();
    s.faults = latch.faults;
    s.first_fault = latch.first;
    s.current_estimate = heat.shown().current;
    return s;
  }
  Safe see(const Laws& laws, const In& in) const {
    const Arming::In a = request(laws, in);
    Safe s = levels(laws);
    s.locks = arming.locks(a, laws.wait_ticks);
    s.gates_clear = stop.gates_clear(in.pins.stop);
    s.clear = in.commands.clear_faults && !arming.request(a);
    s.arm_request = arming.counts(a) && !starts(in);
    s.ready = arming.ready(a) && !unfit(in);
    return s;
  }
  /// A pulse is beyond every limit.
  std::int64_t pulse(const Laws& laws) const {
    return self_test.pulse() > 0 ? laws.test_torque - 1 : self_test.pulse() * laws.test_torque;
  }

  void clock(const Laws& laws, const P& p, const In& in) {
    const std::uint16_t trips = this->trips(laws, p, in);
    const Arming::In a = request(laws, in);
    const bool open = arming.open(), armed = arming.armed();
    const bool arms = arming.locks(a, laws.wait_ticks) && trips == 0;
    const bool clear = in.commands.clear_faults && !arming.request(a);

    errors.clock(in.tick.last, in.position.illegal);
    overspeed.clock(in.tick.velocity,
                    [&] { return laws.overspeed.tick(overspeed.state, p, in.velocity); });
    if (heat.at(laws.heat.summed)) {
      laws.heat.heat(
          heat_sum, p, armed,
          in.bridge.measured ? laws.heat.measured(in.bridge.current) : heat.shown().current);
    }
    heat.clock(in.tick.sample, [&] { return laws.heat.tick(p, in.voltage, in.velocity); });
    if (after_scene) polarity = judged(laws, p, in).next;
    if (after_duty) hold.tick(p, armed, in.tick.count, in.tau_ref, in.position.moved);
    if (in.tick.duty) {
      self_test.start(p, armed, direct(in), in.pins.axis_waits, in.tick.count);
      watchdog.start(p);
    }
    if (in.tick.sample) self_test.sample(travel(laws, in));
    if (in.tick.last) watchdog.tick(open, arms, in.commands.kick);
    ticks.clock(in.tick.last, in.bridge.period_start, laws.most_periods);
    stop.clock(in.pins.stop, open, latch.first != 0);
    latch.clock(clear, trips);
    arming.clock(in.tick.last, a, trips != 0, laws.wait_ticks);
    after_scene = in.tick.scene;
    after_duty = in.tick.duty;
  }
  /// Whether a cause that Axis::tick() finds may trip in this tick: heat, speed, polarity,
  /// watchdog.
  bool near(const Laws& laws, const P& p, std::int64_t velocity) const {
    return heat_sum >= p.i2t_budget || Fixed::beyond(velocity, p.overspeed) ||
           laws.polarity.near(polarity, p) || watchdog.near(p);
  }
  /// The stop latch stays as it is, and does not trip.
  bool rests(bool stops) const {
    const bool open = arming.open();
    return stop.rests(stops, open, latch.first != 0) && !stop.trip(open);
  }
  /// The last clock of a tick without a trip and a command; whether arming stays as it is while
  /// the requests do.
  bool end_tick(const Laws& laws, const In& in) {
    const Arming before = arming;
    arming.clock(true, request(laws, in), false, laws.wait_ticks);
    end_tick(before.open());
    return arming == before;
  }
  void end_tick(bool open) {
    watchdog.tick(open, arming.armed(), false);
    errors.clock(true, false);
  }
  void reset(bool stops) {
    Safety fresh;
    fresh.heat_sum = heat_sum;
    fresh.stop = stop;
    *this = fresh;
    stop.reset();
    stop.clock(stops, false, false);  // the latch itself has no reset
    stop.reset();
  }

  Polarity<Fixed>::Judged judged(const Laws& laws, const P& p, const In& in) const {
    return laws.polarity.tick(polarity, p, arming.open(), in.velocity, in.current);
  }
  static bool direct(const In& in) { return in.commands.mode == Map::mode_voltage; }
  static unsigned travel(const Laws& laws, const In& in) {
    return in.position.travel >> laws.self_test_drop;
  }
};

}  // namespace feltgate::axis
