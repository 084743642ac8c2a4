// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin of any design as a back-end. Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "clocked_backend.hpp"
#include "law_core.hpp"

namespace feltgate {

/// The twin as a back-end, from event to event. Core: FeltgateCore, or LawCore of a design with an
/// engine.
template <class Core>
class TwinBackend : public ClockedBackend {
 public:
  explicit TwinBackend(const DesignInfo& design)
      : ClockedBackend(design),
        core_(info_.data, false) {}  // nobody reads registers through a back-end
  const char* name() const override { return "twin"; }

  /// Goes from event to event: pins, register writes, end of the stretch. The last clocks, in which
  /// nothing happens that a caller could ask for, are deferred, so that the core gets whole ticks.
  void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last) override {
    snapshots_.clear();
    if (first != last) events_.push(first, last);
    CoreIn in = inputs();
    const Clock end = now_ + clocks;
    const bool may_wait = !gate_times_ && !sensor_;
    if (may_wait && writes_.empty() && events_.next(end) >= end) {
      in.encoder = events_.pins();
      if (core_.calm(in, waiting_ + clocks)) {
        waiting_ += clocks;
        now_ = end;
        return;
      }
    }
    if (gate_times_) gates_before_ = core_.gate_clocks();
    now_ -= waiting_;
    waiting_ = 0;
    const auto tell = [this] {
      keep(core_.out(), core_.sampled_travel(), core_.writes());
      tell_of_law(core_, &snapshots_.back());
    };
    while (now_ < end) {
      in.encoder = events_.at(now_);
      const Clock held = sense(&in, now_, core_.out().serial, end);
      const int clock_of_tick = core_.clock_of_tick();
      if (!writes_.empty() && clock_of_tick == host_write_clock && takes_write(core_)) {
        issue_write(&in);
        core_.clock(in);
        if (snapshot_due(core_)) tell();
        in.reg_write = false;
        ++now_;
        continue;
      }
      Clock until = std::min(held, events_.next(end));
      if (!writes_.empty()) {
        const int ahead = host_write_clock - clock_of_tick;
        until = std::min(until, now_ + (ahead > 0 ? ahead : ahead + info_.clocks_per_tick));
      }
      const Clock last = (clock_of_tick + until - now_) % info_.clocks_per_tick;
      if (may_wait && writes_.empty() && until == end && last < until - now_) {
        core_.run(in, until - last - now_, tell);
        now_ = until - last;
        if (last > 0 && core_.calm(in, last)) {
          waiting_ = last;
          now_ = end;
          return;
        }
      }
      core_.run(in, until - now_, tell);
      now_ = until;
    }
  }
  void set_panel(const Panel& panel) override {
    settle();
    ClockedBackend::set_panel(panel);
  }
  void write(int address, std::uint32_t data) override {
    settle();
    ClockedBackend::write(address, data);
  }
  void keep_gate_times(bool keep) override { gate_times_ = keep; }
  GateClocks gates() const override {
    const auto after = core_.gate_clocks();
    return {after[0] - gates_before_[0], after[1] - gates_before_[1], after[2] - gates_before_[2],
            after[3] - gates_before_[3], after[4] - gates_before_[4], after[5] - gates_before_[5]};
  }
  std::vector<LawEvent> law_events() override {
    settle();
    return law_events_of(core_);
  }
  int duty() const override { return core_.out().duty_active; }
  bool gates_enabled() const override { return core_.out().gates_enable; }
  int on_time(std::size_t leg) const override { return core_.on_time(leg); }

 private:
  /// Runs the deferred clocks; call it before the inputs change.
  void settle() {
    CoreIn in = inputs();
    in.encoder = events_.pins();
    core_.run(in, waiting_, [] {});
    waiting_ = 0;
  }
  void reset_core(std::uint64_t, EncoderPins) override {
    core_ = Core(info_.data, false);
    waiting_ = 0;
    gates_before_ = {};
  }
  Core core_;
  Clock waiting_ = 0;  ///< deferred clocks before now()
  bool gate_times_ = true;
  GateCounts gates_before_{};
};

}  // namespace feltgate
