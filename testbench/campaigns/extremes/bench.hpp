// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core on a bench. Its inputs are encoder edges and register writes. Its output is one sample per
// tick, from the core (RTL and twin in lock-step, or the twin alone) and from the same chain in
// double. Documentation: docs/extremes.md
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "campaigns/extremes/case.hpp"
#include "sim/loop/ensemble.hpp"

namespace feltgate::extremes {

enum class Cores { lock_step, twin };

/// One set of signals, in SI units.
struct Signals {
  double velocity_rad_s = 0, tau_hat_nm = 0, tau_ref_nm = 0, current_a = 0, voltage_v = 0;
};

struct Sample {
  std::int64_t tick = 0;  ///< ticks since the bench began
  const Snapshot& raw;
  Signals core, real;
};

class Bench {
 public:
  Bench(const std::string& design, Cores cores);

  const DesignInfo& design() const { return ensemble_.design(); }
  double tick_s() const { return 1.0 / static_cast<double>(design().tick_hz); }
  Clock now() const { return ensemble_.lead_const().now(); }

  /// Sets a parameter, in its unit. Writes are carried out one per tick, in order.
  void set(const std::string& parameter, double value) {
    ensemble_.set_parameter(parameter, value);
  }
  /// Requests to arm (or disarm) with this scene and mode; ramps are off.
  void control(const std::string& scene, bool arm, int mode = 0);
  /// Sets a scene's parameters first, arms, and runs until the core is armed.
  void arm(const std::string& scene, int mode = 0);
  void stop(bool pressed);

  /// Moves the count by `by` at this clock; if |by| > 1 the pins jump. Clocks must not decrease.
  void move(Clock at, int by);
  /// Makes `count` moves of one count at an even rate, from clock `from` on.
  void turn(Clock from, double counts_per_s, std::int64_t count);
  std::int64_t count() const { return count_; }  ///< final position of the moves so far, in counts

  /// Runs `ticks` ticks and calls each(sample) after each.
  template <class Each>
  void run(std::int64_t ticks, Each&& each) {
    // The engine keeps the future edges; the snapshots of one stretch are kept together.
    const EncoderEvent *first = edges_.data(), *last = first + edges_.size();
    for (std::int64_t left = ticks; left > 0; left -= stretch_ticks) {
      const std::int64_t now = std::min(left, stretch_ticks);
      ensemble_.advance(now * design().clocks_per_tick, first, last,
                        [&](const Snapshot& s) { each(sample(s)); });
      first = last;
    }
    edges_.clear();
  }
  void run(std::int64_t ticks) {
    run(ticks, [](const Sample&) {});
  }
  std::int64_t ticks(double seconds) const;

  /// Adds mismatches and device time to the outcome of a case.
  void report(Outcome* outcome) const;
  Ensemble& ensemble() { return ensemble_; }

 private:
  static constexpr std::int64_t stretch_ticks = 5000;
  Sample sample(const Snapshot& s);

  Cores cores_;
  Ensemble ensemble_;
  std::vector<EncoderEvent> edges_;
  std::int64_t count_ = 0, ticks_ = 0;
};

/// Pins at a count: the Gray order 00, 01, 11, 10 of (A,B) counts up.
EncoderPins pins_at(std::int64_t count);

/// A row whose core column comes from a bench: RTL and twin where both ran (their outputs were
/// compared on every clock), the twin alone otherwise.
Finding finding(Cores cores, const std::string& what, const std::string& unit,
                const Expected& expected, double core, std::optional<double> real = {});

}  // namespace feltgate::extremes
