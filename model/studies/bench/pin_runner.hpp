// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs engines with pins and a clock on recorded inputs. Documentation: docs/bench.md
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "sim/engines/engine.hpp"
#include "studies/bench/runner.hpp"

namespace feltgate::bench {

/// Runs all `inputs` on an engine that was just reset; calls `each` with every snapshot.
template <class Each>
void play(Engine& engine, const RunInputs& inputs, Each&& each) {
  constexpr Clock stretch = 50'000;
  const EncoderEvent* const edges = inputs.edges.data();
  std::size_t told = 0;
  auto write = inputs.writes.begin();
  while (engine.now() < inputs.clocks) {
    for (; write != inputs.writes.end() && write->clock <= engine.now(); ++write) {
      engine.write(write->address, write->data);
    }
    Clock end = std::min(engine.now() + stretch, inputs.clocks);
    if (write != inputs.writes.end()) end = std::min(end, write->clock);
    std::size_t to = told;
    while (to < inputs.edges.size() && edges[to].clock < end) ++to;
    engine.advance(end - engine.now(), edges + told, edges + to);
    told = to;
    for (const Snapshot& s : engine.snapshots()) each(s);
  }
}

/// Runs an engine of the program, chosen by its kind.
class PinRunner : public Runner {
 public:
  PinRunner(const char* name, std::unique_ptr<Engine> engine)
      : Runner(name, Arithmetic::integer), engine_(std::move(engine)) {}

  bool has_clocks() const override { return true; }
  void prepare(const Work& work) override { engine_->reset(1, work.inputs.pins); }
  void run(const Work& work) override {
    play(*engine_, work.inputs, [](const Snapshot&) {});
  }
  void inspect(const Work& work, const Inspector& each) override;

 private:
  std::unique_ptr<Engine> engine_;
};

/// Makes the runner "rtl", "twin_clock" or "twin_event" of the design `lever`.
std::unique_ptr<Runner> make_pin_runner(const std::string& name);

}  // namespace feltgate::bench
