// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// larger() and smaller(): maximum and minimum that keep a NaN, for values that are compared with a
// bound afterwards. A kept NaN fails every such comparison; std::max would drop it.
#pragma once

namespace feltgate {

/// The larger of a and b; a NaN if one of them is.
template <class T>
constexpr T larger(const T& a, const T& b) {
  return a != a || a > b ? a : b;
}

/// The smaller of a and b; a NaN if one of them is.
template <class T>
constexpr T smaller(const T& a, const T& b) {
  return a != a || a < b ? a : b;
}

}  // namespace feltgate
