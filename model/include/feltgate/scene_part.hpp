// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the laws of the scenes share: the distance from a reference, and the torque format before
// the limit. RTL: rtl/core/scenes/scene_part.sv, rtl/core/scenes/scenes.sv. Documentation:
// docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "feltgate/words.hpp"

namespace feltgate {

/// Formats and roundings, in number policy N, for design D.
template <class D, class N>
struct ScenePartLaw {
  using Offset = typename N::template num<D::f.scene_offset.key()>;
  using Distance = typename N::template num<D::f.scene_distance.key()>;
  using Part = typename N::template num<D::f.scene_part.key()>;
  /// A scene's rounded torque; wide enough for all values that its parameters allow.
  using Torque = typename N::template num<D::f.scene_torque.key()>;

  /// reference - position [count], exact.
  static Distance distance(std::int32_t position, Offset reference) {
    using Position = typename N::template num<D::f.scene_position.key()>;
    return quantise<N, Distance, Round::truncate, Overflow::wrap>(
        reference - from_integer<N, Position>(position));
  }
  /// A product truncated below its guard bits and saturated; saturation lies far beyond any limit.
  template <class Product>
  static Part part(Product product) {
    return quantise<N, Part, Round::truncate, Overflow::saturate>(product);
  }
  /// The scene's only rounding; a product or a difference of two parts cannot overflow it.
  template <class X>
  static Torque rounded(X x) {
    return quantise<N, Torque, D::rounding, Overflow::wrap>(x);
  }
  /// A parameter word, taken without change.
  template <class Word>
  static Torque whole(Word word) {
    return quantise<N, Torque, Round::truncate, Overflow::wrap>(word);
  }
};

}  // namespace feltgate
