// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_damper.sv: tau = -b * velocity. Documentation:
// docs/blocks/scenes.md
#pragma once

#include "feltgate/scene_part.hpp"

namespace feltgate {

/// The law, in number policy N, for design D.
template <class D, class N>
struct SceneDamperLaw {
  using Scene = ScenePartLaw<D, N>;
  using Velocity = typename N::template num<D::f.velocity.key()>;

  /// The product, rounded, then negated; a product below half a step gives 0 in both directions.
  template <class Product>
  static typename Scene::Torque torque(Product damping_times_velocity) {
    return negated(Scene::rounded(damping_times_velocity));
  }
  /// The torque in one tick.
  template <class W>
  static typename Scene::Torque torque(const W& w, Velocity velocity) {
    return torque(velocity * w.damper_damping());
  }
};

}  // namespace feltgate
