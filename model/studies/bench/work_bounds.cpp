// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The proven bounds for the motion of a work. Documentation: docs/error-bounds.md
#include "studies/bench/work.hpp"

#include <algorithm>
#include <cstdlib>

#include "sim/loop/scenario_bounds.hpp"

namespace feltgate::bench {

namespace {

/// Largest |N-method velocity| before its low-pass, rad/s.
double largest_velocity_rad_s(const design::Elaborated& e, const std::vector<ChainIn>& ticks) {
  const auto m1 = static_cast<std::size_t>(e.design.m1);
  int counts = 0;
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    const int before = k < m1 ? 0 : ticks[k - m1].travel;
    counts = std::max(counts, std::abs(static_cast<std::int16_t>(ticks[k].travel - before)));
  }
  return counts * e.rad_s_per_count();
}

std::string scene_name(const design::Elaborated& e, int number) {
  for (const design::Scene& s : e.registers.scenes) {
    if (s.number == number) return s.name;
  }
  return "free";
}

}  // namespace

bounds::ErrorBounds work_bounds(const design::Elaborated& e, const Work& work) {
  RunBounds run(e, std::max(largest_velocity_rad_s(e, work.ticks), hardly_any_rad_s));
  auto write = work.writes.begin();
  int scene = -1, mode = -1;
  for (std::size_t k = 0; k < work.ticks.size(); ++k) {
    for (; write != work.writes.end() && write->tick <= k; ++write) {
      for (const design::Word& w : e.words) {
        if (w.parameter.address == write->address) run.set(w.parameter.name, write->value, k > 0);
      }
    }
    const ChainIn& in = work.ticks[k];
    if (in.scene == scene && in.mode == mode) continue;
    scene = in.scene;
    mode = in.mode;
    run.render(scene_name(e, scene), mode);
  }
  return run.worst();
}

}  // namespace feltgate::bench
