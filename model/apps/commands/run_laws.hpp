// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The parts of feltgate run for scenes with a law or a device of several axes. A program that runs
// only scenes of the core does not link them. Documentation: docs/architecture.md
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/loop/scene_law.hpp"

namespace feltgate {

/// Options of `feltgate run`.
struct RunArguments {
  std::string scene, design, plant, engine = "all", report, json, csv, fst, record, events, states;
  std::vector<std::string> set;
  std::uint64_t seed = 1;
  int every = 0;            ///< 0: sane_every()
  double torque_scale = 0;  ///< 0: the scene as it is
  bool quiet = false;
  bool columns = false;  ///< only print the names of the columns
};

/// Functions that run_axes.cpp, if linked, sets before main().
struct LawScenes {
  /// As make_scene_law().
  std::unique_ptr<SceneLaw> (*law)(const std::string& path, const DesignInfo& design) = nullptr;
  /// Runs the scene of this file and prints the result; returns the exit code.
  int (*axes)(const std::string& scene_path, const RunArguments& arguments) = nullptr;
};
/// The functions of this program.
LawScenes& law_scenes();

}  // namespace feltgate
