// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Runs back-ends with pins and a clock on recorded inputs. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "sim/backends/backend.hpp"
#include "studies/bench/runner.hpp"

namespace feltgate::bench {

/// Runs all `inputs` on a back-end that was just reset; calls `each` with every snapshot.
template <class Each>
void play(Backend& backend, const RunInputs& inputs, Each&& each) {
  constexpr Clock stretch = 50'000;
  const EncoderEvent* const edges = inputs.edges.data();
  std::size_t told = 0;
  auto write = inputs.writes.begin();
  while (backend.now() < inputs.clocks) {
    for (; write != inputs.writes.end() && write->clock <= backend.now(); ++write) {
      backend.write(write->address, write->data);
    }
    Clock end = std::min(backend.now() + stretch, inputs.clocks);
    if (write != inputs.writes.end()) end = std::min(end, write->clock);
    std::size_t to = told;
    while (to < inputs.edges.size() && edges[to].clock < end) ++to;
    backend.advance(end - backend.now(), edges + told, edges + to);
    told = to;
    for (const Snapshot& s : backend.snapshots()) each(s);
  }
}

/// Runs a back-end of the program, chosen by its kind.
class PinRunner : public Runner {
 public:
  PinRunner(const char* name, std::unique_ptr<Backend> backend)
      : Runner(name, Arithmetic::integer), backend_(std::move(backend)) {}

  bool has_clocks() const override { return true; }
  void prepare(const Work& work) override { backend_->reset(1, work.inputs.pins); }
  void run(const Work& work) override {
    play(*backend_, work.inputs, [](const Snapshot&) {});
  }
  void inspect(const Work& work, const Inspector& each) override;

 private:
  std::unique_ptr<Backend> backend_;
};

/// Makes the runner "rtl", "twin_clock" or "twin_event" of the design `lever`.
std::unique_ptr<Runner> make_pin_runner(const std::string& name);

}  // namespace feltgate::bench
