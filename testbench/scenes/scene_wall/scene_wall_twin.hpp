// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_wall.sv, clock by clock. Documentation: docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "../scene_part/scene_part_twin.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class SceneWall {
 public:
  struct In {
    bool select = false;
    bool behind = false;  ///< the distance is negative
    std::uint64_t wave = 0;
    std::int64_t product = 0;
  };
  struct Out {
    std::int64_t plus = 0;   ///< part of the spring
    std::int64_t minus = 0;  ///< part of the damper
  };

  /// No register of it has a reset.
  void reset() {}

  void clock(const In& in) {
    using Spring =
        ScenePart<D, D::f.scene_distance.fraction + D::P::wall_stiffness.fraction, false>;
    using Damper = ScenePart<D, D::f.velocity.fraction + D::P::wall_damping.fraction, false>;
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    if (!in.select || !in.behind) {
      out_ = {};
      return;
    }
    if (at(Map::M::wall_stiffness)) out_.plus = Spring::of(in.product);
    if (at(Map::M::wall_damping)) out_.minus = Damper::of(in.product);
  }

  const Out& out() const { return out_; }

 private:
  Out out_;
};

}  // namespace feltgate
