// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_setpoint.sv: a constant torque. Documentation:
// docs/blocks/scenes.md
#pragma once

#include "feltgate/scene_part.hpp"

namespace feltgate {

/// The law, in number policy N, for design D.
template <class D, class N>
struct SceneSetpointLaw {
  using Scene = ScenePartLaw<D, N>;

  template <class W>
  static typename Scene::Torque torque(const W& w) {
    return Scene::whole(w.setpoint_torque());
  }
};

}  // namespace feltgate
