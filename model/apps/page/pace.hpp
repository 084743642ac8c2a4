// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Divides the frames of a browser into runs of a law. Documentation: docs/page.md
#pragma once

namespace feltgate::page {

/// Counts the runs of a periodic task when time arrives in pieces.
class Pace {
 public:
  /// Number of runs that fit in `seconds` plus the previous remainder; keeps the new remainder.
  int runs(double seconds, double period_s) {
    owed_s_ += seconds;
    const int fit = static_cast<int>(owed_s_ / period_s);
    if (fit >= 1) owed_s_ -= fit * period_s;
    return fit;
  }

 private:
  double owed_s_ = 0;
};

}  // namespace feltgate::page
