// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The benchmark: every back-end on the same works, errors against 113 bits, equality of the integer
// back-ends, CPU time in interleaved repetitions. Documentation: docs/speed-for-accuracy.md
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/loop/figures.hpp"
#include "studies/bench/runner.hpp"

namespace feltgate::bench {

/// Median, minimum and maximum of some samples.
struct Spread {
  double median = 0, low = 0, high = 0;
};
/// The spread of `samples`, which must not be empty.
Spread spread(std::vector<double> samples);

struct BackendResult {
  std::string name;
  bool integer = false;
  Spread ns_per_tick;
  Spread speed;  ///< simulated seconds per second of CPU
  /// Of back-ends with a clock: clocks per second, and complete ticks of the core per second.
  std::optional<Spread> clocks_per_s, updates_per_s;
  std::vector<double> samples;  ///< ns per tick, one per repetition
  bool compared = false;        ///< true: the errors below were measured
  ErrorFigure velocity_rad_s, tau_hat_nm, torque_nm;
  std::uint64_t hash = 0;  ///< hash of all results of all ticks; integer back-ends only
};

/// The closed loop of one scene: core, bridge, motor, friction, encoder and hand.
struct LoopResult {
  std::string scene;
  double simulated_s = 0;
  Spread speed;
};

/// Proven bounds of the integer back-ends' errors: the largest over all works.
struct ErrorLimits {
  double velocity_rad_s = 0, tau_hat_nm = 0, torque_nm = 0;
};

struct Result {
  std::optional<ErrorLimits> bounds;
  std::vector<BackendResult> engines;
  std::vector<LoopResult> loops;
  Spread device_ns;        ///< a tick of TwinDevice::tick_to
  std::string divergence;  ///< first tick and signal in which integer back-ends differ, or empty
  double simulated_s = 0;  ///< simulated time of all works together
  std::size_t ticks = 0;
  const BackendResult* find(const std::string& name) const;
};

struct Options {
  int repetitions = 3;
  int passes = 5;                             ///< passes of the fast back-ends per repetition
  std::function<void(double done)> progress;  ///< called with 0..1; may be empty
};

/// Runs the complete benchmark. `runners` come from make_runner(); errors are measured only if
/// "quad" is among them.
Result measure(const std::vector<std::unique_ptr<Runner>>& runners, const std::vector<Work>& works,
               const std::vector<Scene>& closed_loops, const Options& options);

/// Where and when the figures were measured.
struct Circumstances {
  std::string version, machine, compiler, date;
};
/// The circumstances of this program, now.
Circumstances circumstances();

/// The result as JSON (schema feltgate-bench/2) and as text.
std::string json(const Result& result, const std::vector<Work>& works, const Circumstances& c);
std::string text(const Result& result, const std::vector<Work>& works, const Circumstances& c);

}  // namespace feltgate::bench
