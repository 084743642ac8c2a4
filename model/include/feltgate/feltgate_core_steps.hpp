// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Functions of FeltgateCore that take the compiler long. A program includes them with
// feltgate_core.hpp; with FELTGATE_COMPILED_TWIN they are in the library feltgate_twin_parts instead,
// which this repository's programs link. docs/architecture.md
#pragma once

#include "feltgate/feltgate_core.hpp"

#ifndef FELTGATE_COMPILED_TWIN
#define FELTGATE_INLINE inline
#else
#define FELTGATE_INLINE
#endif

namespace feltgate {

FELTGATE_INLINE FeltgateCore::FeltgateCore(const axis::Design& d, bool reads)
    : axis_(d),
      encoder_(encoder_of(d)),
      bridge_(bridge_of(d)),
      heartbeat_(d),
      clocks_per_tick_(d["CLOCKS_PER_TICK"]),
      reads_(reads),
      beats_(d["HEARTBEAT"] != 0),
      plain_(std::holds_alternative<axis::Quadrature>(encoder_) &&
             std::holds_alternative<axis::HBridge>(bridge_)) {
  reset();
}

FELTGATE_INLINE void FeltgateCore::reset(const CoreIn& in) {
  sockets([&](auto& encoder, auto& bridge) {
    settle(encoder, bridge);
    axis_.reset({encoder.out(), bridge.out(), in});
    encoder.reset();
    bridge.reset();
    heartbeat_.reset();
    out_.heartbeat = false;
    gate_clocks_ = {};
    writes_ = 0;
    show(in, encoder, bridge);
  });
}

FELTGATE_INLINE void FeltgateCore::clock(const CoreIn& in) {
  sockets([&](auto& encoder, auto& bridge) {
    settle(encoder, bridge);
    clock(in, encoder, bridge);
  });
}

FELTGATE_INLINE void FeltgateCore::settle() {
  if (!whole_.on) return;
  sockets([this](auto& encoder, auto& bridge) { settle(encoder, bridge); });
}

FELTGATE_INLINE bool FeltgateCore::may_trip(const CoreIn& in) const {
  if (!plain_ || !quadrature().calm(in, axis_.encoder())) return true;
  return !(whole_.on && whole_.sampled) &&
         axis_.may_trip({quadrature().out(), h_bridge().out(), in});
}

FELTGATE_INLINE void FeltgateCore::flip(int address, int bit) { axis_.flip(address, bit); }

FELTGATE_INLINE std::uint32_t FeltgateCore::word(int slot) const {
  if (!out_.snapshot_valid) return axis_.word(slot);
  return axis::Snapshot::at(slot, axis_out(CoreIn{}).snapshot);
}

FELTGATE_INLINE int FeltgateCore::on_time(std::size_t leg) const {
  return std::visit([leg](const auto& bridge) { return bridge.on_time(leg); }, bridge_);
}

FELTGATE_INLINE axis::Axis::Out FeltgateCore::axis_out(const CoreIn& in) const {
  return at_axis<axis::Axis::Out>(
      in, [this](const axis::Axis::In& to_axis) { return axis_.out(to_axis); });
}

FELTGATE_INLINE axis::Safe FeltgateCore::safe(const CoreIn& in) const {
  if (plain_) return axis_.safe({quadrature().out(), h_bridge().out(), in});
  return at_axis<axis::Safe>(in,
                             [this](const axis::Axis::In& to_axis) { return axis_.safe(to_axis); });
}

FELTGATE_INLINE void FeltgateCore::go(const CoreIn& in, std::int64_t clocks, Tell on_snapshot,
                                      bool amid) {
  sockets([&](auto& encoder, auto& bridge) {
    while (clocks > 0) {
      const bool may = amid || clocks >= clocks_per_tick_;
      if (whole_.on ? held(in) : may && begin(in, encoder, bridge)) {
        clocks -= step(in, clocks, on_snapshot, encoder, bridge);
      } else {
        settle(encoder, bridge);
        clock(in, encoder, bridge);
        if (out_.snapshot_valid) on_snapshot();
        --clocks;
      }
    }
  });
}

}  // namespace feltgate

#undef FELTGATE_INLINE
