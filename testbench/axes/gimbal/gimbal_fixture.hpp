// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Shared by the tests of the gimbal. docs/devices/three-axes.md
#pragma once

#include <string>

#include "../../sim/plant/plant_fixture.hpp"
#include "sim/plant/gimbal/gimbal.hpp"

namespace feltgate::plant {

inline constexpr double kDegree = 3.14159265358979323846 / 180.0;

inline std::string gimbal_file() {
  return std::string(FELTGATE_SOURCE_DIR) + "/vectors/devices/gimbal.toml";
}
inline GimbalParameters gimbal() { return read_gimbal_file(gimbal_file()); }

/// Three different moments in every body, so that no terms cancel.
inline GimbalBodies uneven_bodies() {
  return {{1e-4, 3e-4, 2e-4}, {4e-5, 7e-5, 9e-5}, {5e-5, 8e-5, 1.1e-4}, {3e-5, 5e-5, 2e-5}};
}

}  // namespace feltgate::plant
