// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_membrane.sv: between two faces, a constant torque drives the lever
// back to the side that it came from. Documentation: docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "feltgate/scene_part.hpp"

namespace feltgate {

/// State of a membrane: the side on which the lever was outside it last.
enum class MembraneSide : std::uint8_t {
  unknown,  ///< not yet outside since the scene was selected: no torque
  below,
  above
};

/// The law, in number policy N, for design D.
template <class D, class N>
struct SceneMembraneLaw {
  using Scene = ScenePartLaw<D, N>;
  using Torque = typename N::template num<D::f.torque.key()>;
  using Offset = typename N::template num<D::f.scene_offset.key()>;

  /// The side of a position: below, above, or unknown for inside. Both faces belong to the inside.
  static MembraneSide where(std::int32_t position, Offset lower, Offset upper) {
    const auto theta = from_integer<N, D::f.scene_position.key()>(position);
    if (theta < lower) return MembraneSide::below;
    if (theta > upper) return MembraneSide::above;
    return MembraneSide::unknown;
  }
  /// Torque inside, for a lever that came from `side`. A negative magnitude counts as 0.
  static Torque inside(MembraneSide side, Torque magnitude) {
    if (magnitude < Torque{} || side == MembraneSide::unknown) return Torque{};
    return side == MembraneSide::above ? magnitude : negated(magnitude);
  }
  /// The torque in one tick; updates `side`.
  template <class W>
  static typename Scene::Torque torque(const W& w, std::int32_t position, MembraneSide* side) {
    const MembraneSide now = where(position, w.membrane_lower(), w.membrane_upper());
    if (now != MembraneSide::unknown) {
      *side = now;
      return {};
    }
    return Scene::whole(inside(*side, w.membrane_torque()));
  }
};

}  // namespace feltgate
