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

  /// Goes from event to event: pins, register writes, end of the stretch.
  void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last) override {
    snapshots_.clear();
    if (first != last) events_.push(first, last);
    CoreIn in = inputs();
    const Clock end = now_ + clocks;
    gates_before_ = core_.gate_clocks();
    const auto tell = [this] {
      keep(core_.out(), core_.sampled_travel(), core_.writes());
      tell_of_law(core_, &snapshots_.back());
    };
    while (now_ < end) {
      in.encoder = events_.at(now_);
      Clock until = std::min(sense(&in, now_, core_.out().serial, end), events_.next(end));
      if (!writes_.empty()) {
        const int ahead = host_write_clock - core_.clock_of_tick();
        if (ahead == 0 && takes_write(core_)) {
          issue_write(&in);
          core_.clock(in);
          if (snapshot_due(core_)) tell();
          in.reg_write = false;
          ++now_;
          continue;
        }
        until = std::min(until, now_ + (ahead > 0 ? ahead : ahead + info_.clocks_per_tick));
      }
      core_.advance(in, until - now_, tell);
      now_ = until;
    }
  }
  GateClocks gates() const override {
    const auto after = core_.gate_clocks();
    return {after[0] - gates_before_[0], after[1] - gates_before_[1], after[2] - gates_before_[2],
            after[3] - gates_before_[3], after[4] - gates_before_[4], after[5] - gates_before_[5]};
  }
  std::vector<LawEvent> law_events() override { return law_events_of(core_); }
  int duty() const override { return core_.out().duty_active; }
  bool gates_enabled() const override { return core_.out().gates_enable; }
  int on_time(std::size_t leg) const override { return core_.on_time(leg); }

 private:
  void reset_core(std::uint64_t, EncoderPins) override {
    core_ = Core(info_.data, false);
    gates_before_ = {};
  }
  Core core_;
  GateCounts gates_before_{};
};

}  // namespace feltgate
