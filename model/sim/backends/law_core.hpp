// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One axis and the engine of its laws, with the interface of a core.
// Documentation: docs/architecture.md
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "backend.hpp"
#include "feltgate/feltgate_axes.hpp"

namespace feltgate {

/// The twin of feltgate_axes for one axis of a design with an engine. It has the outputs of a
/// core, the engine's words at the register port, and tells from which run of thread 0 the torque
/// comes.
class LawCore {
 public:
  /// `reads`: a host reads.
  explicit LawCore(const axis::Design& d, bool reads = true) : axes_(d, reads), reads_(reads) {}
  void clock(const CoreIn& in) {
    engine_writes_ += in.reg_write && in.reg_addr >> 12 == axes_engine >> 12;
    axes_.clock(axes_in(in));
    show();
  }
  /// Like FeltgateCore::advance(): from event to event while nobody writes. A snapshot is told of
  /// at the end of its tick, when it is known which runs of the program began in it.
  template <class OnSnapshot>
  void advance(const CoreIn& in, std::int64_t clocks, OnSnapshot&& on_snapshot) {
    axes_.advance(axes_in(in), clocks, {}, {}, [&] {
      show();
      on_snapshot();
    });
    show();
  }
  bool snapshot_due() const { return axes_.last(); }

  const CoreOut& out() const { return out_; }
  GateCounts gate_clocks() const { return axes_.core(0).gate_clocks(); }
  int on_time(std::size_t leg) const { return axes_.core(0).on_time(leg); }
  int clock_of_tick() const { return axes_.clock_of_tick(); }
  std::int16_t sampled_travel() const { return axes_.core(0).sampled_travel(); }
  /// Writes to core and engine.
  std::int64_t writes() const { return axes_.core(0).writes() + engine_writes_; }
  /// The law's events since the reset.
  std::vector<LawEvent> law_events() {
    std::vector<LawEvent> all;
    for (const auto& e : axes_.glue().engine().told()) {
      all.push_back({e.number, e.value, e.tick});
    }
    return all;
  }
  /// The law's event in this clock; valid only after clock().
  std::optional<LawEvent> law_event() const {
    const AxesOut<1>& out = axes_.out();
    if (!out.event_valid) return std::nullopt;
    return LawEvent{out.event_number, out.event_value, 0};
  }
  /// Whether the engine could not take a write.
  bool busy() const { return axes_.glue().busy(); }
  /// Sets a snapshot's fields about the law's runs.
  void tell(Snapshot* s) const {
    const EngineWatch& watch = axes_.glue().watch();
    s->law_begins = watch.begins;
    s->law_known = watch.in_force.has_value();
    s->law_tick = watch.in_force.value_or(0);
    s->law_changes = watch.changes_at_begin;
    s->law_restart = axes_.glue().restarted();
    s->law_stale = watch.stale;
  }

 private:
  AxesIn<1> axes_in(const CoreIn& in) const {
    AxesIn<1> to = single_axis(in);
    // Without read-back an address matters only with a write.
    if (!reads_ && !in.reg_write) to.reg_addr = 0;
    return to;
  }
  void show() {
    out_ = axes_.out().axis[0];
    out_.reg_rdata = axes_.out().reg_rdata;
    out_.reg_busy = axes_.out().reg_busy;
  }

  FeltgateAxes<1, true> axes_;
  bool reads_;
  CoreOut out_;
  std::int64_t engine_writes_ = 0;
};

/// Sets a snapshot's fields that are not outputs.
inline void tell_of_law(const FeltgateCore&, Snapshot*) {}
inline void tell_of_law(const LawCore& core, Snapshot* s) { core.tell(s); }
/// The events of a law.
inline std::vector<LawEvent> law_events_of(FeltgateCore&) { return {}; }
inline std::vector<LawEvent> law_events_of(LawCore& core) { return core.law_events(); }
/// After a clock: whether its snapshot is to be told of.
inline bool snapshot_due(const FeltgateCore& core) { return core.out().snapshot_valid; }
inline bool snapshot_due(const LawCore& core) { return core.snapshot_due(); }
/// Whether the target of a write could take it now.
inline bool takes_write(const FeltgateCore&) { return true; }
inline bool takes_write(const LawCore& core) { return !core.busy(); }

}  // namespace feltgate
