// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Frames of a browser cut into runs of a law. Documentation: docs/page.md
#pragma once

namespace feltgate::page {

/// How often something with a period runs in time that comes in pieces.
class Pace {
 public:
  /// Runs that fit into these seconds and what was left before; the rest waits for the next call.
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
