// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_wall.sv: a unilateral spring-damper. Above the contact
// tau = k * (contact - position) - b * velocity, but never a pull.
// Documentation: docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "feltgate/scene_part.hpp"

namespace feltgate {

/// The law, in number policy N, for design D.
template <class D, class N>
struct SceneWallLaw {
  using Scene = ScenePartLaw<D, N>;
  using Distance = typename Scene::Distance;
  using Part = typename Scene::Part;
  using Velocity = typename N::template num<D::f.velocity.key()>;

  /// The difference of the two products, each truncated below its guard bits, rounded. It is 0
  /// outside the wall and where the wall would pull. The distance is negative inside the wall.
  static typename Scene::Torque torque(Distance distance, Part k_times_distance,
                                       Part b_times_velocity) {
    if (!(distance < Distance{})) return {};
    const auto tau = Scene::rounded(k_times_distance - b_times_velocity);
    return tau < decltype(tau){} ? tau : typename Scene::Torque{};
  }
  /// The torque in one tick.
  template <class W>
  static typename Scene::Torque torque(const W& w, std::int32_t position, Velocity velocity) {
    const Distance x = Scene::distance(position, w.wall_contact());
    return torque(x, Scene::part(x * w.wall_stiffness()), Scene::part(velocity * w.wall_damping()));
  }
};

}  // namespace feltgate
