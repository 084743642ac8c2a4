// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What every engine of the benchmark is given: pins and register writes on a clock for those that
// have pins, sampled counts tick by tick for those that have none. Documentation: docs/bench.md
#pragma once

#include <string>
#include <vector>

#include "loop/loop.hpp"
#include "loop/scenario.hpp"
#include "plant/parameters.hpp"
#include "reference/real_chain.hpp"

namespace feltgate::bench {

/// One scene, without the plant.
struct Work {
  /// A write that holds from this tick on.
  struct TickWrite {
    std::size_t tick = 0;
    int address = 0;
    std::uint32_t data = 0;
    double value = 0;
  };

  std::string name;
  double simulated_s = 0;
  RunInputs inputs;
  std::vector<ChainIn> ticks;
  std::vector<TickWrite> writes;  ///< of parameters; control words are in `ticks`
};

struct Scene {
  Scenario scenario;
  plant::Parameters plant;
};

/// A shipped scene of the repository `root`, by name, with the plant that it names. Throws
/// std::invalid_argument when it is not there.
Scene read_scene(const std::string& root, const std::string& name);

/// The scene run once in closed loop on the twin of `design`; what reached the core is kept.
Work record_scene(const Scene& scene, const std::string& design);

/// Motion of single counts, back and forth and far apart, under torques of a few steps:
/// quantisation shows here and in no noise. `seconds` of it.
Work slow_small_signals(const std::string& design, double seconds);

}  // namespace feltgate::bench
