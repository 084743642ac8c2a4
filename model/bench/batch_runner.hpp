// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The batch in the benchmark: every lane runs the same work. Documentation: docs/bench.md
#pragma once

#include <memory>
#include <stdexcept>

#include "batch/batch_chain.hpp"
#include "bench/runner.hpp"

namespace feltgate::bench {

template <class Show>
class BatchRunner : public Runner {
 public:
  explicit BatchRunner(const char* name)
      : Runner(name, Arithmetic::integer), chain_(std::make_unique<Batch>()) {}

  int lanes() const override { return Batch::lanes; }
  void prepare(const Work&) override { chain_->reset(); }
  void run(const Work& work) override {
    each_tick(work, [](Batch& chain) { asm volatile("" : : "r"(&chain) : "memory"); });
  }
  void inspect(const Work& work, const Inspector& each) override {
    prepare(work);
    each_tick(work, [&](Batch& chain) {
      const TickResult first = Show::lane(chain.results(), 0);
      for (std::size_t k = 1; k < Batch::lanes; ++k) {
        if (Show::lane(chain.results(), k).raw != first.raw) {
          throw std::logic_error("lanes of the batch with the same input differ");
        }
      }
      each(first);
    });
  }

 private:
  using Batch = BatchChain<typename Show::Design>;

  template <class After>
  void each_tick(const Work& work, After&& after) {
    auto write = work.writes.begin();
    for (std::size_t tick = 0; tick < work.ticks.size(); ++tick) {
      const ChainIn& in = work.ticks[tick];
      for (; write != work.writes.end() && write->tick <= tick; ++write) {
        for (int k = 0; k < Batch::lanes; ++k) chain_->set_word(k, write->address, write->data);
      }
      for (int k = 0; k < Batch::lanes; ++k) chain_->set_counts(k, in.position, in.travel);
      if (in.restart) chain_->restart();
      chain_->tick(in.armed, in.scene, static_cast<Mode>(in.mode));
      after(*chain_);
    }
  }

  std::unique_ptr<Batch> chain_;
};

}  // namespace feltgate::bench
