// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The benchmark: every engine on the same works, errors against 113 bits, equality of the integer
// engines, CPU time in interleaved repetitions. Documentation: docs/bench.md
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/runner.hpp"
#include "loop/figures.hpp"

namespace feltgate::bench {

/// Median of some samples with their ends.
struct Spread {
  double median = 0, low = 0, high = 0;
};
/// Precondition: not empty.
Spread spread(std::vector<double> samples);

struct EngineResult {
  std::string name;
  bool integer = false;
  Spread ns_per_tick;
  Spread speed;  ///< simulated seconds per second of CPU
  /// Of engines with a clock: clocks, and what a user pays for, ticks with all that the core does.
  std::optional<Spread> clocks_per_s, updates_per_s;
  std::vector<double> samples;  ///< ns per tick, one per repetition
  bool compared = false;        ///< the errors below were taken
  ErrorFigure velocity_rad_s, tau_hat_nm, torque_nm;
  std::uint64_t hash = 0;  ///< over every result of every tick; integer engines
};

/// The closed loop of one scene: core, bridge, motor, friction, encoder and hand.
struct LoopResult {
  std::string scene;
  double simulated_s = 0;
  Spread speed;
};

/// A shipped law: ns of a run.
struct LawResult {
  std::string name;
  int instructions = 0;
  Spread compiled, real, interpreted;  ///< C++ in fixed point, in double; the interpreter
};

/// What is promised, and what was measured.
struct Goal {
  std::string key, text;
  double goal = 0;
  bool at_most = false;  ///< the value shall stay below the goal instead of above
  Spread value;
  bool met() const { return at_most ? value.median <= goal : value.median >= goal; }
};

/// Proven bounds of the integer engines' errors, the worst over the works.
struct ErrorLimits {
  double velocity_rad_s = 0, tau_hat_nm = 0, torque_nm = 0;
};

struct Result {
  std::optional<ErrorLimits> bounds;
  std::vector<EngineResult> engines;
  std::vector<LoopResult> loops;
  std::vector<LawResult> laws;
  std::vector<Goal> goals;
  std::string divergence;  ///< first tick and signal in which integer engines differ; else empty
  double simulated_s = 0;  ///< of all works together
  std::size_t ticks = 0;
  const EngineResult* find(const std::string& name) const;
};

struct Options {
  int repetitions = 3;
  std::string laws;                           ///< folder of the shipped laws; empty: none
  int passes = 5;                             ///< of the fast engines in each repetition
  std::function<void(double done)> progress;  ///< called with 0..1; may be empty
};

/// Runs everything. `runners` as of make_runner(); errors need "quad" among them.
Result measure(const std::vector<std::unique_ptr<Runner>>& runners, const std::vector<Work>& works,
               const std::vector<Scene>& closed_loops, const Options& options);

}  // namespace feltgate::bench
