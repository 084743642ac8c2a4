// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the tests of rates and margins share: shipped designs, scenes and laws.
#pragma once

#include <string>

#include "design/design.hpp"
#include "sim/axes_loop/axes_scene.hpp"
#include "sim/plant/plant_file.hpp"
#include "studies/rates/slow_law.hpp"

namespace feltgate::rates {

inline const std::string root = FELTGATE_ROOT;
constexpr double count_rad = 2 * 3.14159265358979323846 / 4096;

inline design::Elaborated elaborated(const std::string& name) {
  return design::elaborate(design::read_design(root + "/rtl/designs/" + name + ".toml"),
                           design::read_registers(root + "/rtl/registers.toml"));
}
/// Of a device, by its path in the repository.
inline AxesScene axes_scene(const std::string& path) {
  return read_axes_scene(root + "/" + path, [](const std::string& device) {
    return root + "/vectors/devices/" + device + ".toml";
  });
}
inline AxesScene scene_of(const std::string& name) {
  return axes_scene("vectors/scenes/" + name + ".toml");
}
inline plant::Parameters plant_named(const std::string& name) {
  return plant::read_plant_file(root + "/vectors/plants/" + name + ".toml");
}
/// Linear, with viscous friction: what turns freely must come to rest.
inline plant::Parameters lever() {
  plant::Parameters p = plant_named("linear");
  p.effects.viscous = true;
  return p;
}
inline LawSource shipped(const std::string& name) {
  return {root + "/rtl/laws/" + name + ".law", ""};
}

}  // namespace feltgate::rates
