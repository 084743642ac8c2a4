// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the link's twin contains instead of a core where the design has an engine or several axes.
// docs/link.md
#pragma once

#include <cstdint>

#include "feltgate/feltgate_axes.hpp"

namespace feltgate {

/// N axes of a design, with the engine if the design has one, behind the link's register port.
template <int N, bool WithEngine>
class LinkedAxes {
 public:
  explicit LinkedAxes(const axis::Design& d) : axes_(d) {}
  void reset() { axes_.reset(); }
  void clock(const AxesIn<N>& in) { axes_.clock(taking(in)); }
  /// Like clock() for `clocks` clocks; also calls `on_event(clock, number)` for each event of the
  /// law, where clock 0 is the first of these clocks.
  void run(const AxesIn<N>& in, std::int64_t clocks, Callback<> on_snapshot,
           Callback<std::int64_t, int> on_event) {
    axes_.run(taking(in), clocks, on_snapshot, on_event);
  }

  const AxesOut<N>& out() const { return axes_.out(); }
  /// Whether the law gives an event in the next clock.
  bool event_valid() const { return axes_.glue().event_valid(); }
  int event_number() const { return axes_.glue().event_number(); }
  /// Whether the block at this address cannot take a write in the next clock.
  bool busy(std::uint16_t address) const {
    if constexpr (WithEngine) {
      if (address >> 12 == axes_engine >> 12) return axes_.glue().port_busy();
    }
    return address < N * axes_stride && axes_.core(address / axes_stride).out().reg_busy;
  }
  /// A word of axis n by its slot: of the running tick, or between two ticks of the last one.
  std::uint32_t word(int n, int slot) const { return axes_.core(n).word(slot); }
  int clock_of_tick() const { return axes_.clock_of_tick(); }
  FeltgateCore& core(int n = 0) { return axes_.core(n); }
  const FeltgateCore& core(int n = 0) const { return axes_.core(n); }
  auto& engine() { return axes_.glue().engine(); }

 private:
  /// A write removes an event, a read does not: a read may be repeated.
  AxesIn<N> taking(AxesIn<N> in) const {
    in.reg_read = in.reg_write && !busy(in.reg_addr);
    return in;
  }

  FeltgateAxes<N, WithEngine> axes_;
};

}  // namespace feltgate
