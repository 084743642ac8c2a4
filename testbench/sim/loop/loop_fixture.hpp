// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Short runs of shipped scenes. Documentation: docs/json.md
#pragma once

#include <string>

#include "sim/loop/loop.hpp"
#include "sim/plant/plant_file.hpp"

namespace feltgate {

inline Scenario shipped_scene(const std::string& name) {
  Scenario s = read_scenario(std::string(FELTGATE_ROOT) + "/vectors/scenes/" + name + ".toml");
  return s;
}

inline plant::Parameters p24() {
  return plant::read_plant_file(std::string(FELTGATE_ROOT) + "/vectors/plants/p24.toml");
}

inline RunResult run_on_p24(Scenario scene, const RunOptions& options) {
  const plant::Parameters plant = p24();
  resolve_effects(scene, plant.effects);
  return run_scenario(scene, plant, options);
}

}  // namespace feltgate
