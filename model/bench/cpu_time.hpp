// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// CPU time of this process: another program on the machine does not count. Documentation:
// docs/bench.md
#pragma once

#include <time.h>

namespace feltgate::bench {

/// Seconds that the action takes.
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
