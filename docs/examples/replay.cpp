// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
// A recording through the twin, with binary32 and binary64 beside it: the largest differences.
#include "feltgate/loop/replay.hpp"
#include <cmath>
#include <cstdio>
#include "feltgate/traces/open.hpp"
int main(int, char** argv) {  // argv[1]: a recording, such as traces/membrane.vec of the package
  const auto recording = feltgate::traces::open(argv[1], {});
  feltgate::ReplayOptions options;
  options.engine = "twin,float,double";
  options.scene = "membrane";
  double fixed = 0, binary32 = 0;  // against binary64, rad/s
  options.row = [&](const feltgate::Row& r) {
    fixed = std::fmax(fixed, std::abs(r.engines[0].velocity_rad_s - r.engines[2].velocity_rad_s));
    binary32 =
        std::fmax(binary32, std::abs(r.engines[1].velocity_rad_s - r.engines[2].velocity_rad_s));
  };
  const feltgate::RunResult run = feltgate::run_replay(*recording, argv[1], options);
  std::printf("%.3f s: fixed %.2e, float %.2e rad/s\n", run.simulated_s, fixed, binary32);
}
