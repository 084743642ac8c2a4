// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/estimators/velocity_n.sv, clock by clock, by the law of the chain.
// Documentation: docs/blocks/velocity.md
#pragma once

#include <cstdint>

#include "../lowpass/lowpass_twin.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/velocity_n.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class VelocityN {
 public:
  using Law = VelocityLaw<D, Fixed>;
  using Velocity = typename Law::Velocity;
  using A1 = fixed_of<D::P::velocity_a1.key()>;

  struct In {
    std::uint64_t wave = 0;
    std::int16_t travel = 0;   ///< taken in T::sample
    std::int64_t product = 0;  ///< in T::velocity: a1 * operand
  };
  struct Out {
    std::int64_t operand = 0;
    std::int64_t velocity = 0;
    bool saturated = false;
  };

  void reset() {
    line_.reset();
    filter_.reset();
    travel_ = oldest_ = difference_ = 0;
    raw_ = Velocity{};
    out_ = {};
  }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    using T = Map::T;
    filter_.clock({at(T::velocity_difference), at(T::velocity), false, raw_.raw(), in.product});
    if (at(T::velocity_difference)) line_.push(travel_);
    if (at(T::velocity_raw)) {
      out_.saturated = false;
      raw_ = Law::raw(difference_, &out_.saturated);
    }
    if (at(T::travel)) difference_ = travel_difference(travel_, oldest_);
    if (at(T::sample)) {
      travel_ = in.travel;
      oldest_ = line_.oldest();
    }
    out_.operand = filter_.out().operand;
    out_.velocity = filter_.out().y;
  }

  const Out& out() const { return out_; }
  Velocity velocity() const { return filter_.state(); }

 private:
  DelayLine<D::m1> line_;
  Lowpass<D::f.velocity.key(), D::f.velocity_difference.key(), D::P::velocity_a1.key(), D::rounding>
      filter_;
  std::int16_t travel_ = 0, oldest_ = 0, difference_ = 0;
  Velocity raw_{};
  Out out_;
};

}  // namespace feltgate
