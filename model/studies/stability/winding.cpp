// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Counting and finding zeros by the argument principle. Documentation: docs/designs.md
#include "studies/stability/winding.hpp"

#include <algorithm>
#include <cmath>

namespace feltgate::stability {

namespace {

constexpr double two_pi = 6.283185307179586;

/// Change of the argument of f from a to b, halving the way until it turns little.
double turn(const AnalyticFunction& f, Complex a, Complex fa, Complex b, Complex fb, int depth) {
  const Complex middle = (a + b) / 2.0, fm = f(middle);
  const double first = std::arg(fm / fa), second = std::arg(fb / fm);
  if (depth == 0 || std::abs(first) + std::abs(second) < 0.5) return first + second;
  return turn(f, a, fa, middle, fm, depth - 1) + turn(f, middle, fm, b, fb, depth - 1);
}

double turn(const AnalyticFunction& f, Complex a, Complex b, int pieces) {
  double sum = 0;
  Complex from = a, f_from = f(a);
  for (int i = 1; i <= pieces; ++i) {
    const Complex to = a + (b - a) * (static_cast<double>(i) / pieces), f_to = f(to);
    sum += turn(f, from, f_from, to, f_to, 30);
    from = to;
    f_from = f_to;
  }
  return sum;
}

int zeros_of(const AnalyticFunction& f, Complex low, Complex high) {
  const Complex right{high.real(), low.imag()}, left{low.real(), high.imag()};
  const double angle = turn(f, low, right, 16) + turn(f, right, high, 16) +
                       turn(f, high, left, 16) + turn(f, left, low, 16);
  return static_cast<int>(std::lround(angle / two_pi));
}

/// Newton's method from the middle; keeps the middle where it leaves the rectangle.
Complex polished(const AnalyticFunction& f, Complex low, Complex high, bool* inside) {
  const Complex middle = (low + high) / 2.0;
  const double size = std::abs(high - low);
  Complex s = middle;
  for (int i = 0; i < 50; ++i) {
    const double h = 1e-5 * size;
    const Complex slope = (f(s + h) - f(s - h)) / (2 * h);
    if (slope == Complex{}) break;
    const Complex step = f(s) / slope;
    s -= step;
    if (std::abs(s - middle) > size) break;
    if (std::abs(step) < 1e-12 * size) break;
  }
  *inside = s.real() >= low.real() && s.real() <= high.real() && s.imag() >= low.imag() &&
            s.imag() <= high.imag();
  return *inside ? s : middle;
}

void collect(const AnalyticFunction& f, Complex low, Complex high, int count, double smallest,
             std::vector<Complex>& found) {
  if (count <= 0) return;
  const Complex size = high - low;
  const bool small = std::abs(size) < smallest;
  if (count == 1 || small) {
    bool inside = false;
    Complex zero = polished(f, low, high, &inside);
    if (inside || small) {
      // On the real axis but for rounding.
      if (std::abs(zero.imag()) < 1e-6 * std::abs(size)) zero.imag(0);
      found.insert(found.end(), static_cast<std::size_t>(count), zero);
      return;
    }
  }
  // Cut the longer side, away from the middle, where symmetric functions have their real zeros.
  const double at = 0.4871;
  const bool upright = size.imag() > size.real();
  const Complex cut_high = upright ? Complex{high.real(), low.imag() + at * size.imag()}
                                   : Complex{low.real() + at * size.real(), high.imag()};
  const Complex cut_low =
      upright ? Complex{low.real(), cut_high.imag()} : Complex{cut_high.real(), low.imag()};
  const int lower = zeros_of(f, low, cut_high);
  collect(f, low, cut_high, lower, smallest, found);
  collect(f, cut_low, high, count - lower, smallest, found);
}

}  // namespace

int zeros_right_of(const AnalyticFunction& f, double real, double top, int pieces) {
  double angle = 0, imag = 0;
  Complex at = f({real, 0});
  while (imag < top) {
    const double step = std::min(std::max(1e-4, 0.05 * imag), top / pieces);
    const double next = std::min(top, imag + step);
    const Complex f_next = f({real, next});
    angle += turn(f, {real, imag}, at, {real, next}, f_next, 30);
    imag = next;
    at = f_next;
  }
  // Upwards with the region on the right: clockwise; the mirrored half turns as much.
  return static_cast<int>(std::lround(-2 * angle / two_pi));
}

std::vector<Complex> zeros_in(const AnalyticFunction& f, Complex low, Complex high) {
  std::vector<Complex> found;
  collect(f, low, high, zeros_of(f, low, high), 1e-6 * std::abs(high - low), found);
  return found;
}

}  // namespace feltgate::stability
