// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Worst-case peak gains. Documentation: docs/error-bounds.md
#include "studies/bounds/sections.hpp"

#include <algorithm>

namespace feltgate::bounds {

namespace {

/// Around e.
const Interval euler(2.718281828459045, 2.718281828459046);

}  // namespace

Interval one_pole_gain(const Interval& pole) {
  if (magnitude(pole) >= 1.0) return {endless, endless};
  return Interval(1.0) / (Interval(1.0) - boost::numeric::abs(pole));
}

double lowpass_change_gain(const Interval& p, const Interval& q) {
  const double least = std::min(p.lower(), q.lower());
  if (least <= 0.0) return endless;
  if (least >= 1.0) return 0.0;
  // The terms change sign once and sum to 0, so the sum of magnitudes is twice the largest partial
  // sum, |(1-p)^K - (1-q)^K| <= |p-q| * K*x^(K-1) with 1-x between p and q; over all K that is
  // below 1/(e*(1-x)*x), which is largest for the smaller of the two.
  const Interval slow(least);
  const Interval gain =
      Interval(2.0) * boost::numeric::abs(p - q) / (euler * slow * (Interval(1.0) - slow));
  return std::min(2.0, gain.upper());
}

double high_passed_gain(const Interval& p, const Interval& q) {
  if (p.upper() < 0.0 || magnitude(p) >= 1.0 || magnitude(q) >= 1.0) return endless;
  constexpr long most_terms = 4'000'000;
  constexpr double loose = 1e-6;
  const Interval a = Interval(1.0) - p;
  const Interval memory = one_pole_gain(q);
  Interval power(1.0), h(1.0), sum(1.0);  // p^k, h_k, sum of |h|
  Interval tail(endless);
  for (long k = 1; k <= most_terms; ++k) {
    h = q * h - a * power;
    power *= p;
    sum += boost::numeric::abs(h);
    if (k % 1024 != 0) continue;
    // What is still to come of the source, sum of a*p^j from j = k on, is p^k.
    tail = (boost::numeric::abs(q * h) + power) * memory;
    if (tail.upper() < loose * sum.upper()) break;
  }
  return (sum + tail).upper();
}

}  // namespace feltgate::bounds
