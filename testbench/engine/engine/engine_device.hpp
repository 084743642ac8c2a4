// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The engine's twin with a host and ticks of 50 clocks. Documentation:
// docs/blocks/engine.md
#pragma once

#include <functional>

#include "catch.hpp"

#include "engine_adapter.hpp"
#include "machine_programs.hpp"

namespace feltgate::test {

// The engine of AXES axes in lock-step.

using Twin = EngineTwin<AXES>;
using Bench = LockStep<Vengine, Twin, EngineAdapter<AXES>>;
using Host = EngineHost;

using H = EngineMap::H;

constexpr int kTick = 50;

/// The twin with an image in its memories.
struct Device {
  Twin twin;
  Twin::In in;
  int since = 0;
  std::int64_t clocks = 0;
  int jumps = 0;    ///< clocks in which the twin tells that torques may jump
  int results = 0;  ///< number of fresh results

  std::vector<Twin::In> inputs;

  Device() { twin.reset(); }
  explicit Device(const EngineMemory& m) {
    twin.memory() = m;
    twin.reset();
    twin.memory().line_base = m.line_base;
  }
  Twin::Out out() const { return twin.peek(in); }
  void clock() {
    in.tick = ++since == kTick;
    if (in.tick) since = 0;
    if (in.tick) ++in.tick_count;
    twin.clock(in);
    inputs.push_back(in);
    in.enter = in.crc_start = in.write = in.read = false;
    ++clocks;
    jumps += out().changed;
    results += out().fresh;
  }
  void clock(int n) {
    for (int k = 0; k < n; ++k) clock();
  }
  void write(int addr, std::uint32_t word) {
    in.addr = static_cast<unsigned>(addr);
    in.wdata = word;
    in.write = true;
    clock();
    while (out().busy) clock();
  }
  std::uint32_t read(int addr) {
    in.addr = static_cast<unsigned>(addr);
    while (out().busy) clock();
    clock(32);
    const std::uint32_t word = out().rdata;
    in.read = true;
    clock();
    return word;
  }
  bool status(int bit) { return (read(H::status) >> bit & 1U) != 0; }
  /// Returns the number of clocks to the next fresh result, at most `limit`.
  int until_fresh(int limit = 5000) {
    for (int k = 1; k <= limit; ++k) {
      clock();
      if (out().fresh) return k;
    }
    return -1;
  }
};

inline EngineMemory with_parameters(std::initializer_list<std::int32_t> words) {
  EngineMemory m;
  int n = 0;
  for (const std::int32_t w : words) m.set_data(kParameter + n++, w);
  return m;
}

/// A device whose image was loaded over the port, so that the RTL can run the same inputs.
struct LoadedDevice : Device {
  explicit LoadedDevice(const EngineMemory& m) {
    Host host;
    host.load(m);
    for (const Access& a : host.queue) write(static_cast<int>(a.addr), a.word);
  }
  /// Runs the recorded inputs, RTL against twin.
  void play() {
    Twin again = Bench("engine", 1).run_list(inputs);
    CHECK(again.memory().data == twin.memory().data);
    CHECK(again.memory().table == twin.memory().table);
  }
};

/// A law with one output in thread 0, and words for the other axes.
inline EngineMemory image(const std::function<void(EngineMemory&, int)>& make,
                          std::initializer_list<std::int32_t> parameters) {
  EngineMemory m = with_parameters(parameters);
  make(m, 0);
  return m;
}

}  // namespace feltgate::test
