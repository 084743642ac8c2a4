// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Columns of a run with several axes, in the order of axes_columns(). Documentation:
// docs/devices.md
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "sim/axes_loop/axes_scene.hpp"
#include "sim/axes_loop/device_signals.hpp"

namespace feltgate {

/// Name of a column of one axis, "NAME.n".
inline std::string of_axis(const char* name, std::size_t axis) {
  return fmt::format("{}.{}", name, axis);
}

/// The columns of a scene on this kind of plant, in order.
template <class Plant>
std::vector<std::string> columns_of(const AxesScene& scene) {
  std::vector<std::string> all{"time_s"};
  for (std::size_t n = 0; n < Plant::axes; ++n) {
    for (const char* name : {"theta_rad", "position_rad", "velocity_rad_s", "tau_ref_nm",
                             "tau_hat_nm", "motor_torque_nm", "law_nm", "limits", "faults"}) {
      all.push_back(of_axis(name, n));
    }
  }
  const auto own = DeviceSignals<Plant>::names();
  all.insert(all.end(), own.begin(), own.end());
  if (scene.plane) {
    for (const std::string& name : PlaneHost::names(scene.plane->axes)) all.push_back(name);
  }
  return all;
}

}  // namespace feltgate
