// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// A scene file of a device with several axes: as for a lever, but with `device` instead of `plant`,
// and with the hand of that device. Documentation: docs/scenes.md
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sim/axes_loop/plane_host.hpp"
#include "sim/loop/scenario.hpp"
#include "sim/plant/gimbal/gimbal.hpp"
#include "sim/plant/lever_set.hpp"
#include "sim/plant/pantograph/pantograph.hpp"

namespace feltgate {

struct PantographSetup {
  using Plant = plant::Pantograph;
  plant::PantographParameters parameters;
  plant::PenHand hand;
};

struct TwoLeversSetup {
  using Plant = plant::TwoLevers;
  plant::LeverSetParameters parameters;
  std::array<plant::Hand, 2> hand;  ///< hand on the first lever; object at the second
};

struct StylusSetup {
  using Plant = plant::Stylus;
  plant::LeverSetParameters parameters;
  std::array<plant::Hand, 3> hand;  ///< hand along x, y and z
};

struct GimbalSetup {
  using Plant = plant::Gimbal;
  plant::GimbalParameters parameters;
  plant::TurningHand hand;
};

using DeviceSetup = std::variant<PantographSetup, TwoLeversSetup, StylusSetup, GimbalSetup>;

/// A scene and the device that it names.
struct AxesScene {
  Scenario scenario;  ///< its hand is empty
  DeviceSetup device;
  std::string device_path;
  std::optional<PlaneHostSettings> plane;  ///< only for a device with a pen
};

/// Reads a scene and the device that it names; `find` converts that name to a path.
/// Errors: config::ConfigError "file:line: what; mend", and those of `find`.
AxesScene read_axes_scene(const std::string& path,
                          const std::function<std::string(const std::string&)>& find);

/// Number of axes of the device, and its name.
int axes_of(const AxesScene& scene);
const std::string& device_of(const AxesScene& scene);

/// Name of the design that is made for the device: "DEVICE_law" in rtl/designs.
std::string own_design(const AxesScene& scene);

/// Recordings that its hands follow.
std::vector<std::string> hand_files(const AxesScene& scene);

/// Jumps in the speed that a hand on one of two levers imposes: loop/speed_jumps.hpp.
std::vector<std::string> speed_jumps(const AxesScene& scene);

}  // namespace feltgate
