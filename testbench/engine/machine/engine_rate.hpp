// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// How often a program runs in the engine's twin, clock by clock. Documentation:
// docs/blocks/engine.md
#pragma once

#include <cstdint>

#include "feltgate/engine.hpp"

namespace feltgate::test {

/// Runs of thread 0 and whether a start was missed, in so many ticks.
struct Seen {
  int fresh = 0;
  bool overrun = false;
};

template <int Axes>
Seen run(const EngineMemory& memory, int divider, int clocks_per_tick, int phase, int ticks) {
  using H = EngineMap::H;
  law::Engine<Axes> engine(0xffff);
  engine.reset();
  engine.memory() = memory;
  typename law::Engine<Axes>::In in;
  const auto write = [&](int address, int word) {
    in.addr = static_cast<unsigned>(address);
    in.wdata = static_cast<std::uint32_t>(word);
    in.write = true;
    engine.clock(in);
    in.write = false;
    for (int k = 0; k < 40; ++k) engine.clock(in);
  };
  write(H::divider0, divider);
  write(H::run, 1);
  for (int k = 0; k < phase; ++k) engine.clock(in);
  in.addr = static_cast<unsigned>(H::status);
  Seen seen;
  for (int k = 0; k < ticks * clocks_per_tick; ++k) {
    in.tick = k % clocks_per_tick == 0;
    engine.clock(in);
    seen.fresh += engine.out().fresh ? 1 : 0;
  }
  seen.overrun = (engine.out().rdata >> EngineMap::S::status_overrun & 1U) != 0;
  return seen;
}

}  // namespace feltgate::test
