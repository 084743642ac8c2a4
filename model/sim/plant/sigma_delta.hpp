// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Isolated sigma-delta modulator at a shunt: one bit for each of its clocks, whose mean is the
// current. Second order, y = x two clocks ago + the second difference of its error. docs/plant.md
#pragma once

#include <algorithm>

namespace feltgate::plant {

/// One modulator, clock by clock of its own clock.
class SigmaDelta {
 public:
  /// `full_scale_a` is the current at which the input clips: 320 mV over the shunt.
  explicit SigmaDelta(double full_scale_a = 1.0) : per_a_(1.0 / full_scale_a) {}

  /// A rising edge of its clock with this current in the shunt; true is a bit of +full scale.
  bool next(double current_a) {
    const double x = current_a * per_a_;
    const bool bit = second_ >= 0;
    const double y = bit ? 1 : -1;
    error_ = y - second_;
    second_ += first_ - 2 * y;
    first_ += x - y;
    // Beyond its range its states are held, as by the amplifiers' supplies.
    first_ = std::clamp(first_, -10.0, 10.0);
    second_ = std::clamp(second_, -20.0, 20.0);
    return bit;
  }

  /// Error of its one-bit quantiser at the last bit, in full scales.
  double error() const { return error_; }

 private:
  double per_a_;
  double first_ = 0, second_ = 0, error_ = 0;
};

}  // namespace feltgate::plant
