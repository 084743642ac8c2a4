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
#include <optional>
#include <vector>

#include "feltgate/axis/host.hpp"
#include "feltgate/axis/safety.hpp"
#include "feltgate/axis/tick_counter.hpp"

namespace feltgate::axis {

class Axis {
 public:
  using P = Words<std::int64_t>;
  struct In {
    const Position& position;
    const Bridge& bridge;
    const Pins& pins;
  };
  /// What the sockets take.
  struct ToSockets {
    Encoder encoder;
    Drive drive;
  };
  struct Out {
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
    std::int32_t position = 0;  ///< sampled, as the next
    std::int16_t travel = 0;
    bool testing = false;  ///< another axis runs its self-test, at the sample
    bool limit_hold = false;
    TravelWindow window;
    SpanMeter::State spans;  ///< of M/T, in place of the window
    Clocked<VelocityEstimator<Fixed>> velocity;
    Clocked<Observer<Fixed>> observer;
    Clocked<Scene<Fixed>> scene;
    Clocked<Ramp<Fixed>> ramp;
    Clocked<TorqueLaw<Fixed>> torque;
    Safety safety;
    Host host;
  };

  static constexpr Bits scene_position{18};
  /// The clocks of a tick in which velocity and tau_hat are new.
  static constexpr int velocity_clock =
      TickCounter::sample_clock + VelocityEstimator<Fixed>::latency;
  static constexpr int measured_clock = velocity_clock + Observer<Fixed>::latency;
  /// From a scene's torque to the duty.
  static constexpr int duty_after_scene = Ramp<Fixed>::latency + TorqueLaw<Fixed>::latency;

  explicit Axis(const Design& d)
      : laws_(std::make_shared<const Laws>(d)),
        formats_(std::make_shared<const WordFormats>(d)),
        line_(static_cast<std::size_t>(laws_->m1)),
        stamps_(laws_->spans.places),
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
    t.scene = q_.scene.valid(laws_->scene.latency(q_.host.scene) - laws_->scene.summed);
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
    o.zeroed = zeroed();
    o.word = q_.host.snapshot.word;
    o.reg_busy = q_.host.registers.busy();
    o.reg_rdata = q_.host.rdata;
    return o;
  }

  ToSockets clock(const In& in) {
    rests_ = false;
    const Laws& laws = *laws_;
    const P& p = params_.p;
    const Tick tick = this->tick();
    const Safety::In to_safety = this->to_safety(in, tick);
    const Safe safe = q_.safety.see(laws, to_safety);
    const Values values = q_.host.snapshot.goes() ? this->values(in, safe) : Values{};
    const int scene = q_.host.scene;
    const bool renders = safe.armed && !safe.testing && !q_.testing;
    const bool sums = q_.velocity.valid(laws.velocity.latency + laws.scene.summed);
    const ToSockets to{encoder(tick, safe), drive(tick, safe.gates_clear, safe.clear)};

    // The position at the beginning of a tick.
    if (tick.sample) sample(in, safe.derated);
    const auto travel = static_cast<std::int16_t>(in.position.travel);
    if (laws.spans.used) laws.spans.clock(q_.spans, stamps_.data(), travel, tick.sample);
    q_.velocity.clock(tick.sample, [&] {
      if (laws.spans.used) return laws.velocity.tick(q_.velocity.state, p, q_.spans);
      const std::int16_t counts = q_.window.counts(travel);
      q_.window.tick(line_.data(), laws.m1, travel);
      return laws.velocity.tick(q_.velocity.state, p, counts);
    });
    q_.observer.clock(tick.velocity, [&] {
      return laws.observer.tick(q_.observer.state, p, safe.armed, motor_current(in),
                                q_.velocity.state.velocity);
    });
    q_.scene.clock(sums, [&] {
      return laws.scene.tick(q_.scene.state, p, renders, scene,
                             Fixed::saturate(q_.position, scene_position),
                             q_.velocity.state.velocity, law(in));
    });
    q_.ramp.clock(tick.scene, [&] {
      return laws.ramp.tick(q_.ramp.state, p,
                            to_ramp(in, q_.scene.state.torque, renders, safe.testing));
    });
    if (tick.scene) q_.ramp.showing().limit_torque = q_.ramp.state.limit_torque;
    q_.torque.clock(tick.tau_ref, [&] {  // tau_hat is new a clock later at the latest
      return laws.torque.tick(q_.torque.state, p, safe.armed, control().mode(),
                              q_.ramp.state.tau_ref, q_.observer.state.tau_hat,
                              q_.velocity.state.velocity);
    });
    const bool restart = q_.host.registers.restart(tick.last, scene) ||
                         (tick.last && law_selected() && in.pins.law_restart);
    if (restart) q_.ramp.state.ramping = true;

    q_.safety.clock(laws, p, to_safety);
    q_.host.clock(params_, bank_, *formats_, tick, in.pins, safe, in.position, values);
    q_.ticks.clock(laws.clocks_per_tick);
    return to;
  }

  /// The clock of a tick in which the duty is new.
  int duty_clock() const {
    return velocity_clock + laws_->scene.latency(q_.host.scene) + duty_after_scene;
  }
  /// A tick begins that tick() may take: nothing is written, nothing trips in every clock, and all
  /// words of the snapshot are there before its end.
  [[gnu::always_inline]] bool ordinary(const In& in) const {
    const bool open = q_.safety.arming.open();
    return (rests_ ? in.pins.stop == stop_ : rests(in.pins.stop)) && !in.pins.reg_write &&
           !in.pins.set_zero && in.position.why == 0 && in.bridge.why == 0 &&
           !(open && (in.pins.axis_fault || (law_selected() && in.pins.law_late))) &&
           duty_clock() + Snapshot::words - Snapshot::early + 1 < laws_->clocks_per_tick;
  }
  /// A tick as a whole but for its end, its inputs as in the sample's clock; `v` is what the RTL
  /// shows at its end. If something trips in it, nothing is changed: false.
  [[gnu::always_inline]] bool tick(const In& in, Values& v) {
    const Laws& laws = *laws_;
    params_.load_scene(*formats_, q_.host.scene);
    const P& p = params_.p;
    const std::uint32_t count = q_.ticks.count;
    Safety& safety = q_.safety;
    const bool armed = safety.arming.armed(), open = safety.arming.open();
    const bool tests = safety.self_test.busy(armed), idle = safety.self_test.idle(armed);
    const int mode = control().mode();
    auto& torque = q_.torque.tick();

    // What can trip.
    const auto heat = laws.heat.tick(p, torque.voltage, q_.velocity.state.velocity);
    std::int64_t heat_sum = safety.heat_sum;
    const bool hot =
        laws.heat.heat(heat_sum, p, armed,
                       in.bridge.measured ? laws.heat.measured(in.bridge.current) : heat.current);
    const auto travel = static_cast<std::int16_t>(in.position.travel);
    std::optional<SpanMeter::State> spans;
    if (laws.spans.used) {
      spans = q_.spans;
      laws.spans.tick(*spans, stamps_.data(), travel, laws.clocks_per_tick);
    }
    const auto speed = spans ? laws.velocity.tick(q_.velocity.state, p, *spans)
                             : laws.velocity.tick(q_.velocity.state, p, q_.window.counts(travel));
    const auto fast = laws.overspeed.tick(safety.overspeed.state, p, speed.velocity);
    const auto polarity =
        laws.polarity.tick(safety.polarity, p, open, speed.velocity, torque.current);
    safety.watchdog.start(p);
    if (hot || fast.too_fast || fast.jumped || polarity.trip || safety.watchdog.trip(open)) {
      return false;
    }
    SelfTest self_test = safety.self_test;
    self_test.sample(in.position.travel >> laws.self_test_drop);
    if (idle) {
      self_test.rest(count);
    } else {
      self_test.start(p, armed, mode == Map::mode_voltage, in.pins.axis_waits, count);
      if (self_test.failed()) return false;
    }

    sample(in, safety.hold.derated);
    if (spans) {
      q_.spans = *spans;
    } else {
      q_.window.tick(line_.data(), laws.m1, travel);
    }
    q_.velocity.tick() = speed;
    safety.heat.tick() = heat;
    safety.heat_sum = heat_sum;
    safety.overspeed.tick() = fast;
    safety.polarity = polarity.next;
    auto& observer = q_.observer.tick();
    observer = laws.observer.tick(observer, p, armed, motor_current(in), speed.velocity);
    const bool renders = armed && !tests && !in.pins.axis_testing;
    auto& scene = q_.scene.tick();
    scene = laws.scene.tick(scene, p, renders, q_.host.scene,
                            Fixed::saturate(q_.position, scene_position), speed.velocity, law(in));
    auto& ramp = q_.ramp.tick();
    ramp = laws.ramp.tick(ramp, p, to_ramp(in, scene.torque, renders, tests));
    torque =
        laws.torque.tick(torque, p, armed, mode, ramp.tau_ref, observer.tau_hat, speed.velocity);
    safety.self_test = self_test;
    safety.hold.tick(p, armed, count, ramp.tau_ref, in.position.moved);
    v = values(in, safety.levels(laws));
    return true;
  }
  /// The end of this tick. `reads`: the host may read its values.
  [[gnu::always_inline]] void end_tick(const In& in, const Values& v, bool reads) {
    q_.host.tick(bank_, laws_->clocks_per_tick, in.pins, v, reads);
    if (law_selected() && in.pins.law_restart) q_.ramp.state.ramping = true;
    const unsigned requests = (in.pins.arm ? 1U : 0U) | (in.pins.axis_silent ? 2U : 0U) |
                              (in.pins.axis_blocked ? 4U : 0U);
    if (rests_ && steady_ && requests == requests_) {
      q_.safety.end_tick(q_.safety.arming.open());
    } else {
      steady_ = q_.safety.end_tick(*laws_, to_safety(in, Tick{}));
      requests_ = requests;
    }
    rests_ = true;
    stop_ = in.pins.stop;
    ++q_.ticks.count;
  }
  /// Back to the registers of the tick's beginning.
  void undo(const Blocks& begin) {
    q_ = begin;
    rests_ = false;
  }
  /// The gates may close before this tick ends, if the encoder rests. It may be true where nothing
  /// happens.
  bool may_trip(const In& in) const {
    const Laws& laws = *laws_;
    const P& p = params_.p;
    const auto travel = static_cast<std::int16_t>(in.position.travel);
    const std::int64_t raw =
        laws.spans.used ? q_.spans.size : laws.velocity.speed(q_.window.counts(travel));
    return !ordinary(in) || q_.safety.self_test.busy(q_.safety.arming.armed()) ||
           q_.safety.near(laws, p, q_.velocity.state.velocity) || Fixed::beyond(raw, p.overspeed);
  }

  /// A clock with the reset. What has none: the parameters, the motor's heat, the stop latch.
  void reset(const In& in) {
    rests_ = false;
    Blocks fresh;
    fresh.safety = q_.safety;
    fresh.host = q_.host;
    fresh.safety.reset(in.pins.stop);
    fresh.host.reset(params_, bank_, in.pins, laws_->control_reset);
    q_ = fresh;
  }

  const Laws& laws() const { return *laws_; }
  const P& words() const { return params_.p; }
  std::uint32_t parameter(int address) const { return params_.word(address); }
  /// Fault injection.
  void flip(int address, int bit) {
    q_.host.read_data(params_, bank_);  // what was read before
    params_.flip(address, bit);
    rests_ = false;
  }
  void flip_control(int bit) {
    q_.host.registers.flip(bit);
    rests_ = false;
  }

  /// The bridge's operands. The last two may change within a tick.
  Drive drive(const Tick& tick, bool gates_clear, bool clear) const {
    Drive d;
    d.gates_enable = q_.safety.arming.open();
    d.gates_clear = gates_clear;
    d.clear = clear;
    d.pwm_mode = control().pwm_mode();
    d.polarity = control().motor_polarity();
    d.direct = control().mode() == Map::mode_voltage;
    d.sample = tick.sample;
    d.valid = tick.duty;
    d.current = static_cast<std::int32_t>(q_.torque.shown().current);
    d.feed = static_cast<std::int32_t>(q_.torque.shown().feed);
    d.duty = static_cast<std::int16_t>(q_.torque.shown().duty);
    return d;
  }
  bool gates_clear(const In& in) const { return q_.safety.stop.gates_clear(in.pins.stop); }
  Encoder encoder(const Tick& tick, const Safe& safe) const {
    return {tick.sample, tick.count, control().filter(), control().encoder_polarity(),
            zeroed(),    safe.clear, safe.gates_enable};
  }
  /// The encoder's operands in a tick in which nothing is written.
  Encoder encoder() const {
    return {false, q_.ticks.count, control().filter(),     control().encoder_polarity(),
            false, false,          q_.safety.arming.open()};
  }
  /// The position becomes 0.
  bool zeroed() const { return q_.host.registers.set_zero(q_.ticks.last); }
  Safe safe(const In& in) const { return q_.safety.see(*laws_, to_safety(in, tick())); }
  /// A write or a command is carried out in this clock.
  bool writes() const { return q_.ticks.last && q_.host.registers.busy(); }
  /// A word of the snapshot, of the running tick or between two ticks of the last one.
  std::uint32_t word(int place) const {
    return q_.host.snapshot.at(bank_, q_.ticks.at == 0, place);
  }
  std::uint32_t read_data() { return q_.host.read_data(params_, bank_); }
  const Blocks& blocks() const { return q_; }
  int clock_of_tick() const { return q_.ticks.at; }
  Control control() const { return q_.host.registers.control; }

  /// All values of the tick as the outputs have them.
  [[gnu::always_inline]] Values values(const In& in, const Safe& safe) const {
    using L = Map::L;
    const auto& ramp = q_.ramp.shown();
    const auto& torque = q_.torque.shown();
    const auto bit = [](bool on, int place) { return (on ? 1U : 0U) << place; };
    Values v;
    v.tick = q_.ticks.count;
    v.position = q_.position;
    v.velocity = q_.velocity.shown().velocity;
    v.tau_hat = q_.observer.shown().tau_hat;
    v.tau_ref = ramp.tau_ref;
    v.current = torque.current;
    v.voltage = torque.voltage;
    v.duty = torque.duty;
    v.scene = q_.host.scene;
    v.index = in.position.index_position;
    v.encoder = std::uint32_t{in.position.rejected_count} << 16 | in.position.error_count;
    v.limits = bit(ramp.limit_torque, L::torque) | bit(ramp.limit_ramp, L::ramp) |
               bit(torque.limit_current, L::current) | bit(torque.limit_voltage, L::voltage) |
               bit(torque.limit_duty, L::duty) | bit(q_.velocity.shown().saturated, L::velocity) |
               bit(q_.observer.shown().saturated, L::tau_hat) |
               bit(!safe.gates_enable, L::gates_closed) | bit(q_.limit_hold, L::hold) |
               bit(in.position.chatters, L::chatter);
    q_.host.words(v, safe, in.position, in.bridge, safe.testing || q_.testing);
    return v;
  }

 private:
  /// A tick begins, and no block is in the middle of an operation.
  bool rests(bool stop) const {
    return q_.ticks.at == 0 && q_.ticks.count != 0 && params_.whole &&
           !q_.host.params.word_error() && q_.host.registers.rests(false, false) &&
           q_.host.snapshot.rests() && q_.safety.rests(stop);
  }
  Safety::In to_safety(const In& in, const Tick& tick) const {
    return {tick,
            q_.host.commands(tick.last),
            in.position,
            in.bridge,
            in.pins,
            q_.host.params.word_error() || q_.host.registers.error(),
            law_selected() && in.pins.law_late,
            q_.velocity.shown().velocity,
            q_.ramp.shown().tau_ref,
            q_.torque.shown().current,
            q_.torque.shown().voltage};
  }
  static Law<std::int64_t> law(const In& in) {
    return {in.pins.law_torque, in.pins.law_late, in.pins.law_restart};
  }
  bool law_selected() const {
    return q_.host.scene == Map::S::law && laws_->scene.has(Map::S::law);
  }
  std::int64_t motor_current(const In& in) const {  // of the tick before
    return in.bridge.measured ? in.bridge.current : q_.torque.shown().current;
  }
  [[gnu::always_inline]] Ramp<Fixed>::In to_ramp(const In& in, std::int64_t torque, bool armed,
                                                 bool testing) const {
    return {armed,
            q_.host.scene,
            in.position.chatters,
            q_.safety.hold.derated,
            testing,
            testing ? q_.safety.pulse(*laws_) : torque};
  }
  void sample(const In& in, bool derated) {
    q_.position = in.position.position;
    q_.travel = static_cast<std::int16_t>(in.position.travel);
    q_.testing = in.pins.axis_testing;
    q_.limit_hold = derated;
  }
  std::shared_ptr<const Laws> laws_;
  std::shared_ptr<const WordFormats> formats_;
  std::vector<std::int16_t> line_;     ///< of the travel's window
  std::vector<std::uint32_t> stamps_;  ///< of the edges, for M/T
  ParamsMemory params_;
  Snapshot::Memory bank_{};
  Blocks q_;
  // Since the last clock(): ticks as a whole with this level of the stop; and arming stays as it is
  // with these requests.
  bool rests_ = false, stop_ = false, steady_ = false;
  unsigned requests_ = 0;
};

}  // namespace feltgate::axis
