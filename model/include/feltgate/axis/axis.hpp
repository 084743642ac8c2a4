// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/axis.sv, bit-exact and clock-exact: one axis, from the encoder's socket to the
// bridge's, once a tick in the order of the data:
//   position -> velocity_estimator -> observer -> tau_hat
//                      |                            |
//                      +------> scene -> ramp -> torque_law -> duty
// clock() is the definition. tick() takes an ordinary tick as a whole. docs/architecture.md
#pragma once

#include <memory>
#include <vector>

#include "feltgate/axis/host.hpp"
#include "feltgate/axis/safety.hpp"
#include "feltgate/axis/tick_counter.hpp"

namespace feltgate::axis {

class Axis {
 public:
  struct In {
    Position position;
    Bridge bridge;
    Panel panel;
    Law<std::int64_t> law;
    Peers peers;
    RegisterPort port;
  };
  struct Out {
    Encoder encoder;
    Drive drive;
    Tick tick;
    Values snapshot;
    Safe safety;
    SnapshotWord word;
    bool zeroed = false, reg_busy = false;
    std::uint32_t reg_rdata = 0;
  };

  /// All registers but those of the memories.
  struct Blocks {
    TickCounter ticks;
    std::int32_t position = 0;
    TravelWindow window;
    Clocked<VelocityEstimator<Fixed>> velocity;
    Clocked<Observer<Fixed>> observer;
    Clocked<Scene<Fixed>> scene;
    Clocked<Ramp<Fixed>> ramp;
    Clocked<TorqueLaw<Fixed>> torque;
    Safety safety;
    Host host;
  };

  explicit Axis(const Design& d)
      : laws_(std::make_shared<const Laws>(d)),
        formats_(std::make_shared<const WordFormats>(d)),
        line_(static_cast<std::size_t>(laws_->m1)),
        params_(d, *formats_) {
    q_.safety.heat_sum = laws_->heat.start;
    q_.host.registers.control.word = laws_->control_reset;
  }

  Tick tick() const {
    Tick t;
    t.clock = q_.ticks.at;
    t.sample = q_.ticks.sample;
    t.velocity = q_.velocity.valid(laws_->velocity.latency);
    t.tau_hat = q_.observer.valid(laws_->observer.latency);
    t.scene = q_.scene.valid(laws_->scene.latency(q_.host.scene));
    t.tau_ref = q_.ramp.valid(laws_->ramp.latency);
    t.duty = q_.torque.valid(laws_->torque.latency);
    t.last = q_.ticks.last;
    t.count = q_.ticks.count;
    return t;
  }
  /// The outputs, which follow from the registers and these inputs.
  Out out(const In& in) const {
    Out o;
    o.tick = tick();
    o.safety = q_.safety.see(*laws_, to_safety(in, o.tick));
    o.snapshot = values(in, o.safety);
    o.zeroed = q_.host.registers.set_zero(o.tick.last);
    o.encoder = encoder(o.tick, o.zeroed, o.safety.clear);
    o.drive = drive(o.safety.gates_clear, o.safety.clear);
    o.word = q_.host.snapshot.word;
    o.reg_busy = q_.host.registers.busy();
    o.reg_rdata = q_.host.rdata;
    return o;
  }

  void clock(const In& in) {
    const Laws& laws = *laws_;
    const Words<std::int64_t>& p = params_.p;
    const Tick tick = this->tick();
    const Safety::In to_safety = this->to_safety(in, tick);
    const Safe safe = q_.safety.see(laws, to_safety);
    const Values values = this->values(in, safe);
    const int scene = q_.host.scene;
    const bool testing = safe.testing || in.peers.testing;

    // The position at the beginning of a tick.
    if (tick.sample) {
      q_.position = in.position.position;
      q_.ramp.shown.limit_hold = safe.derated;
    }
    q_.velocity.clock(tick.sample, [&] {
      return laws.velocity.tick(
          q_.velocity.state, p,
          q_.window.tick(line_.data(), laws.m1, static_cast<std::int16_t>(in.position.travel)));
    });
    q_.observer.clock(tick.velocity, [&] {
      return laws.observer.tick(q_.observer.state, p, safe.armed, motor_current(in),
                                q_.velocity.shown.velocity);
    });
    q_.scene.clock(tick.velocity, [&] {
      return laws.scene.tick(q_.scene.state, p, safe.armed && !testing, scene,
                             Fixed::saturate(q_.position, 18), q_.velocity.shown.velocity, in.law);
    });
    q_.ramp.clock(tick.scene, [&] {
      return laws.ramp.tick(
          q_.ramp.state, p,
          to_ramp(in, q_.scene.state.torque, safe.armed && !testing, safe.testing));
    });
    if (tick.scene) q_.ramp.shown.limit_torque = q_.ramp.state.limit_torque;
    q_.torque.clock(tick.tau_ref, [&] {  // tau_hat is new a clock later at the latest
      return laws.torque.tick(q_.torque.state, p, safe.armed, control().mode(),
                              q_.ramp.state.tau_ref, q_.observer.state.tau_hat,
                              q_.velocity.shown.velocity);
    });
    const bool restart = q_.host.registers.restart(tick.last, scene) ||
                         (tick.last && law_selected() && in.law.restart);
    if (restart) q_.ramp.state.ramping = true;

    q_.safety.clock(laws, p, to_safety);
    q_.host.clock(params_, bank_, *formats_, tick, in.panel, in.port, safe, in.position, values);
    q_.ticks.clock(laws.clocks_per_tick);
  }

  /// The clock of a tick in which the duty is new.
  int duty_clock() const {
    return TickCounter::sample_clock + laws_->velocity.latency +
           laws_->scene.latency(q_.host.scene) + laws_->ramp.latency + laws_->torque.latency;
  }
  /// A tick begins that tick() may take: nothing is written, nothing trips in every clock, and all
  /// words of the snapshot are there before its end.
  bool ordinary(const In& in) const {
    const bool cause = in.peers.fault || (law_selected() && in.law.late) || in.position.why != 0 ||
                       in.bridge.why != 0;
    return q_.ticks.at == 0 && q_.ticks.count != 0 && !in.bridge.measured && params_.whole &&
           q_.host.registers.rests(in.port.write, in.panel.set_zero) && q_.host.snapshot.rests() &&
           q_.safety.rests(in.panel.stop, cause) &&
           duty_clock() + Snapshot::words - Snapshot::early + 1 < laws_->clocks_per_tick;
  }
  /// A tick as a whole, its inputs as in the sample's clock. All that it makes is a copy; if
  /// anything tripped in it, the copy is thrown away: false.
  bool tick(const In& in) {
    const Laws& laws = *laws_;
    const Words<std::int64_t>& p = params_.p;
    const std::uint32_t count = q_.ticks.count;
    const int number = q_.host.scene;
    const bool armed = q_.safety.arming.armed(), open = q_.safety.arming.open();
    const auto& last = q_.torque.state;
    params_.load_scene(*formats_, number);

    const auto heat = laws.heat.tick(p, last.voltage, q_.velocity.state.velocity);
    std::int64_t heat_sum = q_.safety.heat_sum;
    const bool hot = laws.heat.heat(heat_sum, p, armed, heat.current);
    TravelWindow window = q_.window;
    const auto travel = static_cast<std::int16_t>(in.position.travel);
    const auto speed =
        laws.velocity.tick(q_.velocity.state, p, window.tick(line_.data(), laws.m1, travel));
    const auto fast = laws.overspeed.tick(q_.safety.overspeed.state, p, speed.velocity);
    const auto observed =
        laws.observer.tick(q_.observer.state, p, armed, last.current, speed.velocity);

    const bool tests = q_.safety.self_test.busy(armed);
    const bool runs = armed && !tests && !in.peers.testing;
    const auto scene =
        laws.scene.tick(q_.scene.state, p, runs, number, Fixed::saturate(in.position.position, 18),
                        speed.velocity, in.law);
    const auto polarity =
        laws.polarity.tick(q_.safety.polarity, p, open, speed.velocity, last.current);
    auto ramp = laws.ramp.tick(q_.ramp.state, p, to_ramp(in, scene.torque, runs, tests));
    const auto torque = laws.torque.tick(last, p, armed, control().mode(), ramp.tau_ref,
                                         observed.tau_hat, speed.velocity);
    SelfTest self_test = q_.safety.self_test;
    self_test.sample(in.position.travel >> laws.self_test_drop);
    self_test.start(p, armed, control().mode() == Map::mode_voltage, in.peers.waits, count);
    q_.safety.watchdog.start(p);
    if (hot || fast.too_fast || fast.jumped || polarity.trip || self_test.failed() ||
        q_.safety.watchdog.trip(open)) {
      return false;
    }
    if (law_selected() && in.law.restart) ramp.ramping = true;

    q_.position = in.position.position;
    q_.window = window;
    q_.velocity.tick(speed);
    q_.observer.tick(observed);
    q_.scene.tick(scene);
    q_.ramp.tick(ramp);
    q_.torque.tick(torque);
    q_.safety.heat.tick(heat);
    q_.safety.heat_sum = heat_sum;
    q_.safety.overspeed.tick(fast);
    q_.safety.polarity = polarity.next;
    q_.safety.self_test = self_test;
    q_.safety.hold.tick(p, armed, count, ramp.tau_ref, in.position.moved);
    q_.host.params.tick(params_, laws.clocks_per_tick, number, in.port.addr);
    q_.host.tick(bank_, in.panel, in.port, values(in, q_.safety.levels(laws)));
    q_.safety.end_tick(laws, to_safety(in, Tick{}));
    ++q_.ticks.count;
    return true;
  }

  /// A clock with the reset. What has none: the parameters, the motor's heat, the stop latch.
  void reset(const In& in) {
    Blocks fresh;
    fresh.safety = q_.safety;
    fresh.host = q_.host;
    fresh.safety.reset(in.panel.stop);
    fresh.host.reset(params_, bank_, in.port, laws_->control_reset);
    q_ = fresh;
  }

  const Laws& laws() const { return *laws_; }
  const Words<std::int64_t>& p() const { return params_.p; }
  /// The bridge's operands, but for the stop pin.
  Drive drive(bool gates_clear, bool clear) const {
    const Tick tick = this->tick();
    return {q_.safety.arming.open(),
            gates_clear,
            clear,
            control().pwm_mode(),
            control().motor_polarity(),
            control().mode() == Map::mode_voltage,
            tick.sample,
            tick.duty,
            static_cast<std::int32_t>(q_.torque.shown.current),
            static_cast<std::int32_t>(q_.torque.state.feed),
            static_cast<std::int16_t>(q_.torque.shown.duty)};
  }
  bool gates_clear(const In& in) const { return q_.safety.stop.gates_clear(in.panel.stop); }
  Encoder encoder(const Tick& tick, bool set_zero, bool clear) const {
    return {tick.sample, tick.count, control().filter(),     control().encoder_polarity(),
            set_zero,    clear,      q_.safety.arming.open()};
  }
  int clock_of_tick() const { return q_.ticks.at; }
  Control control() const { return q_.host.registers.control; }

 private:
  Safety::In to_safety(const In& in, const Tick& tick) const {
    return {tick,
            q_.host.commands(tick.last, in.panel),
            in.position,
            in.bridge,
            in.peers,
            q_.host.params.word_error(),
            law_selected() && in.law.late,
            q_.velocity.shown.velocity,
            q_.ramp.shown.tau_ref,
            q_.torque.shown.current,
            q_.torque.shown.voltage};
  }
  bool law_selected() const {
    return q_.host.scene == Map::S::law && laws_->scene.has(Map::S::law);
  }
  std::int64_t motor_current(const In& in) const {  // of the tick before
    return in.bridge.measured ? in.bridge.current : q_.torque.shown.current;
  }
  Ramp<Fixed>::In to_ramp(const In& in, std::int64_t torque, bool armed, bool testing) const {
    return {armed,
            q_.host.scene,
            in.position.chatters,
            q_.safety.hold.derated,
            testing,
            testing ? q_.safety.pulse(*laws_) : torque};
  }
  Values values(const In& in, const Safe& safe) const {
    using L = Map::L;
    const auto& ramp = q_.ramp.shown;
    const auto& torque = q_.torque.shown;
    const auto bit = [](bool on, int place) { return (on ? 1U : 0U) << place; };
    Values v;
    v.tick = q_.ticks.count;
    v.position = q_.position;
    v.velocity = q_.velocity.shown.velocity;
    v.tau_hat = q_.observer.shown.tau_hat;
    v.tau_ref = ramp.tau_ref;
    v.current = torque.current;
    v.voltage = torque.voltage;
    v.duty = torque.duty;
    v.scene = q_.host.scene;
    v.index = in.position.index_position;
    v.encoder = std::uint32_t{in.position.rejected_count} << 16 | in.position.error_count;
    v.limits = bit(ramp.limit_torque, L::torque) | bit(ramp.limit_ramp, L::ramp) |
               bit(torque.limit_current, L::current) | bit(torque.limit_voltage, L::voltage) |
               bit(torque.limit_duty, L::duty) | bit(q_.velocity.shown.saturated, L::velocity) |
               bit(q_.observer.shown.saturated, L::tau_hat) |
               bit(!safe.gates_enable, L::gates_closed) | bit(ramp.limit_hold, L::hold) |
               bit(in.position.chatters, L::chatter);
    q_.host.words(v, safe, in.position, in.bridge, safe.testing || in.peers.testing);
    return v;
  }

  std::shared_ptr<const Laws> laws_;
  std::shared_ptr<const WordFormats> formats_;
  std::vector<std::int16_t> line_;  ///< of the travel's window
  ParamsMemory params_;
  Snapshot::Memory bank_{};
  Blocks q_;
};

}  // namespace feltgate::axis
