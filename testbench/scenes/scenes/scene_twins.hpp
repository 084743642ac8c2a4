// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twins of the blocks in rtl/core/scenes, clock by clock, by the laws of the scenes.
// Documentation: docs/blocks/scenes.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "feltgate/scene_charge.hpp"
#include "feltgate/scene_membrane.hpp"
#include "feltgate/scene_part.hpp"
#include "feltgate/words.hpp"

namespace feltgate {

/// Combinational twin: a product with `Fraction` fraction bits as one term of a scene's torque.
template <class D, int Fraction, bool Exact = true>
class ScenePart {
 public:
  using Law = ScenePartLaw<D, Fixed>;
  using Part = typename Law::Part;

  struct In {
    std::int64_t product = 0;
  };
  struct Out {
    std::int64_t part = 0;
  };

  void reset() {}
  void clock(const In& in) { out_.part = of(in.product); }
  const Out& out() const { return out_; }

  static std::int64_t of(std::int64_t product) {
    using Product = fixed<1, D::product_bits - 1 - Fraction, Fraction>;
    const std::int64_t part = Law::part(Product::from_raw(product)).raw();
    constexpr std::int64_t below = (std::int64_t{1} << (Fraction - Part::format.fraction)) - 1;
    const bool tells = Exact && D::rounding == Round::convergent;
    return tells && (product & below) != 0 ? part | 1 : part;
  }

 private:
  Out out_;
};

template <class D>
class SceneSetpoint {
 public:
  struct In {
    bool select = false;
    std::uint64_t wave = 0;
    std::uint32_t param = 0;
  };
  struct Out {
    std::int64_t plus = 0;  ///< a torque
  };

  /// No register of it has a reset.
  void reset() {}

  void clock(const In& in) {
    if (!in.select) {
      out_.plus = 0;
    } else if (((in.wave >> Map::W::setpoint_torque) & 1u) != 0) {
      out_.plus = decode_word(D::f.torque, in.param);
    }
  }

  const Out& out() const { return out_; }

 private:
  Out out_;
};

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
