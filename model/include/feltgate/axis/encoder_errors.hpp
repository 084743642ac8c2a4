// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/safety/encoder_errors.sv, a cause of fault: too many illegal transitions.
// docs/blocks/safety.md
#pragma once

#include "feltgate/generated/map.hpp"

namespace feltgate::axis {

class EncoderErrors {
 public:
  bool trip(bool illegal) const { return illegal && errors_ == Map::errors_borne; }
  void clock(bool tick, bool illegal) {
    const bool forgives = tick && ticks_ == (1U << Map::forgive_bits) - 1;
    if (trip(illegal)) {
      errors_ = 0;
    } else if (illegal) {
      ++errors_;
    } else if (forgives && errors_ != 0) {
      --errors_;
    }
    if (tick) ticks_ = (ticks_ + 1) & ((1U << Map::forgive_bits) - 1);
  }

 private:
  int errors_ = 0;  ///< that still count
  unsigned ticks_ = 0;
};

}  // namespace feltgate::axis
