// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// sin, cos, sqrt, exp, log and floor of double, long double and Quad. C++ has none for Quad; here
// they are series, exact to about 1e-32 of the largest value of the result. Documentation:
// docs/laws.md
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "feltgate/quad.hpp"

namespace feltgate::law {

template <class N>
inline constexpr bool kInLibrary =
    std::is_same_v<N, float> || std::is_same_v<N, double> || std::is_same_v<N, long double>;

/// x rounded towards minus infinity; without a library function, |x| must be below 2^62.
template <class N>
N floor_of(N x) {
  if constexpr (kInLibrary<N>) {
    return std::floor(x);
  } else {
    const N whole = static_cast<N>(static_cast<std::int64_t>(x));
    return whole > x ? whole - 1 : whole;
  }
}

template <class N>
N root_of(N x) {
  if constexpr (kInLibrary<N>) {
    return std::sqrt(x);
  } else {
    if (!(x > 0)) return 0;
    N y = static_cast<N>(std::sqrt(static_cast<long double>(x)));
    for (int i = 0; i < 2; ++i) y = (y + x / y) / 2;  // each step doubles the digits
    return y;
  }
}

namespace series {

/// pi as the sum of three numbers that any type holds.
template <class N>
N pi() {
  return static_cast<N>(3.14159265358979311600) + static_cast<N>(1.22464679914735317723e-16) +
         static_cast<N>(-2.99476980971833966e-33);
}

/// sin(x) for odd = true, else cos(x); |x| <= pi/4.
template <class N>
N wave(N x, bool odd) {
  N term = odd ? x : N{1}, sum = 0;
  for (int k = odd ? 1 : 0; k < 40; k += 2) {
    sum += term;
    term *= -x * x / static_cast<N>((k + 1) * (k + 2));
  }
  return sum;
}

template <class N>
N sine(N x, int quarters) {
  const N turns = floor_of(x / (pi<N>() / 2) + static_cast<N>(0.5));
  const N rest = x - turns * (pi<N>() / 2);
  const int quarter =
      static_cast<int>(static_cast<std::int64_t>(turns - 4 * floor_of(turns / 4)) + quarters) % 4;
  const N value = wave(rest, quarter % 2 == 0);
  return quarter < 2 ? value : -value;
}

}  // namespace series

template <class N>
N sine_of(N x) {
  if constexpr (kInLibrary<N>) {
    return std::sin(x);
  } else {
    return series::sine(x, 0);
  }
}

template <class N>
N cosine_of(N x) {
  if constexpr (kInLibrary<N>) {
    return std::cos(x);
  } else {
    return series::sine(x, 1);
  }
}

template <class N>
N exponential_of(N x) {
  if constexpr (kInLibrary<N>) {
    return std::exp(x);
  } else {
    if (x < 0) return 1 / exponential_of(-x);  // near 0 the sum below would lose digits
    constexpr int halvings = 16;               // undone by squaring
    N small = x / static_cast<N>(1 << halvings), term = 1, sum = 0;
    for (int k = 1; k < 12; ++k) {
      term *= small / static_cast<N>(k);
      sum += term;
    }
    // The sum holds exp - 1, so that squaring loses no digits.
    for (int i = 0; i < halvings; ++i) sum = sum * (sum + 2);
    return sum + 1;
  }
}

/// Natural logarithm of x > 0; x must lie within the range of a double.
template <class N>
N logarithm_of(N x) {
  if constexpr (kInLibrary<N>) {
    return std::log(x);
  } else {
    if (!(x > 0)) return static_cast<N>(std::log(static_cast<double>(x)));
    N y = static_cast<N>(std::log(static_cast<long double>(x)));
    const N rest = x * exponential_of(-y) - 1;  // below 1e-18: two terms of log(1 + rest) suffice
    return y + rest - rest * rest / 2;
  }
}

template <class N>
N arctangent_of(N x) {
  if constexpr (kInLibrary<N>) {
    return std::atan(x);
  } else {
    const N y = static_cast<N>(std::atan(static_cast<long double>(x)));
    // The tangent of the rest, which is below 1e-18.
    return y + (x * cosine_of(y) - sine_of(y)) / (cosine_of(y) + x * sine_of(y));
  }
}

}  // namespace feltgate::law
