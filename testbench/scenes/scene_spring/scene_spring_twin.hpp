// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_spring.sv, clock by clock. Documentation:
// docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "../scene_part/scene_part_twin.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class SceneSpring {
 public:
  struct In {
    bool tension = false;
    bool compression = false;
    bool behind = false;  ///< the distance is negative
    std::uint64_t wave = 0;
    std::int64_t product = 0;
  };
  struct Out {
    std::int64_t plus = 0;  ///< a part
  };

  /// No register of it has a reset.
  void reset() {}

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    if (!in.tension && (!in.compression || in.behind)) {
      out_.plus = 0;
    } else if (in.tension && at(Map::M::tension_stiffness)) {
      out_.plus = Part<D::P::tension_stiffness.fraction>::of(in.product);
    } else if (!in.tension && at(Map::M::compression_stiffness)) {
      out_.plus = Part<D::P::compression_stiffness.fraction>::of(in.product);
    }
  }

  const Out& out() const { return out_; }

 private:
  template <int Fraction>
  using Part = ScenePart<D, D::f.scene_distance.fraction + Fraction>;

  Out out_;
};

}  // namespace feltgate
