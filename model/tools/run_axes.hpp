// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// feltgate run of a scene whose device has several axes. Documentation: docs/devices.md
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "axes_loop/axes_run.hpp"

namespace feltgate {

/// Options of `feltgate run` that such a scene takes.
struct AxesArguments {
  std::string scene_path, design, engine, json, csv, fst;
  std::vector<std::string> set;
  std::uint64_t seed = 1;
  int every = 0;  ///< 0: sane_every()
  bool quiet = false;
  bool columns = false;  ///< print their names alone
};

/// Runs and prints; the exit code.
int run_axes_scene(const AxesArguments& arguments);

/// The result for reading on a terminal, and as a JSON object, pretty-printed.
std::string axes_text(const AxesResult& result);
std::string axes_json(const AxesResult& result);

}  // namespace feltgate
