// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Fixed-point arithmetic of all blocks, by the names of rtl/core/fx.sv, as a policy: Fixed has the
// RTL's integers; Real<T> computes the same equations in T, in SI units, without formats.
// docs/fixed-point.md
#pragma once

#include <cmath>
#include <cstdint>

namespace feltgate::axis {

/// Where the chain rounds; cfg::ROUNDING.
enum class Rounding : std::uint8_t { half_up, down, half_to_even };

/// The low `bits` of x, as a signed number.
constexpr std::int64_t signed_bits(std::uint64_t x, int bits) {
  return static_cast<std::int64_t>(x << (64 - bits)) >> (64 - bits);
}
constexpr std::uint32_t low_bits(std::uint32_t x, int bits) {
  return bits >= 32 ? x : x & ((1U << bits) - 1);
}

/// A power of two by which a value is scaled: the factor is 1, or the shift 0.
struct Exponent {
  std::int64_t factor;
  int right;
  Exponent(int exponent)  // NOLINT(google-explicit-constructor): it is a number
      : factor(exponent > 0 ? std::int64_t{1} << exponent : 1),
        right(exponent < 0 ? -exponent : 0) {}
};
/// The lowest `drop` bits, at least one, are rounded away: `half` is added to them, and one more
/// to half of an odd result where it is `to_even`.
struct Drop {
  int drop;
  std::int64_t half, to_even;
  Drop(int d, Rounding rounding)
      : drop(d),
        half(rounding == Rounding::down ? 0 : std::int64_t{1} << (d - 1)),
        to_even(rounding == Rounding::half_to_even) {
    half -= to_even;
  }
};

/// The range of a signed format of so many bits.
struct Bits {
  std::int64_t least, most;
  constexpr Bits(int bits)  // NOLINT(google-explicit-constructor): it is a number
      : least(-(std::int64_t{1} << (bits - 1))), most(-(least + 1)) {}
};

struct Fixed {
  using T = std::int64_t;
  static constexpr bool is_fixed = true;

  /// The number nearest to a value, in a format with `fraction`; and the value of a number.
  static T of(double value, int fraction) { return std::llround(std::ldexp(value, fraction)); }
  static double value(T x, int fraction) { return std::ldexp(static_cast<double>(x), -fraction); }
  /// y + x * 2^-drop, rounded.
  static T add_rounded(T y, T x, const Drop& d) {
    if (d.to_even != 0) x += (y + (x >> d.drop)) & 1;
    return y + ((x + d.half) >> d.drop);
  }
  /// x * 2^exponent, truncated.
  static T scale(T x, const Exponent& e) { return x * e.factor >> e.right; }
  /// x * 2^-drop, truncated, with the lowest bit set where a dropped bit was.
  static T scale_sticky(T x, int drop) {
    return (x >> drop) | ((x & ((T{1} << drop) - 1)) != 0 ? 1 : 0);
  }
  /// x does not fit a signed format of so many bits.
  static bool overflows(T x, const Bits& b) { return x < b.least || x > b.most; }
  /// The nearest value of a signed format of so many bits.
  static T saturate(T x, const Bits& b) { return x < b.least ? b.least : x > b.most ? b.most : x; }
  /// |x| > limit.
  static bool beyond(T x, T limit) { return x > limit || x < -limit; }
  /// The nearest value in -limit .. limit.
  static T limited(T x, T limit) { return x > limit ? limit : x < -limit ? -limit : x; }
  /// An integer in units of 2^-fraction, times 2^exponent: of a format with `fraction`.
  static T integer(T x, int exponent, int) { return scale(x, exponent); }
  /// x without its lowest `drop` bits, in the same format.
  static T truncated(T x, int drop) { return x & -(T{1} << drop); }
  /// The whole number below x.
  static T floor(T x, int fraction) { return truncated(x, fraction); }
  static T wrapped(T x, int bits) { return signed_bits(static_cast<std::uint64_t>(x), bits); }
};

/// R: float, double or a wider type.
template <class R>
struct Real {
  using T = R;
  static constexpr bool is_fixed = false;
  static T of(double value, int) { return static_cast<T>(value); }
  static double value(T x, int) { return static_cast<double>(x); }
  static T add_rounded(T y, T x, const Drop&) { return y + x; }
  static T scale(T x, const Exponent&) { return x; }
  static T scale_sticky(T x, int) { return x; }
  static bool overflows(T, const Bits&) { return false; }
  static T saturate(T x, const Bits&) { return x; }
  static bool beyond(T x, T limit) { return x > limit || x < -limit; }
  static T limited(T x, T limit) { return x > limit ? limit : x < -limit ? -limit : x; }
  /// x * 2^(exponent - fraction): the value that Fixed has in a format with `fraction`.
  static T integer(T x, int exponent, int fraction) { return x * power(exponent - fraction); }
  static T floor(T x, int) {
    const T whole = static_cast<T>(static_cast<std::int64_t>(x));
    return whole > x ? whole - 1 : whole;
  }
  static T truncated(T x, int) { return x; }
  static T wrapped(T x, int) { return x; }
  static T power(int n) {  // 2^n
    T y = 1;
    for (; n > 0; --n) y *= 2;
    for (; n < 0; ++n) y /= 2;
    return y;
  }
};

}  // namespace feltgate::axis
