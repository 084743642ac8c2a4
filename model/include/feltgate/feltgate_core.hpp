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

  /// The clocks of a tick in which the position is sampled, velocity and tau_hat are new, and the
  /// duty of a program's torque.
  static constexpr int sample_clock = axis::TickCounter::sample_clock;
  static constexpr int velocity_clock = axis::Axis::velocity_clock;
  static constexpr int measured_clock = axis::Axis::measured_clock;
  static constexpr int law_duty_clock =
      velocity_clock + axis::Scene<axis::Fixed>::usual_latency + axis::Axis::duty_after_scene;

  /// `reads`: a host reads; without it every read gives 0, and no words are told.
  explicit FeltgateCore(const axis::Design& d, bool reads = true)
      : axis_(d),
        encoder_(encoder_of(d)),
        bridge_(bridge_of(d)),
        heartbeat_(d),
        clocks_per_tick_(d["CLOCKS_PER_TICK"]),
        reads_(reads),
        beats_(d["HEARTBEAT"] != 0),
        whole_(std::holds_alternative<axis::Quadrature>(encoder_) &&
               std::holds_alternative<axis::HBridge>(bridge_)) {
    reset();
  }

  /// A clock with the reset. The parameter RAM keeps its words, as in the RTL.
  void reset(const CoreIn& in = {}) {
    sockets([&](auto& encoder, auto& bridge) {
      axis_.reset({encoder.out(), bridge.out(), in});
      encoder.reset();
      bridge.reset();
      heartbeat_.reset();
      out_.heartbeat = false;
      gate_clocks_ = {};
      writes_ = 0;
      show(in, encoder, bridge);
    });
  }

  /// Advances one clock with these inputs.
  void clock(const CoreIn& in) {
    sockets([&](auto& encoder, auto& bridge) { clock(in, encoder, bridge); });
  }

  /// Advances `clocks` clocks with the inputs held; reg_write and set_zero must be low. Equals so
  /// many calls of clock(). `on_snapshot()` is called whenever out() holds a valid snapshot.
  template <class OnSnapshot>
  void run(const CoreIn& in, std::int64_t clocks, OnSnapshot&& on_snapshot) {
    bool by_clock = true;
    while (clocks > 0) {
      if (clocks >= clocks_per_tick_ && tick(in, on_snapshot)) {
        clocks -= clocks_per_tick_;
        by_clock = false;
        continue;
      }
      by_clock = true;
      do {
        clock(in);
        if (out_.snapshot_valid) on_snapshot();
      } while (--clocks > 0 && clock_of_tick() != 0);
    }
    if (!by_clock) show_end();
  }

  /// Whether, with the inputs held, the next `clocks` clocks change neither the duty in force nor
  /// the gate enable, and give no snapshot; a caller that needs nothing else may then compute them
  /// later. May return false when true would hold.
  bool calm(const CoreIn& in, std::int64_t clocks) const {
    if (!whole_ || clock_of_tick() != 0 || clocks >= axis_.duty_clock() ||
        h_bridge().clocks_to_duty() < clocks) {
      return false;
    }
    return out_.gates_enable ? !may_trip(in) : out_.duty_active == 0;
  }
  /// Whether something could close the gates before the tick ends, with the inputs held. May return
  /// true when false would hold.
  bool may_trip(const CoreIn& in) const {
    return !whole_ || !quadrature().calm(in, axis_.encoder()) ||
           axis_.may_trip({quadrature().out(), h_bridge().out(), in});
  }

  /// Fault injection: inverts a bit of a word of the parameter RAM, or from bit 32 on of its check;
  /// between two ticks.
  void flip(int address, int bit) { axis_.flip(address, bit); }
  /// Fault injection: inverts a bit of the control word.
  void flip_control(int bit) { axis_.flip_control(bit); }

  const CoreOut& out() const { return out_; }
  /// A word of the running tick's snapshot by its slot; all are there when on_snapshot() is called.
  /// Between two ticks of the last one's.
  std::uint32_t word(int slot) const {
    if (!out_.snapshot_valid) return axis_.word(slot);
    return axis::Snapshot::at(slot, axis_out(CoreIn{}).snapshot);
  }
  /// Clocks since reset for which each gate was on: a_hi, a_lo, b_hi, b_lo, c_hi, c_lo.
  GateCounts gate_clocks() const { return whole_ ? h_bridge().gate_clocks() : gate_clocks_; }
  /// Of three phases: clocks of this PWM period in which leg 0, 1 or 2 is to be high; else 0.
  int on_time(std::size_t leg) const {
    return std::visit([leg](const auto& bridge) { return bridge.on_time(leg); }, bridge_);
  }
  /// Free-running count at the start of the tick.
  std::int16_t sampled_travel() const { return axis_.blocks().travel; }
  SelfTestResult self_test_result() const {
    return static_cast<SelfTestResult>(axis_.blocks().safety.self_test.result());
  }
  bool testing() const { return axis_.blocks().safety.self_test.busy(out_.armed); }
  /// For the other axes: whether this axis asks to be armed in the next clock, and whether nothing
  /// refuses its request.
  bool arm_request(const CoreIn& in) const { return safe(in).arm_request; }
  bool ready() const { return safe(CoreIn{}).ready; }
  /// Whether the next clock samples the position and a program's torque, or is the last of its
  /// tick.
  bool samples() const { return axis_.blocks().ticks.sample; }
  bool last() const { return axis_.blocks().ticks.last; }
  /// Whether in the next clock position, velocity and tau_hat are those of this tick.
  bool measured() const { return axis_.tick().tau_hat; }
  /// Whether the position becomes 0 in the next clock.
  bool zeroed() const { return axis_.zeroed(); }
  /// Whether no write or command waits for the end of the tick.
  bool at_rest() const { return axis_.blocks().host.registers.rests(false, false); }
  /// Register writes carried out so far.
  std::int64_t writes() const { return writes_; }
  /// The clock of a tick in which the duty is new, in the scene of this tick.
  int duty_clock() const { return axis_.duty_clock(); }
  /// The next clock's number in its tick, 0 .. clocks_per_tick - 1.
  int clock_of_tick() const { return axis_.clock_of_tick(); }

  const axis::Axis& axis() const { return axis_; }
  /// For comparisons: every output of the axis with these inputs.
  axis::Axis::Out axis_out(const CoreIn& in) const {
    return at_axis<axis::Axis::Out>(
        in, [this](const axis::Axis::In& to_axis) { return axis_.out(to_axis); });
  }
  int clocks_per_tick() const { return clocks_per_tick_; }
  /// Ticks that run() took as a whole, and those in which something happened.
  std::int64_t whole_ticks() const { return whole_ticks_; }
  std::int64_t thrown_ticks() const { return thrown_ticks_; }

 private:
  using EncoderSocket = std::variant<axis::Quadrature, axis::QuadratureHall, axis::Absolute>;
  using BridgeSocket =
      std::variant<axis::HBridge, axis::HBridgeCurrent, axis::ThreePhase, axis::ThreePhaseCurrent>;

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
  // Of a core that can take a tick as a whole.
  axis::Quadrature& quadrature() { return *std::get_if<axis::Quadrature>(&encoder_); }
  const axis::Quadrature& quadrature() const { return *std::get_if<axis::Quadrature>(&encoder_); }
  axis::HBridge& h_bridge() { return *std::get_if<axis::HBridge>(&bridge_); }
  const axis::HBridge& h_bridge() const { return *std::get_if<axis::HBridge>(&bridge_); }

  template <class F>
  void sockets(F&& f) {
    if (whole_) return f(quadrature(), h_bridge());
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
  axis::Safe safe(const CoreIn& in) const {
    if (whole_) return axis_.safe({quadrature().out(), h_bridge().out(), in});
    return at_axis<axis::Safe>(
        in, [this](const axis::Axis::In& to_axis) { return axis_.safe(to_axis); });
  }

  template <class Encoder, class Bridge>
  void clock(const CoreIn& in, Encoder& encoder, Bridge& bridge) {
    constexpr bool is_whole =
        std::is_same_v<Encoder, axis::Quadrature> && std::is_same_v<Bridge, axis::HBridge>;
    using Words = axis::Words<std::int64_t>;  // as before this clock
    const std::conditional_t<is_whole, const Words&, Words> p = axis_.words();
    writes_ += axis_.writes();
    if (beats_) {
      heartbeat_.clock(axis_.tick(), axis_.blocks().safety.latch.first);
      out_.heartbeat = heartbeat_.out();
    }
    const axis::Axis::ToSockets to = axis_.clock({encoder.out(), bridge.out(), in});
    const axis::Rotor rotor = encoder.rotor();
    encoder.clock(in, to.encoder, p);
    bridge.clock(in, to.drive, p, rotor);
    if constexpr (!is_whole) {
      for (std::size_t g = 0; g < gate_clocks_.size(); ++g) {
        gate_clocks_[g] += bridge.gates() >> g & 1;
      }
    }
    show(in, encoder, bridge);
  }

  /// Takes a tick as a whole. False: nothing has changed.
  template <class OnSnapshot>
  bool tick(const CoreIn& in, OnSnapshot&& on_snapshot) {
    if (!whole_) return false;
    using axis::TickCounter;
    axis::Quadrature& encoder = quadrature();
    axis::HBridge& bridge = h_bridge();
    const axis::Axis::In begin{encoder.out(), bridge.out(), in};
    if (!axis_.ordinary(begin)) return false;
    // M/T counts the clocks from edge to edge.
    if (axis_.laws().spans.used && !encoder.calm(in, axis_.encoder())) return false;
    const axis::Position* sampled =
        encoder.still(in.encoder)
            ? encoder.tick(axis_.blocks().ticks.count)
            : encoder.tick(in, axis_.encoder(), TickCounter::sample_clock, clocks_per_tick_);
    axis::Drive drive = axis_.drive({}, axis_.gates_clear(begin), false);
    const axis::Position& position = sampled != nullptr ? *sampled : encoder.out();
    const axis::Axis::In to_axis{position, bridge.out(), in};
    const bool edges = sampled != &encoder.out() && axis_.laws().spans.used;
    axis::Values v;
    if (sampled == nullptr || edges || !axis_.tick(to_axis, v)) {
      encoder.undo();
      ++thrown_ticks_;
      return false;
    }
    show_chain(v);
    const int duty_clock = axis_.duty_clock();
    const bool still = bridge.pass(drive, clocks_per_tick_);
    if (!still) {
      bridge.run(drive, duty_clock);
      show_gates(bridge);
    }
    out_.snapshot_valid = true;
    out_.word_valid = false;
    if (reads_) {
      out_.word_slot = Map::R::current_ref;
      out_.word_data = static_cast<std::uint32_t>(out_.current_ref);
    }
    on_snapshot();
    out_.snapshot_valid = false;
    if (!still) {
      drive.duty = out_.duty;
      bridge.run(drive, clocks_per_tick_ - duty_clock);
      show_gates(bridge);
    }
    axis_.end_tick(to_axis, v, reads_);
    ++whole_ticks_;
    return true;
  }
  /// After such ticks: what has changed with the end of the last one.
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
    show_gates(bridge);
    out_.serial = static_cast<std::uint8_t>(encoder.lines());
    if constexpr (std::is_same_v<Bridge, axis::HBridgeCurrent> ||
                  std::is_same_v<Bridge, axis::ThreePhaseCurrent>) {
      out_.current = bridge.out().current;
      out_.current_clock = bridge.modulator_clock();
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
  template <class Bridge>
  void show_gates(const Bridge& bridge) {
    out_.duty_active = bridge.out().duty_active;
    out_.gates = static_cast<std::uint8_t>(bridge.gates());
  }

  axis::Axis axis_;
  EncoderSocket encoder_;
  BridgeSocket bridge_;
  axis::Heartbeat heartbeat_;
  int clocks_per_tick_;
  bool reads_, beats_;
  bool whole_;  ///< the sockets can take a tick as a whole
  GateCounts gate_clocks_{};
  std::int64_t writes_ = 0, whole_ticks_ = 0, thrown_ticks_ = 0;
  CoreOut out_;
};

}  // namespace feltgate
