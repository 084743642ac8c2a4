// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Closed loops of the cases: a scenario made in code, run by RTL and twin in lock-step, by the twin
// alone, or by the chain in double driving the motor. Documentation: docs/extremes.md
#pragma once

#include <string>

#include "campaigns/extremes/bench.hpp"
#include "sim/loop/loop.hpp"

namespace feltgate::extremes {

enum class Driver { lock_step, twin, real };

/// Registers engines and chains of the design `wide`, the published lever with registers for every
/// Kp; may be called more than once.
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
  double rms() const;
  double low() const { return low_; }
  double high() const { return high_; }
  double range() const { return high_ - low_; }

 private:
  double sum_ = 0, low_ = 0, high_ = 0;
  std::int64_t n_ = 0;
};

}  // namespace feltgate::extremes
