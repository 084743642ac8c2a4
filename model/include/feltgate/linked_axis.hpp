// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What feltgate_linked contains instead of a core where the design has an engine: feltgate_axes
// with one axis, behind the ports of a core. Documentation: docs/blocks/feltgate_linked.md
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "feltgate/feltgate_axes.hpp"
#include "feltgate/generated/link.hpp"

namespace feltgate {

/// One axis of design D with its engine behind the ports of a core; addresses of the register port
/// have 16 bits.
template <class D>
class LinkedAxis {
 public:
  void reset() {
    axes_.reset();
    show();
  }
  void clock(const CoreIn& in) {
    axes_.clock(to_axes(in));
    show();
  }
  /// Like clock() for `clocks` clocks; also calls `on_event(clock, number)` for each event of the
  /// law, where clock 0 is the first of these clocks.
  template <class OnSnapshot, class OnEvent>
  void run(const CoreIn& in, std::int64_t clocks, OnSnapshot&& on_snapshot, OnEvent&& on_event) {
    const auto shown = [&] {
      show();
      at_snapshot_ = true;
      on_snapshot();
      at_snapshot_ = false;
    };
    struct Watcher {
      LinkedAxis& axis;
      OnEvent& on_event;
      void event(std::int64_t clock, int number) { on_event(clock, number); }
      void words() {
        for (const int slot : LinkMap::slots)
          axis.whole_[static_cast<std::size_t>(slot)] = axis.core().word(slot);
      }
    } watcher{*this, on_event};
    axes_.run(to_axes(in), clocks, shown, watcher);
    show();
  }

  const CoreOut& out() const { return out_; }
  /// Whether the law gives an event in the next clock.
  bool event_valid() const { return axes_.glue().event_valid(); }
  int event_number() const { return axes_.glue().event_number(); }
  /// Whether the block at this address cannot take a write in the next clock.
  bool busy(std::uint16_t address) const {
    if (address >> 12 == axes_engine >> 12) return engine_busy_;
    return address < axes_stride && axes_.core(0).out().reg_busy;
  }
  /// A word of the running tick's snapshot by its slot; inside on_snapshot() all words are valid.
  std::uint32_t word(int slot) const {
    return at_snapshot_ ? whole_[static_cast<std::size_t>(slot)] : axes_.core(0).word(slot);
  }
  int clock_of_tick() const { return axes_.clock_of_tick(); }
  FeltgateCore<D>& core() { return axes_.core(0); }
  const FeltgateCore<D>& core() const { return axes_.core(0); }
  auto& engine() { return axes_.engine(); }

 private:
  AxesIn<1> to_axes(const CoreIn& in) const {
    AxesIn<1> to = single_axis(in);
    // A write removes an event, a read does not: a read may be repeated.
    to.reg_read = in.reg_write && !busy(in.reg_addr);
    return to;
  }
  void show() {
    out_ = axes_.out().axis[0];
    out_.reg_rdata = axes_.out().reg_rdata;
    engine_busy_ = axes_.glue().port_busy();
  }

  FeltgateAxes<D, 1, true, true> axes_;
  CoreOut out_;
  static constexpr std::size_t kSlots = LinkMap::slots[LinkMap::snapshot_words - 1] + 1;
  std::array<std::uint32_t, kSlots> whole_{};  ///< by slot, of the last tick with a snapshot
  bool engine_busy_ = false, at_snapshot_ = false;
};

}  // namespace feltgate
