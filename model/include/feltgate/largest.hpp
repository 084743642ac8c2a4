// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// The larger and the smaller of two numbers where what is kept is compared with a bound: one that
// is not a number stays, and no comparison with a bound holds for it. std::max drops it.
#pragma once

namespace feltgate {

template <class T>
constexpr T larger(const T& a, const T& b) {
  return a != a || a > b ? a : b;
}

template <class T>
constexpr T smaller(const T& a, const T& b) {
  return a != a || a < b ? a : b;
}

}  // namespace feltgate
