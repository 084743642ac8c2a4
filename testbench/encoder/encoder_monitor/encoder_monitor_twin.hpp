// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/encoder/encoder_monitor.sv, clock by clock. Documentation:
// docs/blocks/encoder.md
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
    std::uint32_t count = 0, zero = 0;
    std::uint8_t step = 0;
    bool set_zero = false;
  };
  struct Out {
    bool moved = false, chatters = false, trip = false, index_trip = false, flip_trip = false;
  };

  explicit EncoderMonitor(int edge_bits = 6, bool fast = false)
      : edge_bits_(edge_bits), fast_(fast) {}

  void reset() { *this = EncoderMonitor(edge_bits_, fast_); }

  void clock(const In& in) {
    out_.trip = out_.index_trip = false;
    const bool parity = odd(in.count ^ in.zero);
    out_.flip_trip = parity != parity_q_ && in.step == 0 && !zeroed_q_;
    parity_q_ = parity;
    zeroed_q_ = in.set_zero;
    if (((in.wave >> Map::T::levels) & 1u) == 0) return;
    law_.tick(in.levels, in.tick_count, in.index_wrong, in.count);
    out_ = {law_.moved(), law_.chatters(), law_.trips(), law_.index_trips(), out_.flip_trip};
  }

  const Out& out() const { return out_; }

 private:
  static bool odd(std::uint32_t word) {
    bool ones = false;
    for (; word != 0; word &= word - 1) ones = !ones;
    return ones;
  }

  int edge_bits_;
  bool fast_;
  EncoderMonitorLaw law_{edge_bits_, fast_};
  bool parity_q_ = false, zeroed_q_ = false;
  Out out_;
};

}  // namespace feltgate
