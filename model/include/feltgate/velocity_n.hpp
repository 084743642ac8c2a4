// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/velocity_n.sv: N-method velocity. Velocity is 2^n times the counts of the last m1
// ticks, saturated to the velocity format, through a low-pass. Documentation:
// docs/blocks/velocity_n.md
#pragma once

#include <array>
#include <cstdint>

#include "feltgate/generated/map.hpp"
#include "feltgate/lowpass.hpp"
#include "feltgate/numbers.hpp"

namespace feltgate {

/// Travel of the last M1 ticks; before the line has filled, the travel before reset (0) is the
/// oldest.
template <int M1>
class DelayLine {
 public:
  void reset() {
    line_.fill(0);
    pointer_ = 0;
  }
  std::int16_t oldest() const { return line_[pointer_]; }
  void push(std::int16_t travel) {
    line_[pointer_] = travel;
    pointer_ = pointer_ == M1 - 1 ? 0 : pointer_ + 1;
  }

 private:
  std::array<std::int16_t, M1> line_{};
  std::size_t pointer_ = 0;
};

/// The arithmetic, in number policy N, for design D.
template <class D, class N>
struct VelocityLaw {
  using Velocity = typename N::template num<D::f.velocity.key()>;
  using Filter = LowpassLaw<N, D::f.velocity.key(), D::f.velocity_difference.key(), D::rounding>;

  /// Counts of m1 ticks as rad/s, saturated to the velocity format. 2^n times them is exact; a
  /// quantised gain truncates below the last bit.
  static constexpr Velocity raw(std::int16_t counts, bool* saturated) {
    const auto travel = from_integer<N, D::f.travel_difference.key()>(counts);
    if constexpr (D::velocity_gain == 0) {
      return quantise<N, Velocity, Round::truncate, Overflow::saturate>(
          times_power_of_two<N, D::velocity_shift>(travel), saturated);
    } else if constexpr (N::is_fixed) {
      return quantise<N, Velocity, Round::truncate, Overflow::saturate>(
          travel * N::template from_raw<D::base.velocity_gain.key()>(D::velocity_gain), saturated);
    } else {
      return travel * static_cast<Velocity>(D::velocity_gain_rad_s);
    }
  }
};

/// Difference of two wrapping 16-bit counts, exact while it lies in [-2^15, 2^15).
constexpr std::int16_t travel_difference(std::int16_t newest, std::int16_t oldest) {
  const int difference = (static_cast<int>(newest) - static_cast<int>(oldest)) & 0xffff;
  return static_cast<std::int16_t>(difference >= 0x8000 ? difference - 0x10000 : difference);
}

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

  /// A whole wave at once, from the sampled travel to the new velocity.
  void tick(std::int16_t travel, A1 a1) {
    out_.saturated = false;
    difference_ = travel_difference(travel, line_.oldest());
    line_.push(travel);
    raw_ = Law::raw(difference_, &out_.saturated);
    const auto operand = Law::Filter::operand(raw_, filter_.state());
    filter_.set_state(Law::Filter::next(filter_.state(), operand * a1));
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
