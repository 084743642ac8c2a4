// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/scenes/scene_charge.sv, clock by clock, by the division of the law.
// Documentation: docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "../scene_part/scene_part_twin.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/scene_charge.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class SceneCharge {
 public:
  using Law = SceneChargeLaw<D, Fixed>;

  struct In {
    bool armed = false;
    bool attract = false;
    bool repel = false;
    std::int64_t distance = 0;  ///< centre - position, with the strength on the bus
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
    std::int64_t product = 0;
    bool over_limit =
        false;  ///< from the limiter: the distance is larger than the core's half-width
  };
  struct Out {
    std::int64_t plus = 0;     ///< a part
    std::int64_t minus = 0;    ///< a part
    std::int64_t outside = 0;  ///< a torque; in the clocks before, the bits of it that are known
  };

  /// Whether the divider runs has a reset, all else has none.
  void reset() { running_ = false; }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    render_core(in, at(kCore + 1));
    render_outside(in, at(kFirst));
    if (at(Map::T::scene_distance)) near_ = false;
    if (at(kCore)) near_ = !in.over_limit && !none_;
    if (at(Map::T::charge_width_limited)) none_ = decode_word(kWidth, in.param) == 0;
    if (at(Map::W::attract_strength)) {
      strength_ = in.param;
      minus_ = in.attract != (in.distance > 0);  // sgn(0) is +1
    }
    if (at(Map::M::charge_square)) {
      quotient_ = charge_quotient(strength_, square(in));
    }
    running_ = at(Map::M::charge_square) || (running_ && !at(kLast));
  }

  const Out& out() const { return out_; }

 private:
  static constexpr Format kWidth = Format::from_key(Law::kWidthKey);
  static constexpr int kBits = 16;                          // of the quotient
  static constexpr int kFirst = Map::M::charge_square + 1;  // of the divider's clocks
  static constexpr int kLast = kFirst + kBits;
  static constexpr int kCore = Map::T::charge_core;
  template <int Fraction>
  using Part = ScenePart<D, D::f.scene_distance.fraction + Fraction>;

  void render_core(const In& in, bool decided) {
    const bool off = decided && !near_;
    if (!in.attract || off) {
      out_.plus = 0;
    } else if (((in.wave >> Map::M::attract_core_slope) & 1u) != 0) {
      out_.plus = Part<D::P::attract_core_slope.fraction>::of(in.product);
    }
    if (!in.repel || off) {
      out_.minus = 0;
    } else if (((in.wave >> Map::M::repel_core_slope) & 1u) != 0) {
      out_.minus = Part<D::P::repel_core_slope.fraction>::of(in.product);
    }
  }
  /// A bit of the quotient per clock, the highest first.
  void render_outside(const In& in, bool first) {
    known_ = first ? 0 : known_ + 1;
    if (!in.armed || !(in.attract || in.repel) || near_ || !running_ || first) {
      out_.outside = 0;
      return;
    }
    const std::int64_t q = quotient_ >> (kBits - known_);
    const auto force = Fixed::from_raw<Law::force_format.key()>(minus_ ? -q : q);
    out_.outside =
        quantise<Fixed, typename Law::Torque, Round::truncate, Overflow::wrap>(force).raw();
  }
  /// The square on the product bus. Of a distance beyond 18 bits it is negative there, since one of
  /// the factors wraps: larger than any strength.
  static std::int64_t square(const In& in) {
    const std::int64_t square = in.product >> D::f.scene_distance.fraction;
    return square < 0 ? std::int64_t{1} << 40 : square;
  }

  std::int64_t strength_ = 0, quotient_ = 0;
  int known_ = 0;
  bool running_ = false, minus_ = false, near_ = false, none_ = false;
  Out out_;
};

}  // namespace feltgate
