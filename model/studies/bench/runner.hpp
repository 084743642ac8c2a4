// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The benchmark's interface to a back-end: it runs a work as fast as possible, or shows every tick.
// Documentation: docs/speed-for-accuracy.md
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/backends/backend.hpp"
#include "studies/bench/work.hpp"

namespace feltgate::bench {

/// Number of raw results of a tick of an integer back-end, in the order of `raw_names`.
constexpr std::size_t raw_signals = 7;
using RawTick = std::array<std::int64_t, raw_signals>;
constexpr std::array<const char*, raw_signals> raw_names = {
    "velocity", "tau_hat", "tau_ref", "current_ref", "voltage", "duty", "limits"};

/// One tick of any back-end.
struct TickResult {
  double velocity_rad_s = 0, tau_hat_nm = 0;
  double torque_nm = 0;  ///< commanded: nominal torque constant times current reference
  RawTick raw{};         ///< of integer back-ends
};
using Inspector = std::function<void(const TickResult&)>;

enum class Arithmetic { integer, real };

class Runner {
 public:
  Runner(std::string name, Arithmetic arithmetic)
      : name_(std::move(name)), arithmetic_(arithmetic) {}
  virtual ~Runner() = default;
  const std::string& name() const { return name_; }
  bool integer() const { return arithmetic_ == Arithmetic::integer; }
  /// Whether the back-end simulates single clocks, so that clocks per second are defined.
  virtual bool has_clocks() const { return false; }

  /// Resets the back-end; not timed.
  virtual void prepare(const Work& work) = 0;
  /// Runs the whole work after prepare(); timed.
  virtual void run(const Work& work) = 0;
  /// Runs the whole work again, slowly, and calls `each` with every tick.
  virtual void inspect(const Work& work, const Inspector& each) = 0;

 private:
  std::string name_;
  Arithmetic arithmetic_;
};

/// Every back-end of the benchmark, in the order of its table.
std::vector<std::string> runner_names();
/// Makes a runner by name. Throws std::invalid_argument with the known names for an unknown one.
std::unique_ptr<Runner> make_runner(const std::string& name);

// Runs back-ends with pins and a clock on recorded inputs.

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
