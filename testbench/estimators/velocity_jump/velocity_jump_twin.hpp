// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/estimators/velocity_jump.sv, clock by clock. Documentation:
// docs/blocks/velocity.md
#pragma once

#include <cstdint>

#include "feltgate/generated/map.hpp"

namespace feltgate {

/// Clocked twin.
template <class D>
class VelocityJump {
 public:
  /// The low-pass changes in a tick by less than 2^weight bits of the velocity.
  static constexpr int weight =
      D::f.velocity.width() + D::coefficient_bits - D::P::velocity_a1.fraction;
  static constexpr bool compares = weight >= 0 && weight <= D::f.velocity.width() - 2;

  struct In {
    std::uint64_t wave = 0;
    std::int64_t velocity = 0;  ///< raw
  };
  struct Out {
    bool trip = false;
  };

  void reset() { *this = VelocityJump{}; }
  void clock(const In& in) {
    out_.trip = false;
    if (!compares || ((in.wave >> Map::T::jump) & 1u) == 0) return;
    const std::int64_t top = floor_of(in.velocity);
    out_.trip = top > before_ + 1 || top < before_ - 1;
    before_ = top;
  }
  const Out& out() const { return out_; }

 private:
  static std::int64_t floor_of(std::int64_t raw) {
    constexpr std::int64_t unit = std::int64_t{1} << (compares ? weight : 0);
    return raw >= 0 ? raw / unit : -((unit - 1 - raw) / unit);
  }
  std::int64_t before_ = 0;
  Out out_;
};

}  // namespace feltgate
