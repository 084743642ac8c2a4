// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Scenes of several axes by name, run by the program's own loop. docs/devices.md
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "axes_loop/axes_run.hpp"
#include "catch.hpp"

namespace feltgate::test {

inline std::string device_file(const std::string& name) {
  return std::string(FELTGATE_ROOT) + "/vectors/devices/" + name + ".toml";
}

inline AxesScene scene_named(const std::string& name) {
  return read_axes_scene(std::string(FELTGATE_ROOT) + "/vectors/scenes/" + name + ".toml",
                         device_file);
}

/// On the device's own design; `row` as in AxesRunOptions.
inline AxesResult run_scene(const AxesScene& scene, const std::string& engine,
                            std::function<void(const std::vector<double>&)> row = nullptr,
                            int row_every = 1) {
  const std::string design = device_of(scene) + "_law";
  const AxesDesignMakers* made = find_axes_design(design);
  REQUIRE(made != nullptr);
  const auto law =
      make_axes_law(std::string(FELTGATE_ROOT) + "/rtl/laws/" + scene.scenario.law + ".law",
                    made->info(), axes_of(scene));
  AxesRunOptions options;
  options.design = design;
  options.engine = engine;
  options.law = law.get();
  options.row = std::move(row);
  options.row_every = row_every;
  return run_axes(scene, options);
}

}  // namespace feltgate::test
