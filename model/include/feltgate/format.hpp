// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Number formats [S,I,F] and their growth rules, written once: the C++ types use them at compile
// time, and the generator writes the SystemVerilog package from them. Documentation:
// docs/fixed-point.md
#pragma once

namespace feltgate {

/// A fixed-point format in the notation [S,I,F]: S sign bits (0 or 1), I integer bits, F fraction
/// bits. The word has S+I+F bits and the range [-S*2^I, 2^I) in steps of 2^-F. I or F may be
/// negative; key() packs each of them into -128..127.
struct Format {
  int sign;
  int integer;
  int fraction;

  /// Word width in bits.
  constexpr int width() const { return sign + integer + fraction; }

  /// The three numbers packed into one int, so that a format can be a C++17 template argument.
  constexpr int key() const { return (sign * 256 + integer + 128) * 256 + fraction + 128; }

  /// Inverse of key().
  static constexpr Format from_key(int key) {
    return {key / 65536, (key / 256) % 256 - 128, key % 256 - 128};
  }

  constexpr bool operator==(const Format& o) const {
    return sign == o.sign && integer == o.integer && fraction == o.fraction;
  }
  constexpr bool operator!=(const Format& o) const { return !(*this == o); }
};

/// Each rule gives a format that holds all results, and the narrowest one, except in two degenerate
/// cases with one spare bit: a 1-bit operand, and a sum whose operands do not overlap
/// (docs/fixed-point.md, "Growth").
namespace growth {

/// The larger of two numbers.
constexpr int max_of(int a, int b) { return a > b ? a : b; }

/// Format that holds a+b for every a and b.
constexpr Format sum(Format a, Format b) {
  return {max_of(a.sign, b.sign), max_of(a.integer, b.integer) + 1, max_of(a.fraction, b.fraction)};
}

/// Format that holds a-b for every a and b (always signed).
constexpr Format difference(Format a, Format b) {
  const int grown = (a.sign == 0 && b.sign == 0) ? 0 : 1;
  return {1, max_of(a.integer, b.integer) + grown, max_of(a.fraction, b.fraction)};
}

/// Format that holds a*b for every a and b; the product of two signed minima needs one bit more.
constexpr Format product(Format a, Format b) {
  return {max_of(a.sign, b.sign), a.integer + b.integer + a.sign * b.sign, a.fraction + b.fraction};
}

/// Format of -a: the negated minimum needs one more integer bit.
constexpr Format negation(Format a) { return {1, a.integer + a.sign, a.fraction}; }

/// Format of a*2^k: the binary point moves, the bits stay.
constexpr Format scaled(Format a, int k) { return {a.sign, a.integer + k, a.fraction - k}; }

}  // namespace growth
}  // namespace feltgate
