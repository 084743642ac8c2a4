// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Mean of a piecewise constant signal over each PWM period of whole clocks. docs/plant.md
#pragma once

#include <cstdint>
#include <stdexcept>

#include "feltgate/encoder_source.hpp"

namespace feltgate::plant {

/// Gets step means, e.g. Observables::motor_torque_mean_nm; periods start at clock `phase`.
class PeriodMean {
 public:
  /// Errors: std::invalid_argument if the period is below one clock.
  explicit PeriodMean(Clock period_clocks, Clock phase = 0)
      : period_(period_clocks), left_(period_clocks) {
    if (period_clocks < 1) throw std::invalid_argument("PWM period below one clock");
    const Clock offset = phase % period_;
    if (offset > 0) left_ = offset;
    partial_ = offset > 0;
  }

  /// Adds `value`, held over `clocks`; returns how many periods ended in that time.
  int add(Clock clocks, double value) {
    int ended = 0;
    while (clocks > 0) {
      const Clock part = clocks < left_ ? clocks : left_;
      sum_ += value * static_cast<double>(part);
      clocks -= part;
      left_ -= part;
      if (left_ > 0) continue;
      if (!partial_) {
        mean_ = sum_ / static_cast<double>(period_);
        ++periods_;
        ++ended;
      }
      partial_ = false;
      sum_ = 0.0;
      left_ = period_;
    }
    return ended;
  }

  /// Mean of the last full period, in the unit of the signal; 0 before the first.
  double mean() const { return mean_; }
  std::int64_t periods() const { return periods_; }

 private:
  Clock period_;
  Clock left_;
  bool partial_ = false;
  double sum_ = 0.0;
  double mean_ = 0.0;
  std::int64_t periods_ = 0;
};

}  // namespace feltgate::plant
