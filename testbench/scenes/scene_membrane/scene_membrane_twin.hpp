// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_membrane.sv, clock by clock, by the law of the scene.
// Documentation: docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "feltgate/scene_membrane.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class SceneMembrane {
 public:
  using Law = SceneMembraneLaw<D, Fixed>;
  using Torque = typename Law::Torque;

  struct In {
    bool select = false;
    bool distance_positive = false;  ///< of the lower face, with the upper one on the bus
    bool gap_negative = false;       ///< of the face on the parameter bus, in whole counts
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
  };
  struct Out {
    std::int64_t plus = 0;   ///< torque of a lever from above
    std::int64_t minus = 0;  ///< from below
  };

  /// The side alone has a reset.
  void reset() { side_ = MembraneSide::unknown; }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    render(in, at(Map::W::membrane_torque));
    if (!in.select) {
      side_ = MembraneSide::unknown;
    } else if (at(Map::T::membrane_side) && (below_ || above_)) {
      side_ = below_ ? MembraneSide::below : MembraneSide::above;
    }
    if (at(Map::W::membrane_upper)) {
      below_ = in.distance_positive;
      above_ = in.gap_negative;
    }
  }

  const Out& out() const { return out_; }
  MembraneSide side() const { return side_; }

 private:
  void render(const In& in, bool word) {
    if (!in.select || below_ || above_ || side_ == MembraneSide::unknown) {
      out_ = {};
      return;
    }
    if (word) {
      const auto magnitude = Torque::from_raw(decode_word(D::f.torque, in.param));
      const std::int64_t torque = Law::inside(side_, magnitude).raw();
      out_ = {torque > 0 ? torque : 0, torque < 0 ? -torque : 0};
    } else if (side_ == MembraneSide::above) {
      out_.minus = 0;
    } else {
      out_.plus = 0;
    }
  }

  bool below_ = false, above_ = false;
  MembraneSide side_ = MembraneSide::unknown;
  Out out_;
};

}  // namespace feltgate
