// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// What the tests of the chain share: the design under test, exact parameters in quad precision, and
// the twin wrapped so that a stimulus learns of resets. Documentation: docs/testing.md
#pragma once

#include <cstdint>

#include "feltgate/fixed.hpp"
#include "feltgate/generated/lever.hpp"
#include "feltgate/generated/paper.hpp"
#include "feltgate/quad.hpp"

#ifndef FELTGATE_DESIGN
#define FELTGATE_DESIGN Lever
#endif

namespace feltgate::test {

/// The longest and a very short window of the velocity estimator, in lever's formats.
struct Longest : Lever {
  static constexpr int m1 = 1534;
  static constexpr int velocity_shift = 0;
};
struct Shortest : Lever {
  static constexpr int m1 = 3;
  static constexpr int velocity_shift = 9;
};

/// lever with the exact factor, 1.999975 rad/s per count, quantised, instead of 2^n.
struct Gained : Lever {
  static constexpr int velocity_gain = 131070;
  static constexpr double velocity_gain_rad_s = count_rad * 1e6 / m1;
  static constexpr BaseFormats base = [] {
    BaseFormats b = Lever::base;
    b.has_velocity_gain = true;
    b.velocity_gain = {0, 1, 16};
    return b;
  }();
};

using Design = FELTGATE_DESIGN;
/// rad/s per count of m1 ticks
constexpr double kRadSPerCount = Design::velocity_gain == 0
                                     ? static_cast<double>(1 << Design::velocity_shift)
                                     : static_cast<double>(Design::velocity_gain) / 65536.0;
constexpr bool kIsPaper = Design::m1 == Paper::m1;

using quad = Quad;

constexpr quad magnitude(quad x) { return x < 0 ? -x : x; }

/// 2^-k
constexpr quad lsb(int k) {
  quad value = 1;
  for (int n = 0; n < k; ++n) value /= 2;
  for (int n = 0; n > k; --n) value *= 2;
  return value;
}

/// A fixed-point number, exactly.
template <int S, int I, int F>
constexpr quad exact(fixed<S, I, F> x) {
  return static_cast<quad>(x.raw()) * lsb(F);
}

/// The design's parameter at an address.
inline const ParameterInfo& parameter(int address) {
  for (const ParameterInfo& p : Design::parameters) {
    if (p.address == address) return p;
  }
  return Design::parameters[0];
}

/// How far the quantised parameter is from its exact value, in its unit.
inline quad coefficient_error(const ParameterInfo& p) {
  return magnitude(static_cast<quad>(p.raw) * lsb(p.format.fraction) - static_cast<quad>(p.si));
}

/// A twin whose inputs carry, beside its ports, what the test needs, and whose outputs count
/// resets.
template <class Block, class Aside>
struct Watched {
  struct In {
    typename Block::In port;
    Aside aside;
  };
  struct Out {
    typename Block::Out port;
    std::int64_t resets = 0;
    bool clocked = false;  ///< since the last reset: what has none is known
  };
  void reset() {
    block.reset();
    seen.port = block.out();
    ++seen.resets;
    seen.clocked = false;
  }
  void clock(const In& in) {
    block.clock(in.port);
    seen.port = block.out();
    seen.clocked = true;
  }
  const Out& out() const { return seen; }

  Block block;
  Out seen;
};

}  // namespace feltgate::test
