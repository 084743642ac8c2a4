// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Fixed-point numbers over 64- and 128-bit integers, with exact growth and explicit narrowing. No
// operation loses a bit; only narrow() makes a number narrower, with a stated rounding and a stated
// treatment of overflow. Documentation: docs/fixed-point.md
#pragma once

#include <cstdint>
#include <type_traits>

#include "feltgate/format.hpp"

namespace feltgate {

__extension__ typedef __int128 int128_t;

/// How narrow() treats the bits below the target's last bit.
enum class Round {
  truncate,    ///< toward minus infinity: the bits are dropped
  half_up,     ///< to nearest, ties toward plus infinity
  convergent,  ///< to nearest, ties to even
  toward_zero  ///< magnitude truncation
};

/// What narrow() does with a value outside the target's range, after rounding.
enum class Overflow {
  wrap,      ///< modulo 2^width
  saturate,  ///< the nearest end of the range
  never      ///< not checked: the caller knows that the value fits
};

/// 2^k as an integer of type Raw, 0 <= k < bits(Raw)-1.
template <class Raw>
constexpr Raw power_of_two(int k) {
  return static_cast<Raw>(Raw{1} << k);
}

/// 2^k - 1 as an integer of type Raw, 0 <= k < bits(Raw); also where 2^k itself does not fit.
template <class Raw>
constexpr Raw ones(int k) {
  return k == 0 ? Raw{0} : static_cast<Raw>((power_of_two<Raw>(k - 1) - 1) * 2 + 1);
}

/// A number of format [S,I,F], stored sign-extended: in int64 where it fits, else in int128.
template <int S, int I, int F>
class fixed {  // NOLINT(readability-identifier-naming): reads like the arithmetic type it is
 public:
  static constexpr Format format{S, I, F};
  static constexpr int width = S + I + F;
  static_assert(S == 0 || S == 1, "S counts sign bits: 0 or 1");
  static_assert(width >= 1, "a number needs at least one bit");
  static_assert(width <= 126 + S, "wider than the 128-bit integer that would hold it");
  using raw_type = std::conditional_t<(width <= 63 + S), std::int64_t, int128_t>;

  constexpr fixed() = default;

  /// The number raw * 2^-F. Precondition: raw lies in [min_raw(), max_raw()].
  static constexpr fixed from_raw(raw_type raw) {
    fixed x;
    x.raw_ = raw;
    return x;
  }
  static constexpr raw_type max_raw() { return ones<raw_type>(width - S); }
  static constexpr raw_type min_raw() { return S == 1 ? -max_raw() - 1 : 0; }
  static constexpr fixed max() { return from_raw(max_raw()); }
  static constexpr fixed min() { return from_raw(min_raw()); }

  constexpr raw_type raw() const { return raw_; }

  /// The value as a double; the processor rounds it if it has more than 53 bits.
  constexpr double to_double() const {
    double scale = 1.0;
    for (int k = 0; k < F; ++k) scale *= 0.5;
    for (int k = 0; k > F; --k) scale *= 2.0;
    return static_cast<double>(raw_) * scale;
  }

 private:
  raw_type raw_ = 0;
};

/// The number type of a packed format, e.g. fixed_of<Design::velocity.key()>.
template <int Key>
using fixed_of = fixed<Format::from_key(Key).sign, Format::from_key(Key).integer,
                       Format::from_key(Key).fraction>;

namespace detail {

/// The integer of x with its fraction extended to `to` bits, in a type that holds it.
template <class Raw, int S, int I, int From>
constexpr Raw aligned(fixed<S, I, From> x, int to) {
  return static_cast<Raw>(x.raw()) * power_of_two<Raw>(to - From);
}

/// floor(x / 2^k) for k >= 0: an arithmetic shift right, written so that g++ and clang agree.
template <class Raw>
constexpr Raw floor_shift(Raw x, int k) {
  return static_cast<Raw>(x >> k);
}

/// x / 2^k rounded by R. Precondition: x has one spare bit in Raw, and 2^k fits too.
template <Round R, class Raw>
constexpr Raw round_shift(Raw x, int k) {
  if (k == 0 || R == Round::truncate) return floor_shift(x, k);
  const Raw half = power_of_two<Raw>(k - 1);
  if (R == Round::half_up) return floor_shift(static_cast<Raw>(x + half), k);
  if (R == Round::toward_zero) {
    return floor_shift(static_cast<Raw>(x + (x < 0 ? ones<Raw>(k) : Raw{0})), k);
  }
  // Adds just under one half, or one half where the floor is odd; only then a tie rounds up.
  const Raw odd = static_cast<Raw>(floor_shift(x, k) & 1);
  return floor_shift(static_cast<Raw>(x + (half - 1) + odd), k);
}

/// The low `width` bits of y, read as a word with or without sign.
template <class Raw>
constexpr Raw wrapped(Raw y, int sign, int width) {
  const Raw low_bits = static_cast<Raw>(y & ones<Raw>(width));
  if (sign == 0) return low_bits;
  // Flipping the sign bit and subtracting its weight sign-extends the word without a branch.
  const Raw weight = power_of_two<Raw>(width - 1);
  return static_cast<Raw>((low_bits ^ weight) - weight);
}

/// Whether every value of `from`, rounded to to.fraction, lies in the range of `to`.
constexpr bool always_fits(Format from, Format to, Round round) {
  const bool rounds_up =
      from.fraction > to.fraction && (round == Round::half_up || round == Round::convergent);
  return from.sign <= to.sign && from.integer + (rounds_up ? 1 : 0) <= to.integer;
}

}  // namespace detail

/// Sum, difference, product and negation, exact: the result's format grows by the rules of growth.
template <int S1, int I1, int F1, int S2, int I2, int F2>
constexpr auto operator+(fixed<S1, I1, F1> a, fixed<S2, I2, F2> b) {
  using Sum = fixed_of<growth::sum(Format{S1, I1, F1}, Format{S2, I2, F2}).key()>;
  using Raw = typename Sum::raw_type;
  return Sum::from_raw(detail::aligned<Raw>(a, Sum::format.fraction) +
                       detail::aligned<Raw>(b, Sum::format.fraction));
}

template <int S1, int I1, int F1, int S2, int I2, int F2>
constexpr auto operator-(fixed<S1, I1, F1> a, fixed<S2, I2, F2> b) {
  using Difference = fixed_of<growth::difference(Format{S1, I1, F1}, Format{S2, I2, F2}).key()>;
  using Raw = typename Difference::raw_type;
  return Difference::from_raw(detail::aligned<Raw>(a, Difference::format.fraction) -
                              detail::aligned<Raw>(b, Difference::format.fraction));
}

template <int S1, int I1, int F1, int S2, int I2, int F2>
constexpr auto operator*(fixed<S1, I1, F1> a, fixed<S2, I2, F2> b) {
  using Product = fixed_of<growth::product(Format{S1, I1, F1}, Format{S2, I2, F2}).key()>;
  using Raw = typename Product::raw_type;
  return Product::from_raw(static_cast<Raw>(a.raw()) * static_cast<Raw>(b.raw()));
}

template <int S, int I, int F>
constexpr auto operator-(fixed<S, I, F> a) {
  using Negation = fixed_of<growth::negation(Format{S, I, F}).key()>;
  return Negation::from_raw(-static_cast<typename Negation::raw_type>(a.raw()));
}

namespace detail {

/// An integer type that holds both numbers with their binary points aligned.
template <class A, class B>
using common_raw = typename fixed_of<growth::difference(A::format, B::format).key()>::raw_type;

}  // namespace detail

// Comparison by value; the two formats may differ.
template <int S1, int I1, int F1, int S2, int I2, int F2>
constexpr bool operator==(fixed<S1, I1, F1> a, fixed<S2, I2, F2> b) {
  using Raw = detail::common_raw<fixed<S1, I1, F1>, fixed<S2, I2, F2>>;
  constexpr int fraction = growth::max_of(F1, F2);
  return detail::aligned<Raw>(a, fraction) == detail::aligned<Raw>(b, fraction);
}
template <int S1, int I1, int F1, int S2, int I2, int F2>
constexpr bool operator<(fixed<S1, I1, F1> a, fixed<S2, I2, F2> b) {
  using Raw = detail::common_raw<fixed<S1, I1, F1>, fixed<S2, I2, F2>>;
  constexpr int fraction = growth::max_of(F1, F2);
  return detail::aligned<Raw>(a, fraction) < detail::aligned<Raw>(b, fraction);
}
template <int S1, int I1, int F1, int S2, int I2, int F2>
constexpr bool operator!=(fixed<S1, I1, F1> a, fixed<S2, I2, F2> b) {
  return !(a == b);
}
template <int S1, int I1, int F1, int S2, int I2, int F2>
constexpr bool operator>(fixed<S1, I1, F1> a, fixed<S2, I2, F2> b) {
  return b < a;
}
template <int S1, int I1, int F1, int S2, int I2, int F2>
constexpr bool operator<=(fixed<S1, I1, F1> a, fixed<S2, I2, F2> b) {
  return !(b < a);
}
template <int S1, int I1, int F1, int S2, int I2, int F2>
constexpr bool operator>=(fixed<S1, I1, F1> a, fixed<S2, I2, F2> b) {
  return !(a < b);
}

/// x * 2^K, exact: the bits stay, the binary point moves.
template <int K, int S, int I, int F>
constexpr auto scale_by_power_of_two(fixed<S, I, F> x) {
  return fixed<S, I + K, F - K>::from_raw(x.raw());
}

/// x as type To: rounds by R, then wraps or saturates by O. Sets *saturated (optional), never
/// clears it, when the value had to be changed to fit. Only this function makes a number narrower.
template <class To, Round R, Overflow O, int S, int I, int F>
constexpr To narrow(fixed<S, I, F> x, bool* saturated = nullptr) {
  constexpr int to_fraction = To::format.fraction;
  constexpr int drop = F > to_fraction ? F - to_fraction : 0;
  constexpr int grow = F < to_fraction ? to_fraction - F : 0;
  // One bit more than the wider of the two, so that neither rounding nor alignment overflows.
  constexpr int needed = growth::max_of(1 + I + F + grow, To::width + 1 - To::format.sign) + 1;
  static_assert(needed <= 128, "narrow() would need more than 128 bits");
  using Raw = std::conditional_t<(needed <= 64), std::int64_t, int128_t>;
  Raw y = 0;
  if constexpr (drop >= needed - 1) {
    // Every bit is dropped: -1/2 <= x < 1/2 of the target's last bit, so only truncation can
    // give another result than 0.
    y = (R == Round::truncate && x.raw() < 0) ? Raw{-1} : Raw{0};
  } else if constexpr (drop > 0) {
    y = detail::round_shift<R>(static_cast<Raw>(x.raw()), drop);
  } else {
    y = static_cast<Raw>(x.raw()) * power_of_two<Raw>(grow);
  }
  if constexpr (O != Overflow::never &&
                !detail::always_fits(fixed<S, I, F>::format, To::format, R)) {
    if constexpr (O == Overflow::saturate) {
      constexpr Raw low = static_cast<Raw>(To::min_raw());
      constexpr Raw high = static_cast<Raw>(To::max_raw());
      const Raw limited = y < low ? low : (y > high ? high : y);
      if (saturated != nullptr && limited != y) *saturated = true;
      y = limited;
    } else {
      y = detail::wrapped(y, To::format.sign, To::width);
    }
  }
  return To::from_raw(static_cast<typename To::raw_type>(y));
}

}  // namespace feltgate
