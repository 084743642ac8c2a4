// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/snapshot.sv, clock by clock. Documentation: docs/blocks/snapshot.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Clocked twin.
template <bool ReadBack>
class Snapshot {
 public:
  struct In {
    int slot_fetch = 0;  ///< 6 bits
    std::uint64_t wave = 0;
    std::uint32_t status = 0, position = 0, tick_count = 0, index_position = 0;
    std::uint16_t error_count = 0, rejected_count = 0;
  };
  struct Out {
    std::uint32_t word = 0;
    bool valid = false;
    int slot = 0;
  };

  /// The registers have no reset; this clears them.
  void reset() { *this = Snapshot{}; }

  void clock(const In& in) {
    taken_ = kNothing;
    if (in.slot_fetch == Map::first_wave_clock - 1) taken_ = Map::R::status;
    for (const int t : {Map::R::position, Map::R::tick, Map::R::index, Map::R::encoder}) {
      if (((in.wave >> (t - 1)) & 1u) != 0) taken_ = t;
    }
  }

  Out peek(const In& in) const {
    using R = Map::R;
    Out out;
    out.slot = (in.slot_fetch - Map::first_wave_clock) & 63;
    if constexpr (ReadBack) {
      for (const int t : {R::status, R::position, R::tick, R::index, R::encoder, R::velocity,
                          R::tau_hat, R::tau_ref, R::current_ref, R::voltage, R::duty}) {
        out.valid = out.valid || ((in.wave >> t) & 1u) != 0;
      }
      switch (taken_) {
        case R::status:
          out.word = in.status;
          break;
        case R::position:
          out.word = in.position;
          break;
        case R::tick:
          out.word = in.tick_count;
          break;
        case R::index:
          out.word = in.index_position;
          break;
        case R::encoder:
          out.word = std::uint32_t{in.rejected_count} << 16 | in.error_count;
          break;
        default:
          break;
      }
    }
    return out;
  }

 private:
  static constexpr int kNothing = -1;
  int taken_ = kNothing;
};

}  // namespace feltgate
