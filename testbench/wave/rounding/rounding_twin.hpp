// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Twin of rtl/core/wave/rounding.sv, by the rounding of fixed-point numbers. Documentation:
// docs/architecture.md
#pragma once

#include <cstdint>

#include "feltgate/fixed.hpp"

namespace feltgate {

/// Combinational twin: whether a number goes up when its lowest Drop bits are dropped.
template <int Drop, Round R>
class Rounding {
 public:
  struct In {
    std::uint32_t low = 0;  ///< Drop + 1 bits: what is dropped and the lowest that is kept
    bool negated = false;
  };
  struct Out {
    bool up = false;
  };

  void reset() {}
  void clock(const In& in) {
    const auto x = fixed<1, 2, Drop>::from_raw(in.low);
    const std::int64_t rounded = in.negated ? -whole<R>(-x) : whole<R>(x);
    out_.up = rounded != whole<Round::truncate>(x);
  }
  const Out& out() const { return out_; }

 private:
  template <Round How, class X>
  static std::int64_t whole(X x) {
    return narrow<fixed<1, 4, 0>, How, Overflow::wrap>(x).raw();
  }

  Out out_;
};

}  // namespace feltgate
