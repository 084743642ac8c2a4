// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Intervals of double, rounded outward after every operation as in model/studies/bounds, with the
// functions of the law language and with derivatives up to the second. Documentation:
// docs/laws.md
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace feltgate::law {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = 3.14159265358979323846;

/// The double next to x towards infinity, as std::nextafter gives it: inlined, since the search for
/// formats calls it most of all. NaN stays NaN.
inline double up(double x) {
  if (!(x < infinity)) return x;
  if (x == 0) return std::numeric_limits<double>::denorm_min();
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  bits += x > 0 ? std::uint64_t{1} : ~std::uint64_t{0};  // a negative number: one less
  std::memcpy(&x, &bits, sizeof bits);
  return x;
}
inline double down(double x) { return -up(-x); }

/// All numbers from lo to hi; empty if hi < lo.
struct Span {
  double lo = 0, hi = 0;
  bool empty() const { return !(lo <= hi); }
  bool within(const Span& o) const { return empty() || (o.lo <= lo && hi <= o.hi); }
  double size() const { return std::max(std::fabs(lo), std::fabs(hi)); }
  double width() const { return hi - lo; }
  double middle() const { return lo + (hi - lo) / 2; }
};

inline Span whole_line() { return {-infinity, infinity}; }
inline Span hull(const Span& a, const Span& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}
inline Span both_of(const Span& a, const Span& b) {
  return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
}
inline Span wider(const Span& a, double by) { return {down(a.lo - by), up(a.hi + by)}; }

/// Rounds a sum down. A computed sum of 0 is exactly 0 and stays 0, so a range that cannot be
/// negative does not become negative.
inline double sum_down(double x) { return x == 0 ? 0 : down(x); }
inline double sum_up(double x) { return x == 0 ? 0 : up(x); }
inline Span operator+(const Span& a, const Span& b) {
  return {sum_down(a.lo + b.lo), sum_up(a.hi + b.hi)};
}
inline Span operator-(const Span& a, const Span& b) {
  return {sum_down(a.lo - b.hi), sum_up(a.hi - b.lo)};
}
inline Span operator-(const Span& a) { return {-a.hi, -a.lo}; }
inline double bounded_product(double a, double b) { return a == 0 || b == 0 ? 0 : a * b; }
inline Span operator*(const Span& a, const Span& b) {
  const double p = bounded_product(a.lo, b.lo), q = bounded_product(a.lo, b.hi),
               r = bounded_product(a.hi, b.lo), s = bounded_product(a.hi, b.hi);
  Span all = {down(std::min({p, q, r, s})), up(std::max({p, q, r, s}))};
  // The product of factors with equal signs is not negative: outward rounding must not cross 0.
  if ((a.lo >= 0 && b.lo >= 0) || (a.hi <= 0 && b.hi <= 0)) all.lo = std::max(all.lo, 0.0);
  if ((a.lo >= 0 && b.hi <= 0) || (a.hi <= 0 && b.lo >= 0)) all.hi = std::min(all.hi, 0.0);
  return all;
}
inline Span operator*(const Span& a, double b) { return a * Span{b, b}; }
inline Span square(const Span& a) {
  const double p = a.lo * a.lo, q = a.hi * a.hi;
  const bool zero = a.lo <= 0 && a.hi >= 0;
  return {zero ? 0 : std::max(0.0, down(std::min(p, q))), up(std::max(p, q))};
}
/// Product of ranges of words, which doubles hold exactly: no outward rounding.
inline Span exact_product(const Span& a, const Span& b, bool same) {
  const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
  if (same) return {a.lo <= 0 && a.hi >= 0 ? 0 : std::min(p, s), std::max(p, s)};
  return {std::min({p, q, r, s}), std::max({p, q, r, s})};
}

/// The truth of a < b: 1, 0, or both.
inline Span truth_of_less(const Span& a, const Span& b) {
  if (a.hi < b.lo) return {1, 1};
  if (a.lo >= b.hi) return {0, 0};
  return {0, 1};
}
inline Span least(const Span& a, const Span& b) {
  return {std::min(a.lo, b.lo), std::min(a.hi, b.hi)};
}
inline Span most(const Span& a, const Span& b) {
  return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
}
inline Span amount(const Span& a) {
  if (a.lo >= 0) return a;
  if (a.hi <= 0) return -a;
  return {0, std::max(-a.lo, a.hi)};
}
/// 1/a; the whole line if `a` contains 0.
inline Span inverse(const Span& a) {
  if (a.lo <= 0 && a.hi >= 0) return whole_line();
  const Span i = {down(1 / a.hi), up(1 / a.lo)};
  return a.lo > 0 ? Span{std::max(0.0, i.lo), i.hi} : Span{i.lo, std::min(0.0, i.hi)};
}
/// Square root of the part of `a` that is not negative.
inline Span root(const Span& a) {
  return {std::max(0.0, down(std::sqrt(std::max(a.lo, 0.0)))), up(std::sqrt(std::max(a.hi, 0.0)))};
}
/// Moves x by four doubles towards `way`: exp, log, atan, sin and cos of the C library err by less
/// than one double.
inline double four_steps(double x, double way) {
  for (int i = 0; i < 4; ++i) x = way > 0 ? up(x) : down(x);
  return x;
}
inline Span exponential(const Span& a) {
  return {std::max(0.0, four_steps(std::exp(a.lo), -infinity)),
          four_steps(std::exp(a.hi), infinity)};
}
/// Logarithm of the part of `a` above 0.
inline Span logarithm(const Span& a) {
  return {a.lo > 0 ? four_steps(std::log(a.lo), -infinity) : -infinity,
          a.hi > 0 ? four_steps(std::log(a.hi), infinity) : infinity};
}
inline Span arctangent(const Span& a) {
  return {four_steps(std::atan(a.lo), -infinity), four_steps(std::atan(a.hi), infinity)};
}
inline Span cosine(const Span& a) {
  if (!(a.width() < 6.28)) return {-1, 1};
  constexpr double slack = 1e-15;
  const double size = a.size() * 1e-15;  // error of the argument reduction
  Span r = hull({std::cos(a.lo), std::cos(a.lo)}, {std::cos(a.hi), std::cos(a.hi)});
  const double first = std::ceil((a.lo - size) / pi - 1e-12);
  for (double k = first; k * pi <= a.hi + size + 1e-12; ++k) {
    r = hull(r, std::fmod(k, 2) == 0 ? Span{1, 1} : Span{-1, -1});
  }
  return both_of(wider(r, slack + size), {-1, 1});
}
inline Span sine(const Span& a) { return cosine(a - Span{down(pi / 2), up(pi / 2)}); }

/// A function's value, slope and curvature over a span of its argument.
struct Jet {
  Span v, d1, d2;
};
inline Jet constant_jet(double c) { return {{c, c}, {0, 0}, {0, 0}}; }
inline Jet operator+(const Jet& a, const Jet& b) { return {a.v + b.v, a.d1 + b.d1, a.d2 + b.d2}; }
inline Jet operator-(const Jet& a, const Jet& b) { return {a.v - b.v, a.d1 - b.d1, a.d2 - b.d2}; }
inline Jet operator-(const Jet& a) { return {-a.v, -a.d1, -a.d2}; }
inline Jet operator*(const Jet& a, const Jet& b) {
  return {a.v * b.v, a.d1 * b.v + a.v * b.d1, a.d2 * b.v + a.d1 * b.d1 * 2.0 + a.v * b.d2};
}
/// f(a) from f, f', f'' over a.v.
inline Jet chain(const Jet& a, const Span& f, const Span& f1, const Span& f2) {
  return {f, f1 * a.d1, f2 * square(a.d1) + f1 * a.d2};
}
inline Jet inverse(const Jet& a) {
  const Span i = inverse(a.v);
  return chain(a, i, -(i * i), i * i * i * 2.0);
}
inline Jet root(const Jet& a) {
  const Span r = root(a.v);
  if (r.lo <= 0) return {r, whole_line(), whole_line()};
  const Span i = inverse(r);
  return chain(a, r, i * 0.5, -(i * i * i) * 0.25);
}
inline Jet exponential(const Jet& a) {
  const Span e = exponential(a.v);
  return chain(a, e, e, e);
}
inline Jet logarithm(const Jet& a) {
  const Span i = inverse(a.v);
  return chain(a, logarithm(a.v), i, -square(i));
}
inline Jet arctangent(const Jet& a) {
  const Span i = inverse(Span{1, 1} + square(a.v));
  return chain(a, arctangent(a.v), i, a.v * square(i) * -2.0);
}
inline Jet sine(const Jet& a) { return chain(a, sine(a.v), cosine(a.v), -sine(a.v)); }
inline Jet cosine(const Jet& a) { return chain(a, cosine(a.v), -sine(a.v), -cosine(a.v)); }
/// The jet of a selection whose choice is unknown: it has a kink, so its curvature is unbounded.
inline Jet either_of(const Jet& a, const Jet& b, const Span& v) {
  return {v, hull(a.d1, b.d1), whole_line()};
}
inline Jet least(const Jet& a, const Jet& b) {
  if (a.v.hi <= b.v.lo) return a;
  if (b.v.hi <= a.v.lo) return b;
  return either_of(a, b, least(a.v, b.v));
}
inline Jet most(const Jet& a, const Jet& b) {
  if (a.v.hi <= b.v.lo) return b;
  if (b.v.hi <= a.v.lo) return a;
  return either_of(a, b, most(a.v, b.v));
}
inline Jet amount(const Jet& a) {
  if (a.v.lo >= 0) return a;
  if (a.v.hi <= 0) return -a;
  return either_of(a, -a, amount(a.v));
}

}  // namespace feltgate::law
