// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Measures CPU time of this process, so other programs on the machine do not count. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include <time.h>

namespace feltgate::bench {

/// CPU time of the action, seconds.
template <class Do>
double cpu_seconds(Do&& action) {
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double begin = now();
  action();
  return now() - begin;
}

}  // namespace feltgate::bench
