// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/estimators/velocity_mt.sv, clock by clock. Documentation:
// docs/blocks/velocity.md
#pragma once

#include <cstdint>

#include "../lowpass/lowpass_twin.hpp"
#include "feltgate/generated/map.hpp"
#include "feltgate/velocity_mt.hpp"

namespace feltgate {

/// Clocked twin; the parameters are those of the RTL.
template <class D, int Window = 0, int Doublings = 0, int Counts = 4096, int StampBits = 26>
class VelocityMt : public SpanMeter<D, Window, Doublings, Counts, StampBits> {
 public:
  using Meter = SpanMeter<D, Window, Doublings, Counts, StampBits>;
  using A1 = fixed_of<D::P::velocity_a1.key()>;

  struct In {
    std::uint64_t wave = 0;
    std::int16_t travel = 0;   ///< live
    std::int64_t product = 0;  ///< in T::velocity: a1 * operand
  };
  struct Out {
    std::int64_t operand = 0;
    std::int64_t velocity = 0;
    bool saturated = false;
  };

  void reset() { *this = {}; }

  void clock(const In& in) {
    const auto at = [&in](int t) { return ((in.wave >> t) & 1u) != 0; };
    using T = Map::T;
    filter_.clock({at(T::velocity_difference), at(T::velocity), this->follows(out_.velocity),
                   this->raw(), in.product});
    Meter::clock(in.travel, at(T::sample), at(T::velocity_raw));
    out_.saturated = this->limited();
    out_.operand = filter_.out().operand;
    out_.velocity = filter_.out().y;
  }

  const Out& out() const { return out_; }

 private:
  Lowpass<D::f.velocity.key(), D::f.velocity_difference.key(), D::P::velocity_a1.key(), D::rounding>
      filter_;
  Out out_;
};

}  // namespace feltgate
