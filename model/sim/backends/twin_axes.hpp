// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The twin of a design with several axes; needs no Verilated code.
// Documentation: docs/architecture.md
#pragma once

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>

#include "axes_cores.hpp"
#include "feltgate/feltgate_axes.hpp"

namespace feltgate {

/// The twin of N axes with an engine. A derived class may run RTL beside it, through the virtual
/// members.
template <int N>
class TwinAxes : public AxesCores {
 public:
  explicit TwinAxes(const DesignInfo& design) : AxesCores(design, N) {}

  const char* name() const override { return beside() ? "lockstep" : "twin"; }

  void reset(std::uint64_t seed, const Pins& pins) override {
    writes_.clear();
    now_ = mismatches_ = 0;
    first_mismatch_.clear();
    in_ = {};
    twin_ = std::make_unique<Twin>(info_.data);
    for (std::size_t n = 0; n < N; ++n) {
      events_[n].reset(pins[n]);
      in_.axis[n].encoder = pins[n];
    }
    reset_beside(seed);
  }

  void advance(Clock clocks) override {
    snapshots_.clear();
    for (const Clock end = now_ + clocks; now_ < end;) {
      in_.stop = stop_;
      Clock until = end;
      for (std::size_t n = 0; n < N; ++n) {
        in_.axis[n].encoder = events_[n].at(now_);
        until = std::min(until, events_[n].next(end));
      }
      bool writes = false;
      if (!writes_.empty()) {
        const int ahead = host_write_clock - twin_->clock_of_tick();
        writes = ahead == 0 && !twin_->glue().busy() && !twin_->out().reg_busy;
        until = std::min(until, now_ + (ahead == 0  ? 1
                                        : ahead > 0 ? ahead
                                                    : ahead + info_.clocks_per_tick));
      }
      if (writes) issue_write();
      run(until - now_);
      in_.reg_write = false;
    }
  }

  int duty(std::size_t axis) const override { return twin_->out().axis[axis].duty_active; }
  bool gates_enabled(std::size_t axis) const override {
    return twin_->out().axis[axis].gates_enable;
  }

 protected:
  using Twin = FeltgateAxes<N, true>;

  /// Called after the twin's reset.
  virtual void reset_beside(std::uint64_t /*seed*/) {}
  /// Whether drive() is called before a stretch with held inputs, and follow() after every clock of
  /// it.
  virtual bool beside() const { return false; }
  virtual void drive() {}
  virtual void follow() {}

  std::unique_ptr<Twin> twin_;
  AxesIn<N> in_;

 private:
  void issue_write() {
    std::tie(in_.reg_addr, in_.reg_wdata) = writes_.pop();
    in_.reg_write = true;
    engine_writes_ += in_.reg_addr >= axes_engine ? 1 : 0;
  }

  /// Advances with the inputs held.
  void run(Clock clocks) {
    const bool with_rtl = beside();
    if (!with_rtl && !in_.reg_write) {
      // Without RTL nobody reads; the back-end's address would force clock-by-clock execution.
      if (writes_.empty()) in_.reg_addr = 0;
      twin_->advance(in_, clocks, {}, {}, [this] { keep(); });
      now_ += clocks;
      return;
    }
    if (with_rtl) drive();
    for (Clock k = 0; k < clocks; ++k) {
      twin_->clock(in_);
      if (with_rtl) follow();
      ++now_;
      if (twin_->last()) keep();
    }
  }

  /// At the end of a tick, when it is known which runs of the program began in it.
  void keep() {
    AxesSnapshot s;
    std::int64_t writes = engine_writes_;
    for (int n = 0; n < N; ++n) writes += twin_->core(n).writes();
    for (std::size_t n = 0; n < N; ++n) {
      s[n] =
          Snapshot(twin_->out().axis[n], twin_->core(static_cast<int>(n)).sampled_travel(), writes);
    }
    const EngineWatch& watch = twin_->glue().watch();
    s[0].law_begins = watch.begins;
    s[0].law_known = watch.in_force.has_value();
    s[0].law_tick = watch.in_force.value_or(0);
    s[0].law_changes = watch.changes_at_begin;
    s[0].law_restart = twin_->glue().restarted();
    s[0].law_stale = watch.stale;
    snapshots_.push_back(s);
  }

  std::int64_t engine_writes_ = 0;
};

}  // namespace feltgate
