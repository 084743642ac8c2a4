// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What stands between the engine and the axes, and what stands there without one; parts of
// FeltgateAxes. Documentation: docs/blocks/feltgate_axes.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/axes_ports.hpp"
#include "feltgate/engine.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Programmed torque comes in by ports.
template <class D, int N>
class NoAxesEngine {
 public:
  void reset() {}
  template <class Cores>
  void clock(const AxesIn<N>&, const Cores&, const std::array<CoreIn, N>&) {}
  /// What it says to the cores in the clock to come.
  template <class Cores>
  void give(const AxesIn<N>& in, const Cores&, std::array<CoreIn, N>& each) const {
    for (std::size_t n = 0; n < N; ++n) {
      each[n].law_torque = in.axis[n].law_torque;
      each[n].law_late = in.law_late;
      each[n].law_restart = in.law_restart;
    }
  }
  void show(const AxesIn<N>&, AxesOut<N>&) const {}
};

/// The engine, the check of its programs at each arming, and when a torque may jump.
template <class D, int N>
class AxesEngine {
 public:
  using EngineOf = law::Engine<N, D::f.torque.width()>;

  AxesEngine() { reset(); }

  EngineOf& engine() { return engine_; }

  void reset() {
    engine_.reset();
    out_ = engine_.out();
    state_ = {};
  }

  template <class Cores>
  void give(const AxesIn<N>&, const Cores& cores, std::array<CoreIn, N>& each) const {
    bool law = false;
    for (const auto& core : cores) law |= in_law(core);
    for (std::size_t n = 0; n < N; ++n) {
      each[n].law_torque = out_.torque[n];
      each[n].law_late = out_.late || !out_.crc_good;
      each[n].law_restart = state_.runs != 0 || !state_.sampled;
      each[n].axis_silent |= !state_.checked;
      each[n].axis_blocked |= law && !out_.crc_good;
    }
  }

  /// A clock, before that of the cores.
  template <class Cores>
  void clock(const AxesIn<N>& in, const Cores& cores, const std::array<CoreIn, N>& each) {
    State& s = state_;
    bool law = false, armed = false, all_ask = true, zeroed = false;
    for (std::size_t n = 0; n < N; ++n) {
      law |= in_law(cores[n]);
      armed |= cores[n].out().armed;
      all_ask &= cores[n].asks(each[n]);
      zeroed |= cores[n].zeroed();
    }
    const bool shown = cores[0].out().snapshot_valid;
    const bool check = shown && all_ask && !s.checked && !s.checks;
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

    const typename EngineOf::Out before = engine_.peek(to);
    s.rdata = addressed ? before.rdata : 0;
    s.rdata_known = !addressed || before.rdata_known;
    if (shown && !all_ask) {
      s.check_of_these = s.checked = false;
    } else {
      if (out_.crc_done && s.check_of_these) s.checked = true;
      if (check) s.check_of_these = true;
    }
    s.checks = check || (s.checks && !out_.crc_done);
    s.sampled = s.runs == 0 && (s.sampled || to.tick);
    if ((law && !s.law) || (armed && !s.armed) || zeroed || out_.changed) {
      s.runs = 2;
    } else if (out_.fresh && s.runs != 0) {
      --s.runs;
    }
    s.law = law;
    s.armed = armed;
    engine_.clock(to);
    out_ = engine_.out();
  }

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
    int runs = 0;  ///< that must end before the torque is that of what has changed
    bool sampled = true;
    std::uint32_t rdata = 0;
    bool rdata_known = true;
  };

  static bool is_engine(std::uint16_t address) { return address >> 12 == axes_engine >> 12; }
  template <class Core>
  static bool in_law(const Core& core) {
    return core.out().scene == Map::S::law;
  }

  EngineOf engine_{D::engine_max_age};
  typename EngineOf::Out out_;
  State state_;
};

}  // namespace feltgate
