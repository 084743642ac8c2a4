// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The input of every back-end in the benchmark: pins and register writes on a clock for back-ends
// with pins, sampled counts per tick for back-ends without. Documentation:
// docs/speed-for-accuracy.md
#pragma once

#include <string>
#include <vector>

#include "sim/loop/loop.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/plant/parameters.hpp"
#include "sim/reference/real_chain.hpp"
#include "studies/bounds/error_bounds.hpp"

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
  std::vector<TickWrite> writes;  ///< writes of parameters; control words are in `ticks`
};

struct Scene {
  Scenario scenario;
  plant::Parameters plant;
};

/// Reads a shipped scene of the repository `root`, by name, with the plant that it names. Throws
/// std::invalid_argument when the scene does not exist.
Scene read_scene(const std::string& root, const std::string& name);

/// Runs the scene once in closed loop on the twin of `design`, and records the inputs of the core.
Work record_scene(const Scene& scene, const std::string& design);

/// Motion of single counts, back and forth and far apart, under torques of a few LSB, for
/// `seconds`: quantisation is visible in it because no noise covers it.
Work slow_small_signals(const std::string& design, double seconds);

/// Proven error bounds (docs/error-bounds.md) for all scenes, modes and parameters of the work, up
/// to its largest velocity.
bounds::ErrorBounds work_bounds(const design::Elaborated& e, const Work& work);

}  // namespace feltgate::bench
