// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The back-end that runs RTL and twin in lock-step.
// Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <array>
#include <string>

#include "clocked_backend.hpp"
#include "lock_step_core.hpp"
#include "sampled_watch.hpp"

namespace feltgate {

/// The twin leads, from event to event, and the RTL follows.
template <class Rtl>
class LockStepBackend : public ClockedBackend {
 public:
  explicit LockStepBackend(const DesignInfo& design) : ClockedBackend(design), core_(info_.data) {}
  const char* name() const override { return "lockstep"; }
  void trace(const std::string& path, Clock from, Clock to) override {
    core_.trace(path, from, to);
    traced_ = true;
  }
  std::int64_t mismatches() const override { return followed().mismatches(); }
  std::string first_mismatch() const override { return followed().first_mismatch(); }
  Clock first_mismatch_clock() const override { return followed().first_mismatch_clock(); }
  double busy_s(const std::string& half) const override {
    return half == "rtl" ? followed().rtl_busy_s() : twin_watch_.seconds();
  }

  void advance(Clock clocks, const EncoderEvent* first, const EncoderEvent* last) override {
    snapshots_.clear();
    if (first != last) events_.push(first, last);
    const auto& twin = core_.twin();
    gates_before_ = twin.gate_clocks();
    CoreIn in = inputs();
    for (const Clock end = now_ + clocks; now_ < end; in.reg_write = false) {
      in.encoder = events_.at(now_);
      const Clock held = sense(&in, now_, twin.out().serial, end);
      Clock until = std::min({held, events_.next(end), now_ + core_.room()});
      if (!writes_.empty()) {
        const int ahead = host_write_clock - twin.clock_of_tick();
        if (ahead == 0 && takes_write(twin)) issue_write(&in);
        until = std::min(until, now_ + (ahead == 0  ? 1
                                        : ahead > 0 ? ahead
                                                    : ahead + info_.clocks_per_tick));
      }
      twin_watch_.time([&] {
        core_.lead(in, until - now_, [&] {
          keep(twin.out(), twin.sampled_travel(), twin.writes());
          tell_of_law(twin, &snapshots_.back());
        });
      });
      now_ = until;
      if (core_.room() == 0) core_.follow();
    }
    if (traced_) followed();  // reports at once a file that cannot be written
  }
  GateClocks gates() const override {
    const auto after = core_.twin().gate_clocks();
    return {after[0] - gates_before_[0], after[1] - gates_before_[1], after[2] - gates_before_[2],
            after[3] - gates_before_[3], after[4] - gates_before_[4], after[5] - gates_before_[5]};
  }
  std::vector<LawEvent> law_events() override { return core_.law_events(); }
  int duty() const override { return core_.twin().out().duty_active; }
  bool gates_enabled() const override { return core_.twin().out().gates_enable; }
  int on_time(std::size_t leg) const override { return core_.twin().on_time(leg); }

 private:
  /// The core, after the RTL has caught up.
  const LockStepCore<Rtl>& followed() const {
    core_.follow();
    return core_;
  }
  void reset_core(std::uint64_t seed, EncoderPins pins) override {
    core_.power_up(seed, pins);
    gates_before_ = {};
  }

  mutable LockStepCore<Rtl> core_;
  bool traced_ = false;
  SampledWatch twin_watch_;
  GateCounts gates_before_{};
};

}  // namespace feltgate
