// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The chip of a design with one axis, bit-exact and clock-exact: the axis between the sockets of
// its encoder and its bridge, as in rtl/tops. clock() is one clock; run() takes a tick as a whole
// where nothing out of the ordinary happens in it, with identical results. docs/architecture.md
#pragma once

#include <cstdint>
#include <type_traits>
#include <variant>

#include "feltgate/axis/absolute.hpp"
#include "feltgate/axis/axis.hpp"
#include "feltgate/axis/h_bridge_current.hpp"
#include "feltgate/axis/heartbeat.hpp"
#include "feltgate/axis/quadrature_hall.hpp"
#include "feltgate/axis/three_phase.hpp"
#include "feltgate/axis/three_phase_current.hpp"
#include "feltgate/callback.hpp"
#include "feltgate/core_ports.hpp"

namespace feltgate {

/// The result of the self-test, as in the status word.
enum class SelfTestResult : std::uint8_t {
  none = 0,
  right = Map::self_test_right,
  held = Map::self_test_held,
  moving = Map::self_test_moving
};

/// The design of a generated header, as data.
template <class D>
const axis::Design& design_of() {
  static const axis::Design design = axis::Design::of<D>();
  return design;
}

class FeltgateCore {
 public:
  using In = CoreIn;
  using Out = CoreOut;
  using Tell = Callback<>;

  /// The clocks of a tick in which the position is sampled, velocity and tau_hat are new, and the
  /// duty of a program's torque.
  static constexpr int sample_clock = axis::TickCounter::sample_clock;
  static constexpr int velocity_clock = axis::Axis::velocity_clock;
  static constexpr int measured_clock = axis::Axis::measured_clock;
  static constexpr int law_duty_clock =
      velocity_clock + axis::Scene<axis::Fixed>::usual_latency + axis::Axis::duty_after_scene;

  /// `reads`: a host reads; without it every read gives 0, and no words are told.
  explicit FeltgateCore(const axis::Design& d, bool reads = true);

  /// A clock with the reset. The parameter RAM keeps its words, as in the RTL.
  void reset(const CoreIn& in = {});

  /// Advances one clock with these inputs.
  void clock(const CoreIn& in);

  /// Advances `clocks` clocks with the inputs held; reg_write and set_zero must be low. Equals so
  /// many calls of clock(). `on_snapshot()` is called whenever out() holds a valid snapshot.
  void run(const CoreIn& in, std::int64_t clocks, Tell on_snapshot) {
    go(in, clocks, on_snapshot, false);
    settle();
  }
  /// As run(), but amid a tick out() shows of this tick only the snapshot, what bridge and encoder
  /// show, and position, velocity and tau_hat; settle() shows the rest. A caller that needs no more
  /// goes on in short steps at little cost.
  void advance(const CoreIn& in, std::int64_t clocks, Tell on_snapshot) {
    go(in, clocks, on_snapshot, true);
    if (whole_.on && whole_.sampled) show_measured();
  }
  /// Makes out() equal to that of so many calls of clock().
  void settle();

  /// Whether something could close the gates before the tick ends, with the inputs held. May return
  /// true when false would hold.
  bool may_trip(const CoreIn& in) const;

  /// Fault injection: inverts a bit of a word of the parameter RAM, or from bit 32 on of its check;
  /// between two ticks.
  void flip(int address, int bit);
  /// Fault injection: inverts a bit of the control word.
  void flip_control(int bit) { axis_.flip_control(bit); }

  const CoreOut& out() const { return out_; }
  /// A word of the running tick's snapshot by its slot; all are there when on_snapshot() is called.
  /// Between two ticks of the last one's.
  std::uint32_t word(int slot) const;
  /// Clocks since reset for which each gate was on: a_hi, a_lo, b_hi, b_lo, c_hi, c_lo.
  GateCounts gate_clocks() const { return plain_ ? h_bridge().gate_clocks() : gate_clocks_; }
  /// Of three phases: clocks of this PWM period in which leg 0, 1 or 2 is to be high; else 0.
  int on_time(std::size_t leg) const;
  /// Free-running count at the start of the tick.
  std::int16_t sampled_travel() const { return axis_.blocks().travel; }
  SelfTestResult self_test_result() const {
    return static_cast<SelfTestResult>(axis_.blocks().safety.self_test.result());
  }
  bool testing() const {
    if (whole_.on && whole_.at <= axis_.duty_clock()) return whole_.testing;
    return axis_.blocks().safety.self_test.busy(out_.armed);
  }
  /// For the other axes: whether this axis asks to be armed in the next clock, and whether nothing
  /// refuses its request.
  bool arm_request(const CoreIn& in) const { return safe(in).arm_request; }
  bool ready() const { return safe(CoreIn{}).ready; }
  /// Whether the next clock samples the position and a program's torque, or is the last of its
  /// tick.
  bool samples() const { return clock_of_tick() == sample_clock; }
  bool last() const { return clock_of_tick() == clocks_per_tick_ - 1; }
  /// Whether in the next clock position, velocity and tau_hat are those of this tick.
  bool measured() const { return whole_.on ? whole_.at == measured_clock : axis_.tick().tau_hat; }
  /// Whether the position becomes 0 in the next clock.
  bool zeroed() const { return axis_.zeroed(); }
  /// Whether no write or command waits for the end of the tick.
  bool at_rest() const { return axis_.blocks().host.registers.rests(false, false); }
  /// Register writes carried out so far.
  std::int64_t writes() const { return writes_; }
  /// The clock of a tick in which the duty is new, in the scene of this tick.
  int duty_clock() const { return axis_.duty_clock(); }
  /// The next clock's number in its tick, 0 .. clocks_per_tick - 1.
  int clock_of_tick() const { return whole_.on ? whole_.at : axis_.clock_of_tick(); }

  const axis::Axis& axis() const { return axis_; }
  /// For comparisons: every output of the axis with these inputs.
  axis::Axis::Out axis_out(const CoreIn& in) const;
  int clocks_per_tick() const { return clocks_per_tick_; }
  /// Ticks that were taken as a whole, and those that began so and went on clock by clock.
  std::int64_t whole_ticks() const { return whole_ticks_; }
  std::int64_t settled_ticks() const { return settled_ticks_; }

 private:
  using EncoderSocket = std::variant<axis::Quadrature, axis::QuadratureHall, axis::Absolute>;
  using BridgeSocket =
      std::variant<axis::HBridge, axis::HBridgeCurrent, axis::ThreePhase, axis::ThreePhaseCurrent>;

  template <class Encoder, class Bridge>
  static constexpr bool is_plain =
      std::is_same_v<Encoder, axis::Quadrature>&& std::is_same_v<Bridge, axis::HBridge>;

  /// A tick as a whole: the sockets are at clock `at`; the axis is at its beginning until the
  /// sample, and from then on at its end.
  struct Whole {
    bool on = false, sampled = false, testing = false;
    int at = 0;
    CoreIn pins;
    axis::Encoder encoder;  ///< the sockets' operands
    axis::Drive drive;
    axis::Position before, after;  ///< as sampled, and in the clocks after the sample
    axis::Bridge bridge;           ///< as sampled
    axis::Values values;
    axis::Axis::Blocks begin;  ///< the axis at the beginning, if the tick may not end so
  };

  static EncoderSocket encoder_of(const axis::Design& d) {
    if (d["ABSOLUTE_ENCODER"] != 0) return axis::Absolute(d);
    if (d["HALL"] != 0) return axis::QuadratureHall(d);
    return axis::Quadrature(d);
  }
  static BridgeSocket bridge_of(const axis::Design& d) {
    const bool loop = d["CURRENT_LOOP"] != 0;
    if (d["PHASES"] == 3) {
      return loop ? BridgeSocket(axis::ThreePhaseCurrent(d)) : BridgeSocket(axis::ThreePhase(d));
    }
    return loop ? BridgeSocket(axis::HBridgeCurrent(d)) : BridgeSocket(axis::HBridge(d));
  }
  // Of a core with these two.
  axis::Quadrature& quadrature() { return *std::get_if<axis::Quadrature>(&encoder_); }
  const axis::Quadrature& quadrature() const { return *std::get_if<axis::Quadrature>(&encoder_); }
  axis::HBridge& h_bridge() { return *std::get_if<axis::HBridge>(&bridge_); }
  const axis::HBridge& h_bridge() const { return *std::get_if<axis::HBridge>(&bridge_); }

  template <class F>
  void sockets(F&& f) {
    if (plain_) return f(quadrature(), h_bridge());
    std::visit(f, encoder_, bridge_);
  }
  template <class Result, class F>
  Result at_axis(const CoreIn& in, F&& f) const {
    return std::visit(
        [&](const auto& encoder, const auto& bridge) -> Result {
          return f(axis::Axis::In{encoder.out(), bridge.out(), in});
        },
        encoder_, bridge_);
  }
  axis::Safe safe(const CoreIn& in) const;

  template <class Encoder, class Bridge>
  void clock(const CoreIn& in, Encoder& encoder, Bridge& bridge) {
    constexpr bool plain = is_plain<Encoder, Bridge>;
    using Words = axis::Words<std::int64_t>;  // as before this clock
    const std::conditional_t<plain, const Words&, Words> p = axis_.words();
    writes_ += axis_.writes();
    if (beats_) {
      heartbeat_.clock(axis_.tick(), axis_.blocks().safety.latch.first);
      out_.heartbeat = heartbeat_.out();
    }
    const axis::Axis::ToSockets to = axis_.clock({encoder.out(), bridge.out(), in});
    const axis::Rotor rotor = encoder.rotor();
    encoder.clock(in, to.encoder, p);
    bridge.clock(in, to.drive, p, rotor);
    if constexpr (!plain) count_gates(bridge);
    show(in, encoder, bridge);
  }
  template <class Bridge>
  void count_gates(const Bridge& bridge) {
    for (std::size_t g = 0; g < gate_clocks_.size(); ++g)
      gate_clocks_[g] += bridge.gates() >> g & 1;
  }

  // A tick as a whole. Nothing is written in it, nothing trips, and no input changes but those of
  // the sockets; if one of these comes amid it, settle() makes up the clocks so far one by one.

  /// `amid`: a tick may be left amid it.
  void go(const CoreIn& in, std::int64_t clocks, Tell on_snapshot, bool amid);
  template <class Encoder, class Bridge>
  bool begin(const CoreIn& in, Encoder& encoder, Bridge& bridge) {
    const axis::Position& position = encoder.out();
    const axis::Axis::In to_axis{position, bridge.out(), in};
    if (axis_.clock_of_tick() != 0 || !axis_.ordinary(to_axis)) return false;
    if (axis_.laws().spans.used && !calm(encoder, in)) return false;
    whole_.testing = testing();
    whole_.on = true;
    whole_.sampled = false;
    whole_.at = 0;
    whole_.pins = in;
    whole_.encoder = axis_.encoder();
    whole_.drive = axis_.drive({}, axis_.gates_clear(to_axis), false);
    whole_.before = position;
    return true;
  }
  /// M/T counts the clocks from edge to edge.
  bool calm(const axis::Quadrature& encoder, const CoreIn& in) const {
    return encoder.calm(in, axis_.encoder());
  }
  template <class Encoder>
  bool calm(const Encoder&, const CoreIn&) const {
    return false;
  }
  /// Whether the axis's inputs are as at the tick's beginning; a program's are sampled.
  bool held(const CoreIn& in) const {
    const CoreIn& b = whole_.pins;
    const bool program = in.law_torque == b.law_torque && in.axis_waits == b.axis_waits;
    return in.arm == b.arm && in.stop == b.stop && in.scene == b.scene &&
           in.reg_addr == b.reg_addr && !in.reg_write && !in.set_zero &&
           in.law_late == b.law_late && in.law_restart == b.law_restart &&
           in.axis_fault == b.axis_fault && in.axis_silent == b.axis_silent &&
           in.axis_blocked == b.axis_blocked && in.axis_testing == b.axis_testing &&
           (program || !whole_.sampled) && (in.encoder == b.encoder || !axis_.laws().spans.used);
  }
  /// At most to the sample, to the duty or to the tick's end; returns the clocks passed.
  template <class Encoder, class Bridge>
  int pass(const CoreIn& in, std::int64_t clocks, Tell on_snapshot, Encoder& encoder,
           Bridge& bridge) {
    constexpr int sample = axis::TickCounter::sample_clock;
    Whole& w = whole_;
    const int from = w.at, duty = axis_.duty_clock();
    const int to = from < sample    ? sample
                   : from == sample ? sample + 1
                   : from < duty    ? duty
                                    : clocks_per_tick_;
    const auto goal = static_cast<int>(std::min<std::int64_t>(to, from + clocks));
    if (from == sample) {
      w.pins = in;
      w.before = encoder.out();
      w.bridge = bridge.out();
    }
    bool ordinary = pass_sockets(in, goal, encoder, bridge);
    if (ordinary && from == sample) {
      const bool ends = clocks >= clocks_per_tick_ - from && is_still(encoder, in);
      ordinary = take(!ends, encoder, bridge);
    }
    if (!ordinary) {
      const int passed = w.at - from;
      settle(encoder, bridge);
      if (out_.snapshot_valid && passed > 0) on_snapshot();
      return passed;
    }
    if (w.at == duty && from < duty) tell(on_snapshot);
    if (w.at == clocks_per_tick_) end(clocks < clocks_per_tick_ + w.at - from, encoder, bridge);
    return goal - from;
  }
  template <class Encoder, class Bridge>
  int step(const CoreIn& in, std::int64_t clocks, Tell on_snapshot, Encoder& encoder,
           Bridge& bridge) {
    if constexpr (is_plain<Encoder, Bridge>) {
      if (whole_.at == 0 && clocks >= clocks_per_tick_ && is_still(encoder, in)) {
        return pass_tick(in, clocks, on_snapshot, encoder, bridge);
      }
    }
    return pass(in, clocks, on_snapshot, encoder, bridge);
  }
  /// All clocks of a tick without an edge.
  template <class Encoder, class Bridge>
  int pass_tick(const CoreIn& in, std::int64_t clocks, Tell on_snapshot, Encoder& encoder,
                Bridge& bridge) {
    Whole& w = whole_;
    const auto run = [&](int to) {
      bridge.run(w.drive, to - w.at);
      w.at = to;
      show_sockets(encoder, bridge);
    };
    w.encoder.sample = true;
    if (!encoder.take(in, w.encoder) || !take(false, encoder, bridge)) {
      run(sample_clock + 1);
      settle(encoder, bridge);
      return sample_clock + 1;
    }
    if (bridge.pass(w.drive, clocks_per_tick_)) {
      tell(on_snapshot);
    } else {
      run(axis_.duty_clock());
      tell(on_snapshot);
      run(clocks_per_tick_);
    }
    end(clocks < 2 * clocks_per_tick_, encoder, bridge);
    return clocks_per_tick_;
  }
  /// The duty is new.
  void tell(Tell on_snapshot) {
    show_chain(whole_.values);
    whole_.drive = axis_.drive({}, whole_.drive.gates_clear, false);
    out_.snapshot_valid = true;
    out_.word_valid = false;
    if (reads_) {
      out_.word_slot = Map::R::current_ref;
      out_.word_data = static_cast<std::uint32_t>(out_.current_ref);
    }
    on_snapshot();
    out_.snapshot_valid = false;
  }
  static bool is_still(const axis::Quadrature& encoder, const CoreIn& in) {
    return encoder.still(in.encoder);
  }
  template <class Encoder>
  static bool is_still(const Encoder&, const CoreIn&) {
    return false;
  }
  /// The sockets up to clock `to`, or to the first one after which something is out of the
  /// ordinary.
  template <class Encoder, class Bridge>
  bool pass_sockets(const CoreIn& in, int to, Encoder& encoder, Bridge& bridge) {
    constexpr int sample = axis::TickCounter::sample_clock;
    Whole& w = whole_;
    bool ordinary = true;
    if constexpr (is_plain<Encoder, Bridge>) {
      int passed = to - w.at;
      w.encoder.sample = w.at == sample;
      if (w.encoder.sample) {
        ordinary = encoder.take(in, w.encoder);
      } else {
        passed = encoder.pass(in, w.encoder, passed, ordinary);
      }
      if (!bridge.pass(w.drive, passed)) bridge.run(w.drive, passed);
      w.at += passed;
    } else {
      while (w.at < to && ordinary) {
        w.encoder.sample = w.drive.sample = w.at == sample;
        w.drive.valid = w.at == axis_.duty_clock();
        const axis::Rotor rotor = encoder.rotor();
        encoder.clock(in, w.encoder, axis_.words());
        bridge.clock(in, w.drive, axis_.words(), rotor);
        count_gates(bridge);
        ++w.at;
        ordinary = bridge.out().why == 0 && is_ordinary(encoder.out());
      }
    }
    show_sockets(encoder, bridge);
    return ordinary;
  }
  /// Against the tick's beginning.
  bool is_ordinary(const axis::Position& now) const {
    const axis::Position& b = whole_.before;
    return now.why == 0 && !now.illegal && !now.trip_channel && !now.trip_index && !now.trip_flip &&
           now.error == b.error && now.error_count == b.error_count &&
           now.rejected_count == b.rejected_count && now.index_position == b.index_position &&
           now.polarity_holds == b.polarity_holds;
  }
  /// The axis's tick, after the sample; whether nothing trips in it.
  template <class Encoder, class Bridge>
  bool take(bool may_settle, const Encoder& encoder, const Bridge& bridge) {
    Whole& w = whole_;
    const axis::Position& now = encoder.out();
    w.after = w.before;
    w.after.moved = now.moved;
    w.after.chatters = now.chatters;
    if (may_settle) w.begin = axis_.blocks();
    w.sampled = axis_.tick({w.after, bridge.out(), w.pins}, w.values);
    return w.sampled;
  }
  template <class Encoder, class Bridge>
  void end(bool last, const Encoder& encoder, const Bridge& bridge) {
    axis_.end_tick({encoder.out(), bridge.out(), whole_.pins}, whole_.values, reads_);
    if (beats_) {
      heartbeat_.end_tick(whole_.values.tick, out_.first_fault);
      out_.heartbeat = heartbeat_.out();
    }
    whole_.on = false;
    ++whole_ticks_;
    if (last) show_end();
  }
  template <class Encoder, class Bridge>
  void settle(const Encoder& encoder, const Bridge& bridge) {
    constexpr int sample = axis::TickCounter::sample_clock;
    Whole& w = whole_;
    if (!w.on) return;
    w.on = false;
    ++settled_ticks_;
    if (w.sampled) axis_.undo(w.begin);
    axis::Bridge now = bridge.out();
    w.bridge.period_start = now.period_start = false;  // it cannot trip here
    for (int c = 0; c < w.at; ++c) {
      const bool before = c <= sample;
      axis_.clock({before ? w.before : w.after, before ? w.bridge : now, w.pins});
    }
    show(w.pins, encoder, bridge);
  }
  /// What has changed with the end of the last one.
  void show_end() {
    const axis::Axis::Blocks& q = axis_.blocks();
    constexpr unsigned closed = 1U << Map::L::gates_closed;
    out_.tick_count = q.ticks.count;
    out_.scene = static_cast<std::uint8_t>(q.host.scene);
    out_.armed = q.safety.arming.armed();
    out_.gates_enable = q.safety.arming.open();
    out_.limits =
        static_cast<std::uint16_t>((out_.limits & ~closed) | (out_.gates_enable ? 0 : closed));
    if (reads_) {
      out_.reg_rdata = axis_.read_data();
      out_.word_slot = Map::R::status;
      out_.word_data = q.host.snapshot.word.data;
    }
  }
  /// The outputs after a clock.
  template <class Encoder, class Bridge>
  void show(const CoreIn& in, const Encoder& encoder, const Bridge& bridge) {
    const axis::Axis::Blocks& q = axis_.blocks();
    show_chain(axis_.values({encoder.out(), bridge.out(), in}, q.safety.levels(axis_.laws())));
    out_.snapshot_valid = axis_.tick().duty;
    out_.reg_busy = q.host.registers.busy();
    if (reads_) {
      out_.reg_rdata = axis_.read_data();
      out_.word_valid = q.host.snapshot.word.valid;
      out_.word_slot = static_cast<std::uint8_t>(q.host.snapshot.word.place);
      out_.word_data = q.host.snapshot.word.data;
    }
    show_sockets(encoder, bridge);
  }
  template <class Encoder, class Bridge>
  void show_sockets(const Encoder& encoder, const Bridge& bridge) {
    out_.duty_active = bridge.out().duty_active;
    out_.gates = static_cast<std::uint8_t>(bridge.gates());
    if constexpr (!is_plain<Encoder, Bridge>) {
      out_.serial = static_cast<std::uint8_t>(encoder.lines());
    }
    if constexpr (std::is_same_v<Bridge, axis::HBridgeCurrent> ||
                  std::is_same_v<Bridge, axis::ThreePhaseCurrent>) {
      out_.current = bridge.out().current;
      out_.current_clock = bridge.modulator_clock();
    }
  }
  void show_measured() {
    out_.position = whole_.values.position;
    if (whole_.at >= velocity_clock) out_.velocity = whole_.values.velocity;
    if (whole_.at >= measured_clock) {
      out_.tau_hat = static_cast<std::int32_t>(whole_.values.tau_hat);
    }
  }
  void show_chain(const axis::Values& v) {
    const axis::Safety& safety = axis_.blocks().safety;
    out_.tick_count = v.tick;
    out_.position = v.position;
    out_.velocity = v.velocity;
    out_.tau_hat = static_cast<std::int32_t>(v.tau_hat);
    out_.tau_ref = static_cast<std::int32_t>(v.tau_ref);
    out_.current_ref = static_cast<std::int32_t>(v.current);
    out_.voltage = static_cast<std::int32_t>(v.voltage);
    out_.duty = static_cast<std::int16_t>(v.duty);
    out_.scene = static_cast<std::uint8_t>(v.scene);
    out_.limits = static_cast<std::uint16_t>(v.limits);
    out_.faults = safety.latch.faults;
    out_.first_fault = static_cast<std::uint8_t>(safety.latch.first);
    out_.armed = safety.arming.armed();
    out_.gates_enable = safety.arming.open();
  }

  axis::Axis axis_;
  EncoderSocket encoder_;
  BridgeSocket bridge_;
  axis::Heartbeat heartbeat_;
  int clocks_per_tick_;
  bool reads_, beats_;
  bool plain_;  ///< the sockets are Quadrature and HBridge
  Whole whole_;
  GateCounts gate_clocks_{};
  std::int64_t writes_ = 0, whole_ticks_ = 0, settled_ticks_ = 0;
  CoreOut out_;
};

}  // namespace feltgate

#ifndef FELTGATE_COMPILED_TWIN  // else a library has it
#include "feltgate/feltgate_core_steps.hpp"
#endif
