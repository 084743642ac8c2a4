// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/snapshot.sv, clock by clock. Documentation: docs/blocks/snapshot.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Combinational; the bench clocks it all the same.
template <bool ReadBack>
class Snapshot {
 public:
  struct In {
    int slot_fetch = 0;  ///< 6 bits
    std::uint64_t wave = 0;
    std::uint32_t status = 0, faults = 0, position = 0, tick_count = 0, index_position = 0;
    std::uint16_t error_count = 0, rejected_count = 0;
  };
  struct Out {
    std::uint32_t word = 0;
    bool valid = false;
    int slot = 0;
  };

  void reset() {}
  void clock(const In&) {}

  Out peek(const In& in) const {
    using R = Map::R;
    Out out;
    out.slot = (in.slot_fetch - Map::first_wave_clock) & 63;
    if constexpr (ReadBack) {
      for (const int t :
           {R::status, R::faults, R::position, R::tick, R::index, R::encoder, R::velocity,
            R::tau_hat, R::tau_ref, R::current_ref, R::voltage, R::duty}) {
        out.valid = out.valid || ((in.wave >> t) & 1u) != 0;
      }
      const auto now = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
      if (now(R::status)) out.word = in.status;
      if (now(R::faults)) out.word = in.faults;
      if (now(R::position)) out.word = in.position;
      if (now(R::tick)) out.word = in.tick_count;
      if (now(R::index)) out.word = in.index_position;
      if (now(R::encoder)) out.word = std::uint32_t{in.rejected_count} << 16 | in.error_count;
    }
    return out;
  }
};

}  // namespace feltgate
