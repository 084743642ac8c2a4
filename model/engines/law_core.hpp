// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One axis with the engine of its laws behind the interface of a core. Documentation:
// docs/architecture.md
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <type_traits>

#include "engine.hpp"
#include "feltgate/core_steps.hpp"
#include "feltgate/feltgate_axes.hpp"

namespace feltgate {

/// The twin of feltgate_axes for one axis of design D, which has an engine. It shows what a core
/// does, the engine's words at the port, and which run of thread 0 the torque is of.
template <class D, bool ReadBack>
class LawCore {
 public:
  void clock(const CoreIn& in) {
    if (axes_.clock_of_tick() == core_steps::clock_of(Map::T::law_torque)) in_force_ = ended_;
    if (axes_.measured()) begins_ = false;
    AxesIn<1> to;
    to.axis[0].encoder = in.encoder;
    to.axis[0].set_zero = in.set_zero;
    to.axis[0].scene = in.scene;
    to.arm = in.arm;
    to.stop = in.stop;
    to.reg_addr = in.reg_addr;
    to.reg_wdata = in.reg_wdata;
    to.reg_write = in.reg_write;
    engine_writes_ += in.reg_write && in.reg_addr >> 12 == axes_engine >> 12;
    axes_.clock(to);
    watch();
    out_ = axes_.out().axis[0];
    out_.reg_rdata = axes_.out().reg_rdata;
    out_.reg_busy = axes_.out().reg_busy;
    const auto gates = out_.gates;
    for (unsigned k = 0; k < 4; ++k) gate_clocks_[k] += gates >> k & 1u;
  }
  template <class OnSnapshot>
  void run(const CoreIn& in, std::int64_t clocks, OnSnapshot&& on_snapshot) {
    for (std::int64_t k = 0; k < clocks; ++k) {
      clock(in);
      if (out_.snapshot_valid) on_snapshot();
    }
  }
  /// Nobody knows what a program will ask for.
  bool calm(const CoreIn&, std::int64_t) const { return false; }

  const CoreOut& out() const { return out_; }
  const std::array<std::int64_t, 4>& gate_clocks() const { return gate_clocks_; }
  int clock_of_tick() const { return axes_.clock_of_tick(); }
  std::int16_t sampled_travel() const { return axes_.core(0).sampled_travel(); }
  /// Of core and engine.
  std::int64_t writes() const { return axes_.core(0).writes() + engine_writes_; }
  /// Whether the engine would not take a write.
  bool busy() const { return engine_busy_; }
  /// What a snapshot says of the law's runs.
  void tell(Snapshot* s) const {
    s->law_begins = begins_;
    s->law_known = in_force_.has_value();
    s->law_tick = in_force_.value_or(0);
    s->law_changes = changes_at_begin_;
  }

 private:
  /// The runs of thread 0: each that begins gives a torque, one after the other.
  void watch() {
    const auto& engine = axes_.engine();
    const auto out = engine.out();
    const bool running = engine.running(0);
    changes_ += out.changed;
    if (running && !running_) {
      changes_at_begin_ = changes_;
      begun_.push_back(axes_.out().axis[0].tick_count);
      begins_ = true;
    }
    running_ = running;
    if (out.fresh && !begun_.empty()) {
      ended_ = begun_.front();
      begun_.pop_front();
    }
    engine_busy_ = out.busy;
  }

  FeltgateAxes<D, 1, ReadBack, true> axes_;
  CoreOut out_;
  std::array<std::int64_t, 4> gate_clocks_{};
  std::int64_t engine_writes_ = 0, changes_ = 0, changes_at_begin_ = 0;
  bool running_ = false, begins_ = false, engine_busy_ = false;
  std::deque<std::uint32_t> begun_;  ///< ticks of the runs that have yet to end
  std::optional<std::uint32_t> ended_, in_force_;
};

/// What an engine of design D runs as its twin.
template <class D, bool ReadBack>
using EngineCore =
    std::conditional_t<D::engine != 0, LawCore<D, ReadBack>, FeltgateCore<D, ReadBack>>;

/// What a snapshot says beside the outputs.
template <class Core>
void tell_of_law(const Core&, Snapshot*) {}
template <class D, bool ReadBack>
void tell_of_law(const LawCore<D, ReadBack>& core, Snapshot* s) {
  core.tell(s);
}
/// Whether what a write would go to takes it.
template <class Core>
bool takes_write(const Core&) {
  return true;
}
template <class D, bool ReadBack>
bool takes_write(const LawCore<D, ReadBack>& core) {
  return !core.busy();
}

}  // namespace feltgate
