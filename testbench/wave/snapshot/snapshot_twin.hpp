// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/wave/snapshot.sv, clock by clock. Documentation: docs/architecture.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"

namespace feltgate {

template <bool ReadBack>
class Snapshot {
 public:
  struct In {
    int slot_fetch = 0;  ///< 6 bits
    std::uint64_t wave = 0;
    std::uint32_t status = 0, faults = 0, position = 0, tick_count = 0, index_position = 0;
    std::uint16_t error_count = 0, rejected_count = 0;
    std::uint32_t operand = 0;  ///< the operand bus, 0 in the clocks of the words above
  };
  struct Out {
    bool valid = false;
    int slot = 0;  ///< these two stand until the next word
    std::uint32_t data = 0;
  };

  void reset() { out_ = Out(); }
  const Out& out() const { return out_; }

  void clock(const In& in) {
    if constexpr (!ReadBack) return;
    const auto now = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    out_.valid = false;
    for (const int t : {R::status, R::faults, R::position, R::tick, R::index, R::encoder,
                        R::velocity, R::tau_hat, R::tau_ref, R::current_ref, R::voltage, R::duty}) {
      out_.valid = out_.valid || now(t);
    }
    if (!out_.valid) return;
    out_.slot = (in.slot_fetch - Map::first_wave_clock) & 63;
    out_.data = in.operand;
    if (now(R::status)) out_.data |= in.status;
    if (now(R::faults)) out_.data |= in.faults;
    if (now(R::position)) out_.data |= in.position;
    if (now(R::tick)) out_.data |= in.tick_count;
    if (now(R::index)) out_.data |= in.index_position;
    if (now(R::encoder)) out_.data |= std::uint32_t{in.rejected_count} << 16 | in.error_count;
  }

 private:
  using R = Map::R;

  Out out_;
};

}  // namespace feltgate
