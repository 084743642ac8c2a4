// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Intervals of double that contain the exact result of every operation: each end is computed to
// nearest and moved one step outward, so no rounding mode of the processor is touched and no
// compiler can undo it. Documentation: docs/error-bounds.md
#pragma once

#include <boost/numeric/interval.hpp>
#include <cmath>
#include <limits>

namespace feltgate::bounds {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Rounding policy of Boost.Interval: round to nearest, then one step outward. To nearest errs by
/// at most half a step, so the result is rigorous wherever IEEE arithmetic holds (no -ffast-math).
struct Outward {
  using unprotected_rounding = Outward;
  static double down(double x) {
    return std::nextafter(x, -std::numeric_limits<double>::infinity());
  }
  static double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
  void init() {}
  template <class U>
  double conv_down(U const& v) {
    return down(static_cast<double>(v));
  }
  template <class U>
  double conv_up(U const& v) {
    return up(static_cast<double>(v));
  }
  double add_down(double x, double y) { return down(x + y); }
  double add_up(double x, double y) { return up(x + y); }
  double sub_down(double x, double y) { return down(x - y); }
  double sub_up(double x, double y) { return up(x - y); }
  double mul_down(double x, double y) { return down(x * y); }
  double mul_up(double x, double y) { return up(x * y); }
  double div_down(double x, double y) { return down(x / y); }
  double div_up(double x, double y) { return up(x / y); }
  double median(double x, double y) { return (x + y) / 2; }
};

using Interval =
    boost::numeric::interval<double,
                             boost::numeric::interval_lib::policies<
                                 Outward, boost::numeric::interval_lib::checking_base<double>>>;

/// The largest magnitude in x.
inline double magnitude(const Interval& x) { return boost::numeric::norm(x); }

/// The set of numbers of at most this magnitude.
inline Interval within(const Interval& x) {
  const double m = magnitude(x);
  return {-m, m};
}

}  // namespace feltgate::bounds
