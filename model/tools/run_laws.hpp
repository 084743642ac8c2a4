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

#include "loop/scene_law.hpp"

namespace feltgate {

/// Options of `feltgate run` that apply to a scene of several axes.
struct AxesArguments {
  std::string scene_path, design, engine, json, csv, fst;
  std::vector<std::string> set;
  std::uint64_t seed = 1;
  int every = 0;  ///< 0: sane_every()
  bool quiet = false;
  bool columns = false;  ///< only print the names of the columns
};

/// Functions that run_axes.cpp, if linked, sets before main().
struct LawScenes {
  /// As make_scene_law().
  std::unique_ptr<SceneLaw> (*law)(const std::string& path, const DesignInfo& design) = nullptr;
  /// Runs the scene and prints the result; returns the exit code.
  int (*axes)(const AxesArguments& arguments) = nullptr;
};
/// The functions of this program.
LawScenes& law_scenes();

}  // namespace feltgate
