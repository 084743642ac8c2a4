// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/safety/fault_latch.sv: causes of fault stay until they are cleared. Of several in one
// clock the lowest number is the first. docs/blocks/safety.md
#pragma once

#include <cstdint>

namespace feltgate::axis {

struct FaultLatch {
  std::uint16_t faults = 0;  ///< seen, by number of the cause
  int first = 0;             ///< number of the first, 0: none

  void clock(bool clear, std::uint16_t trips) {
    faults = static_cast<std::uint16_t>((clear ? 0 : faults) | trips);
    if (clear || first == 0) {
      first = 0;
      for (int n = 15; n > 0; --n) first = (trips >> n & 1) != 0 ? n : first;
    }
  }
};

}  // namespace feltgate::axis
