// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/scene_charge.sv: a point charge, strength * sgn(x) / x^2 outside a linear core and
// slope * x inside it, away from the charge or towards it. Documentation:
// docs/blocks/scene_charge.md
#pragma once

#include <cstdint>

#include "feltgate/words.hpp"

namespace feltgate {

/// floor(strength / square), at most 65535; also 65535 where the square is 0.
constexpr std::int64_t charge_quotient(std::int64_t strength, std::int64_t square) {
  return strength / 65536 >= square ? 65535 : strength / square;
}

/// The law, in number policy N, for design D. Distances here are centre - position, that is -x.
template <class D, class N>
struct SceneChargeLaw {
  static constexpr Format force_format{1, 0, D::f.charge.fraction};
  using Torque = typename N::template num<D::f.torque.key()>;
  using Offset = typename N::template num<D::f.scene_offset.key()>;
  using Distance = typename N::template num<D::f.scene_position.key()>;
  using Strength = typename N::template num<D::f.charge.key()>;
  using Force = typename N::template num<force_format.key()>;

  /// centre - position [count], saturated; the centre's fraction is ignored.
  static Distance distance(std::int32_t position, Offset centre) {
    return quantise<N, Distance, Round::truncate, Overflow::saturate>(
        whole(centre) - from_integer<N, Distance>(position));
  }
  /// Whether the lever is in the core.
  template <class Width>
  static bool near(Distance distance, Width half_width) {
    return distance < half_width && distance > -half_width;
  }
  /// Outside the core: floored in fixed point; endless at x = 0 in real arithmetic. sgn(0) is +1.
  static Force outside(Distance distance, Strength strength, bool attract) {
    const bool minus = attract != (distance > Distance{});
    if constexpr (N::is_fixed) {
      const std::int64_t d = N::raw(distance);
      const std::int64_t q = charge_quotient(N::raw(strength), d * d);
      return N::template from_raw<force_format.key()>(minus ? -q : q);
    } else {
      const Force endless = static_cast<Force>(1e30);
      const Force q = distance == Distance{} ? endless : strength / (distance * distance);
      return minus ? -q : q;
    }
  }
  /// Inside the core: slope * distance rounded, negated where it repels, saturated.
  template <class Product>
  static Force inside(Product slope_times_distance, bool attract) {
    constexpr int steps = Format{1, 40, force_format.fraction}.key();
    const auto rounded = quantise<N, steps, D::rounding, Overflow::wrap>(slope_times_distance);
    if (attract) return saturated(rounded);
    return saturated(-rounded);
  }
  static Torque torque(Force force) {
    return quantise<N, Torque, Round::truncate, Overflow::saturate>(force);
  }
  /// One tick.
  template <class W>
  static Torque torque(const W& w, bool attract, std::int32_t position) {
    const Distance d = distance(position, attract ? w.attract_centre() : w.repel_centre());
    if (!near(d, attract ? w.attract_core() : w.repel_core())) {
      return torque(outside(d, attract ? w.attract_strength() : w.repel_strength(), attract));
    }
    if (attract) return torque(inside(d * w.attract_core_slope(), true));
    return torque(inside(d * w.repel_core_slope(), false));
  }

 private:
  template <class X>
  static Force saturated(X x) {
    return quantise<N, Force, Round::truncate, Overflow::saturate>(x);
  }
  /// The whole counts of a position, downward.
  static Distance whole(Offset x) {
    if constexpr (N::is_fixed) {
      return quantise<N, Distance, Round::truncate, Overflow::wrap>(x);
    } else {
      const auto toward_zero = static_cast<Distance>(static_cast<std::int64_t>(x));
      return toward_zero > x ? toward_zero - 1 : toward_zero;
    }
  }
};

/// Clocked twin. A wave is: start and the centre in clock 1, the strength in 2, the square of the
/// distance in 7, the product of distance and slope in 10, the core's half-width in 12.
template <class D>
class SceneCharge {
 public:
  using Law = SceneChargeLaw<D, Fixed>;

  struct In {
    bool select = false;  ///< stable during a wave, as is attract
    bool attract = false;
    bool start = false;
    std::int32_t position = 0;  ///< counts, 18 bits, stable during a wave
    std::uint32_t param = 0;
    std::int64_t product = 0;
  };
  struct Out {
    std::int64_t operand = 0;  ///< distance in its whole counts
    std::int64_t tau = 0;      ///< takes shape bit by bit until clock 24
  };

  void reset() { *this = SceneCharge{}; }

  void clock(const In& in) {
    for (int t = 24; t >= 2; --t) {
      if ((stage_ & (1u << (t - 2))) != 0) wave_clock(t, in);
    }
    if (in.start) {
      centre_ = Offset::from_raw(decode_word(D::f.scene_offset, in.param));
      near_ = false;
    }
    stage_ = ((stage_ << 1) | (in.start ? 1u : 0u)) & 0x7fffffu;
    out_.tau = Law::torque(Force::from_raw(outside_ | inside_)).raw();
  }

  /// A whole wave at once.
  void tick(const Words<D, Fixed>& w, bool select, bool attract, std::int32_t position) {
    out_.tau = select ? Law::torque(w, attract, position).raw() : 0;
  }

  const Out& out() const { return out_; }

 private:
  using Offset = typename Law::Offset;
  using Distance = typename Law::Distance;
  using Force = typename Law::Force;
  using Attract = decltype(Offset{} * fixed_of<D::P::attract_core_slope.key()>{});
  using Repel = decltype(Offset{} * fixed_of<D::P::repel_core_slope.key()>{});

  void wave_clock(int t, const In& in) {
    switch (t) {
      case 2:
        distance_ = Law::distance(in.position, centre_);
        out_.operand = distance_.raw() * (std::int64_t{1} << D::f.scene_offset.fraction);
        strength_ = decode_word(D::f.charge, in.param);
        break;
      case 7:
        quotient_ = charge_quotient(strength_, in.product);
        break;
      case 8:
        outside_ = 0;
        break;
      case 10:
        core_ = in.attract ? Law::inside(Attract::from_raw(in.product), true).raw()
                           : Law::inside(Repel::from_raw(in.product), false).raw();
        break;
      case 12:
        core_width_ = decltype(core_width_)::from_raw(decode_word(D::P::attract_core, in.param));
        break;
      case 16:
        inside_ = in.select && near_ ? core_ : 0;
        break;
      default:
        break;
    }
    if (t >= 9) {
      const std::int64_t so_far = quotient_ >> (24 - t);
      const bool minus = in.attract != (distance_.raw() > 0);
      outside_ = !in.select || near_ ? 0 : (minus ? -so_far : so_far);
    }
    if (t == 13) near_ = Law::near(distance_, core_width_);
  }

  std::uint32_t stage_ = 0;
  Offset centre_{};
  Distance distance_{};
  fixed_of<D::P::attract_core.key()> core_width_{};
  std::int64_t strength_ = 0, quotient_ = 0, core_ = 0, outside_ = 0, inside_ = 0;
  bool near_ = false;
  Out out_;
};

}  // namespace feltgate
