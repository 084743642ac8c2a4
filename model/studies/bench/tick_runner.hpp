// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs chains without pins, tick by tick on sampled counts. All chains run in the same loop, so
// that only the arithmetic differs. Documentation: docs/bench.md
#pragma once

#include <string>

#include "studies/bench/runner.hpp"

namespace feltgate::bench {

/// `Access` adapts a chain: write(chain, TickWrite) writes to it, show(chain) returns a tick.
template <class Chain, class Access>
class TickRunner : public Runner {
 public:
  TickRunner(const char* name, Arithmetic arithmetic)
      : Runner(name, arithmetic), chain_(std::make_unique<Chain>()) {}

  void prepare(const Work&) override { chain_->reset(); }
  void run(const Work& work) override {
    each_tick(work, [](Chain& chain) {
      // Forces the results into memory after each tick, as if somebody read them.
      asm volatile("" : : "r"(&chain) : "memory");
    });
  }
  void inspect(const Work& work, const Inspector& each) override {
    prepare(work);
    each_tick(work, [&each](Chain& chain) { each(Access::show(chain)); });
  }

 private:
  template <class After>
  void each_tick(const Work& work, After&& after) {
    Chain& chain = *chain_;
    std::size_t tick = 0;
    const auto until = [&](std::size_t end) {
      for (; tick < end; ++tick) {
        chain.tick(work.ticks[tick]);
        after(chain);
      }
    };
    for (const Work::TickWrite& w : work.writes) {
      until(w.tick);
      Access::write(chain, w);
    }
    until(work.ticks.size());
  }

  std::unique_ptr<Chain> chain_;
};

}  // namespace feltgate::bench
