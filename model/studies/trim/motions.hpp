// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Varies the motion of a scene, for checks on motions that a search did not use.
// Documentation: docs/speed-for-accuracy.md
#pragma once

#include <cstdint>

#include "sim/axes_loop/axes_scene.hpp"
#include "sim/loop/scenario.hpp"

namespace feltgate::trim {

/// A scene with its plant.
struct Motion {
  Scenario scene;
  plant::Parameters plant;
  double amplitude = 1, speed = 1;  ///< factors against the scene's own
};

/// The scene with the hand's way 0.7 to 1.3 times as long and everything in it 0.7 to 1.4 times as
/// fast, started up to two counts away, on an encoder of another seed; a hand with a mass is
/// another person's (each constant 0.8 to 1.25 times). Where the host moves instead of the hand,
/// the set-points of torque and voltage are scaled by the amplitude. The same seed gives the same
/// motion; consecutive seeds go round far and near, fast and slow.
Motion perturbed(const Scenario& scene, const plant::Parameters& plant, std::uint64_t seed);

/// A scene of a device.
struct AxesMotion {
  AxesScene scene;
  double amplitude = 1, speed = 1;  ///< factors against the scene's own
};

/// The same for a device. The way is 0.9 to 1.1 times as long, because a linkage has an end; only
/// levers and slides start elsewhere. A plane's host stays as it is.
AxesMotion perturbed(const AxesScene& scene, std::uint64_t seed);

/// Whether an impedance holds it.
bool has_mass(const plant::Hand& hand);
bool has_mass(const DeviceSetup& device);

}  // namespace feltgate::trim
