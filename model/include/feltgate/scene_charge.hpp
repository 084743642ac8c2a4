// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_charge.sv: the torque of a point charge at distance x. Outside a
// linear core it is strength * sgn(x) / x^2, inside the core slope * x; the charge attracts or
// repels. Documentation: docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "feltgate/scene_part.hpp"

namespace feltgate {

/// floor(strength / square), limited to 65535; also 65535 where the square is 0.
constexpr std::int64_t charge_quotient(std::int64_t strength, std::int64_t square) {
  return strength / 65536 >= square ? 65535 : strength / square;
}

/// The law, in number policy N, for design D. A distance here is centre - position, which is -x.
template <class D, class N>
struct SceneChargeLaw {
  using Scene = ScenePartLaw<D, N>;
  static constexpr Format force_format{1, 0, D::f.charge.fraction};
  static constexpr Format gap_format{1, D::f.scene_distance.integer, 0};
  using Offset = typename Scene::Offset;
  using Distance = typename N::template num<gap_format.key()>;
  using Torque = typename N::template num<D::f.torque.key()>;
  using Strength = typename N::template num<D::f.charge.key()>;
  using Force = typename N::template num<force_format.key()>;
  /// The core's half-width as the limiter reads it.
  static constexpr int kWidthKey = Format{1, D::f.limiter.width() - 1, 0}.key();

  /// centre - position [count], exact; the fraction bits of the centre are ignored.
  static Distance distance(std::int32_t position, Offset centre) {
    using Position = typename N::template num<D::f.scene_position.key()>;
    return quantise<N, Distance, Round::truncate, Overflow::wrap>(
        whole(centre) - from_integer<N, Position>(position));
  }
  /// Whether the lever is in the core: |distance| <= half_width. A half-width of 0 means no core.
  template <class Width>
  static bool near(Distance distance, Width half_width) {
    return half_width > Width{} && !beyond(distance, half_width);
  }
  /// Torque outside the core, floored in fixed point; sgn(0) counts as +1. In real arithmetic the
  /// quotient is 1e30 at distance 0.
  static typename Scene::Torque outside(Distance distance, Strength strength, bool attract) {
    const bool minus = attract != (distance > Distance{});
    if constexpr (N::is_fixed) {
      const std::int64_t d = N::raw(distance);
      const std::int64_t q = charge_quotient(N::raw(strength), d * d);
      return Scene::whole(quantise<N, Torque, Round::truncate, Overflow::wrap>(
          N::template from_raw<force_format.key()>(minus ? -q : q)));
    } else {
      const Force endless = static_cast<Force>(1e30);
      const Force q = distance == Distance{} ? endless : strength / (distance * distance);
      return minus ? -q : q;
    }
  }
  /// Torque inside the core: slope * distance, rounded; negated for a charge that repels.
  template <class Product>
  static typename Scene::Torque inside(Product slope_times_distance, bool attract) {
    const auto rounded = Scene::rounded(slope_times_distance);
    return attract ? rounded : negated(rounded);
  }
  /// The torque in one tick.
  template <class W>
  static typename Scene::Torque torque(const W& w, bool attract, std::int32_t position) {
    using A = typename D::A;
    const Distance d = distance(position, attract ? w.attract_centre() : w.repel_centre());
    if (!near(d, w.template get<kWidthKey>(attract ? A::attract_core : A::repel_core))) {
      return outside(d, attract ? w.attract_strength() : w.repel_strength(), attract);
    }
    if (attract) return inside(d * w.attract_core_slope(), true);
    return inside(d * w.repel_core_slope(), false);
  }

 private:
  /// x rounded down to whole counts.
  static Distance whole(Offset x) {
    if constexpr (N::is_fixed) {
      return quantise<N, Distance, Round::truncate, Overflow::wrap>(x);
    } else {
      const auto toward_zero = static_cast<Distance>(static_cast<std::int64_t>(x));
      return toward_zero > x ? toward_zero - 1 : toward_zero;
    }
  }
};

}  // namespace feltgate
