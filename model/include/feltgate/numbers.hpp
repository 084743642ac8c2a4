// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Number policies: the laws of the chain are written once, as templates, and evaluated in fixed
// point (bit-exact with the RTL) or in real arithmetic (the reference). Documentation:
// docs/architecture.md
#pragma once

#include <cmath>
#include <cstdint>

#include "feltgate/fixed.hpp"

namespace feltgate {

namespace detail {

template <class X>
struct Negated {
  static constexpr X of(X x) { return -x; }
};

template <int S, int I, int F>
struct Negated<fixed<S, I, F>> {
  static constexpr fixed<S, I, F> of(fixed<S, I, F> x) {
    return fixed<S, I, F>::from_raw(-x.raw());
  }
};

}  // namespace detail

/// Fixed point: a number of format Key is a fixed<S,I,F>. Another fixed-point type can be used
/// through a policy with the same members.
struct Fixed {
  static constexpr bool is_fixed = true;
  template <int Key>
  using num = fixed_of<Key>;

  /// The number raw * 2^-F. Precondition: it lies in the format.
  template <int Key>
  static constexpr fixed_of<Key> from_raw(std::int64_t raw) {
    return fixed_of<Key>::from_raw(static_cast<typename fixed_of<Key>::raw_type>(raw));
  }
  /// The integer of a number that has at most 64 bits.
  template <class X>
  static constexpr std::int64_t raw(X x) {
    return static_cast<std::int64_t>(x.raw());
  }
  template <int Key, Round R, Overflow O, class X>
  static constexpr fixed_of<Key> narrowed(X x, bool* saturated) {
    return narrow<fixed_of<Key>, R, O>(x, saturated);
  }
  template <int K, class X>
  static constexpr auto scaled(X x) {
    return scale_by_power_of_two<K>(x);
  }
};

/// Real arithmetic in T (double, __float128): every number is a T, and no law rounds.
template <class T>
struct Real {
  static constexpr bool is_fixed = false;
  template <int Key>
  using num = T;
};

/// x narrowed to the format Key in fixed point, with rounding R and overflow O; x itself in Real.
/// Sets *saturated, never clears it, if x saturates.
template <class N, int Key, Round R, Overflow O, class X>
constexpr typename N::template num<Key> quantise(X x, bool* saturated = nullptr) {
  if constexpr (N::is_fixed) {
    return N::template narrowed<Key, R, O>(x, saturated);
  } else {
    (void)saturated;
    return x;
  }
}

/// The same with the target as a type; To is a num of N.
template <class N, class To, Round R, Overflow O, class X>
constexpr To quantise(X x, bool* saturated = nullptr) {
  if constexpr (N::is_fixed) {
    return N::template narrowed<To::format.key(), R, O>(x, saturated);
  } else {
    (void)saturated;
    return x;
  }
}

/// An integer as a number of the integer format Key (fraction 0); exact in both policies while it
/// lies in the format's range.
template <class N, int Key>
constexpr typename N::template num<Key> from_integer(std::int64_t v) {
  if constexpr (N::is_fixed) {
    static_assert(Format::from_key(Key).fraction == 0, "an integer format has no fraction");
    return N::template from_raw<Key>(v);
  } else {
    return static_cast<typename N::template num<Key>>(v);
  }
}
template <class N, class To>
constexpr To from_integer(std::int64_t v) {
  if constexpr (N::is_fixed) {
    return from_integer<N, To::format.key()>(v);
  } else {
    return static_cast<To>(v);
  }
}

/// x * 2^K, exact in both policies (K >= 0).
template <class N, int K, class X>
constexpr auto times_power_of_two(X x) {
  if constexpr (N::is_fixed) {
    return N::template scaled<K>(x);
  } else {
    return static_cast<X>(x * static_cast<X>(1 << K));
  }
}

/// -x in the type of x. Precondition in Fixed: x is not the format's minimum.
template <class X>
constexpr X negated(X x) {
  return detail::Negated<X>::of(x);
}

/// Whether x lies outside [-limit, limit].
template <class X, class Limit>
constexpr bool beyond(X x, Limit limit) {
  return x > limit || x < -limit;
}

}  // namespace feltgate
