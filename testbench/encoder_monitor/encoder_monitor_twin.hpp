// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/encoder_monitor.sv, clock by clock. Documentation: docs/blocks/encoder_monitor.md
#pragma once

#include <cstdint>

#include "feltgate/encoder_monitor.hpp"

namespace feltgate {

class EncoderMonitor {
 public:
  struct In {
    std::uint64_t wave = 0;
    std::uint32_t tick_count = 0;
    std::uint8_t levels = 0;
    bool index_wrong = false;
  };
  struct Out {
    bool moved = false, chatters = false, trip = false, index_trip = false;
  };

  void reset() { *this = {}; }

  void clock(const In& in) {
    out_.trip = out_.index_trip = false;
    if (((in.wave >> Map::T::levels) & 1u) == 0) return;
    law_.tick(in.levels, in.tick_count, in.index_wrong);
    out_ = {law_.moved(), law_.chatters(), law_.trips(), law_.index_trips()};
  }

  const Out& out() const { return out_; }

 private:
  EncoderMonitorLaw law_;
  Out out_;
};

}  // namespace feltgate
