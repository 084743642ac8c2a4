// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// One axis and the engine of its laws, with the interface of a core.
// Documentation: docs/architecture.md
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "backend.hpp"
#include "feltgate/feltgate_axes.hpp"

namespace feltgate {

/// The twin of feltgate_axes for one axis of design D, which has an engine. It has the outputs of a
/// core, the engine's words at the register port, and tells from which run of thread 0 the torque
/// comes.
template <class D, bool ReadBack>
class LawCore {
 public:
  void clock(const CoreIn& in) {
    engine_writes_ += in.reg_write && in.reg_addr >> 12 == axes_engine >> 12;
    axes_.clock(axes_in(in));
    show();
  }
  /// Like FeltgateCore::run(): from event to event while nobody writes.
  template <class OnSnapshot>
  void run(const CoreIn& in, std::int64_t clocks, OnSnapshot&& on_snapshot) {
    axes_.run(axes_in(in), clocks, [&] {
      show();
      on_snapshot();
    });
    show();
  }
  bool calm(const CoreIn& in, std::int64_t clocks) { return axes_.calm(axes_in(in), clocks); }

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
  static AxesIn<1> axes_in(const CoreIn& in) {
    AxesIn<1> to = single_axis(in);
    // Without read-back an address matters only with a write.
    if (!ReadBack && !in.reg_write) to.reg_addr = 0;
    return to;
  }
  void show() {
    out_ = axes_.out().axis[0];
    out_.reg_rdata = axes_.out().reg_rdata;
    out_.reg_busy = axes_.out().reg_busy;
  }

  FeltgateAxes<D, 1, ReadBack, true> axes_;
  CoreOut out_;
  std::int64_t engine_writes_ = 0;
};

/// The twin that an engine of design D uses.
template <class D, bool ReadBack>
using BackendCore =
    std::conditional_t<D::engine != 0, LawCore<D, ReadBack>, FeltgateCore<D, ReadBack>>;

/// Sets a snapshot's fields that are not outputs.
template <class Core>
void tell_of_law(const Core&, Snapshot*) {}
template <class D, bool ReadBack>
void tell_of_law(const LawCore<D, ReadBack>& core, Snapshot* s) {
  core.tell(s);
}
/// The events of a law.
template <class Core>
std::vector<LawEvent> law_events_of(Core&) {
  return {};
}
template <class D, bool ReadBack>
std::vector<LawEvent> law_events_of(LawCore<D, ReadBack>& core) {
  return core.law_events();
}
/// Whether the target of a write could take it now.
template <class Core>
bool takes_write(const Core&) {
  return true;
}
template <class D, bool ReadBack>
bool takes_write(const LawCore<D, ReadBack>& core) {
  return !core.busy();
}

}  // namespace feltgate
