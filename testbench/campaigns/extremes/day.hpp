// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A day of device time on the twin of the whole core, with every tick simulated. Documentation:
// docs/extremes.md
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "campaigns/extremes/bench.hpp"
#include "feltgate/feltgate_core.hpp"
#include "feltgate/generated/lever.hpp"

namespace feltgate::extremes {

/// The core of the design `lever`, armed in the scene `free`, with an encoder that moves edge by
/// edge.
class LongRun {
 public:
  LongRun() {
    wait(10);
    in_.arm = true;
    wait(10);
  }

  /// `ticks` ticks without an edge.
  void wait(std::int64_t ticks) { clocks(ticks * Lever::clocks_per_tick); }
  /// Moves `counts` up or down, one count every `clocks_each` clocks.
  void turn(std::int64_t counts, std::int64_t clocks_each) {
    const int step = counts > 0 ? 1 : -1;
    for (std::int64_t k = std::abs(counts); k > 0; --k) {
      clocks(clocks_each);
      count_ += step;
      ++edges_;
      in_.encoder = pins_at(count_);
    }
  }
  /// Moves forth and back over one edge.
  void dither(std::int64_t edges, std::int64_t clocks_each) {
    for (std::int64_t k = 0; k < edges; ++k) turn(k % 2 == 0 ? 1 : -1, clocks_each);
  }
  /// Runs to the start of this tick.
  void until_tick(std::int64_t tick) { clocks(tick * Lever::clocks_per_tick - clock_); }

  std::int64_t stepped_ticks() const { return clock_ / Lever::clocks_per_tick; }
  std::int64_t count() const { return count_; }
  std::int64_t edges() const { return edges_; }
  const CoreOut& out() const { return core_.out(); }

 private:
  void clocks(std::int64_t n) {
    clock_ += n;
    core_.run(in_, n, [] {});
  }

  FeltgateCore<Lever> core_;
  CoreIn in_;
  std::int64_t clock_ = 0, count_ = 0, edges_ = 0;
};

}  // namespace feltgate::extremes
