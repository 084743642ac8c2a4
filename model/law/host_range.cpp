// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
#include "law/derive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace feltgate::law {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Range wider(double lower, double upper) {
  if (!(lower >= -kLargest) || !(upper <= kLargest)) {
    throw NoRange{"a formula of parameters that gets too large",
                  "make the parameters' ranges smaller"};
  }
  // An end of 0 comes from a factor 0 or from an exact difference: it needs no rounding.
  return {lower == 0 ? 0 : std::nextafter(lower, -kInfinity),
          upper == 0 ? 0 : std::nextafter(upper, kInfinity)};
}

Range range_of_product(const Range& a, const Range& b) {
  const auto [low, high] =
      std::minmax({a.lower * b.lower, a.lower * b.upper, a.upper * b.lower, a.upper * b.upper});
  return wider(low, high);
}

Range square(const Range& a) {
  const double most = std::max(a.lower * a.lower, a.upper * a.upper);
  const bool over_zero = a.lower <= 0 && a.upper >= 0;
  const Range r = wider(std::min(a.lower * a.lower, a.upper * a.upper), most);
  return {over_zero ? 0 : r.lower, r.upper};
}

Range join(const Range& a, const Range& b) {
  return {std::min(a.lower, b.lower), std::max(a.upper, b.upper)};
}

}  // namespace

Range host_range(const Law& law, const Node& n, const std::vector<Range>& ranges) {
  const auto argument = [&](std::size_t i) {
    return ranges[static_cast<std::size_t>(n.arguments[i])];
  };
  const Range a = n.arguments.empty() ? Range{} : argument(0);
  const Range b = n.arguments.size() < 2 ? Range{} : argument(1);
  switch (n.op) {
    case Op::constant:
      return {n.value, n.value};
    case Op::parameter:
      return law.parameters[static_cast<std::size_t>(n.index)].range;
    case Op::add:
      return wider(a.lower + b.lower, a.upper + b.upper);
    case Op::subtract:
      return wider(a.lower - b.upper, a.upper - b.lower);
    case Op::multiply:
      return n.arguments[0] == n.arguments[1] ? square(a) : range_of_product(a, b);
    case Op::negate:
      return {0 - a.upper, 0 - a.lower};
    case Op::absolute:
      return {a.lower > 0 ? a.lower : a.upper < 0 ? -a.upper : 0, std::max(-a.lower, a.upper)};
    case Op::minimum:
      return {std::min(a.lower, b.lower), std::min(a.upper, b.upper)};
    case Op::maximum:
      return {std::max(a.lower, b.lower), std::max(a.upper, b.upper)};
    case Op::select:
      return join(b, argument(2));
    case Op::less:
    case Op::both:
    case Op::either:
    case Op::opposite:
      return {0, 1};
    case Op::sine:
    case Op::cosine:
      return {-1, 1};
    case Op::root:
      if (a.lower < 0) {
        throw NoRange{"the square root of parameters that may be below 0",
                      "begin their ranges at 0, or write sqrt(max(x, 0))"};
      }
      return {std::max(0.0, wider(std::sqrt(a.lower), 0).lower),
              wider(0, std::sqrt(a.upper)).upper};
    case Op::reciprocal:
      if (a.lower <= 0 && a.upper >= 0) {
        throw NoRange{"a division by parameters that may be 0", "let their ranges not hold 0"};
      }
      return wider(1 / a.upper, 1 / a.lower);
    case Op::exponential: {
      const Range r = wider(std::exp(a.lower), std::exp(a.upper));
      return {std::max(0.0, r.lower), r.upper};
    }
    case Op::logarithm:
      if (a.lower <= 0) {
        throw NoRange{"the logarithm of parameters that may be 0 or below",
                      "begin their ranges above 0, or write log(max(x, 0.01))"};
      }
      return wider(std::log(a.lower), std::log(a.upper));
    case Op::element: {
      const auto& values = law.arrays[static_cast<std::size_t>(n.index)].values;
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      return {*low, *high};
    }
    case Op::lookup:
      if (!law.tables[static_cast<std::size_t>(n.index)].points.empty()) {
        throw NoRange{"a table of what only depends on parameters",
                      "make what it gives the parameter, or write its lines with if"};
      }
      break;
    case Op::arctangent:
    case Op::input:
    case Op::state:
    case Op::line_read:
      break;
  }
  throw NoRange{"a table of what only depends on parameters",
                "write its formula in its place; the host computes that"};
}

}  // namespace feltgate::law
