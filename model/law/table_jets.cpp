// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: 2026 the feltgate authors
//
// Values and slopes of a table's function over a range of its argument. Documentation:
// docs/laws.md
#include <algorithm>
#include <cmath>

#include "law/ranges.hpp"

namespace feltgate::law {

namespace {

/// Evaluates the nodes of a table's body by jets; `argument` is the variable.
class Body {
 public:
  Body(const Law& law, const Table& table, const Jet& argument)
      : law_(law), table_(table), argument_(argument) {}

  Jet jet(NodeId id) const {
    const Node& n = law_.nodes[at(id)];
    if (id == table_.argument) return argument_;
    const auto arg = [&](int i) { return jet(n.arguments[at(i)]); };
    switch (n.op) {
      case Op::constant:
        return constant_jet(n.value);
      case Op::add:
        return arg(0) + arg(1);
      case Op::subtract:
        return arg(0) - arg(1);
      case Op::multiply: {
        if (n.arguments[0] == n.arguments[1]) {
          Jet a = arg(0), r = a * a;
          r.v = square(a.v);
          return r;
        }
        return arg(0) * arg(1);
      }
      case Op::negate:
        return -arg(0);
      case Op::absolute:
        return amount(arg(0));
      case Op::minimum:
        return least(arg(0), arg(1));
      case Op::maximum:
        return most(arg(0), arg(1));
      case Op::less:
        return {truth_of_less(arg(0).v, arg(1).v), {0, 0}, {0, 0}};
      case Op::both:
        return {least(arg(0).v, arg(1).v), {0, 0}, {0, 0}};
      case Op::either:
        return {most(arg(0).v, arg(1).v), {0, 0}, {0, 0}};
      case Op::opposite: {
        const Span a = arg(0).v;
        return {{1 - a.hi, 1 - a.lo}, {0, 0}, {0, 0}};
      }
      case Op::select: {
        const Span c = arg(0).v;
        if (c.lo > 0) return arg(1);
        if (c.hi <= 0) return arg(2);
        // The two values may not join: there is no slope either.
        return {hull(arg(1).v, arg(2).v), whole_line(), whole_line()};
      }
      case Op::sine:
      case Op::cosine:
      case Op::root:
      case Op::reciprocal:
      case Op::exponential:
      case Op::logarithm:
      case Op::arctangent:
        return function_of(n.op, arg(0));
      case Op::lookup: {
        const Table& t = law_.tables[at(n.index)];
        Jet a = arg(0);
        if (!t.periodic) {
          a = most(least(a, constant_jet(t.domain.upper)), constant_jet(t.domain.lower));
        }
        const Jet inner = table_jet(law_, t, a.v);
        return chain(a, inner.v, inner.d1, inner.d2);
      }
      default:
        throw Refused(
            n.place, "a table is a function of its variable alone",
            "take parameters, inputs and states out of it, as factors or in its argument");
    }
  }

 private:
  const Law& law_;
  const Table& table_;
  Jet argument_;
};

/// The piecewise line through points. A span that passes a corner by only the rounding of doubles
/// counts as lying on one side.
Jet points_jet(const Table& table, const Span& x) {
  const double width = (table.domain.upper - table.domain.lower) / table.segments;
  const auto place = [&](double at) { return (at - table.domain.lower) / width; };
  constexpr double slack = 1e-9;
  const double most = table.segments - 1.0;
  const auto first = static_cast<int>(std::clamp(std::floor(place(x.lo) + slack), 0.0, most));
  const auto last =
      std::max(first, static_cast<int>(std::clamp(std::ceil(place(x.hi) - slack) - 1, 0.0, most)));
  Jet j{{infinity, -infinity}, {infinity, -infinity}, {0, 0}};
  for (int i = first; i <= last; ++i) {
    const double from = table.points[at(i)], rise = table.points[at(i + 1)] - from;
    const Span part{std::max(place(x.lo), static_cast<double>(i)), std::min(place(x.hi), i + 1.0)};
    const double lo = std::clamp(part.lo - i, 0.0, 1.0), hi = std::clamp(part.hi - i, lo, 1.0);
    const double a = from + rise * lo, b = from + rise * hi;
    j.v = hull(j.v, {down(std::min(a, b)), up(std::max(a, b))});
    j.d1 = hull(j.d1, {down(rise / width), up(rise / width)});
  }
  if (first != last) j.d2 = {-infinity, infinity};
  return j;
}

Jet within(const Law& law, const Table& table, const Span& argument) {
  if (!table.points.empty()) return points_jet(table, argument);
  return Body(law, table, {argument, {1, 1}, {0, 0}}).jet(table.body);
}

/// The jet of a periodic table for any argument. An excess over its end by only the rounding of
/// doubles is ignored.
Jet around(const Law& law, const Table& table, const Span& argument) {
  const Span domain{table.domain.lower, table.domain.upper};
  const double period = domain.width();
  const auto joined = [&](const Span& a, const Span& b) {
    const Jet first = within(law, table, a), second = within(law, table, b);
    return either_of(first, second, hull(first.v, second.v));
  };
  if (!(argument.width() < period)) return joined(domain, domain);
  const double back = period * std::floor((argument.lo - domain.lo) / period + 1e-12);
  const Span x{std::max(domain.lo, argument.lo - back), argument.hi - back};
  if (x.hi <= domain.hi + 1e-12 * period) {
    const double hi = std::clamp(x.hi, x.lo, std::max(x.lo, domain.hi));
    return within(law, table, both_of({x.lo, hi}, domain));
  }
  return joined({x.lo, domain.hi}, {domain.lo, std::min(domain.hi, x.hi - period)});
}

}  // namespace

Jet table_jet(const Law& law, const Table& table, const Span& argument) {
  return table.periodic ? around(law, table, argument) : within(law, table, argument);
}

double table_value(const Law& law, const Table& table, double argument) {
  const Span v = table_jet(law, table, {argument, argument}).v;
  return v.middle();
}

}  // namespace feltgate::law
