// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A core on a bench, whose inputs are encoder edges and register writes; its output is one sample
// per tick, from the core (RTL and twin in lock-step, or the twin alone) and from the same chain in
// double. And closed loops: a scenario made in code, run with a motor. Documentation:
// docs/extremes.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "campaigns/extremes/case.hpp"
#include "sim/loop/ensemble.hpp"
#include "sim/loop/loop.hpp"

namespace feltgate::extremes {

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

enum class Driver { lock_step, twin, real };

/// Registers engines and chains of the design `wide`, `paper` with registers for every Kp; may be
/// called more than once.
void use_wide_design();

/// Reads a plant from vectors/plants.
plant::Parameters shipped_plant(const Settings& settings, const std::string& name);

/// A motor and lever with only linear effects: inductance, back-EMF, and viscous friction `b`.
plant::Parameters linear_plant(const Settings& settings, double b_nm_s_rad);

/// Runs it, calls row(r) once per tick, and adds mismatches and device time to the outcome.
RunResult run_loop(const Scenario& scenario, const plant::Parameters& plant,
                   const std::string& design, Driver driver, Outcome* outcome,
                   const std::function<void(const Row&)>& row);

/// Puts a measured value into the columns of this driver.
void fill(Finding* finding, Driver driver, double value);

/// Root mean square and range of a signal.
class Spread {
 public:
  void add(double v) {
    sum_ += v * v;
    low_ = n_ == 0 || v < low_ ? v : low_;
    high_ = n_ == 0 || v > high_ ? v : high_;
    ++n_;
  }
  double rms() const { return n_ == 0 ? 0 : std::sqrt(sum_ / static_cast<double>(n_)); }
  double low() const { return low_; }
  double high() const { return high_; }
  double range() const { return high_ - low_; }

 private:
  double sum_ = 0, low_ = 0, high_ = 0;
  std::int64_t n_ = 0;
};

}  // namespace feltgate::extremes
