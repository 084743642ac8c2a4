// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Law of rtl/core/estimators/velocity_n.sv: N-method velocity. The velocity is 2^n times the counts
// of the last m1 ticks, saturated to the velocity format and low-pass filtered. Documentation:
// docs/blocks/velocity.md
#pragma once

#include <array>
#include <cstdint>

#include "feltgate/lowpass.hpp"
#include "feltgate/numbers.hpp"

namespace feltgate {

/// The travel at the last M1 ticks. Before the line has filled, oldest() is 0, the travel at reset.
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

  /// Counts of m1 ticks as rad/s, saturated to the velocity format. With the gain 2^n it is exact;
  /// a quantised gain truncates below the last bit.
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

/// One tick of the velocity estimator after its delay line.
template <class D, class N>
struct EstimatorStep {
  typename VelocityLaw<D, N>::Velocity velocity{};
  bool limit = false;  ///< the raw velocity saturated

  /// `counts`: counts of the last m1 ticks. `w`: the parameters, a ParameterReader.
  template <class W>
  void tick(const W& w, std::int16_t counts) {
    using Law = VelocityLaw<D, N>;
    limit = false;
    filter(w, Law::raw(counts, &limit));
  }

  /// The low-pass alone. `raw`: its input.
  template <class W>
  void filter(const W& w, typename VelocityLaw<D, N>::Velocity raw) {
    constexpr int a1 = D::P::velocity_a1.key();
    velocity = VelocityLaw<D, N>::Filter::template step<a1>(raw, velocity, w.velocity_a1());
  }
};

}  // namespace feltgate
