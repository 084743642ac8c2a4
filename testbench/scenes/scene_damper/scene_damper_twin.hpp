// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_damper.sv, clock by clock. Documentation:
// docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "../scene_part/scene_part_twin.hpp"
#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class SceneDamper {
 public:
  struct In {
    bool select = false;
    std::uint64_t wave = 0;
    std::int64_t product = 0;
  };
  struct Out {
    std::int64_t minus = 0;  ///< a part
  };

  /// No register of it has a reset.
  void reset() {}

  void clock(const In& in) {
    using Part = ScenePart<D, D::f.velocity.fraction + D::P::damper_damping.fraction>;
    if (!in.select) {
      out_.minus = 0;
    } else if (((in.wave >> Map::M::damper_damping) & 1u) != 0) {
      out_.minus = Part::of(in.product);
    }
  }

  const Out& out() const { return out_; }

 private:
  Out out_;
};

}  // namespace feltgate
