// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measures the time spent in short code that runs millions of times. One call in 61 is timed, since
// reading the clock takes as long as a tick of the twin; 61 is prime, so the calls of a tick take
// turns. Documentation: docs/architecture.md
#pragma once

#include <chrono>

namespace feltgate {

/// The stopwatch of one piece of code.
class SampledWatch {
 public:
  template <class Work>
  void time(Work&& work) {
    if (calls_++ % kEvery != 0) {
      work();
      return;
    }
    const auto begin = std::chrono::steady_clock::now();
    work();
    timed_ += std::chrono::steady_clock::now() - begin;
  }

  /// Estimated time of all calls, s.
  double seconds() const {
    if (calls_ == 0) return 0.0;
    const unsigned long long timed = (calls_ + kEvery - 1) / kEvery;
    return timed_.count() * static_cast<double>(calls_) / static_cast<double>(timed);
  }

 private:
  static constexpr unsigned kEvery = 61;
  unsigned long long calls_ = 0;
  std::chrono::duration<double> timed_{0};
};

}  // namespace feltgate
