// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The logic between the engine and the axes, and its replacement in a device without an engine;
// both are parts of FeltgateAxes. Documentation: docs/architecture.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/axes_ports.hpp"
#include "feltgate/engine_runs.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate {

/// A program's torques, in the format of the torque; late: they are too old or not checked.
template <int N>
struct Program {
  std::array<std::int32_t, N> torque{};
  bool late = false;
};

/// Without an engine: the programmed torques come from the ports.
template <int N>
class NoAxesEngine {
 public:
  explicit NoAxesEngine(const axis::Design&) {}
  void reset() {}
  template <class Cores>
  void clock(const AxesIn<N>&, const Cores&, const std::array<CoreIn, N>&) {}
  /// Sets what the cores take of the program in every clock.
  template <class Cores>
  void give(const AxesIn<N>& in, const Cores&, std::array<CoreIn, N>& each) const {
    for (CoreIn& core : each) core.law_restart = in.law_restart;
  }
  /// What they take with the position, in the clock `ahead` clocks from now.
  Program<N> program(const AxesIn<N>& in, int) const {
    Program<N> p;
    for (std::size_t n = 0; n < N; ++n) p.torque[n] = in.axis[n].law_torque;
    p.late = in.law_late;
    return p;
  }
  void show(const AxesIn<N>&, AxesOut<N>&) const {}

  // Event to event: there is nothing to compute, the ports give the torques.
  template <class Cores>
  bool by_runs(const AxesIn<N>&, const Cores&, const std::array<CoreIn, N>&) {
    return true;
  }
  bool may_tick(int) const { return true; }
  template <class Cores>
  void tick(int, const Cores&) {}
  template <class Cores, class OnEvent>
  void advance(int, const Cores&, OnEvent&&) {}
  bool event_valid() const { return false; }
  int event_number() const { return 0; }
};

/// The engine, the check of its programs at each arming, and the decision when a torque may jump.
template <int N>
class AxesEngine {
 public:
  using EngineOf = law::Engine<N>;

  explicit AxesEngine(const axis::Design& d)
      : runs_(static_cast<unsigned>(d["ENGINE_MAX_AGE"]), d["TORQUE_W"], timing(d)) {
    reset();
  }

  EngineOf& engine() { return runs_.clocked(); }
  const EngineWatch& watch() const { return runs_.watch(); }
  /// Whether the engine is computed run by run at present.
  bool runs_whole() const { return runs_.on(); }
  /// Whether the torque might jump in the tick that was measured last.
  bool restarted() const { return restarted_; }
  /// Whether the port takes no write, at any address.
  bool port_busy() const { return out_.busy; }
  /// Whether the engine would not take a write, or would drop one.
  bool busy() const { return out_.busy || runs_.committing(); }

  void reset() {
    runs_.reset();
    out_ = runs_.clocked().out();
    state_ = {};
    restarts_ = restarted_ = false;
  }

  template <class Cores>
  void give(const AxesIn<N>&, const Cores& cores, std::array<CoreIn, N>& each) const {
    bool law = false;
    for (const auto& core : cores) law |= in_law(core);
    for (std::size_t n = 0; n < N; ++n) {
      each[n].law_restart = may_jump();
      each[n].axis_silent |= !state_.taken_checked;
      each[n].axis_blocked |= law && state_.checked && !out_.crc_good;
    }
  }

  Program<N> program(const AxesIn<N>&, int ahead) {
    Program<N> p;
    p.late = out_.late || !out_.crc_good;
    if (runs_.on()) {
      p.torque = runs_.torque(ahead);
    } else {
      runs_.take();
      p.torque = out_.torque;
    }
    return p;
  }

  /// One clock; call it before the cores' clock.
  template <class Cores>
  void clock(const AxesIn<N>& in, const Cores& cores, const std::array<CoreIn, N>& each) {
    State& s = state_;
    const bool last = cores[0].last();
    if (last) restarts_ = may_jump();
    if (cores[0].measured()) restarted_ = restarts_;
    bool law = false, armed = false, all_ask = true, zeroed = false;
    for (std::size_t n = 0; n < N; ++n) {
      law |= in_law(cores[n]);
      armed |= cores[n].out().armed;
      all_ask &= cores[n].arm_request(each[n]);
      zeroed |= cores[n].zeroed();
    }
    const bool check = last && all_ask && !s.checked && !s.checks;
    const bool addressed = is_engine(in.reg_addr);

    typename EngineOf::In to;
    to.armed = armed;
    to.enter = law && !s.law;
    to.locked = armed || all_ask || s.checks;
    to.tick = cores[0].measured();
    to.tick_count = cores[0].out().tick_count;
    for (std::size_t n = 0; n < N; ++n) {
      const CoreOut& o = cores[n].out();
      to.position[n] = o.position;
      to.velocity[n] = static_cast<std::int32_t>(o.velocity);
      to.tau_hat[n] = o.tau_hat;
    }
    to.crc_start = check;
    to.addr = in.reg_addr & 0xfffu;
    to.wdata = in.reg_wdata;
    to.write = in.reg_write && addressed;
    to.read = in.reg_read && addressed;

    const typename EngineOf::Out before = runs_.clocked().peek(to);
    s.rdata = addressed ? before.rdata : 0;
    s.rdata_known = !addressed || before.rdata_known;
    if (last && !all_ask) {
      s.check_of_these = s.checked = s.taken_checked = false;
    } else {
      if (s.checked && cores[0].samples()) s.taken_checked = true;
      if (out_.crc_done && s.check_of_these) s.checked = true;
      if (check) s.check_of_these = true;
    }
    s.checks = check || (s.checks && !out_.crc_done);
    s.sampled = s.runs == 0 && (s.sampled || cores[0].samples());
    if ((law && !s.law) || (armed && !s.armed) || zeroed || out_.changed) {
      s.runs = 2;
    } else if (out_.fresh && s.runs != 0) {
      --s.runs;
    }
    s.law = law;
    s.armed = armed;
    runs_.clock(to);
    runs_.show(&out_);
  }

  // Event to event:
  /// Whether, with the inputs held, only the tick itself changes the engine before the tick ends,
  /// and the engine is computed run by run.
  template <class Cores>
  bool by_runs(const AxesIn<N>& in, const Cores& cores, const std::array<CoreIn, N>& each) {
    State& s = state_;
    if (s.runs != 0 || !s.sampled || s.checks || in.reg_write || in.reg_read ||
        is_engine(in.reg_addr)) {
      return false;
    }
    bool law = false, armed = false, all_ask = true;
    for (std::size_t n = 0; n < N; ++n) {
      law |= in_law(cores[n]);
      armed |= cores[n].out().armed;
      all_ask &= cores[n].arm_request(each[n]);
    }
    const bool settled = all_ask ? s.taken_checked : !s.checked && !s.check_of_these;
    if (law != s.law || (armed && !s.armed) || !settled) return false;
    s.armed = armed;
    s.rdata = 0;
    s.rdata_known = true;
    typename EngineOf::In to;
    to.armed = armed;
    to.tick = cores[0].measured();
    to.tick_count = cores[0].out().tick_count;
    to.addr = in.reg_addr & 0xfffu;
    return runs_.enter(to, cores[0].clock_of_tick());
  }
  /// Whether tick() may be called for the clock `ahead` clocks from now; if not, use clock().
  bool may_tick(int ahead) {
    const bool may = runs_.may_tick(ahead);
    if (!may) runs_.give_up();
    return may;
  }
  /// A tick in the clock `ahead` clocks from now; the cores hold its measurements.
  template <class Cores>
  void tick(int ahead, const Cores& cores) {
    Axes tau_hat;
    for (std::size_t n = 0; n < N; ++n) tau_hat[n] = cores[n].out().tau_hat;
    restarted_ = restarts_;
    runs_.tick(ahead, positions(cores), velocities(cores), tau_hat);
  }
  template <class Cores, class OnEvent>
  void advance(int clocks, const Cores& cores, OnEvent&& on_event) {
    runs_.advance(clocks, positions(cores), velocities(cores), on_event);
    if (cores[0].clock_of_tick() == 0) restarts_ = may_jump();
    runs_.show(&out_);
  }

  /// An event in the next clock.
  bool event_valid() const { return out_.event_valid; }
  int event_number() const { return out_.event_number; }

  void show(const AxesIn<N>& in, AxesOut<N>& out) const {
    out.reg_rdata |= state_.rdata;
    out.rdata_known = state_.rdata_known;
    out.reg_busy |= is_engine(in.reg_addr) && out_.busy;
    out.event_valid = out_.event_valid;
    out.event_number = out_.event_number;
    out.event_value = out_.event_value;
  }

 private:
  struct State {
    bool law = false, armed = false;
    bool checks = false, check_of_these = false, checked = false;
    bool taken_checked = false;  ///< the axes have taken the torques of checked programs
    int runs = 0;                ///< runs that must end before the torque includes the change
    bool sampled = true;
    std::uint32_t rdata = 0;
    bool rdata_known = true;
  };

  using Axes = typename EngineOf::Inputs::Axes;

  template <class Cores>
  static Axes positions(const Cores& cores) {
    Axes axes;
    for (std::size_t n = 0; n < N; ++n) axes[n] = cores[n].out().position;
    return axes;
  }
  template <class Cores>
  static Axes velocities(const Cores& cores) {
    Axes axes;
    for (std::size_t n = 0; n < N; ++n) {
      axes[n] = static_cast<std::int32_t>(cores[n].out().velocity);
    }
    return axes;
  }
  /// Whether the torque in force may be from before a change.
  bool may_jump() const { return state_.runs != 0 || !state_.sampled; }
  static bool is_engine(std::uint16_t address) { return address >> 12 == axes_engine >> 12; }
  template <class Core>
  static bool in_law(const Core& core) {
    return core.out().scene == Map::S::law;
  }

  static law::RunTiming timing(const axis::Design& d) {
    using Core = FeltgateCore;
    constexpr int measured = Core::measured_clock;
    const int tick = d["CLOCKS_PER_TICK"];
    return {tick, measured - Core::sample_clock - 1, measured - Core::velocity_clock,
            tick - 2 - measured};
  }

  law::EngineRuns<N> runs_;
  typename EngineOf::Out out_;
  State state_;
  /// restarts_: may_jump() at the end of the last tick; restarted_: see restarted().
  bool restarts_ = false, restarted_ = false;
};

}  // namespace feltgate
