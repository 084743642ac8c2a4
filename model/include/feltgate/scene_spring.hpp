// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_spring.sv: tau = k * (reference - position). Tension acts on both
// sides of the reference, compression only below the contact. Documentation:
// docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "feltgate/scene_part.hpp"

namespace feltgate {

/// The law, in number policy N, for design D.
template <class D, class N>
struct SceneSpringLaw {
  using Scene = ScenePartLaw<D, N>;
  using Distance = typename Scene::Distance;

  /// k * distance, rounded; in compression 0 for a negative distance, since the spring only pushes.
  template <class Product>
  static typename Scene::Torque torque(Distance distance, Product k_times_distance, bool tension) {
    if (!tension && distance < Distance{}) return {};
    return Scene::rounded(k_times_distance);
  }
  /// The torque in one tick.
  template <class W>
  static typename Scene::Torque torque(const W& w, bool tension, std::int32_t position) {
    const Distance x =
        Scene::distance(position, tension ? w.tension_rest() : w.compression_contact());
    if (tension) return torque(x, x * w.tension_stiffness(), true);
    return torque(x, x * w.compression_stiffness(), false);
  }
};

}  // namespace feltgate
