// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/tick_counter.sv: clocks of a tick and ticks. docs/architecture.md
#pragma once

#include <cstdint>

namespace feltgate::axis {

struct TickCounter {
  static constexpr int sample_clock = 2;
  int at = 0;  ///< clock of the tick
  bool sample = false, last = false;
  std::uint32_t count = 0;

  void clock(int clocks_per_tick) {
    count += last ? 1 : 0;
    sample = at == sample_clock - 1;
    const bool ends = at == clocks_per_tick - 2;
    at = last ? 0 : at + 1;
    last = ends;
  }
};

}  // namespace feltgate::axis
